"""Animations: motions that a trajectory on the plane of spatial keyframes plays."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from workbench.authoring.trajectories import Trajectory
from workbench.backprojection.poses import PoseBackProjector
from workbench.errors import WorkbenchError
from workbench.mocap.motion import Motion, check_motion


def animate(
    trajectory: Trajectory,
    model: PoseBackProjector,
    like: Motion,
    *,
    frame_time: float | None = None,
) -> Motion:
    """Play a trajectory as a motion.

    The pose of each frame is the back-projection of where the trajectory is at that time
    (Costa 2018, chapter 6).

    Parameters
    ----------
    trajectory : Trajectory
        In the plane in which the model was fitted.
    model : PoseBackProjector
        Fitted spatial keyframes. If they know where the root is, it moves; otherwise it stays
        where ``like`` begins.
    like : Motion
        Whose skeleton, name and, unless given, frame time the motion gets.
    frame_time : float, optional
        Seconds between frames.

    Returns
    -------
    Motion

    Raises
    ------
    WorkbenchError
        If the model's poses have other joints than the skeleton, or the trajectory is shorter
        than a frame.

    Examples
    --------
    >>> from workbench import load_space
    >>> from workbench.backprojection.poses import SpatialKeyframes
    >>> space = load_space("cmu/01_01-jump")
    >>> keys, points = [0, 150, 299], [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]
    >>> model = SpatialKeyframes().fit(points, space.samples[keys])
    >>> len(animate(Trajectory(points, [0.0, 0.5, 1.0]), model, space.motion, frame_time=0.1))
    11
    """
    check_motion(like)
    step = like.frame_time if frame_time is None else frame_time
    return replace(poses_at(trajectory.frames(step).points, model, like), frame_time=step)


def poses_at(points: ArrayLike, model: PoseBackProjector, like: Motion) -> Motion:
    """Rebuild the poses at some points of the plane.

    Parameters
    ----------
    points : array-like of shape (n_points, n_dimensions)
        Positions.
    model, like
        As :func:`animate` takes them.

    Returns
    -------
    Motion
        One frame for each point.

    Raises
    ------
    WorkbenchError
        If the model's poses have other joints than the skeleton.
    """
    check_motion(like)
    if model.n_joints_ != like.skeleton.n_joints:
        raise WorkbenchError(
            f"model: rebuilds poses of {model.n_joints_} joints, "
            f"want the {like.skeleton.n_joints} of the skeleton of {like.name!r}"
        )
    rotations = model.predict(points)
    if getattr(model, "root_regressor_", None) is not None:
        root = model.predict_root(points)
    else:
        root = np.repeat(like.root_translation[:1], len(rotations), axis=0)
    translations = {
        joint: np.repeat(path.mean(axis=0)[None], len(rotations), axis=0)
        for joint, path in like.joint_translations.items()
    }
    return replace(
        like, rotations=rotations, root_translation=root, joint_translations=translations
    )
