"""Remake figures and tables of the theses into one folder with a report."""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from workbench.errors import WorkbenchError
from workbench.experiments.progress import duration
from workbench.files import write_atomically
from workbench.reproduction.costa2018.uci_projections import UCI_FIGURES
from workbench.reproduction.images import write_pngs
from workbench.reproduction.items import EXTRAS, ITEMS, Item, item_state, select_items
from workbench.reproduction.notebooks import run_notebook
from workbench.reproduction.outputs import forget, read_parts
from workbench.reproduction.profiles import fetch_tables
from workbench.reproduction.report import write_report
from workbench.resources import bundled

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
    out: str | Path = "reproduction",
    seed: int = 0,
    progress: Callable[[str], None] = print_progress,
) -> ReproductionReport:
    """Run the notebooks that make figures and tables, and write the report.

    A notebook that fails does not keep the others from running; its error is in the report.
    Runs that were finished before, in the same output folder, are not computed again.

    Parameters
    ----------
    ids : sequence of str, optional
        Such as ``["costa2018:fig5.3"]``; all figures and tables if None or empty.
    profile : {"quick", "full"}
        Bundled data, within minutes; or all data found.
    jobs : int
        Number of processes, -1 for all cores.
    out : path-like
        Output folder; what is in it and not remade is kept.
    seed : int
        Seed of everything random.
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
        out=out,
        seed=seed,
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
) -> ReproductionReport:
    """Run the notebooks of given items, from a given folder; otherwise as :func:`reproduce`."""
    start = time.perf_counter()
    folder = Path(out).expanduser().resolve()
    _check_writable(folder)
    # With all items of a notebook come its extras; with some of them, they alone.
    whole = {item.notebook for item in items} - {
        item.notebook for item in ITEMS if item not in items
    }
    wanted = [*items, *(extra for extra in EXTRAS if extra.notebook in whole)]
    parameters = {
        "profile": profile,
        "seed": seed,
        "jobs": jobs,
        "out": str(folder),
        "results": str(folder / "results"),
    }
    ids = [item.id for item in items]
    tables = [figure.dataset for figure in UCI_FIGURES if figure.item in ids]
    for table in fetch_tables(tables):
        progress(f"{table} is not here and was not to be had within seconds: going on without it")
    names = list(dict.fromkeys(item.notebook for item in items))
    errors = {}
    for number, name in enumerate(names, 1):
        progress(f"{name} ({number} of {len(names)})")
        mine = [item.id for item in wanted if item.notebook == name]
        forget(folder, name, set(mine))
        began = time.perf_counter()
        error = run_notebook(
            notebooks / f"{name}.ipynb",
            folder,
            {**parameters, "items": None if name in whole else mine},
            lambda line: progress(f"  {line}"),
            items=mine,
        )
        took = duration(time.perf_counter() - began)
        if error:
            errors[name] = error
            progress(f"  failed after {took}: {error.splitlines()[-1]}")
        else:
            progress(f"  finished in {took}")
    notices = _write_images(folder, progress)
    seconds = time.perf_counter() - start
    run = {"profile": profile, "seed": seed, "seconds": seconds, "notices": notices}
    write_atomically(folder / "run.json", json.dumps(run, indent=1).encode())
    made = {part["item"] for part in read_parts(folder)}
    earlier = [item for item in (*ITEMS, *EXTRAS) if item.id in made and item not in wanted]
    index = write_report(folder, [*wanted, *earlier])
    progress(f"report: {index}")
    states = {item.id: item_state(item, folder) for item in items}
    return ReproductionReport(folder, index, states, errors, tuple(notices), seconds)


def _check_writable(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
        probe = folder / ".writable"
        probe.write_bytes(b"")
        probe.unlink()
    except OSError as error:
        raise WorkbenchError(f"out: cannot write to {folder} ({error.strerror})") from None


def _write_images(folder: Path, progress: Callable[[str], None]) -> list[str]:
    """Render the figures whose image is missing or older than the figure."""
    stale = []
    for figure in sorted((folder / "figures").glob("*.json")):
        image = figure.with_suffix(".png")
        if not image.exists() or image.stat().st_mtime < figure.stat().st_mtime:
            stale.append(figure)
    if stale:
        progress(f"rendering {len(stale)} images")
    notice = write_pngs(stale)
    if not notice:
        return []
    for figure in stale:
        figure.with_suffix(".png").unlink(missing_ok=True)
    progress(f"  {notice}")
    return [notice]
