"""Uniform manifold approximation and projection."""

from __future__ import annotations

import warnings

import numpy as np
from numpy.typing import NDArray
from sklearn.utils import check_random_state
from umap import UMAP as LearnUMAP  # noqa: N811 - a class, whatever its capitals

from workbench.projection.base import Projector


class UMAP(Projector):
    """Project so that a fuzzy graph of neighbours is kept (McInnes, Healy & Melville 2018).

    Parameters
    ----------
    n_components : int
        Dimensions of the embedding.
    n_neighbors : int
        Neighbours of each sample; fewer if there are fewer samples, with a warning.
    min_dist : float
        Smallest distance between points of the embedding.
    metric : {"euclidean", "precomputed"}
        Whether samples are vectors or a matrix of distances.
    random_state : int, RandomState instance or None
        Seed.
    """

    def __init__(
        self,
        n_components: int = 2,
        *,
        n_neighbors: int = 15,
        min_dist: float = 0.1,
        metric: str = "euclidean",
        random_state: int | np.random.RandomState | None = None,
    ) -> None:
        self.n_components = n_components
        self.n_neighbors = n_neighbors
        self.min_dist = min_dist
        self.metric = metric
        self.random_state = random_state

    def _project(self, X: NDArray[np.float64]) -> NDArray[np.float64]:
        n_neighbors = self._at_most("n_neighbors", len(X) - 1, f"{len(X)} samples")
        seed = check_random_state(self.random_state).randint(2**31 - 1)
        with warnings.catch_warnings():
            # umap-learn warns of what is asked for here: one job because of the seed, and
            # no inverse transform of precomputed distances.
            warnings.filterwarnings("ignore", message=".*n_jobs value.*")
            warnings.filterwarnings("ignore", message=".*precomputed metric.*")
            embedding: NDArray[np.float64] = LearnUMAP(
                n_components=self.n_components,
                n_neighbors=n_neighbors,
                min_dist=self.min_dist,
                metric=self.metric,
                # The spectral start needs more samples than components.
                init="spectral" if len(X) > self.n_components + 2 else "random",
                random_state=seed,
            ).fit_transform(X)
        return embedding
