"""Descent of every sample on its own error, by steps that are kept only if they lower it.

Both descents work on all points at once, yield after each iteration so that they can be
watched and stopped, and leave what they were given only for something better.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from workbench.kernels import compiled
from workbench.optimization.objective import Objective

#: Steps shorter than this share of the first radius end the search of a point.
_SHORTEST = 1e-3


@dataclass(eq=False)
class Descent:
    """Points on their way down.

    Attributes
    ----------
    objective : Objective
        Errors of samples at positions.
    indices : ndarray of shape (n_points,)
        The sample that each point stands for.
    points : ndarray of shape (n_points, n_dimensions)
        Current positions.
    errors : ndarray of shape (n_points,)
        Errors there; never rising.
    radii : ndarray of shape (n_points,)
        Length of the first step at most.
    bounds : tuple of two ndarrays of shape (n_dimensions,)
        Box that is not left.
    tolerance : float
        A point rests when the improvement to be expected, relative to its error, is below.
    max_iterations : int
        Upper limit.
    """

    objective: Objective
    indices: NDArray[np.intp]
    points: NDArray[np.float64]
    errors: NDArray[np.float64]
    radii: NDArray[np.float64]
    bounds: tuple[NDArray[np.float64], NDArray[np.float64]]
    tolerance: float
    max_iterations: int

    def run(self) -> Iterator[None]:
        """Descend, yielding after each iteration."""
        return _newton(self) if self.objective.has_derivatives else _probing(self)


def _newton(descent: Descent) -> Iterator[None]:
    """Step to the minimum of a quadratic model within a radius that adapts to its success.

    The trust-region method with the curvature of Gauss and Newton (Conn, Gould & Toint 2000).
    """
    objective, indices, points, errors = (
        descent.objective,
        descent.indices,
        descent.points,
        descent.errors,
    )
    radii = descent.radii.copy()
    low, high = descent.bounds
    active = np.arange(len(points))
    errors[:], gradients, curvatures = objective.derivatives(points, indices)
    for _ in range(descent.max_iterations):
        model = ErrorModel(errors[active], gradients[active], curvatures[active])
        steps = np.clip(points[active] + model.steps(radii[active]), low, high) - points[active]
        gains = model.gains(steps)
        worthwhile = (gains > descent.tolerance * errors[active]) & (
            radii[active] > _SHORTEST * descent.radii[active]
        )
        active, steps, gains = active[worthwhile], steps[worthwhile], gains[worthwhile]
        if not len(active):
            return
        tried = objective.derivatives(points[active] + steps, indices[active])
        success = (errors[active] - tried[0]) / gains
        lengths = np.linalg.norm(steps, axis=1)
        at_limit = lengths > 0.9 * radii[active]
        radii[active] = np.where(
            success < 0.25,
            lengths / 3.0,
            np.where((success > 0.75) & at_limit, 2.0 * radii[active], radii[active]),
        )
        lower = tried[0] < errors[active]
        moved = active[lower]
        points[moved] += steps[lower]
        errors[moved], gradients[moved], curvatures[moved] = (part[lower] for part in tried)
        yield


def _probing(descent: Descent) -> Iterator[None]:
    """Try both directions of each axis, and the minimum of the parabolas through them.

    For back-projectors without derivatives, stepwise constant ones among them: a pattern
    search (Kolda, Lewis & Torczon 2003) whose radius is halved where nothing is better.
    """
    objective, indices, points, errors = (
        descent.objective,
        descent.indices,
        descent.points,
        descent.errors,
    )
    radii = descent.radii.copy()
    low, high = descent.bounds
    dimensions = points.shape[1]
    directions = np.concatenate([np.eye(dimensions), -np.eye(dimensions)])
    active = np.arange(len(points))
    errors[:] = objective(points, indices)
    for _ in range(descent.max_iterations):
        if not len(active):
            return
        here, sample, n = points[active], indices[active], len(active)
        probes = np.clip(here + radii[active, None] * directions[:, None], low, high)
        probed = objective(
            probes.reshape(-1, dimensions), np.tile(sample, len(directions))
        ).reshape(-1, n)
        forward, backward = probed[:dimensions], probed[dimensions:]
        slope = forward - backward
        bend = 2.0 * (forward + backward - 2.0 * errors[active])
        vertex = np.divide(-slope, bend, out=-np.sign(slope), where=bend > np.abs(slope))
        middle = np.clip(here + radii[active, None] * vertex.T, low, high)
        candidates = np.concatenate([probes, middle[None]])
        values = np.concatenate([probed, objective(middle, sample)[None]])
        best = values.argmin(axis=0)
        value = values[best, np.arange(n)]
        before = errors[active]
        lower = value < before
        points[active[lower]] = candidates[best, np.arange(n)][lower]
        errors[active[lower]] = value[lower]
        # A vertex close by asks for closer probes, one at the limit for as far ones again.
        reach = np.where(
            best == len(probes), np.clip(2.0 * np.abs(vertex).max(axis=0), 0.25, 1.0), 1.0
        )
        radii[active] *= np.where(lower, reach, 0.5)
        rests = (before - value <= descent.tolerance * before) & (
            radii[active] < 0.05 * descent.radii[active]
        )
        active = active[~rests & (radii[active] > _SHORTEST * descent.radii[active])]
        yield


@compiled
def _eigenvalues(matrix):  # type: ignore[no-untyped-def]  # compiled
    """Decompose a symmetric matrix; in the plane by hand, which is ten times faster."""
    if len(matrix) != 2:
        return np.linalg.eigh(matrix)
    middle = 0.5 * (matrix[0, 0] + matrix[1, 1])
    half = 0.5 * (matrix[0, 0] - matrix[1, 1])
    off = matrix[0, 1]
    radius = np.hypot(half, off)
    turn = 0.5 * np.arctan2(off, half)
    c, s = np.cos(turn), np.sin(turn)
    return np.array([middle - radius, middle + radius]), np.array([[-s, c], [c, s]])


@compiled
def _trust_region_step(gradient, curvature, radius, step):  # type: ignore[no-untyped-def]  # compiled
    values, vectors = _eigenvalues(curvature)
    slopes = vectors.T @ gradient
    n = len(slopes)
    # Small enough to change no well-determined step, large enough to divide by.
    floor = 1e-12 * (np.abs(values).max() + np.sqrt(np.sum(slopes**2)) / radius) + 1e-300
    values = np.maximum(values, 0.0) + floor
    shift, length = 0.0, 0.0
    for _ in range(20):
        length, bend = 0.0, 0.0
        for i in range(n):
            part = slopes[i] / (values[i] + shift)
            length += part * part
            bend += part * part / (values[i] + shift)
        squared, length = length, np.sqrt(length)
        if length <= radius * (1.0 + 1e-6):
            break
        shift += squared * (length - radius) / (bend * radius)
    shorten = radius / length if length > radius else 1.0
    for i in range(n):
        slopes[i] *= -shorten / (values[i] + shift)
    step[:] = vectors @ slopes


@compiled
def _trust_region_steps(gradients, curvatures, radii, steps):  # type: ignore[no-untyped-def]  # compiled
    for i in range(len(gradients)):
        _trust_region_step(gradients[i], curvatures[i], radii[i], steps[i])


def trust_region_steps(
    gradients: NDArray[np.float64], curvatures: NDArray[np.float64], radii: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Minimise quadratic models within balls.

    min g·s + ½ s·H·s subject to ‖s‖ ≤ r, for positive semidefinite H, by Newton's method on
    1/‖s(μ)‖ − 1/r with s(μ) = −(H + μI)⁻¹ g (Moré & Sorensen 1983).

    Parameters
    ----------
    gradients : ndarray of shape (n_points, n_dimensions)
        g.
    curvatures : ndarray of shape (n_points, n_dimensions, n_dimensions)
        H.
    radii : ndarray of shape (n_points,)
        r, above 0.

    Returns
    -------
    ndarray of shape (n_points, n_dimensions)

    Examples
    --------
    >>> bowl = np.diag([2.0, 2.0])[None]
    >>> trust_region_steps(np.array([[-2.0, 2.0]]), bowl, np.array([9.0])).round(9)
    array([[ 1., -1.]])
    """
    steps = np.empty_like(gradients)
    _trust_region_steps(
        np.ascontiguousarray(gradients), np.ascontiguousarray(curvatures), radii, steps
    )
    return steps


