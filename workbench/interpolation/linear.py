"""Linear interpolation of Euler angles."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from workbench.interpolation.base import Interpolator, segments
from workbench.mocap.channels import motion_to_euler, rotations_from_channels
from workbench.mocap.motion import Motion
from workbench.mocap.skeleton import Skeleton


class Linear(Interpolator):
    """Interpolate each joint's Euler angles linearly from keyframe to keyframe.

    Angles are unwrapped along the clip first: across a jump from 180 to -180 degrees the
    joint would else turn the whole way back (Costa 2018, chapter 5, "Linear").
    """

    def encode(self, motion: Motion, keyframes: NDArray[np.intp]) -> NDArray[np.float64]:
        """Take the unwrapped angles of the keyframes, in degrees: (n_keys, n_channels).

        Angles are those of each joint's own channel order.
        """
        return motion_to_euler(motion, unwrap=True)[keyframes]

    def decode(
        self,
        keys: NDArray[np.float64],
        keyframes: NDArray[np.intp],
        n_frames: int,
        skeleton: Skeleton,
    ) -> NDArray[np.float64]:
        """Rebuild the rotations of all frames: (n_frames, n_joints, 3, 3)."""
        left, share = segments(keyframes, n_frames)
        degrees = keys[left] + share[:, None] * (keys[left + 1] - keys[left])
        return rotations_from_channels(skeleton, degrees)
