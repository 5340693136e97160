"""Stress: how well an embedding keeps distances.

Packages disagree on what "stress" is; each function names its formula. d_ij is the
distance in the data and δ_ij the distance in the embedding; sums run over pairs i < j.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from workbench.errors import WorkbenchError
from workbench.validation import as_distances, as_embedding

#: Rows of the distance matrix handled at once, which bounds the memory of temporaries.
_BLOCK = 512


@dataclass(frozen=True)
class _PairSums:
    """Sums over all pairs that every form of stress is made of."""

    data: float
    product: float
    embedding: float


def stress(distances: ArrayLike, embedding: ArrayLike) -> float:
    """Compute stress as Costa 2018 does (Eq. 4.1).

    Σ (δ_ij − d_ij)² / Σ δ_ij². The denominator is the embedding's, so the value changes
    with the embedding's scale: compare it only between embeddings of one data set scaled
    alike, and see :func:`scale_normalized_stress`.

    Parameters
    ----------
    distances : array-like of shape (n_samples, n_samples)
        Distances in the data.
    embedding : array-like of shape (n_samples, n_dimensions)
        Positions.

    Returns
    -------
    float
        0 for an embedding that keeps all distances.

    Raises
    ------
    WorkbenchError
        If the shapes do not fit or all points of the embedding coincide.

    Examples
    --------
    >>> stress([[0, 3], [3, 0]], [[0, 0], [0, 2]])
    0.25
    """
    sums = _pair_sums(distances, embedding)
    return (sums.embedding - 2.0 * sums.product + sums.data) / sums.embedding


def scale_normalized_stress(distances: ArrayLike, embedding: ArrayLike) -> float:
    """Compute normalised stress of the embedding at its best scale.

    min_α Σ (d_ij − α·δ_ij)² / Σ d_ij² = 1 − (Σ d_ij·δ_ij)² / (Σ d_ij² · Σ δ_ij²), which
    does not depend on the embedding's scale (Smelser, Miller & Kobourov 2024).

    Parameters
    ----------
    distances : array-like of shape (n_samples, n_samples)
        Distances in the data.
    embedding : array-like of shape (n_samples, n_dimensions)
        Positions.

    Returns
    -------
    float
        Between 0 and 1.

    Raises
    ------
    WorkbenchError
        If the shapes do not fit or all points coincide, in the data or the embedding.

    Examples
    --------
    >>> scale_normalized_stress([[0, 3], [3, 0]], [[0, 0], [0, 2]])
    0.0
    """
    sums = _pair_sums(distances, embedding)
    if sums.data == 0:
        raise WorkbenchError("distances: got only zeros, want samples that differ")
    return max(0.0, 1.0 - sums.product**2 / (sums.data * sums.embedding))


def _pair_sums(distances: ArrayLike, embedding: ArrayLike) -> _PairSums:
    from scipy.spatial.distance import cdist

    points = as_embedding(embedding)
    data = as_distances(distances, len(points))
    data2 = product = points2 = 0.0
    for start in range(0, len(points), _BLOCK):
        rows = slice(start, start + _BLOCK)
        delta = cdist(points[rows], points)
        data2 += float(np.einsum("ij,ij", data[rows], data[rows]))
        product += float(np.einsum("ij,ij", data[rows], delta))
        points2 += float(np.einsum("ij,ij", delta, delta))
    if points2 == 0:
        raise WorkbenchError("embedding: got one place for all samples, want different places")
    return _PairSums(data2, product, points2)
