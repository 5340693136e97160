"""A motion: one skeleton in a pose per frame."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.errors import WorkbenchError
from workbench.mocap.skeleton import Skeleton


@dataclass(frozen=True, eq=False)
class Motion:
    """A motion clip: rotations of all joints and the root's path, frame by frame.

    Parameters
    ----------
    skeleton : Skeleton
        The joints.
    rotations : ndarray of shape (n_frames, n_joints, 3, 3)
        Rotation of each joint relative to its parent; acts on column vectors.
    root_translation : ndarray of shape (n_frames, 3)
        World position of the root, in file units.
    frame_time : float
        Time between frames, in seconds.
    joint_translations : mapping of int to ndarray of shape (n_frames, 3)
        Positions relative to the parent of the joints, other than the root, that a file
        moves as well as turns; every other joint rests at its offset.
    name : str
        What to call the clip in messages and figures.

    Raises
    ------
    WorkbenchError
        If a shape does not fit the skeleton or the frame time is not a positive number.
    """

    skeleton: Skeleton
    rotations: NDArray[np.float64]
    root_translation: NDArray[np.float64]
    frame_time: float
    joint_translations: Mapping[int, NDArray[np.float64]] = field(default_factory=dict)
    name: str = ""

    def __post_init__(self) -> None:
        n_joints = self.skeleton.n_joints
        shape = np.shape(self.rotations)
        if len(shape) != 4 or shape[0] == 0 or shape[1:] != (n_joints, 3, 3):
            raise WorkbenchError(
                f"rotations: got shape {shape}, want (n_frames, {n_joints}, 3, 3), "
                "at least one frame"
            )
        if np.shape(self.root_translation) != (shape[0], 3):
            raise WorkbenchError(
                f"root_translation: got shape {np.shape(self.root_translation)}, "
                f"want ({shape[0]}, 3)"
            )
        for joint, translations in self.joint_translations.items():
            if not 0 < joint < n_joints or np.shape(translations) != (shape[0], 3):
                raise WorkbenchError(
                    f"joint_translations: got shape {np.shape(translations)} for joint {joint}, "
                    f"want ({shape[0]}, 3) for a joint from 1 to {n_joints - 1}"
                )
        if not 0 < self.frame_time < np.inf:
            raise WorkbenchError(f"frame_time: got {self.frame_time}, want seconds above 0")

    def __len__(self) -> int:
        return len(self.rotations)

    def __getitem__(self, frames: slice) -> Motion:
        """Cut out a range of frames; a step thins them and slows the clock accordingly."""
        if not isinstance(frames, slice):
            raise WorkbenchError(f"frames: got {frames!r}, want a slice such as motion[10:200]")
        start, stop, step = frames.indices(len(self))
        if step < 1 or stop <= start:
            raise WorkbenchError(f"frames: got {frames!r} of {len(self)}, want at least one frame")
        frames = slice(start, stop, step)
        return replace(
            self,
            rotations=self.rotations[frames],
            root_translation=self.root_translation[frames],
            frame_time=self.frame_time * step,
            joint_translations={j: t[frames] for j, t in self.joint_translations.items()},
        )


def check_motion(motion: Any) -> None:
    """Refuse what is no motion.

    Raises
    ------
    WorkbenchError
        If it is not; the message says how to get one.

    Examples
    --------
    >>> check_motion("walk.bvh")
    Traceback (most recent call last):
    workbench.errors.WorkbenchError: motion: got str, want a Motion as read_bvh gives it
    """
    if not isinstance(motion, Motion):
        raise WorkbenchError(
            f"motion: got {type(motion).__name__}, want a Motion as read_bvh gives it"
        )
