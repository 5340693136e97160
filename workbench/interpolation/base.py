"""What interpolators share."""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.mocap.motion import Motion, check_motion
from workbench.mocap.rotations import check_rotations
from workbench.mocap.skeleton import Skeleton
from workbench.validation import control_point_indices, finite


class Interpolator(ABC):
    """The base of interpolators: what is kept of the keyframes, and how the rest is rebuilt.

    The two are apart because a compact file holds the first and has to do with it.
    """

    @abstractmethod
    def encode(self, motion: Motion, keyframes: NDArray[np.intp]) -> NDArray[np.float64]:
        """Take from a motion what is kept of its keyframes.

        Parameters
        ----------
        motion : Motion
            The clip.
        keyframes : ndarray of shape (n_keys,)
            Sorted frame indices.

        Returns
        -------
        ndarray of shape (n_keys, n_values)
        """

    @abstractmethod
    def decode(
        self,
        keys: NDArray[np.float64],
        keyframes: NDArray[np.intp],
        n_frames: int,
        skeleton: Skeleton,
    ) -> NDArray[np.float64]:
        """Rebuild the rotations of all frames from what was kept.

        Parameters
        ----------
        keys : ndarray of shape (n_keys, n_values)
            As ``encode`` gave it.
        keyframes : ndarray of shape (n_keys,)
            Sorted frame indices, at least two.
        n_frames : int
            Number of frames.
        skeleton : Skeleton
            The clip's joints.

        Returns
        -------
        ndarray of shape (n_frames, n_joints, 3, 3)
        """

    def interpolate(self, motion: Motion, keyframes: ArrayLike) -> NDArray[np.float64]:
        """Rebuild the rotations of all frames of a motion from its keyframes.

        Parameters
        ----------
        motion : Motion
            The clip.
        keyframes : array-like of shape (n_keys,)
            Sorted frame indices, at least two.

        Returns
        -------
        ndarray of shape (n_frames, n_joints, 3, 3)

        Raises
        ------
        WorkbenchError
            If the keyframes are no sorted indices of the clip's frames, each once, or its
            matrices are no rotations.
        """
        check_motion(motion)
        check_rotations("rotations", finite(motion.rotations, "rotations"))
        keyframes = control_point_indices(keyframes, len(motion), at_least=2)
        keys = self.encode(motion, keyframes)
        return self.decode(keys, keyframes, len(motion), motion.skeleton)


def segments(
    keyframes: NDArray[np.intp], n_frames: int
) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Find where each frame lies between its two keyframes.

    Frames before the first or after the last keyframe hold its pose.

    Parameters
    ----------
    keyframes : ndarray of shape (n_keys,)
        Sorted indices, at least two.
    n_frames : int
        Number of frames.

    Returns
    -------
    left : ndarray of shape (n_frames,)
        Position, in ``keyframes``, of the keyframe before each frame.
    share : ndarray of shape (n_frames,)
        How far the frame is on the way to the next keyframe, from 0 to 1.

    Examples
    --------
    >>> segments(np.array([0, 4]), 5)[1]
    array([0.  , 0.25, 0.5 , 0.75, 1.  ])
    """
    frames = np.arange(n_frames)
    left = np.clip(np.searchsorted(keyframes, frames, side="right") - 1, 0, len(keyframes) - 2)
    start, end = keyframes[left], keyframes[left + 1]
    return left, np.clip((frames - start) / (end - start), 0.0, 1.0)
