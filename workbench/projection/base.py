"""What the adaptors to scikit-learn and umap-learn share."""

from __future__ import annotations

import warnings
from abc import abstractmethod
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from sklearn.base import BaseEstimator, TransformerMixin
from sklearn.utils.validation import validate_data

from workbench.errors import AdjustmentWarning, WorkbenchError


class Projector(TransformerMixin, BaseEstimator):
    """The base of projectors: validation, ``fit`` and ``fit_transform``.

    A subclass implements ``_project``, which may rely on finite float64 input of at least
    two samples.

    Attributes
    ----------
    embedding_ : ndarray of shape (n_samples, n_components)
        Positions of the samples.
    n_features_in_ : int
        Features of the samples (samples, if distances are precomputed).
    """

    n_components: int
    embedding_: NDArray[np.float64]

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
        """
        samples: NDArray[np.float64] = validate_data(
            self, X, dtype=np.float64, ensure_min_samples=2
        )
        precomputed = getattr(self, "metric", None) == "precomputed"
        if precomputed and samples.shape[0] != samples.shape[1]:
            raise WorkbenchError(f"X: got shape {samples.shape}, want a square distance matrix")
        self.embedding_ = np.asarray(self._project(samples), dtype=np.float64)
        return self.embedding_

    @abstractmethod
    def _project(self, X: NDArray[np.float64]) -> NDArray[np.float64]:
        """Project validated samples."""

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

    @property
    def _n_features_out(self) -> int:
        return self.embedding_.shape[1]

    def __sklearn_tags__(self) -> Any:
        """Tell scikit-learn whether the input is a distance matrix."""
        tags = super().__sklearn_tags__()
        tags.input_tags.pairwise = getattr(self, "metric", None) == "precomputed"
        return tags
