"""Spherical linear interpolation."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from workbench.interpolation import segments
from workbench.mocap.motion import Motion
from workbench.mocap.slerp import slerp
from workbench.validation import control_point_indices


class Slerp:
    """Turn each joint at constant speed from keyframe to keyframe, the shorter way round.

    Spherical linear interpolation of rotations (Costa 2018, chapter 5, "Slerp").
    """

    def interpolate(self, motion: Motion, keyframes: NDArray[np.intp]) -> NDArray[np.float64]:
        """Rebuild the rotations of all frames.

        Parameters
        ----------
        motion : Motion
            The clip, of which only the keyframes' rotations are used.
        keyframes : ndarray of shape (n_keys,)
            Sorted frame indices, at least two.

        Returns
        -------
        ndarray of shape (n_frames, n_joints, 3, 3)
        """
        keyframes = control_point_indices(keyframes, len(motion))
        left, share = segments(keyframes, len(motion))
        keys = motion.rotations[keyframes]
        return slerp(keys[left], keys[left + 1], share[:, None])
