"""Radial basis functions with a linear polynomial."""

from __future__ import annotations

from numbers import Real
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from sklearn.base import BaseEstimator, MultiOutputMixin, RegressorMixin

from workbench.backprojection.checking import at_most, control_points, empty_result, positions
from workbench.backprojection.places import Places, merge_coinciding, spread_out
from workbench.backprojection.radial import (
    RadialKernel,
    fill_basis,
    fill_basis_derivatives,
    radial_kernel,
)
from workbench.backprojection.rbf_system import solve
from workbench.errors import WorkbenchError

#: Numbers in the matrix of basis functions that is evaluated at once: 4 MB.
_BLOCK = 2**19


class RBF(MultiOutputMixin, RegressorMixin, BaseEstimator):
    """Rebuild samples by radial basis function interpolation from control points.

    f(x) = Σ_j w_j φ(‖x − c_j‖) + P(x), with a linear polynomial P, passes through the
    samples of all control points c_j (Costa 2018, Eq. 2.1 with the kernel of Eq. 2.3).

    The weights satisfy Σ w_j = 0 and Σ w_j c_j = 0. On the subspace of such weights every
    kernel offered is definite, so the system is solved there by a Cholesky factorisation,
    and collinear control points, which leave P undetermined, get the P of smallest norm
    instead of a failure. The polynomial, degree 1 whatever the kernel, is what thin plates
    and cubics need to be solvable; with it all kernels continue a plane exactly. Control
    points that coincide share the mean of their samples, which is the least-squares
    solution; a warning says so.

    Parameters
    ----------
    kernel : {"linear", "thin-plate", "cubic", "gaussian", "multiquadric"}
        φ(r): r (Costa 2018, Eq. 2.3), r² log r, r³, exp(−ε²r²), √(1 + ε²r²). All but the
        linear one, which has a kink at each control point, are smooth there. On four tables
        and three motions under PCA and t-SNE, with 6 % control points, the linear kernel had
        the lowest error in the median (thin plates 1.09 times that, multiquadrics 1.19,
        Gaussians 1.20, cubics 1.30); thin plates were 4 to 8 % better on the motions under
        t-SNE.
    epsilon : float, optional
        Inverse width ε of the last two, per unit of the embedding. By default
        1 / (0.815 · mean distance from a centre to its nearest one), as Hardy (1971) has it.
    smoothing : float
        λ of Σ_i ‖y_i − f(x_i)‖² + λ E(f), E the energy of the kernel; 0 interpolates.
        Its unit is that of φ, as in scipy's ``RBFInterpolator``.
    centers : int, optional
        Use that many of the control points as centres, spread over the plane, and fit the
        rest by least squares; evaluation then costs that much less. By default all of them
        are centres.

    Attributes
    ----------
    centers_ : ndarray of shape (n_centers, n_dimensions)
        The centres, all different.
    weights_ : ndarray of shape (n_centers, n_outputs)
        Weights w_j.
    polynomial_ : ndarray of shape (n_dimensions + 1, n_outputs)
        Coefficients of P: the constant, then one row for each dimension.
    epsilon_ : float
        The ε that was used; 1 for kernels without a width.
    n_features_in_ : int
        Dimensions of the embedding.

    References
    ----------
    Hardy, R. L. (1971). Multiquadric equations of topography and other irregular surfaces.
    Micchelli, C. A. (1986). Interpolation of scattered data: distance matrices and
    conditionally positive definite functions.

    Examples
    --------
    >>> points = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]
    >>> model = RBF().fit(points, [0.0, 1.0, 1.0, 2.0])
    >>> model.predict([[0.25, 0.5]]).round(12)
    array([0.75])
    >>> model.jacobian([[0.25, 0.5]]).round(12)
    array([[[1., 1.]]])
    """

    centers_: NDArray[np.float64]
    weights_: NDArray[np.float64]
    polynomial_: NDArray[np.float64]
    epsilon_: float

    def __init__(
        self,
        kernel: str = "linear",
        *,
        epsilon: float | None = None,
        smoothing: float = 0.0,
        centers: int | None = None,
    ) -> None:
        self.kernel = kernel
        self.epsilon = epsilon
        self.smoothing = smoothing
        self.centers = centers

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

        Raises
        ------
        WorkbenchError
            If a parameter, a position or a sample is not valid.

        Warns
        -----
        DegenerateDataWarning
            If control points with different samples coincide and are to be interpolated.
        AdjustmentWarning
            If there are fewer control points than ``centers``.
        """
        kernel = radial_kernel(self.kernel)
        smoothing = _number("smoothing", self.smoothing, allow_zero=True)
        if self.epsilon is not None:
            _number("epsilon", self.epsilon, allow_zero=False)
        points, values = control_points(self, X, y)
        self._single_output = values.ndim == 1
        places = merge_coinciding(points, values.reshape(len(points), -1))
        self.centers_ = self._choose_centers(places)
        if smoothing == 0 and len(self.centers_) == len(places.points):
            places.warn_if_contradicting()
        self.epsilon_ = self._choose_epsilon(kernel)
        self.weights_, self.polynomial_ = solve(
            kernel, self.epsilon_, smoothing, places, self.centers_
        )
        self._coefficients = np.vstack([self.weights_, self.polynomial_])
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
        points = positions(self, X)
        values = self._values(points)
        return values[:, 0] if self._single_output else values

    def jacobian(self, X: ArrayLike) -> NDArray[np.float64]:
        """Differentiate the rebuilt samples by the position.

        ∂f/∂x = Σ_j w_j φ'(r_j) (x − c_j) / r_j + ∂P/∂x. The linear kernel has a kink at its
        centre; there its contribution is the mean of the two one-sided derivatives, 0.

        Parameters
        ----------
        X : array-like of shape (n_points, n_dimensions)
            Positions.

        Returns
        -------
        ndarray of shape (n_points, n_outputs, n_dimensions)
            A view, in memory one dimension of the embedding after the other:
            ``np.swapaxes(jacobian, 1, 2)`` is contiguous.
        """
        return self._derivatives(positions(self, X))

    def predict_with_jacobian(
        self, X: ArrayLike
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Rebuild the samples and differentiate them by the position.

        Parameters
        ----------
        X : array-like of shape (n_points, n_dimensions)
            Positions.

        Returns
        -------
        values : ndarray of shape (n_points, n_outputs), or (n_points,) if fitted so
            As :meth:`predict` gives them.
        jacobian : ndarray of shape (n_points, n_outputs, n_dimensions)
            As :meth:`jacobian` gives it.
        """
        points = positions(self, X)
        values = self._values(points)
        return (values[:, 0] if self._single_output else values), self._derivatives(points)

    def __sklearn_tags__(self) -> Any:
        """Tell scikit-learn that fitting far from the plane is not what this is made for."""
        tags = super().__sklearn_tags__()
        tags.regressor_tags.poor_score = True
        return tags

    def _values(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        code = radial_kernel(self.kernel).code
        result = empty_result(len(points), self._coefficients.shape[1])
        rows = max(1, _BLOCK // len(self._coefficients))
        basis = np.empty((min(rows, len(points)), len(self._coefficients)))
        for start in range(0, len(points), rows):
            block = points[start : start + rows]
            part = basis[: len(block)]
            fill_basis(code, self.epsilon_, block, self.centers_, part)
            np.dot(part, self._coefficients, out=result[start : start + rows])
        return result

    def _derivatives(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        code = radial_kernel(self.kernel).code
        n_basis, n_outputs = self._coefficients.shape
        dimensions = points.shape[1]
        result = empty_result(len(points), dimensions, n_outputs)
        rows = max(1, _BLOCK // (dimensions * n_basis))
        basis = np.empty((min(rows, len(points)), dimensions, n_basis))
        for start in range(0, len(points), rows):
            block = points[start : start + rows]
            part = basis[: len(block)]
            fill_basis_derivatives(code, self.epsilon_, block, self.centers_, part)
            np.dot(
                part.reshape(-1, n_basis),
                self._coefficients,
                out=result[start : start + rows].reshape(-1, n_outputs),
            )
        return np.swapaxes(result, 1, 2)

    def _choose_centers(self, places: Places) -> NDArray[np.float64]:
        if self.centers is None:
            return places.points
        count = at_most(self, "centers", int(places.counts.sum()))
        if count >= len(places.points):
            return places.points
        return places.points[spread_out(places.points, count)]

    def _choose_epsilon(self, kernel: RadialKernel) -> float:
        if kernel.power == 0 and self.epsilon is not None:
            return float(self.epsilon)
        if kernel.power > 0 or len(self.centers_) == 1:
            return 1.0
        from scipy.spatial import KDTree

        gaps, _ = KDTree(self.centers_).query(self.centers_, k=2)
        return float(1.0 / (0.815 * gaps[:, 1].mean()))


def _number(name: str, value: Any, *, allow_zero: bool) -> float:
    """Refuse what is no finite number above 0, or 0 where that is allowed."""
    good = isinstance(value, Real) and not isinstance(value, bool) and np.isfinite(float(value))
    if not good or value < 0 or (value == 0 and not allow_zero):
        wanted = "a number of at least 0" if allow_zero else "a number above 0"
        raise WorkbenchError(f"{name}: got {value!r}, want {wanted}")
    return float(value)
