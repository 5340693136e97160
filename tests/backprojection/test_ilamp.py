"""Tests of workbench.backprojection.ilamp."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sklearn.exceptions import NotFittedError
from sklearn.utils.estimator_checks import check_estimator

from workbench.backprojection.ilamp import ILAMP
from workbench.errors import AdjustmentWarning, DegenerateDataWarning, WorkbenchError

rng = np.random.default_rng(0)
POINTS = rng.random((25, 2))
VALUES = rng.normal(size=(25, 6))
X = rng.random((50, 2)) * 1.5


def plain_ilamp(points, values, x, k, *, similarity):
    """Rebuild one point at a time, as the published formulas stand."""
    result = []
    for p in x:
        nearest = np.argsort(np.linalg.norm(points - p, axis=1))[:k]
        y, samples = points[nearest], values[nearest]
        weights = 1.0 / ((y - p) ** 2).sum(axis=1)
        y_mean, sample_mean = np.average(y, 0, weights), np.average(samples, 0, weights)
        a = np.sqrt(weights)[:, None] * (y - y_mean)
        b = np.sqrt(weights)[:, None] * (samples - sample_mean)
        u, d, v = np.linalg.svd(a.T @ b, full_matrices=False)
        factor = d.sum() / (a**2).sum() if similarity else 1.0
        result.append(factor * (p - y_mean) @ (u @ v) + sample_mean)
    return np.array(result)


@pytest.mark.filterwarnings("ignore")  # scikit-learn's checks use few and degenerate data
def test_ilamp_follows_scikit_learns_conventions():
    """The estimator passes scikit-learn's own checks."""
    check_estimator(ILAMP())


@pytest.mark.parametrize("scaling", ["similarity", "isometry"])
@pytest.mark.parametrize("dimensions", [2, 3], ids=["2-D", "3-D"])
@pytest.mark.parametrize("k", [3, 5, 8, 25])
def test_ilamp_agrees_with_the_formulas(k, dimensions, scaling):
    """Compiled and plain versions agree to 1e-9, with as few neighbours as dimensions too."""
    points, x = rng.random((25, dimensions)), rng.random((50, dimensions))
    found = ILAMP(k, scaling=scaling).fit(points, VALUES).predict(x)
    expected = plain_ilamp(points, VALUES, x, k, similarity=scaling == "similarity")
    # Three neighbours in space lie in a plane: the direction across it is left out here
    # and is any in the plain version.
    if k > dimensions:
        assert np.abs(found - expected).max() < 1e-9 * np.abs(expected).max()
    assert np.isfinite(found).all()


@pytest.mark.parametrize("scaling", ["similarity", "isometry"])
@pytest.mark.parametrize("dimensions", [2, 3], ids=["2-D", "3-D"])
def test_an_isometric_plane_is_recovered(dimensions, scaling):
    """Points of a plane in 10-D come back to 1e-9 from where they lie in the plane."""
    axes = np.linalg.qr(rng.normal(size=(10, dimensions)))[0].T
    plane = rng.random((500, dimensions))
    samples = plane @ axes + rng.normal(size=10)
    found = ILAMP(scaling=scaling).fit(plane[:40], samples[:40]).predict(plane)
    assert np.abs(found - samples).max() < 1e-9


def test_a_plane_of_another_size_is_recovered_by_similarity():
    """In the unit square, a plane of 1000 units comes back all the same."""
    axes = np.linalg.qr(rng.normal(size=(10, 2)))[0].T
    plane = rng.random((200, 2))
    samples = 1000.0 * plane @ axes
    assert np.abs(ILAMP().fit(plane[:40], samples[:40]).predict(plane) - samples).max() < 1e-6
    kept = ILAMP(scaling="isometry").fit(plane[:40], samples[:40]).predict(plane)
    assert np.abs(kept - samples).max() > 1.0


@given(st.floats(0, 2 * np.pi), st.floats(1e-3, 1e3), st.floats(-10, 10), st.booleans())
@settings(deadline=None)
def test_ilamp_does_not_care_how_the_plane_lies(angle, size, shift, mirrored):
    """Turning, mirroring, moving and scaling the plane changes no rebuilt sample."""
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]) * size
    if mirrored:
        turn = turn[::-1]
    expected = ILAMP().fit(POINTS, VALUES).predict(X)
    found = ILAMP().fit(POINTS @ turn + shift * size, VALUES).predict(X @ turn + shift * size)
    assert np.abs(found - expected).max() < 1e-8


