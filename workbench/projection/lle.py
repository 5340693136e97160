"""Locally linear embedding."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from sklearn.manifold import LocallyLinearEmbedding

from workbench.projection.base import Projector


class LLE(Projector):
    """Project so that each sample stays the same mixture of its neighbours (Costa 2018, Alg. 4).

    The local covariance is regularised, without which more neighbours than features make it
    singular; the printed scaling of columns by λ_j is left out.

    Parameters
    ----------
    n_components : int
        Dimensions of the embedding.
    n_neighbors : int
        Neighbours of each sample; fewer if there are fewer samples, with a warning.

    Warns
    -----
    DegenerateDataWarning
        If the graph of neighbours falls into parts.
    """

    def __init__(self, n_components: int = 2, *, n_neighbors: int = 15) -> None:
        self.n_components = n_components
        self.n_neighbors = n_neighbors

    def _memory(self, shape: tuple[int, int]) -> float:
        # The dense matrix of weights and the solver's copy of it.
        return 16.0 * shape[0] ** 2

    def _project(self, X: NDArray[np.float64]) -> NDArray[np.float64]:
        n_neighbors = self._at_most("n_neighbors", len(X) - 1, f"{len(X)} samples")
        # The dense solver needs no random start and does not fail on singular matrices.
        model = LocallyLinearEmbedding(
            n_neighbors=n_neighbors,
            n_components=min(self.n_components, X.shape[1], len(X) - 1),
            eigen_solver="dense",
        )
        embedding: NDArray[np.float64] = model.fit_transform(X)
        self._tell_parts(
            model.nbrs_.kneighbors_graph(), "which nothing relates: each may shrink to a point"
        )
        return embedding
