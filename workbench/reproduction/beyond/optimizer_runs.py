"""Runs that compare optimizers: Alg. 12 of Costa 2018, ours, and markers that move too."""

from __future__ import annotations

from collections.abc import Iterable

from workbench.errors import WorkbenchError
from workbench.experiments.runs.base import Run
from workbench.experiments.runs.schemes import SchemeRun
from workbench.reproduction.costa2018.keyframe_errors import RATIO
from workbench.reproduction.profiles import shortest, some_clips
from workbench.schemes import SpatialScheme

#: What all others are compared with.
BASELINE = "alg12"
#: Our optimizers.
OURS = ("local", "global")
#: Searches for better markers, after the optimizer that is named with them.
MARKER_SEARCHES = ("move", "exchange")
BEFORE_MARKERS = "global"

PROJECTORS = {"PCA": "pca", "MDS": "mds", "Isomap": "isomap", "LLE": "lle", "t-SNE": "tsne"}

#: The quick profile takes the projectors that are fast, and one of them to search for markers,
#: which takes ten times as long as all optimizers together.
_QUICK_PROJECTORS = ("PCA", "Isomap")
_QUICK_MARKER_PROJECTORS = ("PCA",)
#: On how many clips the optimizers are compared in the quick profile, and markers searched for.
_QUICK_CLIPS = 6
_MARKER_CLIPS = {"quick": 1, "full": 6}


def planned_runs(
    profile: str,
    seed: int,
    *,
    clips: Iterable[str] | None = None,
    projectors: Iterable[str] | None = None,
) -> list[Run]:
    """List the runs that the notebook reads.

    Parameters
    ----------
    profile : {"quick", "full"}
        Which clips and projectors.
    seed : int
        Seed of the projectors that take one.
    clips, projectors : iterable of str, optional
        In place of the profile's.

    Returns
    -------
    list of Run
    """
    chosen = some_clips(profile, _QUICK_CLIPS) if clips is None else list(clips)
    names = projectors_of(profile) if projectors is None else list(projectors)
    with_markers = marker_projectors(profile) if projectors is None else names
    return [
        *optimizer_runs(chosen, seed=seed, projectors=names),
        *marker_runs(marker_clips(chosen, profile), seed=seed, projectors=with_markers),
    ]


def projectors_of(profile: str) -> list[str]:
    """Choose the projectors of a profile."""
    return list(_QUICK_PROJECTORS if profile == "quick" else PROJECTORS)


def scheme_of(projector: str, optimizer: str | None, markers: str | None = None) -> SpatialScheme:
    """Make a scheme of the comparison; those of Table 5.1 are the same, so they are run once."""
    return SpatialScheme(projector, selector="uniform", optimizer=optimizer, markers=markers)


def optimizer_runs(
    clips: Iterable[str], *, seed: int = 0, projectors: Iterable[str] | None = None
) -> list[SchemeRun]:
    """List the runs of the comparison: no optimizer, Alg. 12 and ours.

    Parameters
    ----------
    clips : iterable of str
        Names of clips.
    seed : int
        Seed of the projectors that take one.
    projectors : iterable of str, optional
        Some of :data:`PROJECTORS`; by default all.

    Returns
    -------
    list of SchemeRun

    Raises
    ------
    WorkbenchError
        If a projector is unknown.
    """
    names = _projectors(projectors)
    return [
        SchemeRun(clip, scheme_of(PROJECTORS[name], optimizer), ratio=RATIO, seed=seed)
        for clip in clips
        for name in names
        for optimizer in (None, BASELINE, *OURS)
    ]


def marker_runs(
    clips: Iterable[str], *, seed: int = 0, projectors: Iterable[str] | None = None
) -> list[SchemeRun]:
    """List the runs in which markers move, or are exchanged, after the global optimizer.

    Parameters and errors are those of :func:`optimizer_runs`, whose runs on the same clips
    they are compared with.
    """
    names = _projectors(projectors)
    return [
        SchemeRun(clip, scheme_of(PROJECTORS[name], BEFORE_MARKERS, search), ratio=RATIO, seed=seed)
        for clip in clips
        for name in names
        for search in MARKER_SEARCHES
    ]


def marker_clips(clips: list[str], profile: str) -> list[str]:
    """Choose the clips on which markers are searched for.

    They are the shortest, because the search takes as long as the square of the length.
    """
    return shortest(clips, _MARKER_CLIPS[profile])


def marker_projectors(profile: str) -> list[str]:
    """Choose the projectors with which a profile searches for markers."""
    return list(_QUICK_MARKER_PROJECTORS if profile == "quick" else PROJECTORS)


def _projectors(names: Iterable[str] | None) -> list[str]:
    chosen = list(PROJECTORS if names is None else names)
    for name in chosen:
        if name not in PROJECTORS:
            raise WorkbenchError(f"projectors: got {name!r}, want some of {', '.join(PROJECTORS)}")
    return chosen
