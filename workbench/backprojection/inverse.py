"""The projector's own inverse as a back-projector."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from sklearn.base import BaseEstimator

from workbench.backprojection.checking import control_points, positions
from workbench.errors import WorkbenchError


class ProjectorInverse(BaseEstimator):
    """Rebuild samples with the inverse of the projector that placed them.

    PCA has one, the point of the plane of largest variance, and UMAP approximates one. It
    is the baseline that a back-projector has to beat: it knows the projector and all
    samples, but control points are nothing special to it, so it does not pass through
    their samples.

    Schemes tell it the projection before ``fit``, by :meth:`use_projection`.

    Attributes
    ----------
    projection_ : Projection
        The one that is inverted.
    n_features_in_ : int
        Dimensions of the embedding.

    Examples
    --------
    >>> from sklearn.decomposition import PCA
    >>> from workbench.projection.fitted import Projection
    >>> samples = [[0.0, 0.0, 5.0], [1.0, 0.0, 5.0], [0.0, 2.0, 5.0]]
    >>> pca = PCA(n_components=2).fit(samples)
    >>> points = pca.transform(samples)
    >>> inverse = ProjectorInverse()
    >>> inverse.use_projection(Projection(points, pca, low=np.zeros(2), extent=1.0))
    >>> bool(np.allclose(inverse.fit(points, samples).predict(points), samples))
    True
    """

    def use_projection(self, projection: Any) -> None:
        """Take the projection whose projector is to be inverted.

        Parameters
        ----------
        projection : Projection or None
            None says that there is none: the embedding was given, or made in two steps.

        Raises
        ------
        WorkbenchError
            If there is none, or its projector has no inverse.
        """
        if projection is None:
            raise WorkbenchError(
                "back-projector 'inverse': got no projector to invert (the embedding was given, "
                "or made in two steps), want one that projected all samples in one step, "
                "pca or umap"
            )
        if not hasattr(projection.projector, "inverse_transform"):
            raise WorkbenchError(
                f"back-projector 'inverse': got {type(projection.projector).__name__}, which has "
                "no inverse, want a projector that has one: pca or umap"
            )
        self._projection = projection

    def fit(self, X: ArrayLike, y: ArrayLike) -> ProjectorInverse:
        """Check the control points; there is nothing to learn from them.

        Parameters
        ----------
        X : array-like of shape (n_control_points, n_dimensions)
            Positions in the embedding.
        y : array-like of shape (n_control_points, n_outputs)
            Samples there.

        Returns
        -------
        ProjectorInverse
            Itself.

        Raises
        ------
        WorkbenchError
            If no projection was given before.
        """
        self.use_projection(getattr(self, "_projection", None))
        control_points(self, X, y)
        self.projection_ = self._projection
        return self

    def predict(self, X: ArrayLike) -> NDArray[np.float64]:
        """Rebuild the samples at positions of the embedding.

        Parameters
        ----------
        X : array-like of shape (n_points, n_dimensions)
            Positions, on the scale of the projection's embedding.

        Returns
        -------
        ndarray of shape (n_points, n_outputs)
        """
        points = positions(self, X)
        unscaled = self.projection_.unscaled(points)
        return np.asarray(self.projection_.projector.inverse_transform(unscaled), dtype=np.float64)
