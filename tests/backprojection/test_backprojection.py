"""Tests of workbench.backprojection."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.interpolate import RBFInterpolator
from scipy.spatial.transform import Rotation
from sklearn.ensemble import GradientBoostingRegressor
from sklearn.linear_model import LinearRegression
from sklearn.neighbors import KNeighborsRegressor
from sklearn.utils.estimator_checks import check_estimator

from workbench.backprojection import back_projector_for
from workbench.backprojection.poses import PoseBackProjector, SpatialKeyframes
from workbench.backprojection.rbf import RBF
from workbench.backprojection.regressor import RegressorBackProjector
from workbench.errors import DegenerateDataWarning, WorkbenchError
from workbench.spaces import PoseSpace, VectorSpace

rng = np.random.default_rng(0)
POINTS = rng.random((25, 2))
VALUES = rng.normal(size=(25, 6))
POSES = Rotation.random(25 * 3, random_state=0).as_matrix().reshape(25, 3, 3, 3)


@pytest.mark.parametrize(
    "estimator",
    [
        RBF(),
        RegressorBackProjector(),
        RegressorBackProjector(GradientBoostingRegressor(random_state=0)),
    ],
    ids=["rbf", "nearest neighbours", "one output at a time"],
)
@pytest.mark.filterwarnings("ignore")  # scikit-learn's checks use degenerate data on purpose
def test_back_projectors_follow_scikit_learns_conventions(estimator):
    """The estimator passes scikit-learn's own checks."""
    check_estimator(estimator)


@pytest.mark.parametrize("dimensions", [2, 3])
def test_rbf_agrees_with_scipy(dimensions):
    """Between and outside the control points values equal those of scipy's interpolant."""
    points = rng.random((40, dimensions))
    values = rng.normal(size=(40, 5))
    elsewhere = rng.random((200, dimensions)) * 3 - 1
    expected = RBFInterpolator(points, values, kernel="linear", degree=1)(elsewhere)
    assert np.allclose(RBF().fit(points, values).predict(elsewhere), expected, atol=1e-10)


@given(
    arrays(np.float64, (12, 2), elements=st.floats(-1e3, 1e3, width=32), unique=True),
    st.floats(1e-6, 1e6),
)
@settings(deadline=None)
def test_rbf_passes_through_its_control_points(points, size):
    """Samples at control points come back, wherever these lie and whatever their scale."""
    points = np.round(points, 1) * size
    assume(len(np.unique(points, axis=0)) == len(points))
    found = RBF().fit(points, VALUES[:12]).predict(points)
    assert np.abs(found - VALUES[:12]).max() < 1e-9


def test_rbf_continues_a_plane_exactly():
    """Samples that depend linearly on the position are rebuilt everywhere."""
    coefficients = rng.normal(size=(2, 7))
    elsewhere = rng.normal(size=(50, 2)) * 10
    found = RBF().fit(POINTS, POINTS @ coefficients + 3.0).predict(elsewhere)
    assert np.allclose(found, elsewhere @ coefficients + 3.0, atol=1e-9)


def test_markers_rebuild_their_poses():
    """Spatial keyframes give back the key poses to 1e-9 in the matrix entries."""
    found = SpatialKeyframes().fit(POINTS, POSES).predict(POINTS)
    assert np.abs(found - POSES).max() < 1e-9


def test_spatial_keyframes_give_rotations_everywhere():
    """Even far outside the markers every matrix is a proper rotation."""
    far = rng.normal(size=(300, 2)) * 20
    found = SpatialKeyframes().fit(POINTS, POSES).predict(far)
    assert np.abs(found @ np.swapaxes(found, -1, -2) - np.eye(3)).max() < 1e-12
    assert np.linalg.det(found).min() > 0


@pytest.mark.parametrize(
    "points",
    [
        np.stack([POINTS[:, 0], 2 * POINTS[:, 0] + 1], axis=1),
        np.stack([POINTS[:, 0], np.full(25, 0.3)], axis=1),
    ],
    ids=["oblique line", "horizontal line"],
)
def test_collinear_markers_rebuild_their_poses(points):
    """Markers on a line leave the polynomial undetermined, which harms nothing."""
    found = SpatialKeyframes().fit(points, POSES).predict(points)
    assert np.abs(found - POSES).max() < 1e-9
    beside = SpatialKeyframes().fit(points, POSES).predict(points + np.array([0.0, 0.5]))
    assert np.isfinite(beside).all()