@dataclass(frozen=True, eq=False)
class ErrorModel:
    """Quadratic models of squared errors around points.

    An error is a distance, with a kink where it is 0; its square is smooth there. With E, g
    and H an error, its gradient and its curvature, ½E² has the gradient E·g and the curvature
    E·H + g·gᵀ, which for vectors is exact as long as the reconstruction is linear.

    Attributes
    ----------
    errors : ndarray of shape (n_points,)
    gradients : ndarray of shape (n_points, n_dimensions)
    curvatures : ndarray of shape (n_points, n_dimensions, n_dimensions)
    """

    errors: NDArray[np.float64]
    gradients: NDArray[np.float64]
    curvatures: NDArray[np.float64]

    def steps(self, radii: NDArray[np.float64]) -> NDArray[np.float64]:
        """Find the best steps of at most the given lengths: (n_points, n_dimensions)."""
        return trust_region_steps(*self._squared(), radii)

    def gains(self, steps: NDArray[np.float64]) -> NDArray[np.float64]:
        """Tell by how much steps are to lower the errors: (n_points,)."""
        gradients, curvatures = self._squared()
        change = np.einsum("ni,ni->n", gradients, steps)
        change += 0.5 * np.einsum("ni,nij,nj->n", steps, curvatures, steps)
        return self.errors - np.sqrt(np.maximum(self.errors**2 + 2.0 * change, 0.0))

    def _squared(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        curvatures = self.errors[:, None, None] * self.curvatures
        curvatures += self.gradients[:, :, None] * self.gradients[:, None, :]
        return self.errors[:, None] * self.gradients, curvatures
