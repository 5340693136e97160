"""Any scikit-learn regressor as a back-projector."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from sklearn.base import BaseEstimator, MultiOutputMixin, RegressorMixin, clone, is_regressor
from sklearn.multioutput import MultiOutputRegressor
from sklearn.neighbors import KNeighborsRegressor
from sklearn.utils import get_tags

from workbench.backprojection.checking import control_points, positions


def predicts_one_number(method: Any) -> bool:
    """Tell whether a method is a scikit-learn regressor for a single output.

    Examples
    --------
    >>> from sklearn.svm import SVR
    >>> predicts_one_number(SVR()), predicts_one_number(KNeighborsRegressor())
    (True, False)
    """
    if not hasattr(method, "__sklearn_tags__"):
        return False
    return is_regressor(method) and not get_tags(method).target_tags.multi_output


class RegressorBackProjector(MultiOutputMixin, RegressorMixin, BaseEstimator):
    """Rebuild samples with a scikit-learn regressor.

    Regressors that predict a single number, gradient boosting for instance, are fitted
    once for each feature of the samples.

    Parameters
    ----------
    regressor : scikit-learn regressor, optional
        The method; by default the mean of the 5 nearest control points (fewer, if there
        are fewer).

    Attributes
    ----------
    regressor_ : scikit-learn regressor
        The fitted method.

    Examples
    --------
    >>> from sklearn.linear_model import LinearRegression
    >>> model = RegressorBackProjector(LinearRegression())
    >>> model.fit([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], [0.0, 2.0, 3.0]).predict([[1.0, 1.0]])
    array([5.])
    """

    def __init__(self, regressor: Any = None) -> None:
        self.regressor = regressor

    def fit(self, X: ArrayLike, y: ArrayLike) -> RegressorBackProjector:
        """Fit the regressor to the control points.

        Parameters
        ----------
        X : array-like of shape (n_control_points, n_dimensions)
            Positions in the embedding.
        y : array-like of shape (n_control_points, n_outputs) or (n_control_points,)
            Samples there.

        Returns
        -------
        RegressorBackProjector
            Itself.
        """
        points, targets = control_points(self, X, y)
        if self.regressor is None:
            regressor = KNeighborsRegressor(n_neighbors=min(5, len(points)))
        else:
            regressor = clone(self.regressor)
        if np.ndim(targets) == 2 and predicts_one_number(regressor):
            regressor = MultiOutputRegressor(regressor)
        self.regressor_ = regressor.fit(points, targets)
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
        return np.asarray(self.regressor_.predict(points), dtype=np.float64)
