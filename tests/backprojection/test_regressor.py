"""Tests of workbench.backprojection.regressor and of the choice of a back-projector."""

from __future__ import annotations

import numpy as np
import pytest
from sklearn.ensemble import GradientBoostingRegressor
from sklearn.linear_model import LinearRegression
from sklearn.utils.estimator_checks import check_estimator

from workbench.backprojection import back_projector_for, back_projectors
from workbench.backprojection.poses import PoseBackProjector, SpatialKeyframes
from workbench.backprojection.rbf import RBF
from workbench.backprojection.regressor import RegressorBackProjector
from workbench.spaces import PoseSpace, VectorSpace

rng = np.random.default_rng(0)
POINTS = rng.random((25, 2))
VALUES = rng.normal(size=(25, 6))


@pytest.mark.parametrize(
    "estimator",
    [
        RegressorBackProjector(),
        RegressorBackProjector(GradientBoostingRegressor(random_state=0)),
    ],
    ids=["nearest neighbours", "one output at a time"],
)
@pytest.mark.filterwarnings("ignore")  # scikit-learn's checks use degenerate data on purpose
def test_regressors_follow_scikit_learns_conventions(estimator):
    """The estimator passes scikit-learn's own checks."""
    check_estimator(estimator)


def test_single_output_regressors_are_fitted_for_each_feature():
    """Gradient boosting, which predicts one number, rebuilds vectors of six."""
    model = RegressorBackProjector(GradientBoostingRegressor(random_state=0))
    found = model.fit(POINTS, VALUES).predict(POINTS)
    assert found.shape == VALUES.shape
    assert np.abs(found - VALUES).mean() < 0.2


def test_usual_back_projectors(waving):
    """Poses get spatial keyframes, vectors RBF; regressors are adapted where they need it."""
    table = VectorSpace(VALUES)
    assert isinstance(back_projector_for(PoseSpace(waving), None), SpatialKeyframes)
    assert isinstance(back_projector_for(PoseSpace(waving), "rbf"), PoseBackProjector)
    assert isinstance(back_projector_for(table, None), RBF)
    assert isinstance(back_projector_for(table, LinearRegression()), LinearRegression)
    single = back_projector_for(table, GradientBoostingRegressor())
    assert isinstance(single, RegressorBackProjector)


@pytest.mark.parametrize("name", ["rbf", "ilamp", "knn", "inverse"])
def test_names_serve_both_kinds_of_space(name, waving):
    """Every method for vectors is registered, and is made to rebuild poses of a motion."""
    assert name in back_projectors
    assert not isinstance(back_projector_for(VectorSpace(VALUES), name), PoseBackProjector)
    assert isinstance(back_projector_for(PoseSpace(waving), name), PoseBackProjector)
