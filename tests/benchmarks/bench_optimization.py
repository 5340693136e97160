"""Optimizers: Alg. 12 beside plain NumPy, and the better ones beside Alg. 12."""

from __future__ import annotations

from collections.abc import Iterator
from statistics import mean

import numpy as np

from tests.benchmarks.measuring import Measurement, compare, time_of
from workbench.backprojection.poses import SpatialKeyframes
from workbench.datasets import load_space
from workbench.optimization.global_search import GlobalSearch
from workbench.optimization.gradient_descent import GradientDescent
from workbench.optimization.local_search import LocalSearch
from workbench.optimization.objective import Objective, OptimizationResult
from workbench.projection import project
from workbench.schemes import choose_control_points

#: Short and long, calm and lively clips; Alg. 12 takes 17 to 111 sweeps on them.
CLIPS = ("02_01", "05_10", "06_07", "09_06")
PROJECTORS = ("pca", "isomap", "tsne")


class Problem:
    """A clip, projected, at 3 % uniform keyframes."""

    def __init__(self, clip: str, projector: str) -> None:
        self.space = load_space(f"cmu/{clip}")
        self.embedding = project(self.space, projector, random_state=0)
        self.control = choose_control_points(self.space, "uniform", ratio=0.03)
        self.free = np.setdiff1d(np.arange(len(self.space)), self.control)
        self.back_projector = SpatialKeyframes().fit(
            self.embedding[self.control], self.space.samples[self.control]
        )

    def run(self, optimizer: object) -> OptimizationResult:
        objective = Objective.of(self.space, self.back_projector)
        return optimizer.optimize(objective, self.embedding, self.free, self.space.neighbors)

    def run_plainly(self, n_sweeps: int) -> None:
        """Sweep as Alg. 12 does with NumPy alone: batched SVD, arccosine of traces."""
        rbf, space = self.back_projector.regressor_, self.space
        weights, n_joints = space.weights, len(space.weights)
        targets = space.samples[self.free]
        pairs = space.neighbors[self.free]

        def errors(points: np.ndarray) -> np.ndarray:
            kernel = np.linalg.norm(points[:, None] - rbf.centers_, axis=2)
            entries = kernel @ rbf.weights_ + rbf.polynomial_[0] + points @ rbf.polynomial_[1:]
            left, _, right = np.linalg.svd(entries.reshape(-1, n_joints, 3, 3))
            left[..., -1] *= np.sign(np.linalg.det(left @ right))[..., None]
            traces = np.einsum("njab,njab->nj", left @ right, targets)
            return np.arccos(np.clip((traces - 1) / 2, -1, 1)) @ weights / n_joints

        points = self.embedding.copy()
        now = errors(points[self.free])
        for _ in range(n_sweeps):
            here = points[self.free]
            radii = np.linalg.norm(points[pairs] - here[:, None], axis=2).mean(axis=1)
            slope = np.zeros_like(here)
            for axis in range(2):
                offset = np.zeros(2)
                offset[axis] = 0.5
                ahead = errors(here + radii[:, None] * offset)
                behind = errors(here - radii[:, None] * offset)
                better = (ahead < now) | (behind < now)
                slope[:, axis] = np.where(better, behind - ahead, 0.0)
            length = np.linalg.norm(slope, axis=1, keepdims=True)
            points[self.free] += 0.5 * radii[:, None] * slope / np.where(length > 0, length, 1.0)
            now = errors(points[self.free])


def measurements() -> Iterator[Measurement]:
    """Measure all rows."""
    main = Problem("05_10", "tsne")
    sweeps = 3
    few = GradientDescent(max_sweeps=sweeps, tol=0)
    yield compare(
        f"Alg. 12, {sweeps} sweeps on 05_10 (t-SNE, 3 %)",
        lambda: main.run(few),
        "NumPy, batched SVD",
        lambda: main.run_plainly(sweeps),
        at_least=10,
        repeats=3,
    )
    yield time_of("local search on 05_10 (t-SNE, 3 %)", lambda: main.run(LocalSearch()), below=1.0)
    yield time_of(
        "global search on 05_10 (t-SNE, 3 %)", lambda: main.run(GlobalSearch()), below=1.0
    )
    problems = [Problem(clip, projector) for clip in CLIPS for projector in PROJECTORS]

    def run_all(optimizer: object) -> None:
        for problem in problems:
            problem.run(optimizer)

    for name, optimizer in (("local", LocalSearch()), ("global", GlobalSearch())):
        efforts, errors = [], []
        for problem in problems:
            found, reference = problem.run(optimizer), problem.run(GradientDescent())
            efforts.append(_total(found) / _total(reference))
            errors.append(found.errors.sum() / reference.errors.sum())
        yield compare(
            f"{name} search, {len(CLIPS)} clips x {len(PROJECTORS)} projectors",
            lambda optimizer=optimizer: run_all(optimizer),
            "Alg. 12, same kernels",
            lambda: run_all(GradientDescent()),
            at_least=5,
            repeats=3,
            note=f"computes {100 * mean(efforts):.0f} % of what Alg. 12 does in the mean "
            "(back-projections, Jacobians counted twice, distances); its error is "
            f"{np.median(errors):.3f} times Alg. 12's in the median, {max(errors):.3f} at most",
        )


def _total(result: OptimizationResult) -> int:
    effort = result.effort
    return effort.evaluations + 2 * effort.jacobians + effort.distances
