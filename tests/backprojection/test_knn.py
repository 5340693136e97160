"""Tests of workbench.backprojection.knn."""

from __future__ import annotations

import numpy as np
import pytest
from sklearn.exceptions import NotFittedError
from sklearn.utils.estimator_checks import check_estimator

from workbench.backprojection.knn import KNN
from workbench.errors import AdjustmentWarning, WorkbenchError

rng = np.random.default_rng(0)
POINTS = rng.random((25, 2))
VALUES = rng.normal(size=(25, 6))
X = rng.random((10000, 2)) * 1.5


@pytest.mark.filterwarnings("ignore")  # scikit-learn's checks use few and degenerate data
def test_knn_follows_scikit_learns_conventions():
    """The estimator passes scikit-learn's own checks."""
    check_estimator(KNN())


@pytest.mark.parametrize("weights", ["uniform", "distance"])
@pytest.mark.parametrize("k", [1, 4, 25])
def test_knn_is_the_mean_of_the_nearest(k, weights):
    """Values are the plain or inverse-distance mean of the nearest samples, in all blocks."""
    found = KNN(k, weights=weights).fit(POINTS, VALUES).predict(X)
    for i in (0, 4095, 4096, 9999):
        distances = np.linalg.norm(POINTS - X[i], axis=1)
        nearest = np.argsort(distances)[:k]
        shares = None if weights == "uniform" else 1 / distances[nearest]
        assert np.allclose(found[i], np.average(VALUES[nearest], axis=0, weights=shares))


def test_distance_weights_rebuild_the_control_points():
    """A control point's own sample outweighs all others there."""
    assert np.array_equal(KNN(weights="distance").fit(POINTS, VALUES).predict(POINTS), VALUES)


@pytest.mark.parametrize("weights", ["uniform", "distance"])
def test_equal_samples_stay_equal_everywhere(weights):
    """A mean of equal samples is that sample."""
    model = KNN(weights=weights).fit(POINTS, np.full((25, 3), 4.1))
    assert np.allclose(model.predict(X), 4.1, rtol=1e-14)


def test_fewer_control_points_than_neighbors_are_all_taken():
    """The lowered k is said, and the mean is that of all."""
    with pytest.warns(AdjustmentWarning, match=r"n_neighbors=5 lowered to 3 \(3 control points\)"):
        model = KNN().fit(POINTS[:3], VALUES[:3])
    assert np.allclose(model.predict(X[:4]), VALUES[:3].mean(axis=0))


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"n_neighbors": 0}, "n_neighbors: got 0, want an integer of at least 1"),
        ({"weights": "cubic"}, "weights: got 'cubic', want 'uniform' or 'distance'"),
    ],
    ids=["no neighbours", "weights"],
)
def test_wrong_parameters_are_refused(parameters, message):
    """The message names the parameter, its value and what is allowed."""
    with pytest.raises(WorkbenchError, match=message):
        KNN(**parameters).fit(POINTS, VALUES)


def test_wrong_input_is_refused():
    """Nan, other shapes and predicting before fitting are refused."""
    with pytest.raises(NotFittedError, match="not fitted"):
        KNN().predict(POINTS)
    with pytest.raises(ValueError, match="NaN"):
        KNN().fit(np.where(POINTS > 0.9, np.nan, POINTS), VALUES)
    model = KNN().fit(POINTS, VALUES)
    with pytest.raises(ValueError, match="NaN"):
        model.predict([[0.0, np.nan]])
    with pytest.raises(ValueError, match="3 features"):
        model.predict(np.zeros((4, 3)))
