"""Steps to the minimum of a quadratic model of the error, within a radius and within bounds."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from workbench.kernels import compiled


@compiled
def _trust_region_step(gradient, values, vectors, radius, step):  # type: ignore[no-untyped-def]  # compiled
    # In coordinates along the eigenvectors the curvature is diagonal. Loops, because products
    # of whole arrays would take four times as long to compile.
    n = len(gradient)
    slopes = np.zeros(n)
    steepness, largest = 0.0, 0.0
    for i in range(n):
        for j in range(n):
            slopes[i] += vectors[j, i] * gradient[j]
        steepness += slopes[i] * slopes[i]
        largest = max(largest, abs(values[i]))
    # Small enough to change no well-determined step, large enough to divide by.
    floor = 1e-12 * (largest + np.sqrt(steepness) / radius) + 1e-300
    shift, length = 0.0, 0.0
    for _ in range(20):
        length, bend = 0.0, 0.0
        for i in range(n):
            stiffness = max(values[i], 0.0) + floor + shift
            part = slopes[i] / stiffness
            length += part * part
            bend += part * part / stiffness
        squared, length = length, np.sqrt(length)
        if length <= radius * (1.0 + 1e-6):
            break
        shift += squared * (length - radius) / (bend * radius)
    shorten = radius / length if length > radius else 1.0
    for j in range(n):
        step[j] = 0.0
        for i in range(n):
            part = slopes[i] / (max(values[i], 0.0) + floor + shift)
            step[j] -= shorten * vectors[j, i] * part


@compiled
def _trust_region_steps(  # type: ignore[no-untyped-def]  # compiled
    gradients, values, vectors, radii, steps
):
    for i in range(len(gradients)):
        _trust_region_step(gradients[i], values[i], vectors[i], radii[i], steps[i])


def _decompose(
    matrices: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Give eigenvalues and eigenvectors of symmetric matrices; in the plane by hand.

    That is ten times faster than LAPACK's way, which is for any number of dimensions.
    """
    if matrices.shape[-1] != 2:
        values, vectors = np.linalg.eigh(matrices)
        return values, vectors
    middle = 0.5 * (matrices[:, 0, 0] + matrices[:, 1, 1])
    half = 0.5 * (matrices[:, 0, 0] - matrices[:, 1, 1])
    off = matrices[:, 0, 1]
    radius, turn = np.hypot(half, off), 0.5 * np.arctan2(off, half)
    c, s = np.cos(turn), np.sin(turn)
    values = np.stack([middle - radius, middle + radius], axis=1)
    return values, np.stack([-s, c, c, s], axis=1).reshape(-1, 2, 2)


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
    values, vectors = _decompose(curvatures)
    # Made contiguous, because each other layout would be compiled for itself.
    arrays = [np.ascontiguousarray(array) for array in (gradients, values, vectors)]
    _trust_region_steps(*arrays, radii, steps)
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

    def steps_within(
        self,
        radii: NDArray[np.float64],
        low: NDArray[np.float64],
        high: NDArray[np.float64],
    ) -> NDArray[np.float64]:
        """Find the best steps within boxes around 0.

        A step that leaves its box is cut off at a bound and goes on along that, by whichever
        of the bounds that it crosses promises most.

        Parameters
        ----------
        radii : ndarray of shape (n_points,)
            Longest steps; along a bound, longest from where it was reached.
        low, high : ndarray of shape (n_points, n_dimensions)
            Corners of the boxes; a coordinate in which both are equal is fixed.

        Returns
        -------
        ndarray of shape (n_points, n_dimensions)
        """
        steps = self._steps_along(radii, low, low == high)
        best = np.clip(steps, low, high)
        for axis in range(steps.shape[1]):
            rows = np.flatnonzero(
                (steps[:, axis] < low[:, axis]) | (steps[:, axis] > high[:, axis])
            )
            if not len(rows):
                continue
            cut = ErrorModel(self.errors[rows], self.gradients[rows], self.curvatures[rows])
            lowest, highest = low[rows], high[rows]
            reached = np.clip(steps[rows, axis], lowest[:, axis], highest[:, axis])
            lowest[:, axis] = highest[:, axis] = reached
            along = cut.steps_within(radii[rows], lowest, highest)
            better = cut.gains(along) > cut.gains(best[rows])
            best[rows[better]] = along[better]
        return best

    def _steps_along(
        self,
        radii: NDArray[np.float64],
        places: NDArray[np.float64],
        fixed: NDArray[np.bool_],
    ) -> NDArray[np.float64]:
        """Find the best steps that lead to the given places in the coordinates that are fixed."""
        if not fixed.any():
            return self.steps(radii)
        gradients, curvatures = self._squared()
        kept = np.where(fixed, places, 0.0)
        gradients += np.einsum("nij,nj->ni", curvatures, kept)
        free = ~fixed
        others = trust_region_steps(
            gradients * free, curvatures * (free[:, :, None] & free[:, None, :]), radii
        )
        return np.where(fixed, kept, others)

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
