"""Edits of the trajectory: its curve and its timing."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from workbench.authoring.checking import above_zero
from workbench.authoring.recording import recorded
from workbench.authoring.scene import Scene
from workbench.authoring.trajectories import Trajectory
from workbench.errors import WorkbenchError
from workbench.validation import as_numbers, finite


def deform(scene: Scene, index: int, to: ArrayLike, radius: float) -> Scene:
    """Drag the trajectory at one of its points, see :meth:`Trajectory.dragged`.

    It then no longer follows the clip.

    Parameters
    ----------
    scene : Scene
        The scene.
    index : int
        The point.
    to : array-like of shape (2,)
        Where it goes.
    radius : float
        How far along the curve the drag is felt, in units of the plane.

    Returns
    -------
    Scene

    Raises
    ------
    WorkbenchError
        If there is no such point, or the place or the radius is not valid.
    """
    return replace(scene, trajectory=scene.trajectory.dragged(index, to, radius), follows=False)


def draw(scene: Scene, points: ArrayLike, times: ArrayLike) -> Scene:
    """Replace the trajectory by one that was drawn, with the timing of the hand.

    Parameters
    ----------
    scene : Scene
        The scene.
    points : array-like of shape (n_events, 2)
        Where the pointer was.
    times : array-like of shape (n_events,)
        When, in seconds of any clock.

    Returns
    -------
    Scene
        Its trajectory begins at 0 s; see :func:`~workbench.authoring.recording.recorded`.

    Raises
    ------
    WorkbenchError
        If less than a frame was drawn, or positions and times are not valid.

    Examples
    --------
    >>> from workbench import load_space
    >>> from workbench.authoring import scene_on_circle
    >>> jump = load_space("cmu/01_01-jump")
    >>> scene = scene_on_circle(jump, selector="uniform", count=6)
    >>> drawn = draw(scene, [[0.1, 0.1], [0.5, 0.9], [0.9, 0.1]], [0.0, 0.5, 1.0])
    >>> drawn.trajectory.duration, drawn.follows
    (1.0, False)
    """
    return replace(scene, trajectory=recorded(points, times, scene.frame_time), follows=False)


def retime(scene: Scene, times: ArrayLike) -> Scene:
    """Give the trajectory's points other times.

    Parameters
    ----------
    scene : Scene
        The scene.
    times : array-like of shape (n_points,)
        Seconds, growing; at least a frame from the first to the last.

    Returns
    -------
    Scene
        Its trajectory begins at 0 s.

    Raises
    ------
    WorkbenchError
        If there is not one time for each point, they do not grow, or all is over within a
        frame.
    """
    seconds = np.atleast_1d(as_numbers("times", times))
    trajectory = scene.trajectory.retimed(seconds)
    trajectory = trajectory.retimed(trajectory.times - trajectory.times[0])
    if trajectory.duration < scene.frame_time:
        raise WorkbenchError(
            f"times: got {trajectory.duration} s in all, want at least a frame, "
            f"{scene.frame_time} s"
        )
    return replace(scene, trajectory=trajectory)


def stretch(scene: Scene, start: float, stop: float, factor: float) -> Scene:
    """Play a span slower, or faster for a factor below 1.

    Parameters
    ----------
    scene : Scene
        The scene.
    start, stop : float
        The span, in seconds of the trajectory; taken to the nearest points of it.
    factor : float
        How much longer it takes.

    Returns
    -------
    Scene

    Raises
    ------
    WorkbenchError
        If there are no two points of the trajectory so far apart, or the factor is not
        above 0.
    """
    above_zero("factor", factor)
    times = scene.trajectory.times
    span = finite(as_numbers("start and stop", [start, stop]), "start and stop")
    first, last = (int(np.abs(times - second).argmin()) for second in span)
    if first >= last:
        raise WorkbenchError(
            f"start and stop: got {start} and {stop}, want a span within {times[0]} and "
            f"{times[-1]} s that holds two points of the trajectory"
        )
    return retime(scene, scene.trajectory.stretched(times[first], times[last], factor).times)


def follow_clip(scene: Scene) -> Scene:
    """Go back to the clip's own curve and timing."""
    trajectory = Trajectory.of_frames(scene.embedding, scene.frame_time)
    return replace(scene, trajectory=trajectory, follows=True)
