"""Tests of workbench.backprojection.poses."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.spatial.transform import Rotation
from sklearn.base import BaseEstimator, clone
from sklearn.exceptions import NotFittedError
from sklearn.neighbors import KNeighborsRegressor

from workbench.backprojection import back_projector_for
from workbench.backprojection.ilamp import ILAMP
from workbench.backprojection.inverse import ProjectorInverse
from workbench.backprojection.knn import KNN
from workbench.backprojection.poses import PoseBackProjector, SpatialKeyframes
from workbench.backprojection.radial import KERNELS
from workbench.backprojection.rbf import RBF
from workbench.errors import WorkbenchError
from workbench.mocap.rotations import axis_rotation
from workbench.spaces import PoseSpace, VectorSpace

rng = np.random.default_rng(0)
POINTS = rng.random((25, 2))
VALUES = rng.normal(size=(25, 6))
POSES = Rotation.random(25 * 3, random_state=0).as_matrix().reshape(25, 3, 3, 3)
ROOTS = rng.normal(size=(25, 3)) * 40


def smooth_poses(points, n_joints=4):
    """Give poses that turn gently with the position: (n_points, n_joints, 3, 3)."""
    generator = np.random.default_rng(5)
    base = Rotation.random(n_joints, random_state=1).as_matrix()
    vectors = np.asarray(points) @ generator.normal(size=(np.shape(points)[1], 3 * n_joints))
    turns = Rotation.from_rotvec(vectors.reshape(-1, 3) * 0.5).as_matrix()
    return turns.reshape(len(points), n_joints, 3, 3) @ base


@pytest.mark.parametrize("kernel", KERNELS)
def test_markers_rebuild_their_poses(kernel):
    """Spatial keyframes give back the key poses to 1e-9 in the matrix entries."""
    found = SpatialKeyframes(kernel).fit(POINTS, POSES).predict(POINTS)
    assert np.abs(found - POSES).max() < 1e-9


def test_spatial_keyframes_give_rotations_everywhere():
    """Even far outside the markers every matrix is a proper rotation."""
    far = rng.normal(size=(300, 2)) * 20
    found = SpatialKeyframes().fit(POINTS, POSES).predict(far)
    assert np.abs(found @ np.swapaxes(found, -1, -2) - np.eye(3)).max() < 1e-12
    assert np.linalg.det(found).min() > 0


def test_spatial_keyframes_are_rbf_and_nearest_rotation():
    """The poses are those of scipy's SVD of what RBF makes of the matrix entries."""
    x = rng.random((40, 2)) * 2
    entries = RBF().fit(POINTS, POSES.reshape(25, -1)).predict(x).reshape(40, 3, 3, 3)
    u, _, v = np.linalg.svd(entries)
    u[..., 2] *= np.linalg.det(u @ v)[..., None]
    assert np.allclose(SpatialKeyframes().fit(POINTS, POSES).predict(x), u @ v, atol=1e-9)


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
    model = SpatialKeyframes().fit(points, POSES)
    assert np.abs(model.predict(points) - POSES).max() < 1e-9
    beside = model.predict_with_jacobian(points + np.array([0.0, 0.5]))
    assert all(np.isfinite(part).all() for part in beside)


def test_parameters_reach_the_radial_basis_functions():
    """Spatial keyframes with parameters are clones of themselves and use them."""
    model = clone(SpatialKeyframes("gaussian", epsilon=3.0, smoothing=0.1, centers=9))
    model.set_params(centers=8)
    x = rng.random((10, 2))
    inner = RBF("gaussian", epsilon=3.0, smoothing=0.1, centers=8)
    expected = PoseBackProjector(inner).fit(POINTS, POSES).predict(x)
    assert np.array_equal(model.fit(POINTS, POSES).predict(x), expected)


