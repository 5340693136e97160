"""The linear systems behind radial basis functions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from workbench.backprojection.places import Places
from workbench.backprojection.radial import KERNELS, RadialKernel, kernel_matrix
from workbench.validation import require_memory


def solve(
    kernel: RadialKernel,
    epsilon: float,
    smoothing: float,
    places: Places,
    centers: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Find weights and polynomial for given centres.

    They minimise Σ_i n_i ‖y_i − f(x_i)‖² + λ E(f), where n_i control points are at place
    x_i, λ is the smoothing and E the energy that the kernel stands for, and reproduce the
    samples if λ is 0 and every place is a centre.

    Parameters
    ----------
    kernel : RadialKernel
        The kernel.
    epsilon : float
        Its inverse width.
    smoothing : float
        At least 0.
    places : Places
        The control points.
    centers : ndarray of shape (n_centers, n_dimensions)
        All places in their order, or some of them.

    Returns
    -------
    weights : ndarray of shape (n_centers, n_outputs)
    polynomial : ndarray of shape (n_dimensions + 1, n_outputs)
        The constant, then one row for each dimension.

    Raises
    ------
    DataError
        If memory will not suffice for the matrix.
    """
    # Centred and scaled, so that the polynomial part is as well conditioned as can be.
    points = places.points
    middle = points.mean(axis=0)
    size = float(np.abs(points - middle).max()) or 1.0
    points, nodes = (points - middle) / size, (centers - middle) / size
    scaled_epsilon = epsilon * size
    scaled_smoothing = smoothing / size**kernel.power
    # Relative to one sample, so that equal samples stay equal everywhere, exactly.
    base = places.values[0]
    values = places.values - base

    require_memory(
        40.0 * len(points) * len(nodes),
        f"radial basis functions with {len(nodes)} centres for {len(points)} control points",
        "take fewer centres (`centers`) or fewer control points",
    )
    matrix = kernel_matrix(kernel, scaled_epsilon, points, nodes)
    if len(nodes) == len(points):
        weights, coefficients = _interpolate(
            kernel.sign, matrix, values, nodes, scaled_smoothing / places.counts
        )
    else:
        among = kernel_matrix(kernel, scaled_epsilon, nodes, nodes)
        weights, coefficients = _least_squares(
            kernel.sign, matrix, among, values, points, nodes, scaled_smoothing, places.counts
        )
    constant = base + coefficients[0] - (middle / size) @ coefficients[1:]
    if kernel is KERNELS["thin-plate"]:
        # log(r / size) = log r − log size; the latter adds the same everywhere, because the
        # weights do not see linear polynomials.
        constant = constant - np.log(size) * ((nodes**2).sum(axis=1) @ weights)
    polynomial = np.vstack([constant, coefficients[1:] / size])
    return weights / size**kernel.power, polynomial


