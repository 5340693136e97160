"""Sammon's stress: distances kept relative to their own size.

d_ij is the distance in the data and δ_ij the distance in the embedding.
"""

from __future__ import annotations

import warnings

import numpy as np
from numpy.typing import ArrayLike

from workbench.errors import DegenerateDataWarning, WorkbenchError
from workbench.quality.stress import NO_DISTANCES, as_pair, row_blocks


def sammon_stress(distances: ArrayLike, embedding: ArrayLike) -> float:
    """Compute Sammon's stress, in which small distances count as much as large ones.

    1 / Σ d_ij · Σ (δ_ij − d_ij)² / d_ij (Sammon 1969). Samples that coincide in the data
    would have infinite weight; such pairs are left out, with a warning.

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
    >>> sammon_stress([[0, 1, 2], [1, 0, 1], [2, 1, 0]], [[0, 0], [2, 0], [4, 0]])
    1.0
    """
    data, points = as_pair(distances, embedding)
    weighted = total = 0.0
    n_equal = -len(points)  # each sample equals itself
    for rows, delta in row_blocks(data, points):
        apart = rows > 0
        n_equal += int(apart.size - np.count_nonzero(apart))
        weighted += float(np.sum((delta - rows)[apart] ** 2 / rows[apart]))
        total += float(rows.sum())
    if total == 0:
        raise WorkbenchError(NO_DISTANCES)
    if n_equal > 0:
        warnings.warn(
            f"{n_equal // 2} pairs of samples coincide in the data and are left out of "
            "Sammon's stress",
            DegenerateDataWarning,
            stacklevel=2,
        )
    return weighted / total
