"""Tests of spherical linear interpolation."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation, Slerp

from workbench.errors import WorkbenchError
from workbench.mocap.rotations import axis_rotation, geodesic_angles
from workbench.mocap.slerp import slerp


def _random(seed, count):
    return Rotation.random(count, rng=np.random.default_rng(seed)).as_matrix()


def test_agrees_with_scipy():
    """Random pairs are interpolated as scipy interpolates them."""
    a, b = _random(1, 200), _random(2, 200)
    t = np.random.default_rng(3).random(200)
    expected = [
        Slerp([0, 1], Rotation.from_matrix(np.stack(pair)))(fraction).as_matrix()
        for *pair, fraction in zip(a, b, t, strict=True)
    ]
    np.testing.assert_allclose(slerp(a, b, t), expected, atol=1e-12)


def test_ends_are_exact():
    """The ends come back bit for bit."""
    a, b = _random(1, 50), _random(2, 50)
    np.testing.assert_array_equal(slerp(a, b, 0.0), a)
    np.testing.assert_array_equal(slerp(a, b, 1.0), b)


@given(
    angle=st.floats(0, 180) | st.floats(0, 1e-6) | st.floats(179.999999, 180),
    axis=st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda v: np.linalg.norm(v) > 1e-3),
    t=st.floats(0, 1),
    seed=st.integers(0, 999),
)
def test_speed_is_constant_along_the_shorter_way(angle, axis, t, seed):
    """A fraction t of the way is t times the angle from one end and 1 - t from the other."""
    a = _random(seed, 1)[0]
    turn = np.radians(angle) * np.array(axis) / np.linalg.norm(axis)
    b = a @ Rotation.from_rotvec(turn).as_matrix()
    middle = slerp(a, b, t)
    apart = geodesic_angles(a, b)
    np.testing.assert_allclose(geodesic_angles(a, middle), t * apart, atol=5e-8)
    np.testing.assert_allclose(geodesic_angles(middle, b), (1 - t) * apart, atol=5e-8)
    np.testing.assert_allclose(middle @ middle.T, np.eye(3), atol=1e-13)
    assert np.linalg.det(middle) > 0


@pytest.mark.parametrize("axis", ["X", "Y", "Z"])
def test_opposite_rotations_meet_half_way(axis):
    """Half turns, whose direction is undetermined, still give rotations half way."""
    middle = slerp(np.eye(3), axis_rotation(axis, 180.0), 0.5)
    np.testing.assert_allclose(np.degrees(geodesic_angles(np.eye(3), middle)), 90.0, atol=1e-9)
    np.testing.assert_allclose(np.abs(middle), np.abs(axis_rotation(axis, 90.0)), atol=1e-12)


def test_identical_rotations_stay(waving):
    """Between two equal rotations nothing moves, and nothing is divided by zero."""
    a = waving.rotations
    np.testing.assert_allclose(slerp(a, a, 0.3), a, atol=1e-14)


def test_tiny_turns_keep_their_digits():
    """A turn of a billionth of a degree is halved, not lost."""
    middle = slerp(np.eye(3), axis_rotation("Z", 1e-9), 0.5)
    np.testing.assert_allclose(np.degrees(middle[1, 0]), 0.5e-9, rtol=1e-9)


def test_fractions_broadcast(waving):
    """One fraction per frame and one per joint both work."""
    a, b = waving.rotations[:-1], waving.rotations[1:]
    per_frame = np.linspace(0, 1, len(a))[:, None]
    result = slerp(a, b, per_frame)
    np.testing.assert_array_equal(result[7, 2], slerp(a[7, 2], b[7, 2], per_frame[7, 0]))
    assert slerp(np.eye(3), np.eye(3), np.zeros((2, 5))).shape == (2, 5, 3, 3)


@pytest.mark.parametrize(
    ("a", "b", "t"),
    [
        (np.eye(4), np.eye(3), 0.5),
        (np.zeros((2, 3, 3)), np.zeros((3, 3, 3)), 0.5),
        (np.zeros((2, 3, 3)), np.eye(3), np.zeros(3)),
    ],
    ids=["no-rotations", "pairs", "fractions"],
)
def test_shapes_that_do_not_fit_are_refused(a, b, t):
    """A wrong shape is a clear error."""
    with pytest.raises(WorkbenchError, match="got shape"):
        slerp(a, b, t)
