"""The mean of the nearest control points."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from sklearn.base import BaseEstimator, MultiOutputMixin, RegressorMixin
from sklearn.neighbors import KNeighborsRegressor

from workbench.backprojection.checking import at_most, control_points, positions
from workbench.errors import WorkbenchError

#: Points rebuilt at once.
_BLOCK = 4096


class KNN(MultiOutputMixin, RegressorMixin, BaseEstimator):
    """Rebuild samples as the mean of the nearest control points' samples.

    A baseline: it is constant between control points and never leaves their convex hull.

    Parameters
    ----------
    n_neighbors : int
        Control points to take the mean of; all, with a warning, if there are fewer.
    weights : {"uniform", "distance"}
        Whether all count the same, or each by the inverse of its distance, which makes a
        control point give back its own sample.

    Attributes
    ----------
    regressor_ : sklearn.neighbors.KNeighborsRegressor
        The method.
    n_features_in_ : int
        Dimensions of the embedding.

    Examples
    --------
    >>> model = KNN(n_neighbors=2).fit([[0.0, 0.0], [1.0, 0.0], [9.0, 0.0]], [1.0, 3.0, 7.0])
    >>> model.predict([[0.4, 0.0]])
    array([2.])
    """

    def __init__(self, n_neighbors: int = 5, *, weights: str = "uniform") -> None:
        self.n_neighbors = n_neighbors
        self.weights = weights

    def fit(self, X: ArrayLike, y: ArrayLike) -> KNN:
        """Remember the control points and their samples.

        Parameters
        ----------
        X : array-like of shape (n_control_points, n_dimensions)
            Positions in the embedding.
        y : array-like of shape (n_control_points, n_outputs) or (n_control_points,)
            Samples there.

        Returns
        -------
        KNN
            Itself.

        Raises
        ------
        WorkbenchError
            If a parameter, a position or a sample is not valid.

        Warns
        -----
        AdjustmentWarning
            If there are fewer control points than ``n_neighbors``.
        """
        if self.weights not in ("uniform", "distance"):
            raise WorkbenchError(f"weights: got {self.weights!r}, want 'uniform' or 'distance'")
        points, values = control_points(self, X, y)
        n_neighbors = at_most(self, "n_neighbors", len(points))
        regressor = KNeighborsRegressor(n_neighbors=n_neighbors, weights=self.weights)
        self.regressor_ = regressor.fit(points, values)
        return self

    def predict(self, X: ArrayLike) -> NDArray[np.float64]:
        """Rebuild the samples at positions of the embedding.

        Parameters
        ----------
        X : array-like of shape (n_points, n_dimensions)
            Positions.

        Returns
        -------
        ndarray of shape (n_points, n_outputs), or (n_points,) if fitted so
        """
        points = positions(self, X)
        # In blocks: scikit-learn gathers the samples of all neighbours of all points.
        blocks = range(0, len(points), _BLOCK)
        parts = [self.regressor_.predict(points[start : start + _BLOCK]) for start in blocks]
        return np.concatenate(parts).astype(np.float64, copy=False)
