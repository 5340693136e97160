"""Scenes: everything that an author has set, as one value that is never changed in place.

A scene has no algorithm: :mod:`workbench.authoring.edits` makes one scene of another,
:mod:`workbench.authoring.placing` lays its frames out on the plane and
:mod:`workbench.authoring.rendering` plays it.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.authoring.checking import above_zero
from workbench.authoring.trajectories import Trajectory
from workbench.backprojection.radial import radial_kernel
from workbench.errors import WorkbenchError
from workbench.mocap.rotations import check_rotations
from workbench.spaces import PoseSpace
from workbench.validation import MIN_SAMPLES, as_numbers, finite, whole_number

#: Markers that a scene has at least: as many as a plane needs.
MIN_MARKERS = 3


@dataclass(frozen=True, eq=False)
class Marker:
    """A spatial keyframe: a pose and its place on the plane.

    Parameters
    ----------
    position : array-like of shape (2,)
        Where it is.
    rotations : array-like of shape (n_joints, 3, 3)
        The pose: rotation of each joint relative to its parent.
    root : array-like of shape (3,)
        World position of the root in this pose, in file units.
    frame : int or None
        The frame of the clip whose pose it is; None for a new pose.
    name : str
        What it is called.

    Raises
    ------
    WorkbenchError
        If a shape is another, a number is not finite, a matrix is no rotation, or the
        name is empty.
    """

    position: NDArray[np.float64]
    rotations: NDArray[np.float64]
    root: NDArray[np.float64]
    frame: int | None
    name: str

    def __post_init__(self) -> None:
        name = " ".join(self.name.split()) if isinstance(self.name, str) else ""
        if not name:
            raise WorkbenchError(f"name of a marker: got {self.name!r}, want a word or more")
        object.__setattr__(self, "name", name)
        for part, ending in (("position", (2,)), ("rotations", (3, 3)), ("root", (3,))):
            array = as_numbers(f"{part} of marker {name!r}", getattr(self, part), *ending)
            finite(array, f"{part} of marker {name!r}")
            _keep(self, part, array)
        if self.position.ndim != 1 or self.root.ndim != 1 or self.rotations.ndim != 3:
            raise WorkbenchError(
                f"marker {name!r}: got shapes {self.position.shape}, {self.rotations.shape} and "
                f"{self.root.shape}, want one position, one pose and one root"
            )
        check_rotations(f"rotations of marker {name!r}", self.rotations)
        if self.frame is not None:
            object.__setattr__(self, "frame", whole_number("frame of a marker", self.frame, 0))

    @classmethod
    def of_frame(cls, space: PoseSpace, frame: int, position: Any, name: str = "") -> Marker:
        """Make a marker of a frame of a clip.

        Parameters
        ----------
        space : PoseSpace
            The clip.
        frame : int
            The frame.
        position : array-like of shape (2,)
            Where the marker is.
        name : str
            What it is called, by default after its frame.

        Raises
        ------
        WorkbenchError
            If the clip has no such frame or the position is none.
        """
        frame = whole_number("frame", frame, 0)
        if frame >= len(space):
            raise WorkbenchError(f"frame: got {frame}, want one from 0 to {len(space) - 1}")
        root = space.motion.root_translation[frame]
        return cls(position, space.samples[frame], root, frame, name or f"frame {frame}")

    def equals(self, other: Marker) -> bool:
        """Tell whether two markers are the same to the last bit."""
        return (
            self.frame == other.frame
            and self.name == other.name
            and _same(self.position, other.position)
            and _same(self.rotations, other.rotations)
            and _same(self.root, other.root)
        )


@dataclass(frozen=True, eq=False)
class Scene:
    """A clip on the plane of its spatial keyframes, and the trajectory that is to be played.

    Parameters
    ----------
    clip : str
        Name of the clip as the catalogue has it, or path of its file.
    frame_time : float
        Seconds between the clip's frames.
    markers : iterable of Marker
        The spatial keyframes, at least three, of one skeleton; no two of the same frame.
    embedding : array-like of shape (n_frames, 2)
        Places of the clip's frames; frames of markers are where their markers are.
    trajectory : Trajectory
        The curve that is played.
    follows : bool
        Whether the trajectory's points are those of the embedding and go where they go. Its
        times may be other ones.
    kernel : str
        Radial kernel of the spatial keyframes, see
        :class:`~workbench.backprojection.rbf.RBF`.
    epsilon : float or None
        Its inverse width, None for the usual one.
    keep_feet : bool
        Whether the root is recomputed so that the feet do not slide.

    Raises
    ------
    WorkbenchError
        If the parts are not valid or do not fit each other.
    """

    clip: str
    frame_time: float
    markers: tuple[Marker, ...]
    embedding: NDArray[np.float64]
    trajectory: Trajectory
    follows: bool = True
    kernel: str = "linear"
    epsilon: float | None = None
    keep_feet: bool = False

    def __post_init__(self) -> None:
        if not isinstance(self.clip, str) or not self.clip:
            raise WorkbenchError(f"clip: got {self.clip!r}, want a name")
        object.__setattr__(self, "frame_time", above_zero("frame_time", self.frame_time))
        for switch in ("follows", "keep_feet"):
            if not isinstance(getattr(self, switch), bool):
                raise WorkbenchError(f"{switch}: got {getattr(self, switch)!r}, want a yes or no")
        radial_kernel(self.kernel)
        if self.epsilon is not None:
            object.__setattr__(self, "epsilon", above_zero("epsilon", self.epsilon))
        embedding = finite(as_numbers("embedding", self.embedding, 2), "embedding")
        if embedding.ndim != 2 or len(embedding) < MIN_SAMPLES:
            raise WorkbenchError(f"embedding: got shape {embedding.shape}, want (n_frames, 2)")
        _keep(self, "embedding", embedding)
        object.__setattr__(self, "markers", tuple(self.markers))
        _check_markers(self.markers, self.embedding)
        _check_trajectory(self)

    @property
    def positions(self) -> NDArray[np.float64]:
        """Places of the markers: (n_markers, 2)."""
        return np.stack([marker.position for marker in self.markers])

    @property
    def poses(self) -> NDArray[np.float64]:
        """Poses of the markers: (n_markers, n_joints, 3, 3)."""
        return np.stack([marker.rotations for marker in self.markers])

    @property
    def roots(self) -> NDArray[np.float64]:
        """Positions of the root in these poses, in file units: (n_markers, 3)."""
        return np.stack([marker.root for marker in self.markers])

    @property
    def frames(self) -> NDArray[np.intp]:
        """Frame of each marker, −1 for new poses: (n_markers,)."""
        return np.array([-1 if m.frame is None else m.frame for m in self.markers], dtype=np.intp)

    @property
    def n_frames(self) -> int:
        """Number of frames of the clip."""
        return len(self.embedding)

    def laid_out(self, markers: Iterable[Marker], embedding: Any) -> Scene:
        """Put markers and frames at other places; the trajectory goes along if it follows.

        Parameters
        ----------
        markers : iterable of Marker
            The markers.
        embedding : array-like of shape (n_frames, 2)
            Places of all frames; those of markers' frames are taken from the markers.

        Returns
        -------
        Scene

        Raises
        ------
        WorkbenchError
            If they do not fit each other.
        """
        markers = tuple(markers)
        places = np.array(embedding, dtype=np.float64)
        for marker in markers:
            if marker.frame is not None and marker.frame < len(places):
                places[marker.frame] = marker.position
        trajectory = self.trajectory
        if self.follows:
            trajectory = Trajectory(places, trajectory.times)
        return replace(self, markers=markers, embedding=places, trajectory=trajectory)

    def equals(self, other: Scene) -> bool:
        """Tell whether two scenes are the same to the last bit."""
        settings = ("clip", "frame_time", "follows", "kernel", "epsilon", "keep_feet")
        return (
            all(getattr(self, name) == getattr(other, name) for name in settings)
            and len(self.markers) == len(other.markers)
            and all(a.equals(b) for a, b in zip(self.markers, other.markers, strict=True))
            and _same(self.embedding, other.embedding)
            and _same(self.trajectory.points, other.trajectory.points)
            and _same(self.trajectory.times, other.trajectory.times)
        )


def _check_markers(markers: tuple[Marker, ...], embedding: NDArray[np.float64]) -> None:
    if len(markers) < MIN_MARKERS:
        raise WorkbenchError(f"markers: got {len(markers)}, want at least {MIN_MARKERS}")
    n_joints = len(markers[0].rotations)
    taken: set[int] = set()
    for marker in markers:
        if len(marker.rotations) != n_joints:
            raise WorkbenchError(
                f"marker {marker.name!r}: got a pose of {len(marker.rotations)} joints, "
                f"want {n_joints} as the first one has"
            )
        if marker.frame is None:
            continue
        if marker.frame >= len(embedding):
            raise WorkbenchError(
                f"marker {marker.name!r}: got frame {marker.frame} of {len(embedding)}"
            )
        if marker.frame in taken:
            raise WorkbenchError(
                f"marker {marker.name!r}: frame {marker.frame} has a marker already, "
                "want one marker for each frame"
            )
        taken.add(marker.frame)
        if not np.array_equal(embedding[marker.frame], marker.position):
            raise WorkbenchError(
                f"embedding: has frame {marker.frame} at another place than its marker, "
                "want them at the same"
            )


def _check_trajectory(scene: Scene) -> None:
    trajectory = scene.trajectory
    if not isinstance(trajectory, Trajectory) or trajectory.points.shape[1] != 2:
        raise WorkbenchError("trajectory: want a Trajectory on the plane")
    if scene.follows and not np.array_equal(trajectory.points, scene.embedding):
        raise WorkbenchError("trajectory: follows the clip but has other points than it")


def _keep(owner: Any, name: str, array: NDArray[np.float64]) -> None:
    """Store a copy that cannot be written: who kept a scene must find it as it was."""
    array = np.array(array, order="C")
    array.flags.writeable = False
    object.__setattr__(owner, name, array)


def _same(first: NDArray[np.float64], second: NDArray[np.float64]) -> bool:
    """Compare bits, so that 0 and −0 differ."""
    return first.shape == second.shape and first.tobytes() == second.tobytes()
