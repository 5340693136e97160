"""Steps that runs on the same data share, computed once."""

from __future__ import annotations

import time
import warnings
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from workbench.projection import project
from workbench.quality.summary import EmbeddingQuality, embedding_quality
from workbench.spaces import Space


@dataclass(frozen=True)
class Projection:
    """A projection that several runs start from.

    Attributes
    ----------
    embedding : ndarray of shape (n_samples, n_components)
        Scaled to the unit square.
    quality : EmbeddingQuality
        Its quality, before any optimization.
    seconds : float
        Time taken to project, without that of the distance matrix.
    warnings : tuple of str
        What the projector warned of.
    """

    embedding: NDArray[np.float64]
    quality: EmbeddingQuality
    seconds: float
    warnings: tuple[str, ...]


class SharedSteps:
    """Distances and projections, computed once for all runs on a space.

    Raw and optimized schemes start from the same projection, so their results differ by the
    optimizer alone.

    Parameters
    ----------
    space : Space
        The samples.
    """

    def __init__(self, space: Space) -> None:
        self.space = space
        self._distance_seconds: float | None = None
        self._projections: dict[tuple[str, int, int | None], Projection] = {}

    def distance_seconds(self) -> float:
        """Compute the distance matrix, which the space keeps, and tell how long it took."""
        if self._distance_seconds is None:
            start = time.perf_counter()
            _ = self.space.distances
            self._distance_seconds = time.perf_counter() - start
        return self._distance_seconds

    def projection(self, projector: str, seed: int, dimensions: int | None = None) -> Projection:
        """Project the space in one step, or give the projection that is there already."""
        key = (projector, seed, dimensions)
        if key not in self._projections:
            with warnings.catch_warnings(record=True) as caught:
                start = time.perf_counter()
                embedding = project(self.space, projector, dimensions=dimensions, random_state=seed)
                seconds = time.perf_counter() - start
            self._projections[key] = Projection(
                embedding,
                embedding_quality(self.space.distances, embedding),
                seconds,
                messages(caught),
            )
        return self._projections[key]


def messages(caught: list[warnings.WarningMessage]) -> tuple[str, ...]:
    """Give the texts of warnings, each once."""
    return tuple(dict.fromkeys(str(warning.message) for warning in caught))
