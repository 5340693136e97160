"""Stress of each sample.

d_ij is the distance in the data and δ_ij the distance in the embedding.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.quality.stress import NO_DISTANCES, as_pair, pair_sums, row_blocks


def local_stress(distances: ArrayLike, embedding: ArrayLike) -> NDArray[np.float64]:
    """Measure how badly each sample's distances are kept, to colour it by.

    Σ_j (d_ij − α·δ_ij)² / Σ_j d_ij², with α the scale that is best for all pairs. Weighted by
    Σ_j d_ij², the mean is :func:`scale_normalized_stress`.

    Parameters
    ----------
    distances : array-like of shape (n_samples, n_samples)
        Distances in the data.
    embedding : array-like of shape (n_samples, n_dimensions)
        Positions.

    Returns
    -------
    ndarray of shape (n_samples,)

    Raises
    ------
    WorkbenchError
        If the shapes do not fit or all points coincide, in the data or the embedding.

    Examples
    --------
    >>> line = [[0, 1, 2], [1, 0, 1], [2, 1, 0]]
    >>> local_stress(line, [[0, 0], [5, 0], [10, 0]])
    array([0., 0., 0.])
    """
    data, points = as_pair(distances, embedding)
    sums = pair_sums(data, points)
    if sums.data == 0:
        raise WorkbenchError(NO_DISTANCES)
    missed, kept = [], []
    for rows, delta in row_blocks(data, points):
        difference = rows - sums.scale * delta
        missed.append(np.einsum("ij,ij->i", difference, difference))
        kept.append(np.einsum("ij,ij->i", rows, rows))
    return np.concatenate(missed) / np.concatenate(kept)
