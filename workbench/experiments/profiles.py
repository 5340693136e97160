"""Profiles: which of the data on this machine an experiment uses."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING

from workbench.errors import DataError, WorkbenchError

if TYPE_CHECKING:
    from workbench.datasets import Status

#: Lengths of the 70 clips of Costa 2018, in frames.
SHORTEST, LONGEST = 129, 1146

#: Tables too large for the quick profile: Page blocks, 5473 rows, adds almost a minute on two
#: cores, most of it to measure the quality of its embeddings.
LARGE_TABLES = ("uci/page-blocks",)


def motion_clips(profile: str) -> list[str]:
    """Choose the clips of a profile.

    Parameters
    ----------
    profile : {"quick", "full"}
        ``quick``: the short excerpts of the bundled clips. ``full``: all clips found whose
        length is in the range of those of the thesis.

    Returns
    -------
    list of str
        Names of clips that are on this machine.

    Raises
    ------
    WorkbenchError
        If the profile is unknown, or there is no such clip.
    """
    present = [status for status in _present() if status.entry.name.startswith("cmu/")]
    if _is_quick(profile):
        names = [status.entry.name for status in present if status.entry.kind == "excerpt"]
    else:
        names = [
            status.entry.name
            for status in present
            if status.entry.kind == "motion" and SHORTEST <= _n_frames(status) <= LONGEST
        ]
    if not names:
        raise WorkbenchError(
            f"profile {profile!r}: found no clip of {SHORTEST} to {LONGEST} frames; name a folder "
            "with mocap/bvh/ in WORKBENCH_DATA, or take the quick profile"
        )
    return names


def absent_tables(profile: str, datasets: Iterable[str]) -> dict[str, str]:
    """Tell which tables a profile goes without, and why.

    Parameters
    ----------
    profile : {"quick", "full"}
        ``quick`` leaves out large tables; ``full`` takes all that are found.
    datasets : iterable of str
        Names of tables.

    Returns
    -------
    dict of str to str
        For each table that is not used the reason, one sentence.
    """
    quick = _is_quick(profile)
    present = {status.entry.name for status in _present()}
    reasons = {}
    for name in datasets:
        if quick and name in LARGE_TABLES:
            reasons[name] = f"{name} is too large for the quick profile; the full one uses it."
        elif name not in present:
            reasons[name] = (
                f"{name} is not on this machine; `workbench datasets fetch {name}` downloads it."
            )
    return reasons


def fetch_small_tables(
    datasets: Iterable[str], *, fetch: Callable[[str], object] | None = None
) -> list[str]:
    """Download small tables that are on this machine in no folder, if seconds suffice.

    The quick profile runs without them too, so a download that fails is no error.

    Parameters
    ----------
    datasets : iterable of str
        Names of tables; large ones are left out.
    fetch : callable, optional
        Downloads one table by name; by default within 5 seconds for each file.

    Returns
    -------
    list of str
        Tables that could not be had.
    """
    present = {status.entry.name for status in _present()}
    missed = []
    for name in datasets:
        if name not in present and name not in LARGE_TABLES:
            try:
                (fetch or _fetch_within_seconds)(name)
            except DataError:
                missed.append(name)
    return missed


def _fetch_within_seconds(name: str) -> None:
    from workbench.datasets.catalogue import lookup
    from workbench.datasets.download import download
    from workbench.datasets.search import cache_folder

    entry = lookup(name)
    assert entry is not None
    download(entry, cache_folder(), seconds=5.0)


def _is_quick(profile: str) -> bool:
    if profile not in ("quick", "full"):
        raise WorkbenchError(f"profile: got {profile!r}, want 'quick' or 'full'")
    return profile == "quick"


def _present() -> list[Status]:
    from workbench.datasets import list_datasets

    return [status for status in list_datasets() if status.state in ("available", "built in")]


def _n_frames(status: Status) -> int:
    """Tell a clip's length; one that the catalogue does not know has to be read."""
    from workbench.datasets import load

    frames = getattr(status.entry, "frames", None)
    return len(load(status.entry.name)) if frames is None else int(frames)
