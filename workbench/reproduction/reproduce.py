"""Remake figures and tables of the theses into one folder with a report."""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from joblib import effective_n_jobs

from workbench.errors import WorkbenchError
from workbench.experiments.progress import ProgressLine, duration
from workbench.files import write_atomically
from workbench.reproduction.images import write_pngs
from workbench.reproduction.items import (
    EXTRAS,
    ITEMS,
    NOTEBOOKS,
    Item,
    item_state,
    select_items,
)
from workbench.reproduction.notebooks import run_notebook, this_interpreter
from workbench.reproduction.outputs import forget, read_parts
from workbench.reproduction.profiles import fetch_tables
from workbench.reproduction.report import write_report
from workbench.resources import bundled

if TYPE_CHECKING:
    from workbench.experiments.runs.base import Run

PROFILES = ("quick", "full")


@dataclass(frozen=True)
class ReproductionReport:
    """How a reproduction ended.

    Attributes
    ----------
    out : Path
        The output folder.
    index : Path
        The report, to be opened in a browser.
    states : dict of str to str
        "done", "missing" or "failed" for each item that was asked for.
    errors : dict of str to str
        Last lines of the error of each notebook that failed.
    notices : tuple of str
        What the reader should know, such as that there are no PNG images.
    seconds : float
        Time taken.
    """

    out: Path
    index: Path
    states: dict[str, str]
    errors: dict[str, str]
    notices: tuple[str, ...]
    seconds: float

    @property
    def failed(self) -> bool:
        """Whether a notebook failed; the command line then ends with a status above 0."""
        return bool(self.errors)


def print_progress(message: str) -> None:
    """Print a progress message on stderr."""
    print(message, file=sys.stderr, flush=True)  # noqa: T201 - its purpose


def reproduce(
    ids: Sequence[str] | None = None,
    *,
    profile: str = "quick",
    jobs: int = -1,
    scheduler: str | None = None,
    out: str | Path = "reproduction",
    seed: int = 0,
    study: str | Path | None = None,
    progress: Callable[[str], None] = print_progress,
) -> ReproductionReport:
    """Run the notebooks that make figures and tables, and write the report.

    What the notebooks read is computed first, for all of them at once, so that a run that
    several of them want is executed once. A notebook that fails does not keep the others from
    running; its error is in the report. Runs that were finished before, in the same output
    folder, are not computed again.

    Parameters
    ----------
    ids : sequence of str, optional
        Such as ``["costa2018:fig5.3"]``; all figures and tables if None or empty.
    profile : {"quick", "full"}
        Bundled data, within minutes; or all data found.
    jobs : int
        Number of processes, -1 for all cores.
    scheduler : str, optional
        Address of a Dask scheduler, such as ``"tcp://127.0.0.1:8786"``, on whose workers the
        runs are executed in place of processes of this machine.
    out : path-like
        Output folder; what is in it and not remade is kept.
    seed : int
        Seed of everything random.
    study : path-like, optional
        A file of answers of a user study, to be shown beside the published comparisons.
    progress : callable
        Called with one line at a time; by default they are printed on stderr.

    Returns
    -------
    ReproductionReport

    Raises
    ------
    WorkbenchError
        If an id, the profile or the number of jobs is not valid, or the output folder
        cannot be written.
    """
    if profile not in PROFILES:
        raise WorkbenchError(f"profile: got {profile!r}, want one of {', '.join(PROFILES)}")
    if jobs < 1 and jobs != -1:
        raise WorkbenchError(f"jobs: got {jobs}, want a positive number, or -1 for all cores")
    return reproduce_items(
        select_items(list(ids or ())),
        bundled("notebooks"),
        profile=profile,
        jobs=jobs,
        scheduler=scheduler,
        out=out,
        seed=seed,
        study=study,
        progress=progress,
    )


