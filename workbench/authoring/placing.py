"""Where frames and new poses lie on the plane once markers have been moved.

A dragged marker takes the frames with it by radial basis functions (RBFP); the optimizer then
moves each frame to where the spatial keyframes rebuild it better (Costa 2018, chapter 6).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.authoring.scene import Marker, Scene
from workbench.backprojection.poses import SpatialKeyframes
from workbench.errors import WorkbenchError
from workbench.mocap.motion import Motion
from workbench.optimization import VISUALIZATION_OPTIMIZER, optimizers
from workbench.optimization.objective import Callback, Objective
from workbench.projection.rbfp import RBFP
from workbench.spaces import PoseSpace


@dataclass(frozen=True, eq=False)
class Refinement:
    """A scene whose frames the optimizer has moved.

    Attributes
    ----------
    scene : Scene
        The scene.
    before, after : float
        Error per frame per joint over all frames of the clip, see
        :func:`reconstruction_error`.
    reason : str
        Why the optimizer ended.
    """

    scene: Scene
    before: float
    after: float
    reason: str


def spatial_keyframes(scene: Scene) -> SpatialKeyframes:
    """Fit the back-projector of a scene's markers, root included.

    Parameters
    ----------
    scene : Scene
        The scene.

    Returns
    -------
    SpatialKeyframes
    """
    model = SpatialKeyframes(scene.kernel, epsilon=scene.epsilon)
    return model.fit(scene.positions, scene.poses, scene.roots)


def influence(space: PoseSpace, markers: Sequence[Marker]) -> NDArray[np.float64]:
    """Say how much each marker's place counts for each frame of a clip.

    ``influence @ positions`` places the frames as :class:`~workbench.projection.rbfp.RBFP`
    does, wherever the markers are dragged; it depends on their poses only.

    Parameters
    ----------
    space : PoseSpace
        The clip.
    markers : sequence of Marker
        Frames of the clip and new poses.

    Returns
    -------
    ndarray of shape (n_frames, n_markers)
        The row of a marker's frame is a unit vector.

    Raises
    ------
    WorkbenchError
        If a marker has a frame or joints that the clip has not.

    Examples
    --------
    >>> from workbench import load_space
    >>> from workbench.authoring import scene_on_circle
    >>> jump = load_space("cmu/01_01-jump")
    >>> scene = scene_on_circle(jump, selector="uniform", count=6)
    >>> places = influence(jump, scene.markers) @ scene.positions
    >>> bool(np.allclose(places, scene.embedding))
    True
    """
    for marker in markers:
        check_pose(space, marker)
    new = [rank for rank, marker in enumerate(markers) if marker.frame is None]
    kept = [rank for rank, marker in enumerate(markers) if marker.frame is not None]
    kept.sort(key=lambda rank: markers[rank].frame or 0)
    frames = [markers[rank].frame for rank in kept]
    extended = with_poses(space, [markers[rank] for rank in new])
    indices = np.array([*frames, *range(len(space), len(extended))], dtype=np.intp)
    shares = RBFP().influence(extended, indices)[: len(space)]
    columns = np.empty(len(markers), dtype=np.intp)
    columns[[*kept, *new]] = np.arange(len(markers))
    return np.ascontiguousarray(shares[:, columns])


def placed(scene: Scene, space: PoseSpace, markers: Sequence[Marker] | None = None) -> Scene:
    """Place all frames by radial basis functions around the markers.

    Parameters
    ----------
    scene : Scene
        The scene.
    space : PoseSpace
        Its clip.
    markers : sequence of Marker, optional
        Markers in place of the scene's own.

    Returns
    -------
    Scene
        With that embedding; the trajectory goes along if it follows.

    Raises
    ------
    WorkbenchError
        If the clip is another one.
    """
    check_clip(scene, space)
    markers = scene.markers if markers is None else markers
    positions = np.stack([marker.position for marker in markers])
    return scene.laid_out(markers, influence(space, markers) @ positions)


def refined(
    scene: Scene, space: PoseSpace, optimizer: Any = None, callback: Callback | None = None
) -> Refinement:
    """Move the frames between markers to where they are rebuilt better.

    Parameters
    ----------
    scene : Scene
        The scene.
    space : PoseSpace
        Its clip.
    optimizer : str or optimizer, optional
        A registered name or an object, by default the one of projections that are looked at.
        What it raises the error of stays where it was.
    callback : callable, optional
        ``callback(iteration, mean_error, embedding)``; a true result stops it.

    Returns
    -------
    Refinement
        The error after is never above the one before.

    Raises
    ------
    WorkbenchError
        If the clip is another one or there is no such optimizer.

    Examples
    --------
    >>> from workbench import load_space
    >>> from workbench.authoring import scene_on_circle
    >>> jump = load_space("cmu/01_01-jump")
    >>> scene = scene_on_circle(jump, selector="uniform", count=6)
    >>> result = refined(scene, jump)
    >>> result.after < result.before
    True
    """
    check_clip(scene, space)
    free = np.setdiff1d(np.arange(len(space)), scene.frames)
    if not len(free):
        return Refinement(scene, 0.0, 0.0, "every frame has a marker")
    objective = Objective.of(space, spatial_keyframes(scene))
    before = objective(scene.embedding[free], free)
    search = optimizers.build(optimizer or VISUALIZATION_OPTIMIZER)
    found = search.optimize(objective, scene.embedding, free, space.neighbors, callback=callback)
    better = found.errors < before
    embedding = np.array(scene.embedding)
    embedding[free[better]] = found.embedding[free[better]]
    after = np.where(better, found.errors, before)
    n = len(space)
    moved = scene.laid_out(scene.markers, embedding)
    return Refinement(moved, float(before.sum() / n), float(after.sum() / n), found.reason)


def reconstruction_error(scene: Scene, space: PoseSpace) -> float:
    """Measure how well the spatial keyframes rebuild the clip from its places on the plane.

    Parameters
    ----------
    scene : Scene
        The scene.
    space : PoseSpace
        Its clip.

    Returns
    -------
    float
        Error per frame per joint (Costa 2018, Eq. 3.2), over all frames; those of markers
        count as 0.

    Raises
    ------
    WorkbenchError
        If the clip is another one.
    """
    check_clip(scene, space)
    free = np.setdiff1d(np.arange(len(space)), scene.frames)
    errors = Objective.of(space, spatial_keyframes(scene))(scene.embedding[free], free)
    return float(errors.sum() / len(space))


def check_clip(scene: Scene, space: PoseSpace) -> None:
    """Refuse a clip that cannot be the scene's own.

    Raises
    ------
    WorkbenchError
        If it is no motion, or has another number of frames or joints.
    """
    if not isinstance(space, PoseSpace):
        raise WorkbenchError(f"clip: got {type(space).__name__}, want a motion (PoseSpace)")
    wanted = (scene.n_frames, len(scene.markers[0].rotations))
    if space.samples.shape[:2] != wanted:
        raise WorkbenchError(
            f"clip {space.name!r}: got {len(space)} frames of {space.samples.shape[1]} joints, "
            f"want {wanted[0]} of {wanted[1]} as the scene of {scene.clip!r} has"
        )


def check_pose(space: PoseSpace, marker: Marker) -> None:
    """Refuse a marker whose pose or frame a clip cannot have.

    Raises
    ------
    WorkbenchError
        If it has another number of joints, or no such frame.
    """
    if len(marker.rotations) != space.samples.shape[1]:
        raise WorkbenchError(
            f"marker {marker.name!r}: got a pose of {len(marker.rotations)} joints, "
            f"want the {space.samples.shape[1]} of {space.name!r}"
        )
    if marker.frame is not None and marker.frame >= len(space):
        raise WorkbenchError(
            f"marker {marker.name!r}: got frame {marker.frame} of the {len(space)} "
            f"of {space.name!r}"
        )


def with_poses(space: PoseSpace, markers: Sequence[Marker]) -> PoseSpace:
    """Append the poses of markers to a clip as further frames.

    Parameters
    ----------
    space : PoseSpace
        The clip.
    markers : sequence of Marker
        Whose poses; possibly none.

    Returns
    -------
    PoseSpace
    """
    if not markers:
        return space
    motion: Motion = space.motion
    n_new = len(markers)
    return PoseSpace(
        replace(
            motion,
            rotations=np.concatenate([motion.rotations, [m.rotations for m in markers]]),
            root_translation=np.concatenate([motion.root_translation, [m.root for m in markers]]),
            # Where joints slide does not count for D_q.
            joint_translations={
                joint: np.concatenate([path, np.repeat(path[:1], n_new, axis=0)])
                for joint, path in motion.joint_translations.items()
            },
        )
    )
