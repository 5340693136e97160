"""Projection of samples by radial basis functions of their distances to control points."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from numbers import Real
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import AdjustmentWarning, DegenerateDataWarning, WorkbenchError
from workbench.projection.control_points import ControlPointProjector
from workbench.spaces import Space, VectorSpace, check_space
from workbench.validation import control_point_indices, require_memory

Kernel = Callable[[NDArray[np.float64]], NDArray[np.float64]]

#: φ of the distance times ε.
KERNELS: dict[str, Kernel] = {
    "multiquadric": lambda r: np.sqrt(1.0 + r * r),
    "linear": lambda r: r,
    "inverse-multiquadric": lambda r: 1.0 / np.sqrt(1.0 + r * r),
    "gaussian": lambda r: np.exp(-r * r),
}

# Largest miss at a control point, relative to the extent of the positions.
_TOLERANCE = 1e-9

# Largest ε, relative to the largest distance between control points.
_NARROWEST = 1e8


class RBFP(ControlPointProjector):
    """Place samples by radial basis functions of their distances to the control points.

    f(x) = Σ_j w_j φ(ε · d(x, c_j)), without a polynomial, where the weights w_j solve
    f(c_i) = y_i (Amorim et al. 2014; Costa 2018, Alg. 10 with the kernel of Eq. 2.4). The
    argument d is the Euclidean distance of vectors and √D_q of poses.

    ε = 1 acts on distances as they are, so the same table in other units gives another map.
    Where control points are close on that scale, the system is so ill-conditioned that its
    solution misses the control points in double precision. ε is then doubled until each of
    them gets its position, to 1e-9 of the map's extent, with a warning: the kernels become
    narrower, the matrix well conditioned, and the map comes close to that of the kernel r.

    Parameters
    ----------
    kernel : {"multiquadric", "linear", "inverse-multiquadric", "gaussian"}
        φ(r) = √(1 + r²), r, 1/√(1 + r²) or exp(−r²).
    epsilon : float
        ε, in the inverse unit of d.
    smoothing : float
        0 for a map that passes through all positions. Larger values, which are added to the
        absolute value of each eigenvalue of the kernel matrix, keep the weights small and
        let the map miss positions instead; ε then stays as it is.

    Warns
    -----
    AdjustmentWarning
        If ε was raised.
    DegenerateDataWarning
        If equal control points have different positions, which get the mean, or control
        points are so close that the map misses them.

    Attributes
    ----------
    epsilon_ : float
        The ε that was used.
    weights_ : ndarray of shape (n_control_points, n_components)
        The weights w_j.

    Examples
    --------
    >>> space = VectorSpace([[0.0], [1.0], [2.0], [3.0]])
    >>> projector = RBFP().fit(space, [0, 1, 3], [[0.0, 0.0], [1.0, 1.0], [3.0, 1.0]])
    >>> projector.transform([[0.0], [1.0], [3.0]]).round(9) + 0.0
    array([[0., 0.],
           [1., 1.],
           [3., 1.]])
    """

    epsilon_: float
    weights_: NDArray[np.float64]

    def __init__(
        self, kernel: str = "multiquadric", *, epsilon: float = 1.0, smoothing: float = 0.0
    ) -> None:
        if kernel not in KERNELS:
            raise WorkbenchError(f"kernel: got {kernel!r}, want one of {', '.join(KERNELS)}")
        if not _is_number(epsilon) or epsilon <= 0.0:
            raise WorkbenchError(f"epsilon: got {epsilon!r}, want a number above 0")
        if not _is_number(smoothing) or smoothing < 0.0:
            raise WorkbenchError(f"smoothing: got {smoothing!r}, want a number from 0")
        self.kernel = kernel
        self.epsilon = epsilon
        self.smoothing = smoothing

    def influence(self, space: Space, control_points: ArrayLike) -> NDArray[np.float64]:
        """Say how much each control point's position counts for each sample.

        Placing is linear: ``influence @ positions``, with the positions of the control points,
        places all samples as ``fit`` and ``transform`` do with the same ε, wherever control
        points move. The ε is one that serves all positions, so it may be larger than the one
        that ``fit`` finds enough for those at hand.

        Parameters
        ----------
        space : Space
            The samples.
        control_points : array-like of shape (n_control_points,)
            Sorted indices.

        Returns
        -------
        ndarray of shape (n_samples, n_control_points)
            Rows of control points are unit vectors, also of those equal to others.

        Raises
        ------
        WorkbenchError
            If the indices are not valid.
        DataError
            If the free memory does not suffice.

        Examples
        --------
        >>> space = VectorSpace([[0.0], [1.0], [2.0], [3.0]])
        >>> influence = RBFP("linear").influence(space, [0, 1, 3])
        >>> (influence @ [[0.0, 0.0], [1.0, 1.0], [3.0, 1.0]]).round(9) + 0.0
        array([[0., 0.],
               [1., 1.],
               [2., 1.],
               [3., 1.]])
        """
        check_space(space)
        indices = control_point_indices(control_points, len(space))
        require_memory(
            16.0 * len(space) * len(indices),
            f"the influence of {len(indices)} control points on {len(space)} samples",
            "take fewer control points",
        )
        unit = np.eye(len(indices))
        with warnings.catch_warnings():
            # Equal control points have different unit vectors whatever their positions are.
            warnings.simplefilter("ignore", DegenerateDataWarning)
            warnings.simplefilter("ignore", AdjustmentWarning)
            self._learn(space, indices, unit)
        shares = self.transform(space.samples)
        shares[indices] = unit
        return shares

    def _fit(self) -> None:
        distances = self._distances(self.control_samples_)
        # What equal samples differ by is rounding, and its root would be none any more.
        np.fill_diagonal(distances, 0.0)
        self.epsilon_ = self.epsilon
        if self.smoothing > 0.0:
            self.weights_ = self._smoothed(self._kernel(distances))
            return
        self.weights_, missed = self._interpolating(self._kernel(distances))
        # The linear kernel has no scale; others end as narrow as the closest two samples need.
        narrowest = 0.0 if self.kernel == "linear" else _NARROWEST / distances.max(initial=1e-300)
        while missed > _TOLERANCE and self.epsilon_ < narrowest:
            self.epsilon_ *= 2.0
            self.weights_, missed = self._interpolating(self._kernel(distances))
        if self.epsilon_ != self.epsilon:
            warnings.warn(
                f"RBFP: epsilon={self.epsilon:g} raised to {self.epsilon_:g}, because the map "
                f"would else miss its {len(distances)} control points by rounding",
                AdjustmentWarning,
                stacklevel=3,
            )
        if missed > _TOLERANCE:
            warnings.warn(
                f"RBFP: control points are too close to each other: the map misses one by "
                f"{missed:.1g} of its extent",
                DegenerateDataWarning,
                stacklevel=3,
            )

    def _transform(self, samples: NDArray[np.float64]) -> NDArray[np.float64]:
        return self._kernel(self._distances(samples)) @ self.weights_

    def _distances(self, samples: NDArray[np.float64]) -> NDArray[np.float64]:
        """Measure d between samples and control points: (n_samples, n_control_points)."""
        distances = self.space_.cross_distances(samples, self.control_samples_)
        return distances if isinstance(self.space_, VectorSpace) else np.sqrt(distances)

    def _kernel(self, distances: NDArray[np.float64]) -> NDArray[np.float64]:
        return KERNELS[self.kernel](self.epsilon_ * distances)

    def _interpolating(self, matrix: NDArray[np.float64]) -> tuple[NDArray[np.float64], float]:
        """Solve for the weights; tell by how much of the extent they miss a position."""
        from scipy.linalg import lu_factor, lu_solve

        with warnings.catch_warnings(), np.errstate(all="ignore"):
            # A matrix that is singular shows in what the solution misses.
            warnings.simplefilter("ignore")
            factor = lu_factor(matrix, check_finite=False)
            weights = lu_solve(factor, self.positions_, check_finite=False)
            residual = self.positions_ - matrix @ weights
            weights = weights + lu_solve(factor, residual, check_finite=False)
            missed = float(np.abs(self.positions_ - matrix @ weights).max())
        extent = float(np.ptp(self.positions_, axis=0).max()) or 1.0
        return weights, missed / extent if np.isfinite(missed) else np.inf

    def _smoothed(self, matrix: NDArray[np.float64]) -> NDArray[np.float64]:
        values, vectors = np.linalg.eigh(matrix)
        values += np.copysign(self.smoothing, values)
        weights: NDArray[np.float64] = vectors @ ((vectors.T @ self.positions_) / values[:, None])
        return weights


def _is_number(value: Any) -> bool:
    return isinstance(value, Real) and bool(np.isfinite(float(value)))
