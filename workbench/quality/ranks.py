"""Ranks of neighbours in the data and in an embedding, for all sizes of neighbourhood at once.

What every measure of neighbourhoods is made of: for each sample and each size k, how far the
k nearest of one side are down the other side's order, and how many both have in common. No
matrix of ranks is built: of each row only the nearest are sorted, and the ranks of those that
are near on one side only are counted.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np
from numba import prange
from numpy.typing import NDArray

from workbench.kernels import compiled, compiled_parallel

#: Distances that differ by less, relative to the largest, differ by rounding.
TIE = 1e-10

# Rows of distances at once, which bounds the memory.
_BLOCK = 64

# Adding and taking away 1.5 · 2**52 rounds to the nearest whole number, up to 2**51.
_TO_WHOLE = 6755399441055744.0

#: Gives rows start … stop of a matrix of distances.
Rows = Callable[[int, int], NDArray[np.float64]]


class Counts(NamedTuple):
    """Whole-number sums over the neighbours of some samples, for each size k.

    With r the rank in the data and ρ that in the embedding, each an array of shape
    (n_rows, n_sizes):

    Attributes
    ----------
    false : ndarray
        Σ (r − k) over neighbours with ρ ≤ k < r.
    missed : ndarray
        Σ (ρ − k) over neighbours with r ≤ k < ρ.
    kept : ndarray
        Number of neighbours with r ≤ k and ρ ≤ k.
    intruding : ndarray
        Of the kept ones, those with ρ < r less those with ρ > r.
    """

    false: NDArray[np.int64]
    missed: NDArray[np.int64]
    kept: NDArray[np.int64]
    intruding: NDArray[np.int64]


def euclidean_rows(places: NDArray[np.float64], start: int, stop: int) -> NDArray[np.float64]:
    """Compute some rows of the matrix of Euclidean distances."""
    from scipy.spatial.distance import cdist

    return cdist(places[start:stop], places)


def rounding_unit(places: NDArray[np.float64]) -> float:
    """Choose what to round distances to: no two places are farther apart than the diagonal."""
    return float(np.linalg.norm(np.ptp(places, axis=0))) * TIE or 1.0


def count_by_blocks(
    data: Rows, points: Rows, n_samples: int, units: tuple[float, float], sizes: NDArray[np.intp]
) -> Iterator[Counts]:
    """Yield the counts for one block of samples after the other.

    Parameters
    ----------
    data, points : callable
        Give rows of the distances in the data and in the embedding.
    n_samples : int
        Number of samples.
    units : tuple of float
        What to round both distances to, at least 1e-11 of the largest: equal ones rank in
        the order of the samples.
    sizes : ndarray of shape (n_sizes,)
        Neighbourhood sizes.
    """
    n_bits = n_samples.bit_length()
    mask = (1 << n_bits) - 1
    largest = int(sizes.max())
    for start in range(0, n_samples, _BLOCK):
        stop = min(start + _BLOCK, n_samples)
        data_keys = _keys(data(start, stop), start, units[0], n_bits)
        point_keys = _keys(points(start, stop), start, units[1], n_bits)
        counts = np.empty((4, stop - start, len(sizes)), dtype=np.int64)
        _count_rows(
            data_keys,
            _smallest(data_keys, largest),
            point_keys,
            _smallest(point_keys, largest),
            mask,
            sizes,
            counts,
        )
        yield Counts(*counts)


def _keys(rows: NDArray[np.float64], first: int, unit: float, n_bits: int) -> NDArray[np.int64]:
    """Give each pair a whole number that orders by rounded distance, then by sample."""
    keys = np.empty(rows.shape, dtype=np.int64)
    _fill_keys(rows, first, unit, n_bits, keys)
    return keys


@compiled_parallel
def _fill_keys(rows, first, unit, n_bits, keys):  # type: ignore[no-untyped-def]  # compiled
    for i in prange(len(rows)):
        row, out = rows[i], keys[i]
        for j in range(len(row)):
            out[j] = (np.int64((row[j] / unit + _TO_WHOLE) - _TO_WHOLE) << n_bits) | j
        out[first + i] = np.iinfo(np.int64).max


def _smallest(keys: NDArray[np.int64], count: int) -> NDArray[np.int64]:
    """Sort the ``count`` smallest keys of each row, or all where that is about as cheap."""
    if 8 * count < keys.shape[1]:
        keys = np.partition(keys, count - 1, axis=1)[:, :count]
    return np.sort(keys, axis=1)


@compiled
def _rank(key, smallest, keys):  # type: ignore[no-untyped-def]  # compiled
    """Rank a key among all, from 1; ``smallest`` are the first of them in order."""
    if key <= smallest[-1]:
        return np.searchsorted(smallest, key) + 1
    rank = 1
    for j in range(len(keys)):
        rank += keys[j] < key
    return rank


@compiled
def _count_row(  # type: ignore[no-untyped-def]  # compiled
    data, near_data, points, near_points, mask, sizes, counts
):
    """Count one sample's neighbours by its keys in the data and in the embedding."""
    largest = sizes.max()
    # What begins at one size and ends before another is noted at both and summed up below.
    changes = np.zeros((6, largest + 2), dtype=np.int64)
    for rho in range(1, largest + 1):
        r = _rank(data[near_points[rho - 1] & mask], near_data, data)
        if r > rho:
            end = min(r, largest + 1)
            changes[0, rho] += r
            changes[1, rho] += 1
            changes[0, end] -= r
            changes[1, end] -= 1
        if r <= largest:
            both = max(r, rho)
            changes[4, both] += 1
            changes[5, both] += (r > rho) - (r < rho)
    for r in range(1, largest + 1):
        rho = _rank(points[near_data[r - 1] & mask], near_points, points)
        if rho > r:
            end = min(rho, largest + 1)
            changes[2, r] += rho
            changes[3, r] += 1
            changes[2, end] -= rho
            changes[3, end] -= 1
    for what in range(6):
        for size in range(1, largest + 1):
            changes[what, size] += changes[what, size - 1]
    for index in range(len(sizes)):
        size = sizes[index]
        counts[0, index] = changes[0, size] - size * changes[1, size]
        counts[1, index] = changes[2, size] - size * changes[3, size]
        counts[2, index] = changes[4, size]
        counts[3, index] = changes[5, size]


@compiled_parallel
def _count_rows(  # type: ignore[no-untyped-def]  # compiled
    data, near_data, points, near_points, mask, sizes, counts
):
    for row in prange(len(data)):
        _count_row(
            data[row], near_data[row], points[row], near_points[row], mask, sizes, counts[:, row]
        )
