"""Shepard data: each pair's distance in the data beside that in the embedding."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.quality.inputs import as_points
from workbench.validation import as_distances, require_memory, whole_number


@dataclass(frozen=True)
class ShepardPairs:
    """Pairs of samples with their distances, in the order of :func:`numpy.triu_indices`.

    Attributes
    ----------
    first, second : ndarray of shape (n_pairs,)
        Samples of each pair, first < second.
    data, embedding : ndarray of shape (n_pairs,)
        Their distance in the data and in the embedding.
    """

    first: NDArray[np.intp]
    second: NDArray[np.intp]
    data: NDArray[np.float64]
    embedding: NDArray[np.float64]


def shepard_pairs(
    distances: ArrayLike,
    embedding: ArrayLike,
    n_pairs: int | None = None,
    random_state: int = 0,
) -> ShepardPairs:
    """List the distances of all pairs, or of a sample of them, for a Shepard diagram.

    Parameters
    ----------
    distances : array-like of shape (n_samples, n_samples)
        Distances in the data.
    embedding : array-like of shape (n_samples, n_dimensions)
        Positions.
    n_pairs : int, optional
        How many pairs to draw, each at most once; all by default, or if there are no more.
    random_state : int
        Seed of the drawing.

    Returns
    -------
    ShepardPairs

    Raises
    ------
    WorkbenchError
        If the shapes do not fit or ``n_pairs`` is no whole number above 0.
    DataError
        If the memory does not suffice for all pairs.

    Examples
    --------
    >>> pairs = shepard_pairs([[0, 1, 2], [1, 0, 1], [2, 1, 0]], [[0, 0], [3, 0], [9, 0]])
    >>> pairs.data, pairs.embedding
    (array([1., 2., 1.]), array([3., 9., 6.]))
    """
    points = as_points(embedding)
    data = as_distances(distances, len(points))
    n = len(points)
    n_all = n * (n - 1) // 2
    if n_pairs is None:
        n_pairs = n_all
    n_pairs = min(whole_number("n_pairs", n_pairs), n_all)
    seed = whole_number("random_state", random_state, at_least=0)
    require_memory(96.0 * n_pairs, f"a list of {n_pairs} pairs", "give a smaller n_pairs")
    if n_pairs == n_all:
        first, second = np.triu_indices(n, k=1)
    else:
        chosen = np.random.default_rng(seed).choice(n_all, n_pairs, replace=False)
        first, second = _pair_of(np.sort(chosen), n)
    apart = np.sqrt(sum((axis[first] - axis[second]) ** 2 for axis in points.T))
    return ShepardPairs(first, second, data[first, second], apart)


def shepard_goodness(pairs: ShepardPairs) -> float:
    """Measure how well the order of distances is kept.

    Spearman's rank correlation of the distances in the data and in the embedding
    (Espadoto et al. 2021).

    Parameters
    ----------
    pairs : ShepardPairs
        All pairs or a sample of them.

    Returns
    -------
    float
        1 where a longer distance is never shown shorter, -1 where it always is.

    Raises
    ------
    WorkbenchError
        If all distances of one side are equal.

    Examples
    --------
    >>> pairs = shepard_pairs([[0, 1, 3], [1, 0, 2], [3, 2, 0]], [[0, 0], [1, 0], [9, 0]])
    >>> round(shepard_goodness(pairs), 12)
    1.0
    """
    from scipy.stats import spearmanr

    for name, values in (("distances", pairs.data), ("embedding", pairs.embedding)):
        if np.ptp(values) == 0:
            raise WorkbenchError(
                f"{name}: got pairs that are all {values[0]:g} apart, want different distances"
            )
    return float(spearmanr(pairs.data, pairs.embedding).statistic)


def monotone_fit(pairs: ShepardPairs) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Fit the line of a Shepard diagram: distances in the embedding that never fall.

    The non-decreasing function of the data's distances with the least sum of squared
    differences to the embedding's, by isotonic regression (Kruskal 1964). Equal distances in
    the data have equal values (the secondary approach to ties).

    Parameters
    ----------
    pairs : ShepardPairs
        All pairs or a sample of them.

    Returns
    -------
    distances, fitted : ndarray of shape (n_distances,)
        The data's different distances in rising order, and the function's values there.

    Examples
    --------
    >>> pairs = shepard_pairs([[0, 1, 3], [1, 0, 2], [3, 2, 0]], [[0, 0], [4, 0], [2, 0]])
    >>> monotone_fit(pairs)
    (array([1., 2., 3.]), array([2.66666667, 2.66666667, 2.66666667]))
    """
    from scipy.optimize import isotonic_regression

    values, where, counts = np.unique(pairs.data, return_inverse=True, return_counts=True)
    means = np.bincount(where, pairs.embedding, len(values)) / counts
    return values, isotonic_regression(means, weights=counts.astype(np.float64)).x


def nonmetric_stress(pairs: ShepardPairs) -> float:
    """Compute Kruskal's stress-1 of the order of distances, whatever their size.

    √(Σ (δ_ij − f(d_ij))² / Σ δ_ij²) with f the non-decreasing function of the data's
    distances that fits the embedding's best, by isotonic regression (Kruskal 1964). Equal
    distances in the data have equal f (the secondary approach to ties), as in ZADU.

    Parameters
    ----------
    pairs : ShepardPairs
        All pairs or a sample of them.

    Returns
    -------
    float
        0 where a longer distance is never shown shorter.

    Raises
    ------
    WorkbenchError
        If all points of the embedding coincide.

    Examples
    --------
    >>> pairs = shepard_pairs([[0, 1, 3], [1, 0, 2], [3, 2, 0]], [[0, 0], [1, 0], [9, 0]])
    >>> nonmetric_stress(pairs)
    0.0
    """
    values, line = monotone_fit(pairs)
    fitted = line[np.searchsorted(values, pairs.data)]
    total = float(pairs.embedding @ pairs.embedding)
    if total == 0:
        raise WorkbenchError("embedding: got one place for all samples, want different places")
    return math.sqrt(float(np.sum((pairs.embedding - fitted) ** 2)) / total)


def _pair_of(number: NDArray[np.int64], n: int) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Find the pairs with these numbers in the order of the upper triangle's rows."""
    starts = np.concatenate([[0], np.cumsum(np.arange(n - 1, 0, -1))])
    first = np.searchsorted(starts, number, side="right") - 1
    return first, number - starts[first] + first + 1
