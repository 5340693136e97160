"""Run many schemes on many data sets, in parallel, and never the same run twice."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from pathlib import Path

import pandas as pd

from workbench.errors import WorkbenchError
from workbench.experiments.runs.base import Run, content_key, space_checksum
from workbench.experiments.runs.shared import SharedSteps
from workbench.experiments.store import Arrays, ResultStore, Row
from workbench.experiments.versions import versions


@dataclass(frozen=True)
class Advance:
    """How far a grid is.

    Attributes
    ----------
    finished, total : int
        Runs.
    share : float
        Estimated share of the work that is done, from 0 to 1; what was found finished is no
        work.
    what : str
        What was just finished.
    """

    finished: int
    total: int
    share: float
    what: str


Progress = Callable[[Advance], None]

#: Columns that every table of results has, and has first.
_COLUMNS = (
    "key",
    "status",
    "message",
    "dataset",
    "scheme",
    "ratio",
    "count",
    "seed",
    "standardize",
    "n_samples",
    "n_control_points",
    "error",
    "relative_error",
    "seconds_total",
)

_Keyed = tuple[str, Run]
_Data = tuple[str, bool]


def run_grid(
    runs: Iterable[Run],
    folder: str | Path,
    *,
    n_jobs: int = 1,
    progress: Progress | None = None,
) -> pd.DataFrame:
    """Execute runs and gather their results in one table.

    Each finished run is stored at once, under a key made of the run, the content of its
    data, the code and the versions that compute it, and is never computed again: a grid that
    was interrupted, however abruptly, goes on where it was. Runs on one data set are executed
    together, so that its distances and projections are computed once; data sets are
    distributed over the processes, the largest first, one numerical thread each.

    Parameters
    ----------
    runs : iterable of Run
        What to run, of one kind or several; repetitions are dropped.
    folder : path-like
        Where results are kept. All results in it are also gathered in ``runs.parquet``.
    n_jobs : int
        Number of processes, -1 for all cores. With 1 the runs execute in this process,
        where methods registered in it are known too.
    progress : callable, optional
        Called with an :class:`Advance` at the start and whenever runs are finished.

    Returns
    -------
    DataFrame
        One row for each run, in the order given: its values as
        its ``execute`` lists them, ``key``, ``status``
        ("done" or "failed") and ``message`` (why it failed). A run that fails does not
        keep the others from running, and is tried again next time.

    Raises
    ------
    WorkbenchError
        If ``n_jobs`` is neither positive nor -1.
    """
    if n_jobs < 1 and n_jobs != -1:
        raise WorkbenchError(f"n_jobs: got {n_jobs}, want a positive number, or -1 for all cores")
    wanted = list(dict.fromkeys(runs))
    store = ResultStore(folder)
    keyed, sizes, rows = _identify(wanted)
    for run, key in keyed.items():
        stored = store.read(key)
        if stored is not None:
            rows[run] = _done(key, stored)
    groups = _groups([(key, run) for run, key in keyed.items() if run not in rows], sizes)
    work = {run: float(sizes[run.dataset, run.standardize]) for group in groups for _, run in group}
    report = _Reporter(progress, len(wanted), work)
    report(len(rows), [], f"{len(keyed) - len(work)} found finished")
    for finished in _execute_groups(groups, store.folder, n_jobs):
        rows.update(finished)
        report(len(rows), finished, _summary(finished))
    for run, key in keyed.items():
        if run not in rows:
            stored = store.read(key)
            rows[run] = (
                _done(key, stored)
                if stored is not None
                else _failed(run, key, "the process that ran it ended (out of memory?)")
            )
    if keyed:
        store.write_table()
    table = pd.DataFrame([rows[run] for run in wanted])
    # Where nothing was run or all failed, a reader still finds the columns that it asks for.
    return table.reindex(columns=list(dict.fromkeys([*_COLUMNS, *table.columns])))


class _Reporter:
    """Turn finished runs into calls of a progress function, where there is one."""

    def __init__(self, progress: Progress | None, total: int, work: dict[Run, float]) -> None:
        self._progress = progress
        self._total = total
        self._work = work
        self._done = 0.0

    def __call__(self, finished: int, runs: Iterable[Run], what: str) -> None:
        self._done += sum(self._work.get(run, 0.0) for run in runs)
        all_work = sum(self._work.values())
        share = self._done / all_work if all_work else 1.0
        if self._progress is not None:
            self._progress(Advance(finished, self._total, share, what))


def describe_failures(table: pd.DataFrame) -> str:
    """Say in a sentence how many runs of a grid failed and why the first did.

    Parameters
    ----------
    table : DataFrame
        From :func:`run_grid`.

    Returns
    -------
    str
        Empty if none failed.
    """
    failed = table[table["status"] == "failed"]
    if failed.empty:
        return ""
    return f"{len(failed)} of {len(table)} runs failed; the first: {failed['message'].iloc[0]}"


def _identify(
    runs: Sequence[Run],
) -> tuple[dict[Run, str], dict[_Data, int], dict[Run, Row]]:
    """Find the key of each run and the size of its data, and the rows of those without data."""
    from workbench.datasets import load_space

    keyed: dict[Run, str] = {}
    sizes: dict[_Data, int] = {}
    failed: dict[Run, Row] = {}
    by_data: dict[_Data, list[Run]] = {}
    for run in runs:
        by_data.setdefault((run.dataset, run.standardize), []).append(run)
    for (dataset, standardize), group in by_data.items():
        try:
            space = load_space(dataset, standardize=standardize)
        except (WorkbenchError, OSError) as error:
            failed.update({run: _failed(run, "", str(error)) for run in group})
            continue
        checksum = space_checksum(space)
        sizes[dataset, standardize] = len(space)
        keyed.update({run: content_key(run, checksum) for run in group})
    return keyed, sizes, failed


def _groups(runs: Sequence[_Keyed], sizes: dict[_Data, int]) -> list[list[_Keyed]]:
    """Put the runs of one data set together, the data sets that take longest first."""
    groups: dict[_Data, list[_Keyed]] = {}
    for key, run in runs:
        groups.setdefault((run.dataset, run.standardize), []).append((key, run))
    return sorted(
        groups.values(),
        key=lambda group: -len(group) * sizes[group[0][1].dataset, group[0][1].standardize] ** 2,
    )


def _execute_groups(
    groups: Sequence[list[_Keyed]], folder: Path, n_jobs: int
) -> Iterator[dict[Run, Row]]:
    if n_jobs == 1 or len(groups) < 2:
        for group in groups:
            yield from _execute_group(group, folder)
        return
    unfinished = list(groups)
    try:
        for rows in _execute_in_processes(groups, folder, n_jobs):
            unfinished = [group for group in unfinished if group[0][1] not in rows]
            yield rows
    except BrokenProcessPool:
        warnings.warn(
            "a worker process ended; what was not finished is run again, one data set at a time",
            stacklevel=2,
        )
    else:
        return
    # The end of one worker ends the whole pool. Alone in a pool, a group can only end itself.
    for group in unfinished:
        try:
            yield from _execute_in_processes([group], folder, n_jobs)
        except BrokenProcessPool:
            names = f"{group[0][1].dataset} ({len(group)} runs)"
            # What was stored before counts; the caller names the runs that are missing.
            warnings.warn(f"the worker process of {names} ended", stacklevel=2)


def _execute_in_processes(
    groups: Sequence[list[_Keyed]], folder: Path, n_jobs: int
) -> Iterator[dict[Run, Row]]:
    from joblib import Parallel, delayed, parallel_config

    with parallel_config("loky", n_jobs=n_jobs, inner_max_num_threads=1):
        pool = Parallel(return_as="generator_unordered")
        yield from pool(delayed(_execute_whole_group)(group, folder) for group in groups)


def _execute_whole_group(group: Sequence[_Keyed], folder: Path) -> dict[Run, Row]:
    rows: dict[Run, Row] = {}
    for row in _execute_group(group, folder):
        rows.update(row)
    return rows


def _execute_group(group: Sequence[_Keyed], folder: Path) -> Iterator[dict[Run, Row]]:
    """Execute the runs of one data set, storing each as soon as it is finished."""
    from workbench.datasets import load_space

    store = ResultStore(folder)
    shared: SharedSteps | None = None
    for key, run in group:
        # Another process may have finished it since the grid was planned.
        row = store.read(key)
        if row is None:
            try:
                if shared is None:
                    space = load_space(run.dataset, standardize=run.standardize)
                    shared = SharedSteps(space)
                row, arrays = _execute(run, shared)
                store.write(key, row, arrays)
            except Exception as error:  # whatever a method raises must not stop the others
                yield {run: _failed(run, key, f"{type(error).__name__}: {error}")}
                continue
        yield {run: _done(key, row)}


def _execute(run: Run, shared: SharedSteps) -> tuple[Row, Arrays]:
    values, arrays = run.execute(shared)
    made_with = {f"version_{name}": value for name, value in versions().items()}
    return {**run.specification(), **values, **made_with}, arrays


def _done(key: str, row: Row) -> Row:
    return {"key": key, "status": "done", "message": "", **row}


def _failed(run: Run, key: str, message: str) -> Row:
    return {
        "key": key,
        "status": "failed",
        "message": f"{run}: {message}",
        **run.specification(),
    }


def _summary(rows: dict[Run, Row]) -> str:
    names = sorted({run.dataset for run in rows})
    failed = sum(row["status"] == "failed" for row in rows.values())
    return ", ".join(names) + (f" ({failed} failed)" if failed else "")
