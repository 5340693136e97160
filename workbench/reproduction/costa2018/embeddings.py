"""Figures 3.4, 4.1 and 6.2 of Costa 2018: poses of one clip in the plane, and two claims."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray
from scipy.signal import find_peaks

from workbench.datasets import load_space
from workbench.errors import WorkbenchError
from workbench.experiments.runs.base import Run
from workbench.experiments.runs.schemes import SchemeRun, scheme_name
from workbench.experiments.store import ResultStore
from workbench.figures.embeddings import Panel
from workbench.reproduction.claims import Evidence
from workbench.reproduction.clips import PictureClip, picture_clip, titles_of
from workbench.reproduction.costa2018.results import PROJECTORS, evidence_of
from workbench.reproduction.profiles import motion_clips
from workbench.schemes import SpatialScheme
from workbench.spaces import PoseSpace

#: Share of the frames that are keyframes.
RATIO = 0.03

#: The optimized schemes of Table 5.1, whose runs are there already when all is reproduced.
OPTIMIZED = {
    name: SpatialScheme(projector, selector="uniform", optimizer="alg12")
    for name, projector in PROJECTORS.items()
}

#: Panels of the figures, row by row: the scheme that is run, and which of its arrays is drawn.
_LLE = {name: SpatialScheme("lle", selector=name.lower()) for name in ("SCS", "PB", "ROLS")}
FIGURE_3_4: dict[str, tuple[SpatialScheme, str]] = {
    name: (SpatialScheme(PROJECTORS[name], selector="rols", two_step="rbfp"), "embedding")
    for name in ("Force", "LLE", "MDS", "PCA", "t-SNE")
}
FIGURE_4_1: dict[str, tuple[SpatialScheme, str]] = {
    name: (OPTIMIZED[name], "embedding") for name in ("Force", "LLE", "MDS", "PCA", "t-SNE")
}
FIGURE_6_2: dict[str, tuple[SpatialScheme, str]] = {
    **{
        f"{name}, US": (OPTIMIZED[name], "projected")
        for name in ("Force", "MDS", "PCA", "t-SNE", "LLE")
    },
    **{f"LLE, {name}": (scheme, "embedding") for name, scheme in _LLE.items()},
}

#: What is done in a clip whose cycles can be told.
_CYCLIC = ("walk", "run", "stride", "jog")

#: Share of the range of distances by which a minimum has to stand out to be a cycle.
_PROMINENCE = 0.15


def shown_clip(profile: str) -> PictureClip:
    """Choose the clip of the three figures."""
    return picture_clip("cmu/05_10", profile, published="cmu/05_10")


def planned_runs(profile: str, seed: int) -> list[Run]:
    """List the runs that the notebook reads.

    Parameters
    ----------
    profile : {"quick", "full"}
        Which clips.
    seed : int
        Seed of selectors and projectors.

    Returns
    -------
    list of Run
        Of the figures' clip, and for the claims of all clips, those of Table 5.1.
    """
    clip = shown_clip(profile).name
    pictured = [*FIGURE_3_4.values(), *FIGURE_4_1.values(), *FIGURE_6_2.values()]
    pairs = [(clip, scheme) for scheme, _ in pictured]
    pairs += [(name, OPTIMIZED[p]) for name in motion_clips(profile) for p in PROJECTORS]
    return [
        SchemeRun(name, scheme, ratio=RATIO, seed=seed) for name, scheme in dict.fromkeys(pairs)
    ]


def panels(
    table: pd.DataFrame,
    store: ResultStore,
    clip: str,
    figure: Mapping[str, tuple[SpatialScheme, str]],
) -> list[Panel]:
    """Read the panels of a figure.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.
    store : ResultStore
        Where the grid kept its results.
    clip : str
        The clip that is shown.
    figure : mapping of str to (scheme, array)
        Such as :data:`FIGURE_6_2`.

    Returns
    -------
    list of Panel
        Only those whose run is finished.

    Raises
    ------
    WorkbenchError
        If no run is.
    """
    found = []
    for title, (scheme, array) in figure.items():
        rows = _finished(table, scheme, [clip])
        if len(rows):
            arrays = store.arrays(rows.iloc[0]["key"])
            found.append(Panel(title, arrays[array], arrays["control_points"]))
    if not found:
        raise WorkbenchError(f"clip {clip!r}: no run of this figure has finished")
    return found


def roughness(points: ArrayLike) -> float:
    """Measure how much a trajectory bends: mean second over mean first difference.

    A straight and even one has 0, a random walk √2, independent points about √3.

    Parameters
    ----------
    points : array-like of shape (n_frames, n_dimensions)
        Positions of successive frames.

    Returns
    -------
    float
        Not a number where nothing moves.

    Examples
    --------
    >>> roughness([[0, 0], [1, 0], [0, 0], [1, 0]])
    2.0
    """
    positions = np.asarray(points, dtype=np.float64)
    steps = np.linalg.norm(np.diff(positions, axis=0), axis=1).mean()
    bends = np.linalg.norm(np.diff(positions, n=2, axis=0), axis=1).mean()
    return float(bends / steps) if steps > 0 else float("nan")


def roughness_ratios(table: pd.DataFrame, store: ResultStore) -> pd.DataFrame:
    """Compare the roughness of trajectories after optimization with that before.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.
    store : ResultStore
        Where the grid kept its results.

    Returns
    -------
    DataFrame of shape (n_clips, n_projectors)
        Missing where no run is finished.
    """
    ratios: dict[str, dict[str, float]] = {}
    for name in PROJECTORS:
        for _, row in _finished(table, OPTIMIZED[name]).iterrows():
            arrays = store.arrays(row["key"])
            before, after = roughness(arrays["projected"]), roughness(arrays["embedding"])
            ratios.setdefault(row["dataset"], {})[name] = after / before
    frame = pd.DataFrame.from_dict(ratios, orient="index", columns=list(PROJECTORS))
    frame.index.name = "clip"
    return frame


def scatter_evidence(ratios: pd.DataFrame) -> Evidence:
    """Estimate by how much the optimizer roughens trajectories."""
    medians = ratios.dropna().median(axis=1)
    by_projector = ", ".join(f"{name} {ratios[name].median():.2f}" for name in ratios)
    return evidence_of(medians, np.median, f"Medians by projector: {by_projector}.")


def cycle_length(distances: ArrayLike) -> int | None:
    """Find after how many frames a motion comes back.

    Frames a lag apart are compared on average; the first lag at which their distance has a
    clear minimum is one cycle.

    Parameters
    ----------
    distances : array-like of shape (n_frames, n_frames)
        Distances between all poses.

    Returns
    -------
    int or None
        In frames; None where there is no such lag within three quarters of the clip.
    """
    table = np.asarray(distances, dtype=np.float64)
    lags = np.arange(max(3, 3 * len(table) // 4))
    apart = np.array([np.diagonal(table, int(lag)).mean() for lag in lags])
    minima, _ = find_peaks(-apart, prominence=_PROMINENCE * np.ptp(apart))
    return int(minima[0]) if len(minima) else None


def closure(points: NDArray[np.float64], cycle: int) -> float:
    """Compare positions one cycle apart with positions half a cycle apart, by medians.

    Parameters
    ----------
    points : ndarray of shape (n_frames, n_dimensions)
        Positions of successive frames.
    cycle : int
        Frames of one cycle, less than n_frames.

    Returns
    -------
    float
        0 for a curve that closes, about 1 for one that does not come back.
    """
    once = np.linalg.norm(points[cycle:] - points[:-cycle], axis=1)
    half = cycle // 2
    opposite = np.linalg.norm(points[half:] - points[:-half], axis=1)
    return float(np.median(once) / np.median(opposite))


def closures(table: pd.DataFrame, store: ResultStore, profile: str) -> pd.DataFrame:
    """Measure on walks and runs, projected by MDS, whether cycles close.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.
    store : ResultStore
        Where the grid kept its results.
    profile : {"quick", "full"}
        Whose clips.

    Returns
    -------
    DataFrame
        One row for each such clip: its cycle in seconds and its closure, both missing where no
        cycle was found.
    """
    titles = titles_of(profile)
    chosen = [n for n, title in titles.items() if any(word in title for word in _CYCLIC)]
    rows = {}
    for _, row in _finished(table, OPTIMIZED["MDS"], chosen).iterrows():
        space = load_space(row["dataset"])
        cycle = cycle_length(space.distances)
        seconds, closed = float("nan"), float("nan")
        if cycle is not None and isinstance(space, PoseSpace):
            seconds = cycle * space.motion.frame_time
            closed = closure(store.arrays(row["key"])["projected"], cycle)
        rows[row["dataset"]] = {
            "action": titles[row["dataset"]],
            "cycle, seconds": seconds,
            "one cycle apart / half a cycle apart": closed,
        }
    columns = ["action", "cycle, seconds", "one cycle apart / half a cycle apart"]
    frame = pd.DataFrame.from_dict(rows, orient="index", columns=columns)
    frame.index.name = "clip"
    return frame


def cyclic_evidence(found: pd.DataFrame) -> Evidence:
    """Estimate how well the curves of cyclic motions close."""
    values = found["one cycle apart / half a cycle apart"].astype(float)
    without = int(values.isna().sum())
    clips = "1 clip" if len(values) == 1 else f"{len(values)} clips"
    note = f"Walks and runs, {clips}, MDS."
    if without:
        note += f" In {without} of them no cycle was found, for they are too short or too varied."
    return evidence_of(values.dropna(), np.median, note)


def _finished(
    table: pd.DataFrame, scheme: SpatialScheme, clips: Iterable[str] | None = None
) -> pd.DataFrame:
    chosen = (table["status"] == "done") & (table["scheme"] == scheme_name(scheme))
    if clips is not None:
        chosen &= table["dataset"].isin(list(clips))
    return table[chosen].drop_duplicates("dataset")
