"""The usual quality values of an embedding, in one place."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from workbench.quality.inputs import as_points
from workbench.quality.neighborhoods import (
    default_neighborhood_size,
    matrix_neighborhood_quality,
)
from workbench.quality.stress import pair_sums
from workbench.validation import as_distances


@dataclass(frozen=True)
class EmbeddingQuality:
    """Quality of an embedding.

    Attributes
    ----------
    stress : float
        Costa 2018, Eq. 4.1; depends on the embedding's scale. Lower is better.
    scale_normalized_stress : float
        At the embedding's best scale. Lower is better.
    trustworthiness, continuity, neighborhood_preservation : float
        At neighbourhood size ``k``. Higher is better.
    k : int
        min(10, (n_samples − 1) // 2).
    """

    stress: float
    scale_normalized_stress: float
    trustworthiness: float
    continuity: float
    neighborhood_preservation: float
    k: int


def embedding_quality(distances: ArrayLike, embedding: ArrayLike) -> EmbeddingQuality:
    """Measure an embedding by all usual values.

    Parameters
    ----------
    distances : array-like of shape (n_samples, n_samples)
        Distances in the data.
    embedding : array-like of shape (n_samples, n_dimensions)
        Positions.

    Returns
    -------
    EmbeddingQuality

    Raises
    ------
    WorkbenchError
        If the shapes do not fit or all points coincide.
    """
    points = as_points(embedding)
    data = as_distances(distances, len(points))
    k = default_neighborhood_size(len(points))
    sums = pair_sums(data, points)
    near = matrix_neighborhood_quality(data, points, np.array([k]))
    return EmbeddingQuality(
        stress=sums.stress,
        scale_normalized_stress=sums.scale_normalized,
        trustworthiness=float(near.trustworthiness[0]),
        continuity=float(near.continuity[0]),
        neighborhood_preservation=float(near.preservation[0]),
        k=k,
    )