@pytest.mark.parametrize("scale", [1e-150, 1e-3, 1e150])
def test_control_points_are_rebuilt(scale):
    """Each gives its own sample, and very near to it nearly that."""
    points = POINTS * scale
    model = ILAMP().fit(points, VALUES)
    assert np.array_equal(model.predict(points), VALUES)
    assert np.abs(model.predict(points * (1 + 1e-9)) - VALUES).max() < 1e-6


def test_equal_samples_stay_equal_everywhere():
    """No rounding of weighted means shows."""
    model = ILAMP().fit(POINTS, np.full((25, 3), 4.1))
    assert np.array_equal(model.predict(X * 50), np.full((50, 3), 4.1))


def test_neighbors_on_a_line_leave_the_direction_across_out():
    """Beside the line the sample is that of the foot of the perpendicular."""
    line = np.stack([np.linspace(0, 1, 9), np.zeros(9)], axis=1)
    samples = np.outer(line[:, 0], [3.0, 4.0, 0.0])
    model = ILAMP(n_neighbors=5).fit(line, samples)
    found = model.predict([[0.33, 0.2], [0.61, -3.0]])
    assert np.allclose(found, [[0.99, 1.32, 0.0], [1.83, 2.44, 0.0]])


def test_coinciding_control_points_give_their_mean_with_a_warning():
    """Different samples at one place become their mean."""
    points = POINTS.copy()
    points[7] = points[3]
    with pytest.warns(DegenerateDataWarning, match="1 control points coincide"):
        model = ILAMP().fit(points, VALUES)
    assert np.allclose(model.predict(points[7:8]), VALUES[[3, 7]].mean(axis=0))
    assert np.isfinite(model.predict(X)).all()


@pytest.mark.parametrize("n", [1, 2, 3])
def test_few_control_points_suffice(n):
    """One, two and three control points are reproduced, and the lowered k is said."""
    with pytest.warns(AdjustmentWarning, match=f"n_neighbors=8 lowered to {n}"):
        model = ILAMP().fit(POINTS[:n], VALUES[:n])
    assert np.array_equal(model.predict(POINTS[:n]), VALUES[:n])
    assert np.isfinite(model.predict(X)).all()


def test_all_control_points_in_one_place_give_the_mean():
    """Nothing but the mean can be learnt from a single place."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        model = ILAMP().fit(np.ones((9, 2)), VALUES[:9])
    assert np.allclose(model.predict(POINTS), VALUES[:9].mean(axis=0))


def test_blocks_change_nothing():
    """Many points are rebuilt as each alone."""
    many = rng.random((20000, 2))
    model = ILAMP().fit(POINTS, VALUES)
    assert np.array_equal(
        model.predict(many)[[0, 8191, 8192, 19999]], model.predict(many[[0, 8191, 8192, 19999]])
    )


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"n_neighbors": 0}, "n_neighbors: got 0, want an integer of at least 1"),
        ({"n_neighbors": 2.5}, "n_neighbors: got 2.5"),
        ({"scaling": "none"}, "scaling: got 'none', want 'similarity' or 'isometry'"),
    ],
    ids=["no neighbours", "a fraction", "scaling"],
)
def test_wrong_parameters_are_refused(parameters, message):
    """The message names the parameter, its value and what is allowed."""
    with pytest.raises(WorkbenchError, match=message):
        ILAMP(**parameters).fit(POINTS, VALUES)


def test_wrong_input_is_refused():
    """Nan, other shapes and predicting before fitting are refused."""
    with pytest.raises(NotFittedError, match="not fitted"):
        ILAMP().predict(POINTS)
    with pytest.raises(ValueError, match="NaN"):
        ILAMP().fit(np.where(POINTS > 0.9, np.nan, POINTS), VALUES)
    with pytest.raises(ValueError, match="inconsistent"):
        ILAMP().fit(POINTS[:20], VALUES)
    model = ILAMP().fit(POINTS, VALUES)
    with pytest.raises(ValueError, match="NaN"):
        model.predict([[0.0, np.nan]])
    with pytest.raises(ValueError, match="3 features"):
        model.predict(np.zeros((4, 3)))
