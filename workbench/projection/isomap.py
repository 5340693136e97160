"""Isomap."""

from __future__ import annotations

import warnings

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import SparseEfficiencyWarning
from sklearn.manifold import Isomap as SklearnIsomap
from sklearn.utils.validation import check_is_fitted, validate_data

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

    Attributes
    ----------
    model_ : sklearn.manifold.Isomap
        The fitted method.

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

    def _memory(self, shape: tuple[int, int]) -> float:
        # Distances along the graph, the centred kernel and the solver's copy of it.
        return 34.0 * shape[0] ** 2

    def _project(self, X: NDArray[np.float64]) -> NDArray[np.float64]:
        n_neighbors = self._at_most("n_neighbors", len(X) - 1, f"{len(X)} samples")
        self.model_ = SklearnIsomap(
            n_neighbors=n_neighbors,
            n_components=self.n_components,
            eigen_solver="dense",
            metric=self.metric,
        )
        with warnings.catch_warnings():
            # Said below in the words of this package; joining parts is slow and is said too.
            warnings.filterwarnings("ignore", message=".*connected components")
            warnings.filterwarnings("ignore", category=SparseEfficiencyWarning)
            embedding: NDArray[np.float64] = self.model_.fit_transform(X)
        self._tell_parts(
            self.model_.nbrs_.kneighbors_graph(), "which were joined by their shortest links"
        )
        return embedding

    def transform(self, X: ArrayLike) -> NDArray[np.float64]:
        """Place samples on the existing map, by their distances along the graph.

        Parameters
        ----------
        X : array-like of shape (n_samples, n_features)
            Samples, or their distances to those of the map where the projector has
            ``metric="precomputed"``.

        Returns
        -------
        ndarray of shape (n_samples, n_components)
        """
        check_is_fitted(self)
        samples: NDArray[np.float64] = validate_data(self, X, dtype=np.float64, reset=False)
        positions: NDArray[np.float64] = self.model_.transform(samples)
        return positions
