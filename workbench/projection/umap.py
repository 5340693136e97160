"""Uniform manifold approximation and projection."""

from __future__ import annotations

import warnings

import numpy as np
from numpy.typing import ArrayLike, NDArray
from sklearn.utils import check_random_state
from sklearn.utils.validation import check_is_fitted, validate_data
from umap import UMAP as LearnUMAP  # noqa: N811 - a class, whatever its capitals

from workbench.errors import WorkbenchError
from workbench.projection.base import Projector, check_whole_number


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

    Attributes
    ----------
    model_ : umap.UMAP
        The fitted method.

    Warns
    -----
    DegenerateDataWarning
        If the graph of neighbours falls into parts.
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

    def _check_parameters(self) -> None:
        super()._check_parameters()
        check_whole_number("n_neighbors", self.n_neighbors, at_least=2)

    def _memory(self, shape: tuple[int, int]) -> float:
        if self.metric == "precomputed":
            return 16.0 * shape[0] ** 2
        # The graph of neighbours and the trees that it is searched with.
        return 200.0 * shape[0] * min(self.n_neighbors, shape[0])

    def _project(self, X: NDArray[np.float64]) -> NDArray[np.float64]:
        n_neighbors = self._at_most("n_neighbors", len(X) - 1, f"{len(X)} samples")
        seed = check_random_state(self.random_state).randint(2**31 - 1)
        self.model_ = LearnUMAP(
            n_components=self.n_components,
            n_neighbors=n_neighbors,
            min_dist=self.min_dist,
            metric=self.metric,
            # The spectral start needs more samples than components.
            init="spectral" if len(X) > self.n_components + 2 else "random",
            random_state=seed,
        )
        with warnings.catch_warnings():
            # umap-learn warns of what is asked for here: one job because of the seed, and
            # no inverse transform of precomputed distances.
            warnings.filterwarnings("ignore", message=".*n_jobs value.*")
            warnings.filterwarnings("ignore", message=".*precomputed metric.*")
            embedding: NDArray[np.float64] = self.model_.fit_transform(X)
        self._tell_parts(self.model_.graph_, "whose distances on the map mean little")
        return embedding

    def transform(self, X: ArrayLike) -> NDArray[np.float64]:
        """Place samples on the existing map.

        Their places are found together, and depend on which samples are placed at once.

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
        samples = validate_data(self, X, dtype=np.float64, reset=False)
        return np.asarray(self.model_.transform(samples), dtype=np.float64)

    def inverse_transform(self, X: ArrayLike) -> NDArray[np.float64]:
        """Rebuild samples from positions on the map, where these are vectors.

        Parameters
        ----------
        X : array-like of shape (n_points, n_components)
            Positions.

        Returns
        -------
        ndarray of shape (n_points, n_features)

        Raises
        ------
        WorkbenchError
            If the map was made from distances, or the positions have another dimension or
            are not finite.
        """
        check_is_fitted(self)
        points = self._positions(X)
        if self.metric == "precomputed":
            raise WorkbenchError(
                "metric: got 'precomputed', want 'euclidean': distances do not tell what the "
                "samples of other positions are"
            )
        return np.asarray(self.model_.inverse_transform(points), dtype=np.float64)
