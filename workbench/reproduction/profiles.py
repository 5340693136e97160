"""Profiles: which of the data on this machine an experiment uses."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING

from workbench.errors import DataError, WorkbenchError

if TYPE_CHECKING:
    from workbench.datasets import Status

#: Excerpts on which the quick profile compares schemes: the cheapest of each kind of action.
_QUICK_CLIPS = (
    "cmu/01_01-jump",
    "cmu/01_01-two-jumps",
    "cmu/01_01-turn",
    "cmu/01_03-walk",
    "cmu/01_03-climb-up",
    "cmu/01_03-lean-over",
)

#: Lengths of the 70 clips of Costa 2018, in frames.
SHORTEST, LONGEST = 129, 1146


def motion_clips(profile: str) -> list[str]:
    """Choose the clips of a profile.

    Parameters
    ----------
    profile : {"quick", "full"}
        ``quick``: some of the :func:`excerpts`. ``full``: all clips found whose
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
    if _is_quick(profile):
        names = [name for name in excerpts() if name in _QUICK_CLIPS]
    else:
        names = [
            status.entry.name
            for status in _present()
            if status.entry.name.startswith("cmu/")
            and status.entry.kind == "motion"
            and SHORTEST <= _n_frames(status) <= LONGEST
        ]
    if not names:
        raise WorkbenchError(
            f"profile {profile!r}: found no clip of {SHORTEST} to {LONGEST} frames; name a folder "
            "with mocap/bvh/ in WORKBENCH_DATA, or take the quick profile"
        )
    return names


def some_clips(profile: str, quick: int) -> list[str]:
    """Choose the clips of a profile: all of the full one, the shortest few of the quick one.

    Parameters
    ----------
    profile : {"quick", "full"}
    quick : int
        How many the quick profile has time for.

    Returns
    -------
    list of str

    Raises
    ------
    WorkbenchError
        As :func:`motion_clips`.
    """
    clips = motion_clips(profile)
    return shortest(clips, quick) if _is_quick(profile) else clips


def shortest(clips: Sequence[str], count: int) -> list[str]:
    """Take the shortest clips, in their order; a user's own, of unknown length, count as long."""
    chosen = sorted(clips, key=_length)[:count]
    return [clip for clip in clips if clip in chosen]


def excerpts() -> list[str]:
    """List the short excerpts of the bundled clips, which are on every machine."""
    return [status.entry.name for status in _present() if status.entry.kind == "excerpt"]


def absent_tables(datasets: Iterable[str]) -> dict[str, str]:
    """Tell which tables are not on this machine, and how to get them.

    Both profiles take all tables that are found: even Page blocks, the largest, takes no more
    than some ten seconds.

    Parameters
    ----------
    datasets : iterable of str
        Names of tables.

    Returns
    -------
    dict of str to str
        For each table that is not there a sentence.
    """
    present = {status.entry.name for status in _present()}
    return {
        name: f"{name} is not on this machine; `workbench datasets fetch {name}` downloads it."
        for name in datasets
        if name not in present
    }


def fetch_tables(
    datasets: Iterable[str], *, fetch: Callable[[str], object] | None = None
) -> list[str]:
    """Download tables that are on this machine in no folder, if seconds suffice.

    A reproduction runs without them too, so a download that fails is no error.

    Parameters
    ----------
    datasets : iterable of str
        Names of tables.
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
        if name not in present:
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


def _length(clip: str) -> float:
    from workbench.datasets.catalogue import lookup
    from workbench.datasets.entries import ExcerptEntry

    entry = lookup(clip)
    if isinstance(entry, ExcerptEntry):
        return entry.stop - entry.start
    return getattr(entry, "frames", None) or math.inf


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
