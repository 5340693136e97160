"""Run many schemes on many data sets, in parallel, and never the same run twice."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

import pandas as pd

from workbench.errors import WorkbenchError
from workbench.experiments.costs import Costs
from workbench.experiments.execution import Outcome, PlannedRun
from workbench.experiments.local import execute_here, execute_in_processes
from workbench.experiments.planning import Data, plan_tasks
from workbench.experiments.progress import Advance, Progress, Reporter
from workbench.experiments.runs.base import Run, content_key, space_checksum
from workbench.experiments.store import ResultStore, Row

__all__ = ["Advance", "Progress", "describe_failures", "run_grid"]

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


def run_grid(
    runs: Iterable[Run],
    folder: str | Path,
    *,
    n_jobs: int = 1,
    scheduler: str | None = None,
    progress: Progress | None = None,
) -> pd.DataFrame:
    """Execute runs and gather their results in one table.

    Each finished run is stored at once, under a key made of the run, the content of its
    data, the code and the versions that compute it, and is never computed again: a grid that
    was interrupted, however abruptly, goes on where it was. Runs that share the distances of
    a data set or a projection are executed together, what takes longest first. Libraries
    compute in one numerical thread, so that the values do not depend on how many processes
    there are, or where.

    Parameters
    ----------
    runs : iterable of Run
        What to run, of one kind or several; repetitions are dropped.
    folder : path-like
        Where results are kept. All results in it are also gathered in ``runs.parquet``.
    n_jobs : int
        Number of processes, -1 for all cores. With 1 the runs execute in this process,
        where methods registered in it are known too.
    scheduler : str, optional
        Address of a Dask scheduler, such as ``"tcp://127.0.0.1:8786"``, whose workers
        execute the runs in place of processes of this machine. They need this package in the
        same version and the data, in a ``WORKBENCH_DATA`` of their own; results are stored
        here.
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
        If ``n_jobs`` is neither positive nor -1, results cannot be stored in the folder, or
        the scheduler does not answer or has no workers.
    """
    if n_jobs < 1 and n_jobs != -1:
        raise WorkbenchError(f"n_jobs: got {n_jobs}, want a positive number, or -1 for all cores")
    wanted = list(dict.fromkeys(runs))
    store = ResultStore(folder)
    planned, sizes, rows = _plan(wanted)
    costs = Costs()
    missing = []
    for item in planned:
        stored = store.read(item.key)
        if stored is None:
            missing.append(item)
        else:
            rows[item.run] = _done(item.key, stored)
            _learn(costs, item, sizes, stored)
    work = {item.run: sizes[item.run.dataset, item.run.standardize] for item in missing}
    report = Reporter(progress, len(wanted), work, costs)
    report.start(f"{len(planned) - len(missing)} found finished")
    for outcome in _execute(missing, sizes, costs, store, n_jobs, scheduler):
        rows[outcome.planned.run] = _row(outcome)
        report.finished(outcome.planned.run, _seconds(outcome), _summary(outcome))
    if missing or (planned and not store.has_table()):
        _write_table(store)
    table = pd.DataFrame([rows[run] for run in wanted])
    # Where nothing was run or all failed, a reader still finds the columns that it asks for.
    return table.reindex(columns=list(dict.fromkeys([*_COLUMNS, *table.columns])))


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


def _plan(runs: Sequence[Run]) -> tuple[list[PlannedRun], dict[Data, int], dict[Run, Row]]:
    """Find the key of each run and the size of its data, and the rows of those without data."""
    from workbench.datasets import load_space

    planned: list[PlannedRun] = []
    sizes: dict[Data, int] = {}
    failed: dict[Run, Row] = {}
    by_data: dict[Data, list[Run]] = {}
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
        planned += [PlannedRun(run, content_key(run, checksum), checksum) for run in group]
    return planned, sizes, failed


def _execute(
    runs: Sequence[PlannedRun],
    sizes: dict[Data, int],
    costs: Costs,
    store: ResultStore,
    n_jobs: int,
    scheduler: str | None,
) -> Iterator[Outcome]:
    """Execute runs where they are to be executed, and store them."""
    if not runs:
        return
    store.require_writable()
    if scheduler is not None:
        from workbench.experiments.cluster import Cluster

        with Cluster(scheduler) as cluster:
            tasks = plan_tasks(runs, sizes, costs, cluster.n_workers())
            yield from cluster.execute(tasks, store)
        return
    if n_jobs == -1:
        from joblib import cpu_count

        n_jobs = cpu_count()
    tasks = plan_tasks(runs, sizes, costs, n_jobs)
    if n_jobs == 1 or len(tasks) == 1:
        yield from execute_here(tasks, store.folder)
    else:
        yield from execute_in_processes(tasks, store.folder, n_jobs)


def _write_table(store: ResultStore) -> None:
    """Gather all results of the folder; without room for the table they are there all the same."""
    try:
        store.write_table()
    except OSError as error:
        warnings.warn(f"{store.folder}: runs.parquet was not written ({error})", stacklevel=3)


def _learn(costs: Costs, planned: PlannedRun, sizes: dict[Data, int], row: Row) -> None:
    seconds = row.get("seconds_spent")
    if seconds is not None:
        run = planned.run
        costs.learn(run, sizes[run.dataset, run.standardize], seconds)


def _seconds(outcome: Outcome) -> float | None:
    return None if outcome.row is None else outcome.row.get("seconds_spent")


def _row(outcome: Outcome) -> Row:
    planned = outcome.planned
    if outcome.row is None:
        return _failed(planned.run, planned.key, outcome.message)
    return _done(planned.key, outcome.row)


def _done(key: str, row: Row) -> Row:
    return {"key": key, "status": "done", "message": "", **row}


def _failed(run: Run, key: str, message: str) -> Row:
    return {
        "key": key,
        "status": "failed",
        "message": f"{run}: {message}",
        **run.specification(),
    }


def _summary(outcome: Outcome) -> str:
    return outcome.planned.run.dataset + (" (failed)" if outcome.row is None else "")
