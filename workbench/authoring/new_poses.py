"""Where a new pose belongs on the plane."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.authoring.placing import check_clip, check_pose, spatial_keyframes, with_poses
from workbench.authoring.scene import Marker, Scene
from workbench.optimization import VISUALIZATION_OPTIMIZER, optimizers
from workbench.optimization.objective import Objective
from workbench.spaces import PoseSpace

#: How far a new pose stays away from markers, as a share of their extent: on a marker it
#: would have no place of its own.
_APART = 0.02
#: Places around a marker that are tried for a pose that would end on it.
_DIRECTIONS = 32


def best_place(
    scene: Scene, space: PoseSpace, rotations: ArrayLike, seed: ArrayLike
) -> NDArray[np.float64]:
    """Find the place for a new pose: where the markers' poses blend to one most like it.

    From the seed the optimizer goes down to a place of least error. Should that be a marker,
    as it is for a pose that was made by a small turn of one, the best place around it is
    taken.

    Parameters
    ----------
    scene : Scene
        The markers.
    space : PoseSpace
        Its clip.
    rotations : array-like of shape (n_joints, 3, 3)
        The pose.
    seed : array-like of shape (2,)
        Where to begin.

    Returns
    -------
    ndarray of shape (2,)

    Raises
    ------
    WorkbenchError
        If the pose has other joints than the clip, or the seed is no place.

    References
    ----------
    Costa 2018, chapter 6: a marker's place by Alg. 12 from a seed.

    Examples
    --------
    >>> from workbench import load_space
    >>> from workbench.authoring import scene_on_circle
    >>> jump = load_space("cmu/01_01-jump")
    >>> scene = scene_on_circle(jump, selector="uniform", count=6)
    >>> place = best_place(scene, jump, jump.samples[20], scene.positions[0])
    >>> bool(np.linalg.norm(scene.positions - place, axis=1).min() > 0.01)
    True
    """
    check_clip(scene, space)
    pose = Marker(np.asarray(seed), np.asarray(rotations), np.zeros(3), None, "new pose")
    check_pose(space, pose)
    markers = with_poses(space, [*scene.markers, pose]).subset(
        np.arange(len(space), len(space) + len(scene.markers) + 1)
    )
    last = len(scene.markers)
    positions = scene.positions
    objective = Objective.of(markers, spatial_keyframes(scene))
    # The first step is as long as the mean distance to the two nearest markers.
    away = np.linalg.norm(positions - pose.position, axis=1)
    neighbors = np.tile(np.argsort(away, kind="stable")[:2], (last + 1, 1))
    found = optimizers.build(VISUALIZATION_OPTIMIZER).optimize(
        objective, np.vstack([positions, pose.position]), [last], neighbors
    )
    place: NDArray[np.float64] = found.embedding[last]
    apart = _APART * (float(np.ptp(positions, axis=0).max()) or 1.0)
    distances = np.linalg.norm(positions - place, axis=1)
    if distances.min() >= apart:
        return place
    angles = 2 * np.pi * np.arange(_DIRECTIONS) / _DIRECTIONS
    ring = positions[distances.argmin()] + apart * np.stack([np.cos(angles), np.sin(angles)], 1)
    errors = objective(ring, np.full(len(ring), last))
    gaps = np.linalg.norm(ring[:, None] - positions[None], axis=2).min(axis=1)
    crowded = gaps < 0.5 * apart
    best: NDArray[np.float64] = ring[np.lexsort([errors, crowded])[0]]
    return best
