"""Tests of workbench.mocap.rotations."""

from __future__ import annotations

from itertools import permutations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.spatial.transform import Rotation

from workbench.errors import WorkbenchError
from workbench.mocap.nearest_rotation import nearest_rotations
from workbench.mocap.rotations import (
    axis_rotation,
    euler_from_rotations,
    geodesic_angles,
    rotation_vectors,
    rotations_from_euler,
    rotations_from_vectors,
    unwrap_degrees,
)

ORDERS = ["".join(order) for order in permutations("XYZ")]
angles = st.floats(-720, 720)
entries = st.floats(-1e3, 1e3).map(lambda x: 0.0 if abs(x) < 1e-6 else x)


def nearest_by_svd(matrix):
    """Solve the orthogonal Procrustes problem with a proper rotation, the textbook way."""
    u, _, vt = np.linalg.svd(matrix)
    return u @ np.diag([1, 1, np.sign(np.linalg.det(u @ vt))]) @ vt


@pytest.mark.parametrize("order", ORDERS)
def test_euler_composition_agrees_with_scipy(order):
    """Composing Euler angles gives scipy's intrinsic rotations."""
    degrees = np.random.default_rng(0).uniform(-400, 400, (200, 3))
    expected = Rotation.from_euler(order, degrees, degrees=True).as_matrix()
    assert np.abs(rotations_from_euler(order, degrees) - expected).max() < 1e-14


@pytest.mark.parametrize("order", ORDERS)
@given(outer=angles, middle=angles, inner=angles)
def test_euler_round_trip(order, outer, middle, inner):
    """Decomposed angles compose to the same rotation."""
    rotation = rotations_from_euler(order, [outer, middle, inner])
    again = rotations_from_euler(order, euler_from_rotations(order, rotation))
    assert np.abs(again - rotation).max() < 1e-12


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("middle", [90.0, -90.0])
def test_euler_round_trip_in_gimbal_lock(order, middle):
    """A rotation whose outer axes coincide survives the round trip."""
    rotation = rotations_from_euler(order, [37.0, middle, -71.0])
    found = euler_from_rotations(order, rotation)
    assert np.abs(rotations_from_euler(order, found) - rotation).max() < 1e-12
    assert found[2] == 0.0


def test_fewer_axes_rotate_about_these_only():
    """No channel gives the identity, one channel a rotation about its axis."""
    assert np.array_equal(rotations_from_euler("", np.empty((2, 0))), np.stack([np.eye(3)] * 2))
    expected = Rotation.from_euler("Y", 30, degrees=True).as_matrix()
    assert np.allclose(rotations_from_euler("Y", [30.0]), expected)


_NAN = np.full((2, 3, 3), np.nan)
_REFUSED = {
    "axis": (lambda: axis_rotation("x", 90), r"axis: got 'x', want 'X', 'Y' or 'Z'"),
    "axis-of-no-kind": (lambda: axis_rotation(["X"], 90), r"axis: got \['X'\]"),
    "angle-in-words": (lambda: axis_rotation("X", "right"), "degrees: got what is no array"),
    "order": (lambda: rotations_from_euler("XQZ", [1, 2, 3]), "order: got 'XQZ'"),
    "no-order": (lambda: rotations_from_euler(None, [1, 2, 3]), "order: got None"),
    "angles": (
        lambda: rotations_from_euler("XYZ", [1.0, 2.0]),
        r"degrees of the order 'XYZ': got shape \(2,\), want \(\.\.\., 3\)",
    ),
    "single-angle": (lambda: rotations_from_euler("X", 1.0), r"got shape \(\), want \(\.\.\., 1\)"),
    "order-back": (lambda: euler_from_rotations("XYX", np.eye(3)), "three different axes"),
    "no-order-back": (lambda: euler_from_rotations(None, np.eye(3)), "three different axes"),
    "shape-back": (
        lambda: euler_from_rotations("XYZ", np.eye(2)),
        r"rotations: got shape \(2, 2\), want \(\.\.\., 3, 3\)",
    ),
    "vectors-of-shape": (lambda: rotation_vectors(np.ones(9)), r"got shape \(9,\)"),
    "vectors-of-nan": (lambda: rotation_vectors(_NAN), "want finite numbers"),
    "vectors-of-mirror": (lambda: rotation_vectors(-np.eye(3)), "singular or mirrored"),
    "from-vectors-shape": (lambda: rotations_from_vectors(np.ones((4, 2))), r"shape \(4, 2\)"),
    "from-vectors-nan": (lambda: rotations_from_vectors([0, np.nan, 0]), "want finite numbers"),
    "unwrap": (lambda: unwrap_degrees(3.0), "want shape"),
    "nearest-shape": (lambda: nearest_rotations(np.ones((3, 4))), r"matrices: got shape \(3, 4\)"),
    "nearest-nan": (lambda: nearest_rotations(_NAN), "matrices: got numbers that are not finite"),
    "nearest-inf": (lambda: nearest_rotations(np.diag([1, np.inf, 1])), "not finite"),
    "angle-shape": (lambda: geodesic_angles(np.ones(3), np.eye(3)), r"a: got shape \(3,\)"),
    "angle-pairs": (
        lambda: geodesic_angles(np.ones((2, 3, 3)), np.ones((4, 3, 3))),
        r"got shapes \(2, 3, 3\) and \(4, 3, 3\)",
    ),
}