def test_root_translations_are_interpolated_alike():
    """Markers give back their root; between them it is what RBF makes of the translations."""
    x = rng.random((10, 2))
    model = SpatialKeyframes("cubic").fit(POINTS, POSES, ROOTS)
    assert np.abs(model.predict_root(POINTS) - ROOTS).max() < 1e-9 * np.abs(ROOTS).max()
    assert np.array_equal(model.predict_root(x), RBF("cubic").fit(POINTS, ROOTS).predict(x))
    without = SpatialKeyframes("cubic").fit(POINTS, POSES)
    assert np.array_equal(model.predict(x), without.predict(x))
    with pytest.raises(WorkbenchError, match="none were learnt"):
        without.predict_root(x)


@pytest.mark.parametrize(
    ("roots", "message"),
    [
        (ROOTS[:, :2], r"root_translations: got shape \(25, 2\), want \(25, 3\)"),
        (ROOTS[:9], r"root_translations: got shape \(9, 3\), want \(25, 3\)"),
        (np.full((25, 3), np.nan), "root_translations: got nan"),
    ],
    ids=["two columns", "too few", "nan"],
)
def test_wrong_root_translations_are_refused(roots, message):
    """The message gives what was wrong about them."""
    with pytest.raises(WorkbenchError, match=message):
        SpatialKeyframes().fit(POINTS, POSES, roots)


@given(
    arrays(np.float64, (7, 3), elements=st.floats(-1, 2, width=32)),
    st.sampled_from(list(KERNELS)),
    st.sampled_from([2, 3]),
)
@settings(deadline=None)
def test_the_jacobian_agrees_with_central_differences(x, kernel, dimensions):
    """Away from markers it is right to 1e-5 of its largest entry."""
    markers = np.random.default_rng(2).random((15, dimensions))
    x = x[:, :dimensions]
    assume(np.linalg.norm(x[:, None] - markers, axis=2).min() > 1e-2)
    model = SpatialKeyframes(kernel, epsilon=2.0).fit(markers, smooth_poses(markers))
    rotations, jacobian = model.predict_with_jacobian(x)
    assert jacobian.shape == (7, 4, 3, 3, dimensions)
    assert np.allclose(rotations, model.predict(x), atol=1e-14)
    assert np.array_equal(jacobian, model.jacobian(x))
    steps = 1e-6 * np.eye(dimensions)
    expected = [(model.predict(x + s) - model.predict(x - s)) / 2e-6 for s in steps]
    scale = max(1.0, np.abs(jacobian).max())
    assert np.abs(jacobian - np.stack(expected, axis=-1)).max() < 1e-5 * scale


def test_the_jacobian_of_a_turn_is_known():
    """Half-way between poses turned by 0 and 90 degrees the pose turns about the same axis."""
    points = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    poses = axis_rotation("Z", [0.0, 90.0, 0.0])[:, None]
    rotations, jacobian = SpatialKeyframes().fit(points, poses).predict_with_jacobian([[0.5, 0.0]])
    spin = rotations[0, 0].T @ jacobian[0, 0, :, :, 0]
    # The entries are (1 − t, t): the angle is atan(t / (1 − t)), which changes by 2 at 1/2.
    assert np.allclose(spin, [[0, -2, 0], [2, 0, 0], [0, 0, 0]], atol=1e-12)


class Turning(BaseEstimator):
    """A user's own method with a Jacobian, which keeps what it returns."""

    def fit(self, X, y):
        self.values_, self.jacobian_ = np.array(y), np.ones((*np.shape(y), 2))
        return self

    def predict(self, X):
        return self.values_

    def predict_with_jacobian(self, X):
        return self.values_, self.jacobian_


def test_what_a_users_method_keeps_is_not_overwritten():
    """Nearest rotations are taken of a copy, for values and derivatives."""
    model = PoseBackProjector(Turning()).fit(POINTS, 2.0 * POSES)
    rotations, jacobian = model.predict_with_jacobian(POINTS)
    assert np.allclose(rotations, POSES)
    assert np.allclose(model.predict(POINTS), POSES)
    assert np.isfinite(jacobian).all()
    assert np.array_equal(model.regressor_.values_, 2.0 * POSES.reshape(25, -1))
    assert (model.regressor_.jacobian_ == 1.0).all()


