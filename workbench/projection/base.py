"""What the adaptors to scikit-learn and umap-learn share."""

from __future__ import annotations

import warnings
from abc import abstractmethod
from numbers import Integral
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from sklearn.base import BaseEstimator, TransformerMixin
from sklearn.utils import check_random_state
from sklearn.utils.validation import validate_data

from workbench.errors import AdjustmentWarning, DegenerateDataWarning, WorkbenchError
from workbench.validation import as_numbers, finite, require_memory, said_in_one_line


class Projector(TransformerMixin, BaseEstimator):
    """The base of projectors: validation, ``fit`` and ``fit_transform``.

    A subclass implements ``_project``, which may rely on finite float64 input of at least
    two samples. One that takes much memory implements ``_memory`` too, so that what will
    not fit is refused before it starts.

    Attributes
    ----------
    embedding_ : ndarray of shape (n_samples, n_components)
        Positions of the samples.
    n_features_in_ : int
        Features of the samples (samples, if distances are precomputed).
    """

    n_components: int
    embedding_: NDArray[np.float64]

    #: Values of the parameter ``metric``, of projectors that have it.
    _metrics: tuple[str, ...] = ("euclidean", "precomputed")

    def fit(
        self,
        X: ArrayLike,
        y: Any = None,  # noqa: ARG002 - scikit-learn's signature
    ) -> Projector:
        """Project the samples.

        Parameters
        ----------
        X : array-like of shape (n_samples, n_features)
            Samples, or their distances of shape (n_samples, n_samples) where the projector
            has ``metric="precomputed"``.
        y : None
            Ignored.

        Returns
        -------
        Projector
            Itself; the positions are in ``embedding_``.
        """
        self.fit_transform(X)
        return self

    def fit_transform(
        self,
        X: ArrayLike,
        y: Any = None,  # noqa: ARG002 - scikit-learn's signature
    ) -> NDArray[np.float64]:
        """Project the samples and return their positions.

        Parameters
        ----------
        X : array-like of shape (n_samples, n_features)
            As for ``fit``.
        y : None
            Ignored.

        Returns
        -------
        ndarray of shape (n_samples, n_components)

        Raises
        ------
        WorkbenchError
            If a parameter is not valid, or the samples are no finite numbers of that shape.
        DataError
            If the free memory does not suffice.
        """
        with said_in_one_line():
            samples: NDArray[np.float64] = validate_data(
                self, X, dtype=np.float64, ensure_min_samples=2
            )
        self._check_parameters()
        if getattr(self, "metric", None) == "precomputed":
            _check_distances(samples)
        require_memory(
            self._memory(samples.shape),
            f"{type(self).__name__} of {len(samples)} samples",
            "take a sample of them, or project in two steps (RBFP or LAMP around control points)",
        )
        self.embedding_ = self._widened(np.asarray(self._project(samples), dtype=np.float64))
        return self.embedding_

    @abstractmethod
    def _project(self, X: NDArray[np.float64]) -> NDArray[np.float64]:
        """Project validated samples."""

    def _check_parameters(self) -> None:
        """Refuse parameters that no projector could use; a subclass may refuse more."""
        for name in ("n_components", "n_neighbors"):
            check_whole_number(name, getattr(self, name, 1), at_least=1)
        metric = getattr(self, "metric", self._metrics[0])
        if metric not in self._metrics:
            raise WorkbenchError(f"metric: got {metric!r}, want one of {', '.join(self._metrics)}")
        seed = getattr(self, "random_state", None)
        try:
            check_random_state(seed)
        except ValueError:
            raise WorkbenchError(
                f"random_state: got {seed!r}, want a whole number from 0 to {2**32 - 1}, "
                "a RandomState instance or None"
            ) from None

    def _memory(
        self,
        shape: tuple[int, int],  # noqa: ARG002 - for those that take memory
    ) -> float:
        """Estimate the bytes that ``_project`` takes beside input of that shape."""
        return 0.0

    def _at_most(self, name: str, limit: int | float, reason: str) -> Any:
        """Return a parameter, lowered to what the data allow, and say so if it was."""
        value = getattr(self, name)
        if value <= limit:
            return value
        warnings.warn(
            f"{type(self).__name__}: {name}={value} lowered to {limit:g} ({reason})",
            AdjustmentWarning,
            stacklevel=4,
        )
        return limit

    def _widened(self, embedding: NDArray[np.float64]) -> NDArray[np.float64]:
        """Add zeros for dimensions that the data do not have, such as a table's second column."""
        missing = getattr(self, "n_components", 0) - embedding.shape[1]
        return np.pad(embedding, ((0, 0), (0, missing))) if missing > 0 else embedding

    def _positions(self, X: ArrayLike) -> NDArray[np.float64]:
        """Check positions on the map, for the inverse of a projector that has one."""
        points = as_numbers("X", X, self.embedding_.shape[1])
        if points.ndim != 2:
            wanted = f"(n_points, {self.embedding_.shape[1]})"
            raise WorkbenchError(f"X: got shape {points.shape}, want {wanted}")
        return finite(points, "X")

    def _tell_parts(self, graph: Any, consequence: str) -> None:
        """Warn if a sparse graph of neighbours falls into parts."""
        from scipy.sparse.csgraph import connected_components

        n_parts = connected_components(graph, directed=False, return_labels=False)
        if n_parts > 1:
            warnings.warn(
                f"{type(self).__name__}: the graph of neighbours falls into {n_parts} parts, "
                f"{consequence}; more neighbours may serve better",
                DegenerateDataWarning,
                stacklevel=4,
            )

    @property
    def _n_features_out(self) -> int:
        return self.embedding_.shape[1]

    def __sklearn_tags__(self) -> Any:
        """Tell scikit-learn whether the input is a distance matrix."""
        tags = super().__sklearn_tags__()
        tags.input_tags.pairwise = getattr(self, "metric", None) == "precomputed"
        return tags


def check_whole_number(name: str, value: Any, at_least: int) -> None:
    """Refuse a parameter that is no whole number, or too small.

    Raises
    ------
    WorkbenchError
        If it is.
    """
    if not isinstance(value, Integral) or isinstance(value, bool) or value < at_least:
        raise WorkbenchError(f"{name}: got {value!r}, want a whole number from {at_least}")


def _check_distances(X: NDArray[np.float64]) -> None:
    """Refuse what is no matrix of distances."""
    if X.shape[0] != X.shape[1]:
        raise WorkbenchError(f"X: got shape {X.shape}, want a square distance matrix")
    if X.min() < 0:
        raise WorkbenchError(f"X: got a distance of {X.min()}, want none below 0")
    if not np.array_equal(X, X.T) and not np.allclose(X, X.T):
        raise WorkbenchError("X: got distances that are not symmetric")
