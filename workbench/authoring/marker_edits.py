"""Edits of markers: move, add, turn, rename and remove spatial keyframes.

Moving a marker takes the frames of the clip along, by radial basis functions; adding, turning
and removing one leaves all places as they are.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.authoring.placing import placed
from workbench.authoring.scene import MIN_MARKERS, Marker, Scene
from workbench.errors import WorkbenchError
from workbench.mocap.rotations import rotations_from_euler
from workbench.spaces import PoseSpace
from workbench.validation import as_numbers, finite, whole_number

#: Markers closer than this share of their extent cannot be told apart on the plane.
_SAME_PLACE = 1e-6


def move_marker(scene: Scene, space: PoseSpace, marker: int, to: ArrayLike) -> Scene:
    """Drag a marker to another place; the frames of the clip go along.

    Parameters
    ----------
    scene : Scene
        The scene.
    space : PoseSpace
        Its clip.
    marker : int
        Which one.
    to : array-like of shape (2,)
        Where it goes.

    Returns
    -------
    Scene

    Raises
    ------
    WorkbenchError
        If there is no such marker, the clip is another one, or the place is no place or
        that of another marker.

    Examples
    --------
    >>> from workbench import load_space
    >>> from workbench.authoring import scene_on_circle
    >>> jump = load_space("cmu/01_01-jump")
    >>> scene = scene_on_circle(jump, selector="uniform", count=6)
    >>> moved = move_marker(scene, jump, 2, [0.4, 0.4])
    >>> moved.embedding[moved.frames[2]].tolist(), scene.positions[2].round(3).tolist()
    ([0.4, 0.4], [0.933, 0.25])
    """
    chosen = _marker(scene, marker)
    place = _free_place(scene, to, besides=marker)
    return placed(scene, space, _with(scene, marker, replace(chosen, position=place)))


def add_frame(
    scene: Scene, space: PoseSpace, frame: int, at: ArrayLike | None = None, name: str = ""
) -> Scene:
    """Make a marker of a frame of the clip.

    Parameters
    ----------
    scene : Scene
        The scene.
    space : PoseSpace
        Its clip.
    frame : int
        The frame; it has no marker yet.
    at : array-like of shape (2,), optional
        Where the marker is; all frames are then placed anew. By default it is where the
        frame is, and nothing moves.
    name : str
        What it is called, by default after its frame.

    Returns
    -------
    Scene
        Its last marker is the new one.

    Raises
    ------
    WorkbenchError
        If there is no such frame, it has a marker already, or a marker is at that place.
    """
    frame = whole_number("frame", frame, 0)
    if frame >= scene.n_frames:
        raise WorkbenchError(f"frame: got {frame}, want one from 0 to {scene.n_frames - 1}")
    if frame in scene.frames:
        raise WorkbenchError(f"frame: got {frame}, which has a marker already")
    place = _free_place(scene, scene.embedding[frame] if at is None else at)
    markers = (*scene.markers, Marker.of_frame(space, frame, place, name))
    return scene.laid_out(markers, scene.embedding) if at is None else placed(scene, space, markers)


def add_pose(
    scene: Scene, rotations: ArrayLike, root: ArrayLike, at: ArrayLike, name: str = ""
) -> Scene:
    """Make a marker of a new pose; the frames of the clip stay where they are.

    Parameters
    ----------
    scene : Scene
        The scene.
    rotations : array-like of shape (n_joints, 3, 3)
        The pose.
    root : array-like of shape (3,)
        Where the root is in it, in file units.
    at : array-like of shape (2,)
        Where the marker is; :func:`~workbench.authoring.placing.best_place` finds a place.
    name : str
        What it is called, by default "pose" and a number.

    Returns
    -------
    Scene
        Its last marker is the new one.

    Raises
    ------
    WorkbenchError
        If the pose is none of the scene's skeleton, or a marker is at that place.
    """
    place = _free_place(scene, at)
    marker = Marker(place, np.asarray(rotations), np.asarray(root), None, name or _new_name(scene))
    return replace(scene, markers=(*scene.markers, marker))


def remove_marker(scene: Scene, marker: int) -> Scene:
    """Take a marker away; the frames of the clip stay where they are.

    Raises
    ------
    WorkbenchError
        If there is no such marker, or fewer than three would remain.
    """
    index = _index(scene, marker)
    if len(scene.markers) <= MIN_MARKERS:
        raise WorkbenchError(
            f"markers: got {len(scene.markers)}, want to keep at least {MIN_MARKERS}: a plane "
            "needs as many"
        )
    return replace(scene, markers=scene.markers[:index] + scene.markers[index + 1 :])


def rename_marker(scene: Scene, marker: int, name: str) -> Scene:
    """Call a marker something else.

    Raises
    ------
    WorkbenchError
        If there is no such marker, or the name is empty.
    """
    return replace(scene, markers=_with(scene, marker, replace(_marker(scene, marker), name=name)))


def turned(rotations: ArrayLike, joint: int, degrees: ArrayLike) -> NDArray[np.float64]:
    """Turn one joint of a pose about its own axes.

    With R the joint's rotation, it becomes R · Rx(a) · Ry(b) · Rz(c): the axes are those that
    the joint has in the pose, so that turning about the bone's own axis twists it.

    Parameters
    ----------
    rotations : array-like of shape (n_joints, 3, 3)
        The pose.
    joint : int
        The joint.
    degrees : array-like of shape (3,)
        Angles a, b, c about x, y and z.

    Returns
    -------
    ndarray of shape (n_joints, 3, 3)

    Raises
    ------
    WorkbenchError
        If there is no such joint, or not three finite angles.

    Examples
    --------
    >>> pose = np.tile(np.eye(3), (2, 1, 1))
    >>> turned(pose, 1, [0.0, 0.0, 90.0])[1].round(6) @ [1.0, 0.0, 0.0]
    array([0., 1., 0.])
    """
    pose = np.array(as_numbers("rotations", rotations, 3, 3))
    joint = whole_number("joint", joint, 0)
    if joint >= len(pose):
        raise WorkbenchError(f"joint: got {joint}, want one from 0 to {len(pose) - 1}")
    angles = finite(as_numbers("degrees", degrees, 3), "degrees")
    if angles.ndim != 1:
        raise WorkbenchError(f"degrees: got shape {angles.shape}, want three angles")
    pose[joint] = pose[joint] @ rotations_from_euler("XYZ", angles)
    return pose


def turn_joint(
    scene: Scene,
    marker: int,
    joint: int,
    degrees: ArrayLike,
    at: ArrayLike | None = None,
    name: str = "",
) -> Scene:
    """Make a new pose by turning a joint of a marker's pose, see :func:`turned`.

    Parameters
    ----------
    scene : Scene
        The scene.
    marker : int
        Whose pose is turned.
    joint : int
        The joint.
    degrees : array-like of shape (3,)
        Angles about x, y and z.
    at : array-like of shape (2,), optional
        Place of a new marker that gets the pose. By default the marker itself gets it; if
        it was a frame of the clip, it is none any more.
    name : str
        What the marker is called: a new one by default "pose" and a number, one that is
        changed as before.

    Returns
    -------
    Scene

    Raises
    ------
    WorkbenchError
        If there is no such marker or joint, or a marker is at that place.

    Examples
    --------
    >>> from workbench import load_space
    >>> from workbench.authoring import scene_on_circle
    >>> jump = load_space("cmu/01_01-jump")
    >>> scene = scene_on_circle(jump, selector="uniform", count=6)
    >>> turned = turn_joint(scene, 0, 5, [0.0, 30.0, 0.0], at=[0.5, 0.5])
    >>> turned.markers[-1].name, turned.markers[-1].frame
    ('pose 1', None)
    """
    chosen = _marker(scene, marker)
    pose = turned(chosen.rotations, joint, degrees)
    if at is not None:
        return add_pose(scene, pose, chosen.root, at, name)
    if not name:
        name = chosen.name if chosen.frame is None else f"{chosen.name}, turned"
    changed = replace(chosen, rotations=pose, frame=None, name=name)
    return replace(scene, markers=_with(scene, marker, changed))


def _index(scene: Scene, marker: int) -> int:
    index = whole_number("marker", marker, 0)
    if index >= len(scene.markers):
        raise WorkbenchError(f"marker: got {index}, want one from 0 to {len(scene.markers) - 1}")
    return index


def _marker(scene: Scene, marker: int) -> Marker:
    return scene.markers[_index(scene, marker)]


def _with(scene: Scene, marker: int, other: Marker) -> tuple[Marker, ...]:
    index = _index(scene, marker)
    return (*scene.markers[:index], other, *scene.markers[index + 1 :])


def _free_place(scene: Scene, place: ArrayLike, besides: int = -1) -> NDArray[np.float64]:
    """Check that a place is one, and that no other marker is there."""
    position = finite(as_numbers("place", place, 2), "place")
    if position.ndim != 1:
        raise WorkbenchError(f"place: got shape {position.shape}, want one position")
    others = [rank for rank in range(len(scene.markers)) if rank != besides]
    positions = scene.positions[others]
    extent = float(np.ptp(positions, axis=0).max()) or 1.0
    gaps = np.linalg.norm(positions - position, axis=1)
    if gaps.min() < _SAME_PLACE * extent:
        name = scene.markers[others[int(gaps.argmin())]].name
        raise WorkbenchError(f"place: there is the marker {name!r} already, want one of its own")
    return position


def _new_name(scene: Scene) -> str:
    """Find a name for a new pose that no marker has."""
    names: Sequence[str] = [marker.name for marker in scene.markers]
    return next(name for k in range(1, len(names) + 2) if (name := f"pose {k}") not in names)
