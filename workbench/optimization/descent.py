"""Descent of every sample on its own error, by steps that are kept only if they lower it.

Both descents work on all points at once, yield after each iteration so that they can be
watched and stopped, and leave what they were given only for something better.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from workbench.optimization.objective import Objective
from workbench.optimization.trust_region import ErrorModel

#: Steps shorter than this share of the first radius end the search of a point.
_SHORTEST = 1e-3


@dataclass(eq=False)
class Descent:
    """Points on their way down; their errors at the start are evaluated at once.

    Attributes
    ----------
    objective : Objective
        Errors of samples at positions.
    indices : ndarray of shape (n_points,)
        The sample that each point stands for.
    points : ndarray of shape (n_points, n_dimensions)
        Current positions, moved in place.
    radii : ndarray of shape (n_points,)
        Length of the first step at most, above 0.
    bounds : tuple of two ndarrays of shape (n_dimensions,)
        Box that is not left.
    tolerance : float
        A point rests when the improvement to be expected, relative to its error, is below.
    max_iterations : int
        Upper limit.
    errors : ndarray of shape (n_points,)
        Errors at the points; never rising.
    """

    objective: Objective
    indices: NDArray[np.intp]
    points: NDArray[np.float64]
    radii: NDArray[np.float64]
    bounds: tuple[NDArray[np.float64], NDArray[np.float64]]
    tolerance: float
    max_iterations: int
    errors: NDArray[np.float64] = field(init=False)

    def __post_init__(self) -> None:
        self.objective.stage = "start"
        if self.objective.has_derivatives:
            derivatives = self.objective.derivatives(self.points, self.indices)
            self.errors, self._gradients, self._curvatures = derivatives
        else:
            self.errors = self.objective(self.points, self.indices)

    def run(self) -> Iterator[None]:
        """Descend, yielding after each iteration."""
        if self.objective.has_derivatives:
            return _newton(self, self._gradients, self._curvatures)
        return _probing(self)


def _newton(
    descent: Descent, gradients: NDArray[np.float64], curvatures: NDArray[np.float64]
) -> Iterator[None]:
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
    for _ in range(descent.max_iterations):
        model = ErrorModel(errors[active], gradients[active], curvatures[active])
        here = points[active]
        steps = model.steps_within(radii[active], low - here, high - here)
        gains = model.gains(steps)
        worthwhile = (gains > descent.tolerance * errors[active]) & (
            radii[active] > _SHORTEST * descent.radii[active]
        )
        active, steps, gains = active[worthwhile], steps[worthwhile], gains[worthwhile]
        if not len(active):
            return
        # Cut off again: a sum may be rounded to beyond the bounds.
        places = np.clip(points[active] + steps, low, high)
        objective.stage = "step"
        tried = objective.derivatives(places, indices[active])
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
        points[moved] = places[lower]
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
    for _ in range(descent.max_iterations):
        if not len(active):
            return
        here, sample, n = points[active], indices[active], len(active)
        probes = np.clip(here + radii[active, None] * directions[:, None], low, high)
        objective.stage = "probe"
        probed = objective(
            probes.reshape(-1, dimensions), np.tile(sample, len(directions))
        ).reshape(-1, n)
        forward, backward = probed[:dimensions], probed[dimensions:]
        slope = forward - backward
        bend = 2.0 * (forward + backward - 2.0 * errors[active])
        vertex = np.divide(-slope, bend, out=-np.sign(slope), where=bend > np.abs(slope))
        middle = np.clip(here + radii[active, None] * vertex.T, low, high)
        candidates = np.concatenate([probes, middle[None]])
        objective.stage = "vertex"
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