def test_coinciding_control_points_give_their_mean_with_a_warning():
    """Different samples at one place become their mean; all other samples stay exact."""
    points = POINTS.copy()
    points[7] = points[3]
    with pytest.warns(DegenerateDataWarning, match="1 control points coincide"):
        model = RBF().fit(points, VALUES)
    expected = VALUES.copy()
    expected[[3, 7]] = VALUES[[3, 7]].mean(axis=0)
    assert np.abs(model.predict(points) - expected).max() < 1e-9


def test_coinciding_control_points_of_equal_samples_are_fine():
    """A repeated control point that says the same twice needs no warning."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        model = RBF().fit(np.vstack([POINTS, POINTS[:1]]), np.vstack([VALUES, VALUES[:1]]))
    assert np.abs(model.predict(POINTS) - VALUES).max() < 1e-9


@pytest.mark.parametrize("n", [1, 2, 3])
def test_few_control_points_suffice(n):
    """One, two and three control points are reproduced."""
    model = RBF().fit(POINTS[:n], VALUES[:n])
    assert np.abs(model.predict(POINTS[:n]) - VALUES[:n]).max() < 1e-12


def test_all_control_points_in_one_place_give_the_mean():
    """Nothing but the mean can be learnt from a single place."""
    with pytest.warns(DegenerateDataWarning):
        model = RBF().fit(np.ones((5, 2)), VALUES[:5])
    assert np.allclose(model.predict(POINTS), VALUES[:5].mean(axis=0))


def test_equal_samples_stay_equal_everywhere():
    """Control points that differ by rounding noise do not blow it up."""
    model = RBF().fit([[0, 0], [0, 1e-13], [1e-17, 0]], [[3.0, 4.0]] * 3)
    assert np.array_equal(model.predict([[1.0, 1.0], [-50.0, 7.0]]), [[3.0, 4.0]] * 2)


def test_nearly_coinciding_control_points_are_rebuilt():
    """Two control points 1e-9 apart with different samples come back to 1e-5."""
    points = POINTS.copy()
    points[7] = points[3] + 1e-9
    model = RBF().fit(points, VALUES)
    assert np.abs(model.predict(points) - VALUES).max() < 1e-5


def test_single_output_regressors_are_fitted_for_each_feature():
    """Gradient boosting, which predicts one number, rebuilds vectors of six."""
    model = RegressorBackProjector(GradientBoostingRegressor(random_state=0))
    found = model.fit(POINTS, VALUES).predict(POINTS)
    assert found.shape == VALUES.shape
    assert np.abs(found - VALUES).mean() < 0.2


def test_any_regressor_rebuilds_poses(waving):
    """The nearest marker's pose is what one nearest neighbour rebuilds."""
    model = back_projector_for(PoseSpace(waving), KNeighborsRegressor(n_neighbors=1))
    markers, keys = POINTS[:4], waving.rotations[[0, 20, 40, 59]]
    found = model.fit(markers, keys).predict(markers + 1e-4)
    assert np.abs(found - keys).max() < 1e-12


def test_usual_back_projectors(waving):
    """Poses get spatial keyframes, vectors RBF; regressors are adapted where they need it."""
    table = VectorSpace(VALUES)
    assert isinstance(back_projector_for(PoseSpace(waving), None), SpatialKeyframes)
    assert isinstance(back_projector_for(PoseSpace(waving), "rbf"), PoseBackProjector)
    assert isinstance(back_projector_for(table, None), RBF)
    assert isinstance(back_projector_for(table, LinearRegression()), LinearRegression)
    single = back_projector_for(table, GradientBoostingRegressor())
    assert isinstance(single, RegressorBackProjector)


def test_pose_methods_are_refused_for_tables():
    """Spatial keyframes cannot rebuild rows of a table."""
    with pytest.raises(WorkbenchError, match="which rebuilds poses"):
        back_projector_for(VectorSpace(VALUES), "spatial-keyframes")


def test_poses_of_another_shape_are_refused():
    """The message gives both shapes."""
    with pytest.raises(WorkbenchError, match=r"got shape \(25, 6\), want \(25, n_joints, 3, 3\)"):
        SpatialKeyframes().fit(POINTS, VALUES)
