"""Neighbourhoods: which neighbours an embedding keeps, loses and invents.

A sample is never its own neighbour. Ranks count from 1; distances that are equal, to 1e-10
of the largest, rank in the order of the samples.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.quality.inputs import as_points, as_size, as_sizes, as_vectors
from workbench.quality.ranks import TIE, Counts, count_by_blocks, euclidean_rows, rounding_unit
from workbench.validation import as_distances


@dataclass(frozen=True)
class NeighborhoodQuality:
    """Neighbourhood measures for several sizes k, all 1 for an embedding that keeps all ranks.

    Attributes
    ----------
    k : ndarray of shape (n_sizes,)
        Neighbourhood sizes.
    trustworthiness : ndarray of shape (n_sizes,)
        1 minus a penalty for neighbours in the embedding that are none in the data, by
        their rank in the data (Venna & Kaski 2001).
    continuity : ndarray of shape (n_sizes,)
        1 minus a penalty for neighbours in the data that are none in the embedding.
    preservation : ndarray of shape (n_sizes,)
        Mean share of a sample's k nearest in the data that are among its k nearest in the
        embedding; Q_NX of Lee & Verleysen (2009).
    intrusiveness : ndarray of shape (n_sizes,)
        Share of the k nearest that both have and that come closer in the embedding, less
        that of those that move away; B_NX of Lee & Verleysen (2009), 0 where all ranks are
        kept. Embeddings that tear have negative values, those that fold positive ones.
    n_samples : int
        Number of samples.
    """

    k: NDArray[np.intp]
    trustworthiness: NDArray[np.float64]
    continuity: NDArray[np.float64]
    preservation: NDArray[np.float64]
    intrusiveness: NDArray[np.float64]
    n_samples: int

    @property
    def lcmc(self) -> NDArray[np.float64]:
        """Local continuity meta-criterion (Chen & Buja 2009): preservation − k / (n − 1).

        The share that chance would keep is taken away, so that sizes can be compared.
        """
        return self.preservation - self.k / (self.n_samples - 1)

    @property
    def rescaled_preservation(self) -> NDArray[np.float64]:
        """R_NX (Lee et al. 2013): lcmc over its largest value, 0 for chance and 1 at best."""
        return self.lcmc / (1.0 - self.k / (self.n_samples - 1))


@dataclass(frozen=True)
class LocalNeighborhoodQuality:
    """Neighbourhood measures of each sample at one size; their means are the global ones.

    Attributes
    ----------
    k : int
        Neighbourhood size.
    trustworthiness, continuity, preservation : ndarray of shape (n_samples,)
        As in :class:`NeighborhoodQuality`, of each sample's own neighbours.
    """

    k: int
    trustworthiness: NDArray[np.float64]
    continuity: NDArray[np.float64]
    preservation: NDArray[np.float64]


def default_neighborhood_size(n_samples: int) -> int:
    """Choose the size at which single values are reported: min(10, (n − 1) // 2).

    Examples
    --------
    >>> default_neighborhood_size(150), default_neighborhood_size(7)
    (10, 3)
    """
    return max(1, min(10, (n_samples - 1) // 2))


def neighborhood_quality(
    distances: ArrayLike, embedding: ArrayLike, k: ArrayLike
) -> NeighborhoodQuality:
    """Measure trustworthiness, continuity and neighbourhood preservation.

    With r(i, j) the rank of j among the others by distance from i in the data, ρ(i, j) the
    same in the embedding and N, V the k nearest in each:
    T(k) = 1 − 2 / (n·k·(2n − 3k − 1)) · Σ_i Σ_{j ∈ V∖N} (r(i, j) − k), C(k) the same with
    the roles exchanged, and preservation mean_i |N ∩ V| / k.

    Parameters
    ----------
    distances : array-like of shape (n_samples, n_samples)
        Distances in the data.
    embedding : array-like of shape (n_samples, n_dimensions)
        Positions.
    k : int or array-like of shape (n_sizes,)
        Neighbourhood sizes, each at least 1 and below n_samples / 2.

    Returns
    -------
    NeighborhoodQuality

    Raises
    ------
    WorkbenchError
        If the shapes do not fit or a size is out of range.

    Examples
    --------
    >>> plane = np.array([[0.0, 0.0], [1.0, 0.0], [3.0, 0.0], [7.0, 0.0], [15.0, 0.0]])
    >>> data = abs(plane[:, :1] - plane[:, 0])
    >>> float(neighborhood_quality(data, plane, 2).preservation[0])
    1.0
    """
    points = as_points(embedding)
    data = as_distances(distances, len(points))
    return matrix_neighborhood_quality(data, points, as_sizes(k, len(points)))


def matrix_neighborhood_quality(
    data: NDArray[np.float64], points: NDArray[np.float64], sizes: NDArray[np.intp]
) -> NeighborhoodQuality:
    """Do the same with arguments that are checked already."""
    return _sum_up(_matrix_counts(data, points, sizes), sizes, len(points))


def vector_neighborhood_quality(
    features: ArrayLike, embedding: ArrayLike, k: ArrayLike
) -> NeighborhoodQuality:
    """Measure the same from vectors, without a matrix of their distances.

    For samples too many for such a matrix: some rows of it at a time are enough.

    Parameters
    ----------
    features : array-like of shape (n_samples, n_features)
        Vectors, compared by Euclidean distance.
    embedding : array-like of shape (n_samples, n_dimensions)
        Positions.
    k : int or array-like of shape (n_sizes,)
        Neighbourhood sizes, each at least 1 and below n_samples / 2.

    Returns
    -------
    NeighborhoodQuality

    Raises
    ------
    WorkbenchError
        If the shapes do not fit, a value is not finite or a size is out of range.

    Examples
    --------
    >>> plane = np.array([[0.0, 0.0], [1.0, 0.0], [3.0, 0.0], [7.0, 0.0], [15.0, 0.0]])
    >>> float(vector_neighborhood_quality(plane, plane, 2).trustworthiness[0])
    1.0
    """
    points = as_points(embedding)
    vectors = as_vectors(features, len(points))
    sizes = as_sizes(k, len(points))
    counts = count_by_blocks(
        lambda start, stop: euclidean_rows(vectors, start, stop),
        lambda start, stop: euclidean_rows(points, start, stop),
        len(points),
        (rounding_unit(vectors), rounding_unit(points)),
        sizes,
    )
    return _sum_up(counts, sizes, len(points))


def local_neighborhood_quality(
    distances: ArrayLike, embedding: ArrayLike, k: int
) -> LocalNeighborhoodQuality:
    """Measure each sample's trustworthiness, continuity and preservation, to colour it by.

    Parameters
    ----------
    distances : array-like of shape (n_samples, n_samples)
        Distances in the data.
    embedding : array-like of shape (n_samples, n_dimensions)
        Positions.
    k : int
        Neighbourhood size, at least 1 and below n_samples / 2.

    Returns
    -------
    LocalNeighborhoodQuality
        The means of its values are those of :func:`neighborhood_quality`.

    Raises
    ------
    WorkbenchError
        If the shapes do not fit or the size is out of range.

    Examples
    --------
    >>> line = np.array([[0.0], [1.0], [3.0], [7.0], [15.0]])
    >>> torn = np.array([[0.0, 0], [1, 0], [3, 0], [7, 0], [-9, 0]])
    >>> local_neighborhood_quality(abs(line - line.T), torn, 2).preservation
    array([1., 1., 1., 1., 0.])
    """
    points = as_points(embedding)
    data = as_distances(distances, len(points))
    size = as_size(k, len(points))
    sizes = np.array([size], dtype=np.intp)
    parts = zip(*_matrix_counts(data, points, sizes), strict=True)
    false, missed, kept, _ = (np.concatenate(part)[:, 0] for part in parts)
    n = len(points)
    scale = 2.0 / (size * (2.0 * n - 3.0 * size - 1.0))
    return LocalNeighborhoodQuality(size, 1.0 - scale * false, 1.0 - scale * missed, kept / size)


def _matrix_counts(
    data: NDArray[np.float64], points: NDArray[np.float64], sizes: NDArray[np.intp]
) -> Iterator[Counts]:
    return count_by_blocks(
        lambda start, stop: data[start:stop],
        lambda start, stop: euclidean_rows(points, start, stop),
        len(points),
        (float(data.max()) * TIE or 1.0, rounding_unit(points)),
        sizes,
    )


def _sum_up(counts: Iterator[Counts], sizes: NDArray[np.intp], n: int) -> NeighborhoodQuality:
    """Turn the sums over all samples into the measures."""
    false, missed, kept, intruding = sum(np.sum(block, axis=1) for block in counts)
    scale = 2.0 / (n * sizes * (2.0 * n - 3.0 * sizes - 1.0))
    return NeighborhoodQuality(
        k=sizes,
        trustworthiness=1.0 - scale * false,
        continuity=1.0 - scale * missed,
        preservation=kept / (n * sizes),
        intrusiveness=intruding / (n * sizes),
        n_samples=n,
    )
