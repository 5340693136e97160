"""Results: what a scheme made of a space, and how long each step took."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from workbench.backprojection import BackProjector
from workbench.optimization.markers import MarkerResult
from workbench.optimization.objective import OptimizationResult
from workbench.quality.summary import EmbeddingQuality, embedding_quality
from workbench.spaces import Space


@dataclass
class Timings:
    """Seconds spent on each step, in the order of the steps."""

    steps: dict[str, float] = field(default_factory=dict)

    @contextmanager
    def step(self, name: str) -> Iterator[None]:
        """Add the time of a ``with`` block to a step."""
        start = time.perf_counter()
        try:
            yield
        finally:
            self.steps[name] = self.steps.get(name, 0.0) + time.perf_counter() - start

    @property
    def total(self) -> float:
        """Seconds spent on all steps."""
        return sum(self.steps.values())


@dataclass(frozen=True, eq=False)
class Result:
    """What a scheme made of a space.

    Attributes
    ----------
    space : Space
        The samples.
    control_points : ndarray of shape (n_control_points,)
        Indices of the samples that are kept as they are.
    reconstruction : ndarray of shape (n_samples, ...)
        All samples rebuilt, the control points exactly.
    timings : Timings
        Seconds of each step.
    """

    space: Space
    control_points: NDArray[np.intp]
    reconstruction: NDArray[np.float64]
    timings: Timings

    @cached_property
    def errors(self) -> NDArray[np.float64]:
        """Error of each sample, 0 for control points: (n_samples,)."""
        return self.space.errors(np.arange(len(self.space)), self.reconstruction)

    @property
    def error(self) -> float:
        """Mean error over all samples; for poses, the error per frame per joint."""
        return float(self.errors.mean())

    @property
    def relative_error(self) -> float:
        """Mean error relative to rebuilding every sample by the mean; 0 if all are equal."""
        if not np.ptp(self.space.features, axis=0).any():
            return 0.0
        return self.error / self.space.mean_prediction_error()


@dataclass(frozen=True, eq=False)
class SpatialResult(Result):
    """What a spatial scheme made of a space.

    Attributes
    ----------
    projected : ndarray of shape (n_samples, n_dimensions)
        The embedding as projected, scaled to the unit square.
    embedding : ndarray of shape (n_samples, n_dimensions)
        The embedding used for the reconstruction: optimized, if there is an optimizer.
    back_projector : back-projector
        Fitted on the control points.
    optimization : OptimizationResult or None
        How the optimizer got there.
    marker_result : MarkerResult or None
        How better markers were found.
    evaluations : int
        Points back-projected, by the optimizer and for the reconstruction.
    """

    projected: NDArray[np.float64]
    embedding: NDArray[np.float64]
    back_projector: BackProjector
    optimization: OptimizationResult | None
    marker_result: MarkerResult | None
    evaluations: int

    @cached_property
    def quality(self) -> EmbeddingQuality:
        """Quality of the embedding."""
        return embedding_quality(self.space.distances, self.embedding)

    @cached_property
    def projected_quality(self) -> EmbeddingQuality:
        """Quality of the embedding before it was optimized."""
        return embedding_quality(self.space.distances, self.projected)

    @property
    def projected_error(self) -> float:
        """Mean error of all samples before the embedding was optimized.

        Optimizers leave control points where they are, so that only the others had another.
        """
        if self.optimization is None:
            return self.error
        others = self.optimization.history[0] * len(self.optimization.errors)
        return float((others + self.errors[self.control_points].sum()) / len(self.errors))
