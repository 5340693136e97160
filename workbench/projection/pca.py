"""Principal component analysis."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from sklearn.decomposition import PCA as SklearnPCA  # noqa: N811 - the same name is meant
from sklearn.utils.validation import check_is_fitted, validate_data

from workbench.projection.base import Projector


class PCA(Projector):
    """Project onto the directions of largest variance (Costa 2018, Alg. 3).

    The algorithm as printed does not centre the data, which only shifts the result.

    Parameters
    ----------
    n_components : int
        Dimensions of the embedding.

    Attributes
    ----------
    components_ : ndarray of shape (n_components, n_features)
        The directions; zeros where there are fewer features or samples than components.
    mean_ : ndarray of shape (n_features,)
        Mean of the samples.

    Examples
    --------
    >>> samples = [[0.0, 0.0], [3.0, 4.0], [6.0, 8.0]]
    >>> abs(PCA(n_components=1).fit_transform(samples)).round(9).ravel()
    array([5., 0., 5.])
    """

    def __init__(self, n_components: int = 2) -> None:
        self.n_components = n_components

    def _memory(self, shape: tuple[int, int]) -> float:
        # The centred samples and both factors.
        return 24.0 * shape[0] * shape[1]

    def _project(self, X: NDArray[np.float64]) -> NDArray[np.float64]:
        # Exact, so that the result does not depend on a seed.
        model = SklearnPCA(min(self.n_components, *X.shape), svd_solver="full")
        embedding = model.fit_transform(X)
        self.components_, self.mean_ = self._widened(model.components_.T).T, model.mean_
        return embedding

    def transform(self, X: ArrayLike) -> NDArray[np.float64]:
        """Place samples on the existing map.

        Parameters
        ----------
        X : array-like of shape (n_samples, n_features)
            Samples.

        Returns
        -------
        ndarray of shape (n_samples, n_components)
        """
        check_is_fitted(self)
        samples: NDArray[np.float64] = validate_data(self, X, dtype=np.float64, reset=False)
        return (samples - self.mean_) @ self.components_.T

    def inverse_transform(self, X: ArrayLike) -> NDArray[np.float64]:
        """Rebuild samples from positions on the map: the nearest of its plane.

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
            If the positions have another dimension or are not finite.
        """
        check_is_fitted(self)
        points = self._positions(X)
        return points @ self.components_ + self.mean_