def reproduce_items(
    items: Sequence[Item],
    notebooks: Path,
    *,
    profile: str,
    jobs: int,
    out: str | Path,
    seed: int,
    progress: Callable[[str], None],
    scheduler: str | None = None,
    study: str | Path | None = None,
) -> ReproductionReport:
    """Run the notebooks of given items, from a given folder; otherwise as :func:`reproduce`."""
    start = time.perf_counter()
    folder = Path(out).expanduser().resolve()
    _check_writable(folder)
    # With all items of a notebook come its extras; with some of them, they alone.
    names = list(dict.fromkeys(item.notebook for item in items))
    partly = {item.notebook for item in ITEMS if item not in items}
    whole = [name for name in names if name not in partly]
    wanted = [*items, *(extra for extra in EXTRAS if extra.notebook in whole)]
    # What kernels are copied from gets ready while runs are planned and executed.
    with this_interpreter():
        for table in fetch_tables(_tables_of(names)):
            progress(f"{table} is not here nor to be had within seconds: going on without it")
        results = folder / "results"
        computed = _execute_runs(
            whole, results, profile=profile, seed=seed, jobs=jobs, scheduler=scheduler, say=progress
        )
        tasks = {}
        for name in names:
            mine = [item.id for item in wanted if item.notebook == name]
            tasks[name] = {
                "profile": profile,
                "seed": seed,
                "jobs": 1 if name in computed else jobs,
                "scheduler": None if name in computed else scheduler,
                "out": str(folder),
                "results": str(results),
                "items": None if name in whole else mine,
                # The notebook runs in another folder than the one that the path may start from.
                "study": None if study is None else str(Path(study).expanduser().resolve()),
            }
        errors = _run_notebooks(notebooks, folder, tasks, wanted, jobs=jobs, say=progress)
    notices = _write_images(folder, jobs, progress)
    seconds = time.perf_counter() - start
    run = {"profile": profile, "seed": seed, "seconds": seconds, "notices": notices}
    write_atomically(folder / "run.json", json.dumps(run, indent=1).encode())
    made = {part["item"] for part in read_parts(folder)}
    known = [*ITEMS, *EXTRAS]
    shown = [item for item in known if item.id in made or item in wanted]
    index = write_report(folder, [*shown, *(item for item in wanted if item not in known)])
    progress(f"report: {index}")
    states = {item.id: item_state(item, folder) for item in items}
    return ReproductionReport(folder, index, states, errors, tuple(notices), seconds)


def _tables_of(names: Sequence[str]) -> list[str]:
    """Name the tables that are worth a download for some notebooks."""
    if not any(notebook.tables for notebook in NOTEBOOKS if notebook.name in names):
        return []
    from workbench.datasets import list_datasets

    return [s.entry.name for s in list_datasets() if s.entry.name.startswith("uci/")]


def _execute_runs(
    names: Sequence[str],
    results: Path,
    *,
    profile: str,
    seed: int,
    jobs: int,
    scheduler: str | None,
    say: Callable[[str], None],
) -> set[str]:
    """Execute the runs of some notebooks, each once; give the notebooks whose runs these were."""
    from workbench.experiments.grid import run_grid

    planned: dict[str, list[Run]] = {}
    for notebook in NOTEBOOKS:
        if notebook.name in names and notebook.runs:
            try:
                planned[notebook.name] = notebook.planned_runs(profile, seed)
            except WorkbenchError as error:
                # The notebook, run alone, says so too, and its error is in the report.
                say(f"{notebook.name}: {error}")
    runs = list(dict.fromkeys(run for mine in planned.values() for run in mine))
    if runs:
        say(f"runs that the notebooks read: {len(runs)}")
        with ProgressLine("  runs") as line:
            run_grid(runs, results, n_jobs=jobs, scheduler=scheduler, progress=line)
    return set(planned)


def _run_notebooks(
    notebooks: Path,
    folder: Path,
    tasks: dict[str, dict[str, Any]],
    wanted: Sequence[Item],
    *,
    jobs: int,
    say: Callable[[str], None],
) -> dict[str, str]:
    """Run notebooks, as many at once as there are jobs; give the errors of those that failed."""

    def run_one(name: str) -> str:
        say(f"{name} ({list(tasks).index(name) + 1} of {len(tasks)})")
        mine = [item.id for item in wanted if item.notebook == name]
        forget(folder, name, set(mine))
        began = time.perf_counter()
        error = run_notebook(
            notebooks / f"{name}.ipynb",
            folder,
            tasks[name],
            lambda line: say(f"  {name}: {line}"),
            items=mine,
        )
        took = duration(time.perf_counter() - began)
        ended = f"failed after {took}: {error.splitlines()[-1]}" if error else f"took {took}"
        say(f"  {name} {ended}")
        return error

    n_threads = effective_n_jobs(jobs)
    with ThreadPoolExecutor(n_threads) as pool:
        ended = dict(zip(tasks, pool.map(run_one, tasks), strict=True))
    return {name: error for name, error in ended.items() if error}


def _check_writable(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
        probe = folder / ".writable"
        probe.write_bytes(b"")
        probe.unlink()
    except OSError as error:
        raise WorkbenchError(f"out: cannot write to {folder} ({error.strerror})") from None


def _write_images(folder: Path, jobs: int, progress: Callable[[str], None]) -> list[str]:
    """Render the figures whose image is missing or older than the figure."""
    stale = []
    for figure in sorted((folder / "figures").glob("*.json")):
        image = figure.with_suffix(".png")
        if not image.exists() or image.stat().st_mtime < figure.stat().st_mtime:
            stale.append(figure)
    if stale:
        progress(f"rendering {len(stale)} images")
    notice = write_pngs(stale, jobs=effective_n_jobs(jobs))
    if not notice:
        return []
    progress(f"  {notice}")
    return [notice]
