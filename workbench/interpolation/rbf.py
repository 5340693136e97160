"""Radial basis functions in time."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from workbench.errors import WorkbenchError
from workbench.interpolation.base import Interpolator, segments
from workbench.mocap.motion import Motion
from workbench.mocap.nearest_rotation import nearest_rotations
from workbench.mocap.rotations import rotation_vectors, rotations_from_vectors
from workbench.mocap.skeleton import Skeleton

KERNELS = ("linear", "cubic")


class RBFInTime(Interpolator):
    """Rebuild poses as spatial keyframes do, with time in place of the plane.

    Every matrix entry of every joint is a radial basis function of time with a linear
    polynomial, f(t) = Σ_j w_j φ(|t − t_j|) + p₀ + p₁t through all keyframes; the nearest
    rotation to the interpolated matrix is taken (Costa 2018, Table 5.1, "1D-RBF"; the text
    names neither kernel nor polynomial, here those of its Eq. 2.1-2.3).

    With Σ w_j = 0 and Σ w_j t_j = 0 such a function of one variable *is* a spline: for the
    kernel r the broken line through the keyframes, for r³ the natural cubic spline. It is
    evaluated as what it is, which needs no dense system and no more time or digits for
    thousands of keyframes than for three. The broken line explains why Table 5.1 gives this
    method nearly the values of slerp: the ratio of the medians is 0.996 there and 0.995 on
    nine clips here. Frames outside the keyframes hold their pose.

    Parameters
    ----------
    kernel : {"linear", "cubic"}
        φ(r) = r, the kernel of spatial keyframes, or r³.

    Examples
    --------
    >>> from workbench.mocap.rotations import axis_rotation
    >>> hinge = Skeleton(("knee",), [-1], [[0, 0, 0]], (), (("Zrotation",),))
    >>> motion = Motion(hinge, axis_rotation("Z", [[0.0], [10.0], [90.0]]), np.zeros((3, 3)), 0.1)
    >>> middle = RBFInTime().interpolate(motion, [0, 2])[1, 0]
    >>> bool(np.allclose(middle, axis_rotation("Z", 45.0)))
    True
    """

    def __init__(self, kernel: str = "linear") -> None:
        if kernel not in KERNELS:
            raise WorkbenchError(f"kernel: got {kernel!r}, want one of {', '.join(KERNELS)}")
        self.kernel = kernel

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
        entries = rotations.reshape(len(keys), -1)
        if self.kernel == "cubic":
            rebuilt = _natural_cubic(entries, keyframes, n_frames)
        else:
            left, share = segments(keyframes, n_frames)
            rebuilt = entries[left] + share[:, None] * (entries[left + 1] - entries[left])
        rebuilt[keyframes] = entries
        return nearest_rotations(rebuilt.reshape(n_frames, skeleton.n_joints, 3, 3))


def _natural_cubic(
    values: NDArray[np.float64], keyframes: NDArray[np.intp], n_frames: int
) -> NDArray[np.float64]:
    from scipy.interpolate import CubicSpline

    frames = np.clip(np.arange(n_frames), keyframes[0], keyframes[-1])
    curves: NDArray[np.float64] = CubicSpline(keyframes, values, bc_type="natural")(frames)
    return curves
