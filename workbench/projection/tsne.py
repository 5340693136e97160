"""t-distributed stochastic neighbour embedding."""

from __future__ import annotations

from numbers import Real

import numpy as np
from numpy.typing import NDArray
from sklearn.manifold import TSNE as SklearnTSNE  # noqa: N811 - the same name is meant

from workbench.errors import WorkbenchError
from workbench.projection.base import Projector


class TSNE(Projector):
    """Project so that neighbourhoods are kept (Costa 2018, Alg. 8).

    Parameters
    ----------
    n_components : int
        Dimensions of the embedding.
    perplexity : float
        Effective number of neighbours; lowered to (n_samples − 1) / 3 if that is less,
        with a warning.
    metric : {"euclidean", "precomputed"}
        Whether samples are vectors or a matrix of distances.
    random_state : int, RandomState instance or None
        Seed of the random start.
    """

    def __init__(
        self,
        n_components: int = 2,
        *,
        perplexity: float = 50.0,
        metric: str = "euclidean",
        random_state: int | np.random.RandomState | None = None,
    ) -> None:
        self.n_components = n_components
        self.perplexity = perplexity
        self.metric = metric
        self.random_state = random_state

    def _check_parameters(self) -> None:
        super()._check_parameters()
        if not isinstance(self.perplexity, Real) or not 0.0 < float(self.perplexity) < np.inf:
            raise WorkbenchError(f"perplexity: got {self.perplexity!r}, want a number above 0")

    def _memory(self, shape: tuple[int, int]) -> float:
        # Sparse affinities to 3 · perplexity neighbours, in some copies.
        return 60.0 * shape[0] * min(3.0 * self.perplexity, shape[0])

    def _project(self, X: NDArray[np.float64]) -> NDArray[np.float64]:
        perplexity = self._at_most("perplexity", (len(X) - 1) / 3, f"{len(X)} samples")
        embedding: NDArray[np.float64] = SklearnTSNE(
            n_components=self.n_components,
            perplexity=perplexity,
            metric=self.metric,
            init="random",
            random_state=self.random_state,
        ).fit_transform(X)
        return embedding
