"""Problems on which optimizers are tested."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from workbench.backprojection.rbf import RBF
from workbench.optimization.objective import Objective
from workbench.spaces import VectorSpace


@dataclass
class Problem:
    """Samples, a start, and objectives with and without derivatives."""

    space: VectorSpace
    start: np.ndarray
    free: np.ndarray
    back_projector: object

    def objective(self):
        return Objective.of(self.space, self.back_projector)

    def objective_without_derivatives(self):
        return Objective(self.back_projector, self.space.errors)

    def run(self, optimizer, callback: Callable | None = None, *, derivatives: bool = True):
        objective = self.objective() if derivatives else self.objective_without_derivatives()
        return optimizer.optimize(
            objective, self.start, self.free, self.space.neighbors, callback=callback
        )

    def errors(self, embedding):
        return self.objective()(embedding[self.free], self.free)


def sheet(seed=0, dimensions=2, noise=0.05, n=60, n_control=20):
    """Bend a sheet through 4-D, start beside the truth, and keep some samples as control."""
    rng = np.random.default_rng(seed)
    plane = rng.random((n, dimensions))
    samples = np.column_stack([plane, np.sin(3 * plane[:, 0]), np.cos(2 * plane[:, 1])])
    start = plane.copy()
    free = np.arange(n_control, n)
    start[free] += rng.normal(scale=noise, size=(n - n_control, dimensions))
    control = np.arange(n_control)
    return Problem(VectorSpace(samples), start, free, RBF().fit(plane[control], samples[control]))


def flat(seed=0, dimensions=2):
    """Lay a plane into 5-D without bending it, so that every sample has an exact place."""
    rng = np.random.default_rng(seed)
    places = rng.random((40, dimensions))
    frame = np.linalg.qr(rng.normal(size=(5, dimensions)))[0]
    start = places.copy()
    start[10:] += rng.normal(scale=0.1, size=(30, dimensions))
    samples = places @ frame.T
    problem = Problem(
        VectorSpace(samples), start, np.arange(10, 40), RBF().fit(places[:10], samples[:10])
    )
    return problem, places
