"""Tests of workbench.mocap.nearest_rotation_derivative."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.linalg import solve_sylvester
from scipy.spatial.transform import Rotation

from workbench.errors import WorkbenchError
from workbench.mocap.nearest_rotation import nearest_rotations
from workbench.mocap.nearest_rotation_derivative import nearest_rotations_with_derivatives

rng = np.random.default_rng(0)


@given(
    arrays(np.float64, (3, 3), elements=st.floats(-2, 2, width=32)),
    arrays(np.float64, (3, 3), elements=st.floats(-2, 2, width=32)),
)
@settings(deadline=None)
def test_it_agrees_with_central_differences(matrix, change):
    """Wherever the nearest rotation is well determined, reflections included, to 1e-6."""
    u, s, v = np.linalg.svd(matrix)
    smallest = s[2] * np.sign(np.linalg.det(u @ v))
    assume(s[1] + smallest > 0.1)
    h = 1e-6
    _, found = nearest_rotations_with_derivatives([[matrix]], [[[change]]])
    ends = nearest_rotations(np.stack([matrix + h * change, matrix - h * change]))
    expected = (ends[0] - ends[1]) / (2 * h)
    assert np.abs(found[0, 0, 0] - expected).max() < 1e-6 * max(1.0, np.abs(expected).max())


def test_it_solves_the_sylvester_equation():
    """It is R Ω with Ω S + S Ω = Rᵀ dM − dMᵀ R, as scipy solves it."""
    matrices = rng.normal(size=(20, 3, 3, 3))
    changes = rng.normal(size=(20, 2, 3, 3, 3))
    rotations, found = nearest_rotations_with_derivatives(matrices, changes)
    assert np.allclose(rotations, nearest_rotations(matrices), atol=1e-14)
    for row, direction, joint in np.ndindex(20, 2, 3):
        r, m = rotations[row, joint], matrices[row, joint]
        a = r.T @ changes[row, direction, joint]
        omega = solve_sylvester(r.T @ m, r.T @ m, a - a.T)
        scale = max(1.0, np.abs(omega).max())
        assert np.abs(found[row, direction, joint] - r @ omega).max() < 1e-9 * scale


def test_turning_a_rotation_turns_the_nearest():
    """A derivative along the rotations is its own projection; a symmetric one changes nothing."""
    r = Rotation.random(50, random_state=0).as_matrix()[:, None]
    skew = rng.normal(size=(50, 1, 3, 3))
    skew = skew - np.swapaxes(skew, -1, -2)
    symmetric = rng.normal(size=(50, 1, 3, 3))
    symmetric = symmetric + np.swapaxes(symmetric, -1, -2)
    changes = np.stack([r @ skew, r @ symmetric], axis=1)
    _, found = nearest_rotations_with_derivatives(r, changes)
    assert np.allclose(found[:, 0], r @ skew, atol=1e-12)
    assert np.allclose(found[:, 1], 0, atol=1e-12)


@pytest.mark.parametrize(
    "matrix",
    [np.zeros((3, 3)), np.outer([1.0, 2, 3], [4.0, 5, 6]), -np.eye(3), np.diag([1.0, 1, -1])],
    ids=["zero", "rank one", "inversion", "mirror"],
)
def test_without_a_unique_nearest_rotation_it_is_finite(matrix):
    """Where there is no derivative the answer is 0, not nan."""
    _, found = nearest_rotations_with_derivatives([[matrix]], rng.normal(size=(1, 2, 1, 3, 3)))
    assert np.array_equal(found, np.zeros((1, 2, 1, 3, 3)))


def test_the_input_is_kept_unless_it_may_be_overwritten():
    """By default results are new arrays; with overwrite they take the input's place."""
    matrices, changes = rng.normal(size=(4, 2, 3, 3)), rng.normal(size=(4, 3, 2, 3, 3))
    before = matrices.copy(), changes.copy()
    kept = nearest_rotations_with_derivatives(matrices, changes)
    assert np.array_equal(matrices, before[0])
    assert np.array_equal(changes, before[1])
    taken = nearest_rotations_with_derivatives(matrices, changes, overwrite=True)
    assert taken[0] is matrices
    assert taken[1] is changes
    assert np.array_equal(taken[0], kept[0])
    assert np.array_equal(taken[1], kept[1])


def test_nearest_rotations_can_take_the_place_of_the_input():
    """The result of overwriting is the same as that of a copy."""
    matrices = rng.normal(size=(4, 2, 3, 3))
    expected = nearest_rotations(matrices)
    assert nearest_rotations(matrices, overwrite=True) is matrices
    assert np.array_equal(matrices, expected)


@pytest.mark.parametrize(
    ("matrices", "changes", "message"),
    [
        (np.zeros((4, 3, 3)), np.zeros((4, 2, 1, 3, 3)), "matrices and derivatives: got shapes"),
        (np.zeros((4, 1, 3, 3)), np.zeros((4, 2, 3, 3)), "matrices and derivatives: got shapes"),
        (np.zeros((4, 1, 3, 3)), np.zeros((4, 2, 5, 3, 3)), "matrices and derivatives"),
        (np.zeros((4, 1, 3, 2)), np.zeros((4, 2, 1, 3, 3)), "matrices: got shape"),
        (np.full((4, 1, 3, 3), np.nan), np.zeros((4, 2, 1, 3, 3)), "not finite"),
    ],
    ids=["no joints", "no directions", "other joints", "no matrices", "nan"],
)
def test_wrong_input_is_refused(matrices, changes, message):
    """A compiled loop never reads beyond the end of an array."""
    with pytest.raises(WorkbenchError, match=message):
        nearest_rotations_with_derivatives(matrices, changes)
