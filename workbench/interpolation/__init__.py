"""Interpolators: in-between poses from keyframes and their times.

An interpolator has one method, ``interpolate(motion, keyframes)``, which rebuilds the
rotations of all frames from those at the keyframes.
"""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from workbench.mocap.motion import Motion
from workbench.registry import Registry


class Interpolator(Protocol):
    """What an interpolator offers."""

    def interpolate(self, motion: Motion, keyframes: NDArray[np.intp]) -> NDArray[np.float64]:
        """Rebuild the rotations of all frames: (n_frames, n_joints, 3, 3)."""
        ...


interpolators = Registry(
    "interpolator",
    {
        "linear": "workbench.interpolation.linear:Linear",
        "slerp": "workbench.interpolation.slerp:Slerp",
    },
)
register_interpolator = interpolators.register


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