def _interpolate(
    sign: int,
    matrix: NDArray[np.float64],
    values: NDArray[np.float64],
    nodes: NDArray[np.float64],
    smoothing: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Solve (K + sign·Λ) w + P b = y with Pᵀ w = 0, for the b of smallest norm."""
    polynomial = _PolynomialAtNodes.of(nodes)
    system = sign * matrix
    system[np.diag_indices_from(system)] += smoothing
    weights = _solve_definite(polynomial, system, values)
    return sign * weights, polynomial.coefficients(values - system @ weights)


def _least_squares(
    sign: int,
    matrix: NDArray[np.float64],
    among: NDArray[np.float64],
    values: NDArray[np.float64],
    points: NDArray[np.float64],
    nodes: NDArray[np.float64],
    smoothing: float,
    counts: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Minimise ‖√n (K w + P b − y)‖² + λ wᵀ (sign·K_nodes) w with w unseen by P at the nodes."""
    polynomial = _PolynomialAtNodes.of(nodes)
    n_unseen = len(nodes) - polynomial.rank
    emphasis = np.sqrt(counts)[:, None]
    design = np.hstack([polynomial.unseen(matrix.T).T, np.ones((len(points), 1)), points])
    design *= emphasis
    wanted = values * emphasis
    if smoothing > 0 and n_unseen:
        energy, directions = np.linalg.eigh(sign * polynomial.unseen(polynomial.unseen(among).T))
        penalty = np.zeros((n_unseen, design.shape[1]))
        strength = np.sqrt(smoothing * np.maximum(energy, 0.0))
        penalty[:, :n_unseen] = strength[:, None] * directions.T
        design = np.vstack([design, penalty])
        wanted = np.vstack([wanted, np.zeros((n_unseen, values.shape[1]))])
    solution = _least_norm(design, wanted, 1e-13)
    return polynomial.expanded(solution[:n_unseen]), solution[n_unseen:]


@dataclass(frozen=True)
class _PolynomialAtNodes:
    """The linear polynomials at the nodes, and the weights that they do not see.

    The singular value decomposition of the basis 1, x at the nodes has the rank d + 1, or
    less if the nodes are collinear. A block reflector H = I − W (I + P)⁻¹ Wᵀ, symmetric and
    orthogonal, turns its range into the first unit vectors (Schreiber & Parlett 1988), so
    that the other columns of H span the weights it does not see, without ever being formed.

    Attributes
    ----------
    left : ndarray of shape (n, rank)
        Left singular vectors.
    singular : ndarray of shape (rank,)
        Singular values.
    right : ndarray of shape (rank, d + 1)
        Right singular vectors.
    reflector : ndarray of shape (n, rank)
        W.
    middle : ndarray of shape (rank, rank)
        (I + P)⁻¹.
    """

    left: NDArray[np.float64]
    singular: NDArray[np.float64]
    right: NDArray[np.float64]
    reflector: NDArray[np.float64]
    middle: NDArray[np.float64]

    @classmethod
    def of(cls, nodes: NDArray[np.float64]) -> _PolynomialAtNodes:
        """Decompose the basis at nodes (n, d)."""
        basis = np.column_stack([np.ones(len(nodes)), nodes])
        left, singular, right = np.linalg.svd(basis, full_matrices=False)
        rank = int(np.sum(singular > 1e-10 * singular[0]))
        left = left[:, :rank]
        u, stretch, v = np.linalg.svd(left[:rank])
        reflector = left.copy()
        reflector[:rank] += u @ v
        middle = v.T @ (v / (1.0 + stretch)[:, None])
        return cls(left, singular[:rank], right[:rank], reflector, middle)

    @property
    def rank(self) -> int:
        """Number of polynomials that differ at the nodes."""
        return len(self.singular)

    def coefficients(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Fit the polynomial of smallest norm: (n, n_outputs) to (d + 1, n_outputs)."""
        return self.right.T @ ((self.left.T @ values) / self.singular[:, None])

    def unseen(self, matrix: NDArray[np.float64]) -> NDArray[np.float64]:
        """Express columns by the weights it does not see: (n, m) to (n − rank, m)."""
        return self._reflected(matrix)[self.rank :]

    def expanded(self, unseen: NDArray[np.float64]) -> NDArray[np.float64]:
        """Give the weights themselves: (n − rank, m) to (n, m)."""
        return self._reflected(np.vstack([np.zeros((self.rank, unseen.shape[1])), unseen]))

    def _reflected(self, matrix: NDArray[np.float64]) -> NDArray[np.float64]:
        return matrix - self.reflector @ (self.middle @ (self.reflector.T @ matrix))


def _solve_definite(
    polynomial: _PolynomialAtNodes, system: NDArray[np.float64], values: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Solve among the unseen weights, where the system is positive definite, refined once."""
    from scipy.linalg import cho_factor, cho_solve

    if polynomial.rank == len(values):
        return np.zeros_like(values)
    matrix = polynomial.unseen(polynomial.unseen(system).T)
    wanted = polynomial.unseen(values)
    try:
        factor = cho_factor(matrix)
    except np.linalg.LinAlgError:
        # Control points so close that rounding makes the matrix indefinite.
        return polynomial.expanded(_least_norm(matrix, wanted, None))
    weights = polynomial.expanded(cho_solve(factor, wanted))
    residual = polynomial.unseen(values - system @ weights)
    return weights + polynomial.expanded(cho_solve(factor, residual))


def _least_norm(
    matrix: NDArray[np.float64], values: NDArray[np.float64], cutoff: float | None
) -> NDArray[np.float64]:
    """Solve by least squares, for the solution of smallest norm."""
    return np.asarray(np.linalg.lstsq(matrix, values, rcond=cutoff)[0], dtype=np.float64)
