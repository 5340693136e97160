"""Neighbourhoods: which neighbours an embedding keeps, loses and invents.

A sample is never its own neighbour. Ranks count from 1; distances that are equal, to 1e-10
of the largest, rank in the order of the samples.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.validation import as_distances, as_embedding

_BLOCK = 512

# Distances that differ by less, relative to the largest, differ by rounding.
_TIE = 1e-10


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
        embedding.
    """

    k: NDArray[np.intp]
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
    points = as_embedding(embedding)
    data = as_distances(distances, len(points))
    n = len(points)
    sizes = np.atleast_1d(np.asarray(k))
    if sizes.ndim != 1 or not sizes.size or not np.issubdtype(sizes.dtype, np.integer):
        raise WorkbenchError(f"k: got {k!r}, want one or several whole numbers")
    if sizes.min() < 1 or 2 * sizes.max() >= n:
        raise WorkbenchError(
            f"k: got {sizes.min()}…{sizes.max()}, want sizes from 1 to {(n - 1) // 2} "
            f"for {n} samples"
        )
    largest = int(sizes.max())
    false = np.zeros(len(sizes))
    missed = np.zeros(len(sizes))
    kept = np.zeros(len(sizes))
    for data_ranks, point_ranks in _rank_blocks(data, points):
        # Rank 0 is the sample itself, and a pair with both ranks above the largest k matters
        # for no size.
        near = (data_ranks > 0) & (np.minimum(data_ranks, point_ranks) <= largest)
        r, rho = data_ranks[near], point_ranks[near]
        for index, size in enumerate(sizes):
            false[index] += np.sum((r - size)[(rho <= size) & (r > size)])
            missed[index] += np.sum((rho - size)[(r <= size) & (rho > size)])
            kept[index] += np.count_nonzero((r <= size) & (rho <= size))
    scale = 2.0 / (n * sizes * (2.0 * n - 3.0 * sizes - 1.0))
    return NeighborhoodQuality(sizes, 1.0 - scale * false, 1.0 - scale * missed, kept / (n * sizes))


def _rank_blocks(
    data: NDArray[np.float64], points: NDArray[np.float64]
) -> Iterator[tuple[NDArray[np.intp], NDArray[np.intp]]]:
    """Yield the ranks by both distances for blocks of rows, so that memory stays bounded."""
    from scipy.spatial.distance import cdist

    data_unit = float(data.max()) * _TIE or 1.0
    point_unit = float(np.linalg.norm(np.ptp(points, axis=0))) * _TIE or 1.0
    for start in range(0, len(points), _BLOCK):
        stop = min(start + _BLOCK, len(points))
        yield (
            _ranks(np.round(data[start:stop] / data_unit), start),
            _ranks(np.round(cdist(points[start:stop], points) / point_unit), start),
        )


def _ranks(rows: NDArray[np.float64], first: int) -> NDArray[np.intp]:
    """Rank each row's entries, the sample itself as 0."""
    index = np.arange(len(rows))
    rows[index, first + index] = -np.inf
    order = np.argsort(rows, axis=1, kind="stable")
    ranks = np.empty_like(order)
    np.put_along_axis(ranks, order, np.arange(rows.shape[1])[None, :], axis=1)
    return ranks