@pytest.mark.parametrize("case", _REFUSED.values(), ids=_REFUSED.keys())
def test_unfit_input_is_refused(case):
    """A message names the argument, what it got and what it wants."""
    call, message = case
    with pytest.raises(WorkbenchError, match=message):
        call()


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("entry", range(9))
def test_one_bad_entry_among_many_is_found(entry, value):
    """Wherever it stands, a number that is not finite is refused, not turned into a rotation."""
    poses = np.tile(np.eye(3), (7, 5, 1, 1))
    poses[4, 3].flat[entry] = value
    with pytest.raises(WorkbenchError, match="matrices: got numbers that are not finite"):
        nearest_rotations(poses)


def test_nearest_rotation_of_huge_matrices():
    """Finite entries whose squares overflow are no reason to refuse a matrix."""
    turn = rotations_from_euler("XYZ", [10.0, 20.0, 30.0])
    assert np.abs(nearest_rotations(1e300 * turn) - turn).max() < 1e-12


def test_nearest_rotation_leaves_rotations_alone():
    """A rotation input survives orthonormalisation to 1e-15 in every entry."""
    rotations = Rotation.random(5000, random_state=1).as_matrix()
    assert np.abs(nearest_rotations(rotations) - rotations).max() <= 1e-15


@given(arrays(np.float64, (3, 3), elements=entries))
def test_nearest_rotation_is_a_rotation_and_no_other_is_nearer(matrix):
    """For any matrix the result is a proper rotation, as near as the one found by SVD."""
    found = nearest_rotations(matrix)
    assert np.abs(found @ found.T - np.eye(3)).max() < 1e-12
    assert np.linalg.det(found) > 0
    size = np.abs(matrix).max() + 1.0
    distance = np.linalg.norm(matrix - found)
    assert distance <= np.linalg.norm(matrix - nearest_by_svd(matrix)) + 1e-9 * size


def test_nearest_rotation_agrees_with_svd_on_many_matrices():
    """Random matrices, half of them reflections, give the rotation found by SVD."""
    matrices = np.random.default_rng(2).normal(size=(2000, 3, 3))
    expected = np.stack([nearest_by_svd(m) for m in matrices])
    assert np.abs(nearest_rotations(matrices) - expected).max() < 1e-9


@given(arrays(np.float64, (4, 3), elements=st.floats(-1.8, 1.8)))
def test_rotation_vectors_round_trip(vectors):
    """Vectors shorter than π come back, and give rotations by their length about themselves."""
    rotations = rotations_from_vectors(vectors)
    assert np.abs(rotation_vectors(rotations) - vectors).max() < 1e-7
    lengths = np.linalg.norm(vectors, axis=1)
    assert np.allclose(geodesic_angles(rotations, np.eye(3)), lengths, atol=1e-7)
    assert np.allclose(np.einsum("nij,nj->ni", rotations, vectors), vectors, atol=1e-12)


def test_geodesic_angle_is_exact_near_zero():
    """A rotation by 1e-12 rad is measured to 1e-4 of its size, and itself as exactly 0."""
    tiny = Rotation.from_rotvec([1e-12, 0, 0]).as_matrix()
    assert geodesic_angles(tiny, np.eye(3)) == pytest.approx(1e-12, rel=1e-4)
    assert geodesic_angles(tiny, tiny) == 0.0


def test_geodesic_angle_agrees_with_scipy():
    """The angle between rotations is the magnitude of their quotient."""
    a, b = Rotation.random(500, random_state=3), Rotation.random(500, random_state=4)
    expected = (a * b.inv()).magnitude()
    # Near 180 degrees arcsin keeps only half the digits.
    assert np.allclose(geodesic_angles(a.as_matrix(), b.as_matrix()), expected, atol=1e-7)


@given(st.lists(st.floats(-170, 170), min_size=2, max_size=30))
def test_unwrapping_undoes_wrapping(steps):
    """Angles wrapped to (-180, 180] come back, up to whole turns, if no step exceeds 170."""
    curve = np.cumsum(steps)
    wrapped = (curve + 180) % 360 - 180
    turns = (unwrap_degrees(wrapped) - curve) / 360
    assert np.allclose(turns, np.round(turns[0]), atol=1e-9)
