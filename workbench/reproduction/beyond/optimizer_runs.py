"""Runs that compare optimizers: Alg. 12 of Costa 2018, ours, and markers that move too."""

from __future__ import annotations

from collections.abc import Iterable

from workbench.errors import WorkbenchError
from workbench.experiments.runs.schemes import SchemeRun
from workbench.reproduction.costa2018.keyframe_errors import RATIO
from workbench.schemes import SpatialScheme

#: What all others are compared with.
BASELINE = "alg12"
#: Our optimizers.
OURS = ("local", "global")
#: Searches for better markers, after the optimizer that is named with them.
MARKER_SEARCHES = ("move", "exchange")
BEFORE_MARKERS = "global"

PROJECTORS = {"PCA": "pca", "MDS": "mds", "Isomap": "isomap", "LLE": "lle", "t-SNE": "tsne"}

#: Projectors on which the quick profile searches for markers, which takes ten times as long as
#: all the optimizers together.
_QUICK_MARKER_PROJECTORS = ("PCA", "Isomap")
#: On how many clips markers are searched for.
_MARKER_CLIPS = {"quick": 2, "full": 6}


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
    """Choose a few clips, spread over those of a profile, on which markers are searched for."""
    step = -(-len(clips) // _MARKER_CLIPS[profile])
    return clips[::step]


def marker_projectors(profile: str) -> list[str]:
    """Choose the projectors with which a profile searches for markers."""
    return list(_QUICK_MARKER_PROJECTORS if profile == "quick" else PROJECTORS)


def _projectors(names: Iterable[str] | None) -> list[str]:
    chosen = list(PROJECTORS if names is None else names)
    for name in chosen:
        if name not in PROJECTORS:
            raise WorkbenchError(f"projectors: got {name!r}, want some of {', '.join(PROJECTORS)}")
    return chosen
