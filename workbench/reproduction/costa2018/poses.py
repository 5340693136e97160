"""Figures 4.2 and 6.1 of Costa 2018: poses of one clip, and authoring with it."""

from __future__ import annotations

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray

from workbench.authoring import Trajectory, poses_at
from workbench.backprojection.poses import SpatialKeyframes
from workbench.errors import WorkbenchError
from workbench.experiments.runs.base import Run
from workbench.experiments.runs.schemes import SchemeRun, scheme_name
from workbench.experiments.store import ResultStore
from workbench.figures.stick_figures import StickFigures, stick_figures
from workbench.figures.views import best_view
from workbench.mocap.motion import Motion
from workbench.reproduction.costa2018.embeddings import OPTIMIZED, RATIO, shown_clip
from workbench.schemes import SpatialScheme

#: Poses of Figure 4.2.
N_POSES = 12

#: Where the poses of interest are looked for: t-SNE separates groups of poses best.
SEPARATING = SpatialScheme("tsne", selector="rols")

#: Share of the map's extent within which one marker makes another needless.
_NEAR = 0.22

#: Share of the curve's length over which a drag is felt.
_RADIUS = 0.2


def planned_runs(profile: str, seed: int) -> list[Run]:
    """List the runs that the notebook reads: two projections of one clip."""
    clip = shown_clip(profile).name
    schemes = (OPTIMIZED["MDS"], SEPARATING)
    return [SchemeRun(clip, scheme, ratio=RATIO, seed=seed) for scheme in schemes]


def arrays_of(
    table: pd.DataFrame, store: ResultStore, scheme: SpatialScheme
) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
    """Read the projection of a scheme and its keyframes.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.
    store : ResultStore
        Where the grid kept its results.
    scheme : SpatialScheme
        One of those that are planned.

    Returns
    -------
    points : ndarray of shape (n_frames, 2)
        Before optimization.
    keyframes : ndarray of shape (n_keyframes,)

    Raises
    ------
    WorkbenchError
        If its run has not finished.
    """
    rows = table[(table["status"] == "done") & (table["scheme"] == scheme_name(scheme))]
    if rows.empty:
        raise WorkbenchError(f"scheme {scheme_name(scheme)!r}: its run has not finished")
    arrays = store.arrays(rows.iloc[0]["key"])
    return arrays["projected"], arrays["control_points"]


def even_frames(n_frames: int, count: int) -> NDArray[np.intp]:
    """Choose frames at equal distances, the first and the last among them.

    Examples
    --------
    >>> even_frames(817, 3).tolist()
    [0, 408, 816]
    """
    return np.linspace(0, n_frames - 1, count).round().astype(np.intp)


def bent(trajectory: Trajectory, keyframes: NDArray[np.intp]) -> tuple[Trajectory, int]:
    """Deform a trajectory: drag its middle to the marker that is farthest from there.

    The thesis deforms by hand; this is a deformation that anyone can repeat.

    Parameters
    ----------
    trajectory : Trajectory
        The curve of a motion.
    keyframes : ndarray of shape (n_keyframes,)
        Points of it that are markers.

    Returns
    -------
    trajectory : Trajectory
        With both ends where they were.
    dragged : int
        The point that was dragged.
    """
    middle = len(trajectory) // 2
    markers = trajectory.points[keyframes]
    away = np.linalg.norm(markers - trajectory.points[middle], axis=1)
    radius = _RADIUS * float(trajectory.lengths[-1])
    goal = markers[int(away.argmax())]
    return trajectory.dragged(middle, goal, radius, fixed_ends=True), middle


def apart(points: NDArray[np.float64], keyframes: NDArray[np.intp]) -> NDArray[np.intp]:
    """Remove keyframes whose marker is near that of an earlier one.

    The thesis removes keyframes by hand; this rule leaves one for each group of poses.

    Parameters
    ----------
    points : ndarray of shape (n_frames, 2)
        The map.
    keyframes : ndarray of shape (n_keyframes,)
        Sorted.

    Returns
    -------
    ndarray of shape (n_kept,)
        Sorted.
    """
    near = _NEAR * float(np.ptp(points, axis=0).max())
    kept: list[int] = []
    for key in keyframes.tolist():
        if all(np.linalg.norm(points[key] - points[other]) > near for other in kept):
            kept.append(key)
    return np.array(kept, dtype=np.intp)


def poses_on_map(
    motion: Motion, points: NDArray[np.float64], keyframes: NDArray[np.intp], probes: ArrayLike
) -> StickFigures:
    """Rebuild and project the poses at some points of a map.

    Parameters
    ----------
    motion : Motion
        The clip.
    points : ndarray of shape (n_frames, 2)
        Its frames on the map.
    keyframes : ndarray of shape (n_keyframes,)
        Frames whose poses are known.
    probes : array-like of shape (n_probes, 2)
        Where to look.

    Returns
    -------
    StickFigures
        All from the side that shows the clip best.
    """
    model = SpatialKeyframes().fit(
        points[keyframes], motion.rotations[keyframes], motion.root_translation[keyframes]
    )
    rebuilt = poses_at(probes, model, motion)
    return stick_figures(rebuilt, np.arange(len(rebuilt)), best_view(motion), in_place=True)


def points_to_look_at(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Choose five points of a map: four along its curve, and its centre.

    Parameters
    ----------
    points : ndarray of shape (n_frames, 2)
        The map.

    Returns
    -------
    ndarray of shape (5, 2)
    """
    along = even_frames(len(points), 6)[1:-1]
    centre = (points.min(axis=0) + points.max(axis=0)) / 2
    return np.concatenate([points[along], centre[None]])


def frames_around(n_frames: int, frame: int, count: int = 5) -> NDArray[np.intp]:
    """Choose frames at equal distances around one, within the middle half of a clip.

    Examples
    --------
    >>> frames_around(101, 50).tolist()
    [25, 38, 50, 62, 75]
    """
    reach = min(n_frames // 4, frame, n_frames - 1 - frame)
    return np.linspace(frame - reach, frame + reach, count).round().astype(np.intp)
