"""Linear interpolation of Euler angles."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from workbench.interpolation import segments
from workbench.mocap.channels import motion_to_euler, rotations_from_channels
from workbench.mocap.motion import Motion
from workbench.validation import control_point_indices


class Linear:
    """Interpolate each joint's Euler angles linearly from keyframe to keyframe.

    Angles are unwrapped along the clip first: across a jump from 180 to -180 degrees the
    joint would else turn the whole way back (Costa 2018, chapter 5, "Linear").
    """

    def interpolate(self, motion: Motion, keyframes: NDArray[np.intp]) -> NDArray[np.float64]:
        """Rebuild the rotations of all frames.

        Parameters
        ----------
        motion : Motion
            The clip. Euler angles are taken in each joint's own channel order.
        keyframes : ndarray of shape (n_keys,)
            Sorted frame indices, at least two.

        Returns
        -------
        ndarray of shape (n_frames, n_joints, 3, 3)
        """
        keyframes = control_point_indices(keyframes, len(motion))
        left, share = segments(keyframes, len(motion))
        keys = motion_to_euler(motion, unwrap=True)[keyframes]
        degrees = keys[left] + share[:, None] * (keys[left + 1] - keys[left])
        return rotations_from_channels(motion.skeleton, degrees)