@pytest.mark.parametrize(
    ("regressor", "jacobian", "projection"),
    [(RBF(), True, False), (KNN(), False, False), (ProjectorInverse(), False, True)],
    ids=["rbf", "knn", "inverse"],
)
def test_what_the_method_lacks_the_adaptor_lacks(regressor, jacobian, projection):
    """Optimizers and schemes ask by hasattr, which tells the truth before and after fit."""
    model = PoseBackProjector(regressor)
    assert hasattr(model, "jacobian") == jacobian
    assert hasattr(model, "predict_with_jacobian") == jacobian
    assert hasattr(model, "use_projection") == projection
    if not projection:
        assert hasattr(model.fit(POINTS, POSES), "jacobian") == jacobian


@pytest.mark.parametrize(
    "method", [ILAMP(), KNN(weights="distance")], ids=lambda method: type(method).__name__
)
def test_methods_for_vectors_rebuild_poses(method):
    """Through the adaptor they give back the markers' poses, and rotations everywhere."""
    model = PoseBackProjector(method).fit(POINTS, POSES)
    assert np.abs(model.predict(POINTS) - POSES).max() < 1e-9
    found = model.predict(rng.random((100, 2)))
    assert np.abs(found @ np.swapaxes(found, -1, -2) - np.eye(3)).max() < 1e-12
    assert np.linalg.det(found).min() > 0


def test_any_regressor_rebuilds_poses(waving):
    """The nearest marker's pose is what one nearest neighbour rebuilds."""
    model = back_projector_for(PoseSpace(waving), KNeighborsRegressor(n_neighbors=1))
    markers, keys = POINTS[:4], waving.rotations[[0, 20, 40, 59]]
    found = model.fit(markers, keys).predict(markers + 1e-4)
    assert np.abs(found - keys).max() < 1e-12


def test_pose_methods_are_refused_for_tables():
    """Spatial keyframes cannot rebuild rows of a table."""
    with pytest.raises(WorkbenchError, match="which rebuilds poses"):
        back_projector_for(VectorSpace(VALUES), "spatial-keyframes")


@pytest.mark.parametrize(
    ("poses", "message"),
    [
        (VALUES, r"got shape \(25, 6\), want \(25, n_joints, 3, 3\)"),
        (POSES[:9], r"got shape \(9, 3, 3, 3\), want \(25, n_joints, 3, 3\)"),
        (np.full((25, 3, 3, 3), np.nan), "rotations: got nan"),
    ],
    ids=["vectors", "too few", "nan"],
)
def test_wrong_poses_are_refused(poses, message):
    """The message gives both shapes, or where the first bad number is."""
    with pytest.raises(WorkbenchError, match=message):
        SpatialKeyframes().fit(POINTS, poses)


@pytest.mark.parametrize("method", ["predict", "jacobian", "predict_with_jacobian", "predict_root"])
def test_wrong_positions_are_refused(method):
    """Every way to evaluate refuses nan, other dimensions, and to go before fit."""
    with pytest.raises(NotFittedError, match="not fitted"):
        getattr(SpatialKeyframes(), method)(POINTS)
    call = getattr(SpatialKeyframes().fit(POINTS, POSES, ROOTS), method)
    with pytest.raises(ValueError, match="NaN"):
        call([[0.0, np.nan]])
    with pytest.raises(ValueError, match="3 features"):
        call(np.zeros((4, 3)))


def test_numbers_that_are_no_poses_are_refused():
    """A method that rebuilds another number of entries is named."""

    class Short(BaseEstimator):
        def fit(self, X, y):
            self.fitted_ = True
            return self

        def predict(self, X):
            return np.zeros((len(X), 5))

    with pytest.raises(WorkbenchError, match=r"Short: rebuilt numbers of shape \(25, 5\)"):
        PoseBackProjector(Short()).fit(POINTS, POSES).predict(POINTS)
