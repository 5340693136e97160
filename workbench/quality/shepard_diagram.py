"""The Shepard diagram: distances in the data against distances in the embedding."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.quality.shepard import monotone_fit, shepard_goodness, shepard_pairs
from workbench.validation import whole_number

#: Pairs that are drawn: enough for a stable picture, whatever the number of samples.
N_PAIRS = 20_000


@dataclass(frozen=True, eq=False)
class ShepardDiagram:
    """Pairs of samples counted by their distances, and the line that fits them.

    Attributes
    ----------
    data_edges : ndarray of shape (n_bins + 1,)
        Bins of distances in the data, from 0.
    embedding_edges : ndarray of shape (n_bins + 1,)
        Bins of distances in the embedding, from 0.
    counts : ndarray of shape (n_bins, n_bins)
        Pairs in each bin: rows by distance in the data, columns by that in the embedding.
    line_data, line_embedding : ndarray of shape (n_line,)
        The line that never falls and fits best, see
        :func:`workbench.quality.shepard.monotone_fit`, at its corners.
    correlation : float
        Spearman's rank correlation of the two distances; NaN where one side is constant.
    n_pairs : int
        How many pairs were drawn.
    """

    data_edges: NDArray[np.float64]
    embedding_edges: NDArray[np.float64]
    counts: NDArray[np.int64]
    line_data: NDArray[np.float64]
    line_embedding: NDArray[np.float64]
    correlation: float
    n_pairs: int


def shepard_diagram(
    distances: ArrayLike,
    embedding: ArrayLike,
    *,
    n_pairs: int = N_PAIRS,
    n_bins: int = 40,
    random_state: int = 0,
) -> ShepardDiagram:
    """Count pairs of samples by their distances in the data and in the embedding.

    Counts in place of dots: thousands of dots hide each other.

    Parameters
    ----------
    distances : array-like of shape (n_samples, n_samples)
        Distances in the data.
    embedding : array-like of shape (n_samples, n_dimensions)
        Positions.
    n_pairs : int
        How many pairs to draw; all, if there are no more.
    n_bins : int
        Bins on each axis.
    random_state : int
        Seed of the drawing.

    Returns
    -------
    ShepardDiagram

    Raises
    ------
    WorkbenchError
        If the shapes do not fit or a number is not valid.

    Examples
    --------
    >>> line = [[0, 1, 2], [1, 0, 1], [2, 1, 0]]
    >>> diagram = shepard_diagram(line, [[0, 0], [2, 0], [4, 0]], n_bins=2)
    >>> diagram.counts
    array([[0, 0],
           [0, 3]])
    >>> diagram.line_data, diagram.line_embedding
    (array([1., 2.]), array([2., 4.]))
    """
    whole_number("n_bins", n_bins)
    pairs = shepard_pairs(distances, embedding, n_pairs, random_state)
    edges = [_edges(values, n_bins) for values in (pairs.data, pairs.embedding)]
    counts, _, _ = np.histogram2d(pairs.data, pairs.embedding, bins=edges)
    try:
        correlation = shepard_goodness(pairs)
    except WorkbenchError:
        correlation = float("nan")
    values, fitted = monotone_fit(pairs)
    # Only the corners: between them the line is level or straight.
    corner = np.ones(len(values), dtype=bool)
    corner[1:-1] = (fitted[1:-1] != fitted[:-2]) | (fitted[1:-1] != fitted[2:])
    return ShepardDiagram(
        data_edges=edges[0],
        embedding_edges=edges[1],
        counts=counts.astype(np.int64),
        line_data=values[corner],
        line_embedding=fitted[corner],
        correlation=correlation,
        n_pairs=len(pairs.data),
    )


def _edges(values: NDArray[np.float64], n_bins: int) -> NDArray[np.float64]:
    return np.linspace(0.0, float(values.max()) or 1.0, n_bins + 1)
