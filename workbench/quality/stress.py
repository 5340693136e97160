"""Stress: how well an embedding keeps distances.

Packages disagree on what "stress" is; each function names its formula. d_ij is the
distance in the data and δ_ij the distance in the embedding; sums run over pairs i < j.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.quality.inputs import as_points
from workbench.quality.ranks import euclidean_rows
from workbench.validation import as_distances

#: Rows of the distance matrix handled at once, which bounds the memory of temporaries.
_BLOCK = 128

NO_DISTANCES = "distances: got only zeros, want samples that differ"


@dataclass(frozen=True)
class PairSums:
    """Sums over all pairs that most forms of stress are made of.

    Attributes
    ----------
    data, product, embedding, raw : float
        Σ d_ij², Σ d_ij·δ_ij, Σ δ_ij² and Σ (δ_ij − d_ij)². The last one follows from the
        others only as long as it is not small beside them.
    """

    data: float
    product: float
    embedding: float
    raw: float

    @property
    def stress(self) -> float:
        """Costa 2018, Eq. 4.1."""
        return self.raw / self.embedding

    @property
    def scale(self) -> float:
        """The factor of the embedding that minimises the raw stress."""
        return self.product / self.embedding

    @property
    def scale_normalized(self) -> float:
        """The least normalised stress over all scales of the embedding."""
        return max(0.0, 1.0 - self.product**2 / (self._data() * self.embedding))

    @property
    def normalized(self) -> float:
        """Raw stress over the data's squared distances."""
        return self.raw / self._data()

    def _data(self) -> float:
        if self.data == 0:
            raise WorkbenchError(NO_DISTANCES)
        return self.data


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
    >>> stress([[0, 1, 2], [1, 0, 1], [2, 1, 0]], [[0, 0], [2, 0], [4, 0]])
    0.25
    """
    return pair_sums(*as_pair(distances, embedding)).stress


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
    >>> scale_normalized_stress([[0, 1, 2], [1, 0, 1], [2, 1, 0]], [[0, 0], [2, 0], [4, 0]])
    0.0
    """
    return pair_sums(*as_pair(distances, embedding)).scale_normalized


def raw_stress(distances: ArrayLike, embedding: ArrayLike) -> float:
    """Compute raw stress, the sum that other forms divide by something.

    Σ (δ_ij − d_ij)² over pairs i < j (Kruskal 1964); ``stress_`` of scikit-learn's metric
    MDS. It grows with the number of samples and with their unit.

    Parameters
    ----------
    distances : array-like of shape (n_samples, n_samples)
        Distances in the data.
    embedding : array-like of shape (n_samples, n_dimensions)
        Positions.

    Returns
    -------
    float
        In the distances' unit, squared.

    Raises
    ------
    WorkbenchError
        If the shapes do not fit or all points of the embedding coincide.

    Examples
    --------
    >>> raw_stress([[0, 1, 2], [1, 0, 1], [2, 1, 0]], [[0, 0], [2, 0], [4, 0]])
    6.0
    """
    return pair_sums(*as_pair(distances, embedding)).raw


def normalized_stress(distances: ArrayLike, embedding: ArrayLike) -> float:
    """Compute normalised stress of the embedding as it is.

    Σ (δ_ij − d_ij)² / Σ d_ij², the square of what ZADU calls stress and of scikit-learn's
    normalised stress of metric MDS. It depends on the embedding's scale; see
    :func:`scale_normalized_stress`.

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
        If the shapes do not fit or all points coincide, in the data or the embedding.

    Examples
    --------
    >>> normalized_stress([[0, 1, 2], [1, 0, 1], [2, 1, 0]], [[0, 0], [2, 0], [4, 0]])
    1.0
    """
    return pair_sums(*as_pair(distances, embedding)).normalized


def kruskal_stress(distances: ArrayLike, embedding: ArrayLike) -> float:
    """Compute Kruskal's stress-1 of the distances themselves.

    √(Σ (δ_ij − d_ij)² / Σ δ_ij²) (Kruskal 1964 with the data's distances as disparities),
    the root of :func:`stress`. With disparities that only keep the order of the distances it
    is :func:`workbench.quality.shepard.nonmetric_stress`.

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
    >>> kruskal_stress([[0, 1, 2], [1, 0, 1], [2, 1, 0]], [[0, 0], [2, 0], [4, 0]])
    0.5
    """
    return math.sqrt(pair_sums(*as_pair(distances, embedding)).stress)


def as_pair(
    distances: ArrayLike, embedding: ArrayLike
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Check distances and an embedding of the same samples.

    Raises
    ------
    WorkbenchError
        If the shapes do not fit, a value is not finite or there are fewer than 3 samples.
    """
    points = as_points(embedding)
    return as_distances(distances, len(points)), points


def pair_sums(data: NDArray[np.float64], points: NDArray[np.float64]) -> PairSums:
    """Sum up over all pairs of samples, checked before.

    Raises
    ------
    WorkbenchError
        If all points of the embedding coincide.
    """
    data2 = product = points2 = raw = 0.0
    for rows, delta in row_blocks(data, points):
        data2 += float(np.einsum("ij,ij", rows, rows))
        product += float(np.einsum("ij,ij", rows, delta))
        points2 += float(np.einsum("ij,ij", delta, delta))
        delta -= rows
        raw += float(np.einsum("ij,ij", delta, delta))
    if points2 == 0:
        raise WorkbenchError("embedding: got one place for all samples, want different places")
    # Each pair was met twice.
    return PairSums(data2 / 2.0, product / 2.0, points2 / 2.0, raw / 2.0)


def row_blocks(
    data: NDArray[np.float64], points: NDArray[np.float64]
) -> Iterator[tuple[NDArray[np.float64], NDArray[np.float64]]]:
    """Yield the distances of some samples at a time, in the data and in the embedding."""
    for start in range(0, len(points), _BLOCK):
        stop = min(start + _BLOCK, len(points))
        yield data[start:stop], euclidean_rows(points, start, stop)
