"""Spherical linear interpolation."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from workbench.interpolation.base import Interpolator, segments
from workbench.mocap.motion import Motion
from workbench.mocap.rotations import rotation_vectors, rotations_from_vectors
from workbench.mocap.skeleton import Skeleton
from workbench.mocap.slerp import slerp


class Slerp(Interpolator):
    """Turn each joint at constant speed from keyframe to keyframe, the shorter way round.

    Spherical linear interpolation of rotations (Costa 2018, chapter 5, "Slerp"). Three
    numbers are kept of each joint and keyframe, its rotation vector.
    """

    def encode(self, motion: Motion, keyframes: NDArray[np.intp]) -> NDArray[np.float64]:
        """Take the rotation vectors of the keyframes: (n_keys, 3 · n_joints), in radians."""
        return rotation_vectors(motion.rotations[keyframes]).reshape(len(keyframes), -1)

    def decode(
        self,
        keys: NDArray[np.float64],
        keyframes: NDArray[np.intp],
        n_frames: int,
        skeleton: Skeleton,
    ) -> NDArray[np.float64]:
        """Rebuild the rotations of all frames: (n_frames, n_joints, 3, 3)."""
        rotations = rotations_from_vectors(keys.reshape(len(keys), skeleton.n_joints, 3))
        left, share = segments(keyframes, n_frames)
        return slerp(rotations[left], rotations[left + 1], share[:, None])
