"""Radial basis functions with a linear kernel and a linear polynomial."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from sklearn.base import BaseEstimator, MultiOutputMixin, RegressorMixin
from sklearn.utils.validation import check_is_fitted, validate_data

from workbench.errors import DegenerateDataWarning

#: Rows evaluated at once, which bounds the memory of the kernel matrix.
_BLOCK = 8192


class RBF(MultiOutputMixin, RegressorMixin, BaseEstimator):
    """Rebuild samples by radial basis function interpolation from control points.

    f(x) = Σ_j w_j ‖x − c_j‖ + P(x), with a linear polynomial P, passes through the samples
    of all control points c_j (Costa 2018, Eq. 2.1 with the kernel of Eq. 2.3).

    The weights satisfy Σ w_j = 0 and Σ w_j c_j = 0. On the subspace of such weights the
    kernel matrix is negative definite, so the system is solved there by a Cholesky
    factorisation, and collinear control points, which leave P undetermined, get the P of
    smallest norm instead of a failure. Control points that coincide share the mean of
    their samples, which is the least-squares solution; a warning says so.

    Attributes
    ----------
    centers_ : ndarray of shape (n_centers, n_dimensions)
        The different control points.
    weights_ : ndarray of shape (n_centers, n_outputs)
        RBF weights.
    polynomial_ : ndarray of shape (n_dimensions + 1, n_outputs)
        Coefficients of P: the constant, then one row for each dimension.
    n_features_in_ : int
        Dimensions of the embedding.

    Examples
    --------
    >>> points = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]
    >>> RBF().fit(points, [0.0, 1.0, 1.0, 2.0]).predict([[0.25, 0.5]]).round(12)
    array([0.75])
    """

    centers_: NDArray[np.float64]
    weights_: NDArray[np.float64]
    polynomial_: NDArray[np.float64]

    def fit(self, X: ArrayLike, y: ArrayLike) -> RBF:
        """Find the weights that reproduce the samples at the control points.

        Parameters
        ----------
        X : array-like of shape (n_control_points, n_dimensions)
            Positions in the embedding.
        y : array-like of shape (n_control_points, n_outputs) or (n_control_points,)
            Samples there.

        Returns
        -------
        RBF
            Itself.

        Warns
        -----
        DegenerateDataWarning
            If control points with different samples coincide.
        """
        points, targets = validate_data(
            self, X, y, multi_output=True, y_numeric=True, dtype=np.float64
        )
        values = np.asarray(targets, dtype=np.float64)
        self._single_output = values.ndim == 1
        centers, values = _merge_coinciding(points, values.reshape(len(points), -1))

        # Centred and scaled, so that the polynomial part is as well conditioned as can be.
        middle = centers.mean(axis=0)
        size = float(np.abs(centers - middle).max()) or 1.0
        scaled = (centers - middle) / size
        polynomial = np.column_stack([np.ones(len(scaled)), scaled])
        left, singular, right = np.linalg.svd(polynomial, full_matrices=True)
        rank = int(np.sum(singular > 1e-10 * singular[0]))
        span, free = left[:, :rank], left[:, rank:]

        # Relative to one sample, so that equal samples stay equal everywhere, exactly.
        base = values[0]
        values = values - base
        kernel = _distances(scaled, scaled)
        weights = _solve_negative_definite(free, kernel, values)
        rest = span.T @ (values - kernel @ weights)
        coefficients = right[:rank].T @ (rest / singular[:rank, None])

        self.centers_ = centers
        self.weights_ = weights / size
        self.polynomial_ = np.vstack(
            [
                base + coefficients[0] - (middle / size) @ coefficients[1:],
                coefficients[1:] / size,
            ]
        )
        return self

    def predict(self, X: ArrayLike) -> NDArray[np.float64]:
        """Rebuild the samples at positions of the embedding.

        Parameters
        ----------
        X : array-like of shape (n_points, n_dimensions)
            Positions.

        Returns
        -------
        ndarray of shape (n_points, n_outputs), or (n_points,) if fitted so
        """
        check_is_fitted(self)
        points = validate_data(self, X, reset=False, dtype=np.float64)
        result = np.empty((len(points), self.weights_.shape[1]))
        for start in range(0, len(points), _BLOCK):
            block = points[start : start + _BLOCK]
            part = _distances(block, self.centers_) @ self.weights_
            part += block @ self.polynomial_[1:]
            part += self.polynomial_[0]
            result[start : start + _BLOCK] = part
        return result[:, 0] if self._single_output else result

    def __sklearn_tags__(self) -> Any:
        """Tell scikit-learn that fitting far from the plane is not what this is made for."""
        tags = super().__sklearn_tags__()
        tags.regressor_tags.poor_score = True
        return tags


def _distances(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    from scipy.spatial.distance import cdist

    return cdist(a, b)


def _merge_coinciding(
    points: NDArray[np.float64], values: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Replace control points at the same place by one with their mean sample.

    Points closer than 1e-12 of the cloud's extent count as the same: no weights could
    tell them apart in double precision.
    """
    extent = float(np.ptp(points, axis=0).max()) or 1.0
    keys = np.round((points - points.min(axis=0)) / (1e-12 * extent))
    _, first, group = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    if len(first) == len(points):
        return points, values
    group = group.ravel()
    sums = np.zeros((len(first), values.shape[1]))
    np.add.at(sums, group, values)
    means = sums / np.bincount(group)[:, None]
    if not np.allclose(means[group], values):
        warnings.warn(
            f"{len(points) - len(first)} control points coincide with others but have "
            "different samples; each place gets the mean of its samples",
            DegenerateDataWarning,
            stacklevel=3,
        )
    return points[first], means


def _solve_negative_definite(
    free: NDArray[np.float64], kernel: NDArray[np.float64], values: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Solve for kernel weights within the span of ``free``, refined once."""
    from scipy.linalg import cho_factor, cho_solve

    if free.shape[1] == 0:
        return np.zeros_like(values)
    matrix = -(free.T @ kernel @ free)
    try:
        factor = cho_factor(matrix)
    except np.linalg.LinAlgError:
        # Control points so close that rounding makes the matrix indefinite.
        return free @ np.linalg.lstsq(matrix, -(free.T @ values), rcond=None)[0]
    weights = free @ cho_solve(factor, -(free.T @ values))
    residual = free.T @ (values - kernel @ weights)
    return weights + free @ cho_solve(factor, -residual)
