"""The linear systems behind radial basis functions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from workbench.backprojection.radial import KERNELS, RadialKernel, kernel_matrix


@dataclass(frozen=True)
class Places:
    """Control points at different places.

    Attributes
    ----------
    points : ndarray of shape (n_places, n_dimensions)
        The places.
    values : ndarray of shape (n_places, n_outputs)
        Mean sample of the control points at each.
    counts : ndarray of shape (n_places,)
        How many control points it stands for.
    contradicting : bool
        Whether control points at one place had different samples.
    """

    points: NDArray[np.float64]
    values: NDArray[np.float64]
    counts: NDArray[np.float64]
    contradicting: bool


def merge_coinciding(points: NDArray[np.float64], values: NDArray[np.float64]) -> Places:
    """Replace control points at the same place by one with their mean sample.

    Points closer than 1e-12 of the cloud's extent count as the same: no weights could
    tell them apart in double precision. The mean with its count says all that least
    squares needs to know of them.

    Parameters
    ----------
    points : ndarray of shape (n_control_points, n_dimensions)
        Positions.
    values : ndarray of shape (n_control_points, n_outputs)
        Samples there.

    Returns
    -------
    Places
    """
    extent = float(np.ptp(points, axis=0).max()) or 1.0
    keys = np.round((points - points.min(axis=0)) / (1e-12 * extent))
    _, first, group = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    if len(first) == len(points):
        return Places(points, values, np.ones(len(points)), contradicting=False)
    group = group.ravel()
    counts = np.bincount(group).astype(np.float64)
    # Relative to the first sample of each place, so that equal ones keep their value.
    sums = np.zeros((len(first), values.shape[1]))
    np.add.at(sums, group, values - values[first][group])
    means = values[first] + sums / counts[:, None]
    return Places(points[first], means, counts, not np.allclose(means[group], values))


def spread_out(points: NDArray[np.float64], count: int) -> NDArray[np.intp]:
    """Choose points that cover the cloud, each the farthest from those chosen before.

    The first is the one nearest to the mean.

    Parameters
    ----------
    points : ndarray of shape (n_points, n_dimensions)
        Candidates.
    count : int
        How many to choose.

    Returns
    -------
    ndarray of shape (count,)
        Sorted indices.
    """
    chosen = [int(((points - points.mean(axis=0)) ** 2).sum(axis=1).argmin())]
    gaps = ((points - points[chosen[0]]) ** 2).sum(axis=1)
    while len(chosen) < count:
        chosen.append(int(gaps.argmax()))
        np.minimum(gaps, ((points - points[chosen[-1]]) ** 2).sum(axis=1), out=gaps)
    return np.sort(chosen)


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
    left, singular, right, free = _polynomial_spaces(nodes)
    system = sign * matrix
    system[np.diag_indices_from(system)] += smoothing
    weights = _solve_definite(free, system, values)
    rest = left.T @ (values - system @ weights)
    return sign * weights, right.T @ (rest / singular[:, None])


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
    _, _, _, free = _polynomial_spaces(nodes)
    n_free = free.shape[1]
    emphasis = np.sqrt(counts)[:, None]
    design = np.hstack([matrix @ free, np.ones((len(points), 1)), points]) * emphasis
    wanted = values * emphasis
    if smoothing > 0 and n_free:
        energy, directions = np.linalg.eigh(sign * (free.T @ among @ free))
        penalty = np.sqrt(smoothing * np.maximum(energy, 0.0))[:, None] * directions.T
        rows = np.zeros((n_free, design.shape[1]))
        rows[:, :n_free] = penalty
        design = np.vstack([design, rows])
        wanted = np.vstack([wanted, np.zeros((n_free, values.shape[1]))])
    solution = np.linalg.lstsq(design, wanted, rcond=1e-13)[0]
    return free @ solution[:n_free], solution[n_free:]


def _polynomial_spaces(
    nodes: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Decompose the polynomial basis at the nodes; collinear ones leave it a lower rank.

    Gives its left singular vectors (n, rank), singular values (rank,), right singular
    vectors (rank, d + 1), and a basis of the weights that it does not see (n, n − rank).
    """
    polynomial = np.column_stack([np.ones(len(nodes)), nodes])
    left, singular, right = np.linalg.svd(polynomial, full_matrices=True)
    rank = int(np.sum(singular > 1e-10 * singular[0]))
    return left[:, :rank], singular[:rank], right[:rank], left[:, rank:]


def _solve_definite(
    free: NDArray[np.float64], system: NDArray[np.float64], values: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Solve within the span of ``free``, where the system is positive definite, refined once."""
    from scipy.linalg import cho_factor, cho_solve

    if free.shape[1] == 0:
        return np.zeros_like(values)
    matrix = free.T @ system @ free
    try:
        factor = cho_factor(matrix)
    except np.linalg.LinAlgError:
        # Control points so close that rounding makes the matrix indefinite.
        return free @ np.linalg.lstsq(matrix, free.T @ values, rcond=None)[0]
    weights = free @ cho_solve(factor, free.T @ values)
    residual = free.T @ (values - system @ weights)
    return weights + free @ cho_solve(factor, residual)
