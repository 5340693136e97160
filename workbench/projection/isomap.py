"""Isomap."""

from __future__ import annotations

import warnings

import numpy as np
from numpy.typing import NDArray
from sklearn.manifold import Isomap as SklearnIsomap

from workbench.errors import DegenerateDataWarning
from workbench.projection.base import Projector


class Isomap(Projector):
    """Project by classical scaling of geodesic distances (Costa 2018, Alg. 5).

    Parameters
    ----------
    n_components : int
        Dimensions of the embedding.
    n_neighbors : int
        Neighbours joined to each sample in the graph that distances are measured along;
        fewer if there are fewer samples, with a warning.
    metric : {"euclidean", "precomputed"}
        Whether samples are vectors or a matrix of distances.

    Warns
    -----
    DegenerateDataWarning
        If the graph falls into parts; they are joined by their shortest links.
    """

    def __init__(
        self, n_components: int = 2, *, n_neighbors: int = 14, metric: str = "euclidean"
    ) -> None:
        self.n_components = n_components
        self.n_neighbors = n_neighbors
        self.metric = metric

    def _project(self, X: NDArray[np.float64]) -> NDArray[np.float64]:
        n_neighbors = self._at_most("n_neighbors", len(X) - 1, f"{len(X)} samples")
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            embedding: NDArray[np.float64] = SklearnIsomap(
                n_neighbors=n_neighbors,
                n_components=self.n_components,
                eigen_solver="dense",
                metric=self.metric,
            ).fit_transform(X)
        if any("connected components" in str(w.message) for w in caught):
            warnings.warn(
                f"Isomap: the graph of {n_neighbors} neighbours falls into parts, which were "
                "joined by their shortest links; more neighbours may serve better",
                DegenerateDataWarning,
                stacklevel=3,
            )
        return embedding
