"""Labels: whether an embedding keeps samples of one kind together."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.quality.inputs import as_points, as_size
from workbench.quality.ranks import euclidean_rows, rounding_unit

# Rows of distances at once, which bounds the memory.
_BLOCK = 128


def neighborhood_hit(embedding: ArrayLike, labels: ArrayLike, k: int) -> NDArray[np.float64]:
    """Measure for each sample how many of its neighbours in the embedding share its label.

    Share of the k nearest with the sample's own label (Paulovich et al. 2008); the mean over
    all samples is the neighbourhood hit of the embedding.

    Parameters
    ----------
    embedding : array-like of shape (n_samples, n_dimensions)
        Positions.
    labels : array-like of shape (n_samples,)
        Labels of any kind that can be compared.
    k : int
        Neighbourhood size, from 1 to n_samples − 1.

    Returns
    -------
    ndarray of shape (n_samples,)

    Raises
    ------
    WorkbenchError
        If there is not one label for each position, labels cannot be compared, or the size
        is out of range.

    Examples
    --------
    >>> neighborhood_hit([[0, 0], [1, 0], [9, 0]], ["a", "a", "b"], 1)
    array([1., 1., 0.])
    """
    points = as_points(embedding)
    found = np.asarray(labels)
    if found.shape != (len(points),):
        raise WorkbenchError(f"labels: got shape {found.shape}, want ({len(points)},)")
    try:
        _, codes = np.unique(found, return_inverse=True)
    except TypeError:
        raise WorkbenchError("labels: got labels of different kinds, want one kind") from None
    size = as_size(k, len(points), len(points) - 1)
    unit = rounding_unit(points)
    hits = np.empty(len(points))
    for start in range(0, len(points), _BLOCK):
        rows = np.round(euclidean_rows(points, start, start + _BLOCK) / unit)
        index = np.arange(len(rows))
        rows[index, start + index] = np.inf
        near = np.argsort(rows, axis=1, kind="stable")[:, :size]
        hits[start : start + _BLOCK] = np.mean(codes[near] == codes[start + index, None], axis=1)
    return hits
