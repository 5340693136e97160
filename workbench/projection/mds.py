"""Classical multidimensional scaling."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from sklearn.manifold import ClassicalMDS

from workbench.projection.base import Projector


class MDS(Projector):
    """Project so that scalar products are kept best (Costa 2018, Alg. 6).

    The coordinates are √λ_j · E_j, as in classical scaling; λ_j · E_j is printed. They are 0
    where λ_j is negative, which happens with few samples, or distances that no coordinates
    have.

    Parameters
    ----------
    n_components : int
        Dimensions of the embedding.
    metric : {"euclidean", "precomputed"}
        Whether samples are vectors or a matrix of distances.
    """

    def __init__(self, n_components: int = 2, *, metric: str = "euclidean") -> None:
        self.n_components = n_components
        self.metric = metric

    def _memory(self, shape: tuple[int, int]) -> float:
        # Distances, their squares, the centred matrix and the solver's copy of it.
        return 33.0 * shape[0] ** 2

    def _project(self, X: NDArray[np.float64]) -> NDArray[np.float64]:
        model = ClassicalMDS(self.n_components, metric=self.metric)
        with np.errstate(invalid="ignore"):
            embedding: NDArray[np.float64] = model.fit_transform(X)
        embedding[:, model.eigenvalues_ < 0] = 0.0
        return embedding
