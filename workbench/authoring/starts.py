"""How a scene begins: a clip whose keyframes become markers on the plane."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.authoring.placing import influence
from workbench.authoring.scene import MIN_MARKERS, Marker, Scene
from workbench.authoring.trajectories import Trajectory
from workbench.errors import WorkbenchError
from workbench.projection import project
from workbench.schemes import choose_control_points
from workbench.spaces import PoseSpace


def scene_from_clip(
    space: PoseSpace,
    clip: str = "",
    *,
    selector: Any = "scs",
    count: int | None = None,
    projector: Any = "tsne",
    random_state: int | None = 0,
) -> Scene:
    """Begin with a clip that a projector lays out on the plane.

    Parameters
    ----------
    space : PoseSpace
        The clip.
    clip : str
        Its name in the catalogue or path; by default the space's own name.
    selector : str or selector
        Chooses the frames that become markers.
    count : int or None
        How many, at least three; None for a selector that has a rule of its own.
    projector : str or scikit-learn transformer
        Lays the frames out.
    random_state : int or None
        Seed of both, where they take one.

    Returns
    -------
    Scene

    Raises
    ------
    WorkbenchError
        If the space is no motion, a name is unknown, the count is not valid, or the
        projector fails.

    Examples
    --------
    >>> from workbench import load_space
    >>> jump = load_space("cmu/01_01-jump")
    >>> scene = scene_from_clip(jump, selector="uniform", count=8, projector="pca")
    >>> len(scene.markers), scene.trajectory.points.shape
    (8, (300, 2))
    """
    frames = _marker_frames(space, selector, count, random_state)
    embedding = project(space, projector, random_state=random_state)
    if embedding.shape[1] != 2:
        raise WorkbenchError(
            f"projector: gives {embedding.shape[1]} dimensions, want 2: markers lie on a plane"
        )
    return _begun(space, clip, frames, embedding[frames], embedding)


def scene_on_circle(
    space: PoseSpace,
    clip: str = "",
    *,
    selector: Any = "scs",
    count: int | None = None,
    random_state: int | None = 0,
) -> Scene:
    """Begin with markers on a circle, in the order of time and equally far from each other.

    It looks at no pose: the first marker is at the top of the unit square's circle, the others
    follow clockwise. The frames between them are placed by radial basis functions (RBFP).

    Parameters
    ----------
    space, clip, selector, count, random_state
        As :func:`scene_from_clip` takes them.

    Returns
    -------
    Scene

    Raises
    ------
    WorkbenchError
        If the space is no motion, the selector is unknown or the count is not valid.

    Examples
    --------
    >>> from workbench import load_space
    >>> jump = load_space("cmu/01_01-jump")
    >>> scene_on_circle(jump, selector="uniform", count=4).positions.round(6).tolist()
    [[0.5, 1.0], [1.0, 0.5], [0.5, 0.0], [0.0, 0.5]]
    """
    frames = _marker_frames(space, selector, count, random_state)
    angles = 0.5 * np.pi - 2.0 * np.pi * np.arange(len(frames)) / len(frames)
    positions = 0.5 + 0.5 * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    markers = [
        Marker.of_frame(space, int(frame), place)
        for frame, place in zip(frames, positions, strict=True)
    ]
    return _begun(space, clip, frames, positions, influence(space, markers) @ positions)


def _marker_frames(
    space: PoseSpace, selector: Any, count: int | None, random_state: int | None
) -> NDArray[np.intp]:
    if not isinstance(space, PoseSpace):
        raise WorkbenchError(f"clip: got {type(space).__name__}, want a motion (PoseSpace)")
    frames = choose_control_points(space, selector, count=count, random_state=random_state)
    if len(frames) < MIN_MARKERS:
        raise WorkbenchError(f"count: got {len(frames)} markers, want at least {MIN_MARKERS}")
    return frames


def _begun(
    space: PoseSpace,
    clip: str,
    frames: NDArray[np.intp],
    positions: NDArray[np.float64],
    embedding: NDArray[np.float64],
) -> Scene:
    places = np.array(embedding)
    places[frames] = positions
    frame_time = space.motion.frame_time
    return Scene(
        clip or space.name or "clip",
        frame_time,
        tuple(
            Marker.of_frame(space, int(frame), place)
            for frame, place in zip(frames, positions, strict=True)
        ),
        places,
        Trajectory.of_frames(places, frame_time),
    )
