"""Tests of workbench.mocap.distances."""

from __future__ import annotations

import re

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from workbench.errors import WorkbenchError
from workbench.mocap.distances import (
    position_distance_matrix,
    position_distance_pairs,
    rotation_distance_matrix,
    rotation_distance_pairs,
    rotation_distance_table,
)

WEIGHTS = np.array([3.0, 0.5, 0.0, 1.0])


@pytest.fixture
def poses():
    """Give 21 random poses of 4 joints."""
    return Rotation.random(84, random_state=0).as_matrix().reshape(21, 4, 3, 3)


def by_trace(a, b):
    """Evaluate Eq. 3.2 of Costa 2018 as printed."""
    cosine = (np.einsum("jrc,jrc->j", a, b) - 1) / 2
    return float(WEIGHTS @ np.arccos(np.clip(cosine, -1, 1)))


@pytest.mark.parametrize("n", [21, 20], ids=["odd", "even"])
def test_rotation_distances_agree_with_the_printed_formula(poses, n):
    """D_q of all pairs equals the weighted arccos of traces."""
    poses = poses[:n]
    expected = np.array([[by_trace(a, b) for b in poses] for a in poses])
    found = rotation_distance_matrix(poses, WEIGHTS)
    # Away from the diagonal, where the printed arccos loses half its digits.
    assert np.allclose(found, expected, atol=1e-6)
    assert np.array_equal(found, found.T)
    assert np.all(np.diag(found) == 0)


def test_pairs_agree_with_the_matrix(poses):
    """Distances of single pairs are the entries of the full matrix."""
    rows, columns = np.triu_indices(len(poses))
    matrix = rotation_distance_matrix(poses, WEIGHTS)
    pairs = rotation_distance_pairs(poses[rows], poses[columns], WEIGHTS)
    assert np.allclose(pairs, matrix[rows, columns], rtol=1e-14)


def by_chord(a, b):
    """Sum 2·asin(chord) joint by joint with numpy's arcsine."""
    chord = np.linalg.norm(a - b, axis=(-2, -1)) / np.sqrt(8)
    return 2 * np.arcsin(np.minimum(chord, 1)) @ WEIGHTS


@pytest.mark.parametrize("n", [1, 127, 128, 129, 300])
def test_tiles_leave_no_seam(n):
    """Whatever part of a tile is left over, matrix and table are those of single pairs."""
    vectors = np.random.default_rng(n).uniform(-0.8, 0.8, size=(4 * n, 3))
    # No two are half a turn apart, where the chord hides rounding errors of 1e-8.
    poses = Rotation.from_rotvec(vectors).as_matrix().reshape(n, 4, 3, 3)
    expected = by_chord(poses[:, None], poses)
    assert np.allclose(rotation_distance_matrix(poses, WEIGHTS), expected, rtol=1e-13, atol=1e-13)
    few = poses[: n // 2 + 1]
    table = rotation_distance_table(few, poses, WEIGHTS)
    assert np.allclose(table, expected[: len(few)], rtol=1e-13, atol=1e-13)


def test_small_angles_keep_their_digits():
    """Poses a billionth of a radian apart have that distance, to rounding of the matrices."""
    still = np.tile(np.eye(3), (1, 4, 1, 1))
    turned = Rotation.from_rotvec([1e-9, 0, 0]).as_matrix()[None, None].repeat(4, axis=1)
    found = rotation_distance_pairs(still, turned, WEIGHTS)[0]
    assert found == pytest.approx(1e-9 * WEIGHTS.sum(), rel=1e-7)


def test_half_a_turn_is_pi():
    """Half a turn about any axis, where the chord of rounded matrices may exceed its largest."""
    axes = np.random.default_rng(3).normal(size=(50, 4, 3))
    vectors = np.pi * axes / np.linalg.norm(axes, axis=2, keepdims=True)
    turned = Rotation.from_rotvec(vectors.reshape(-1, 3)).as_matrix().reshape(50, 4, 3, 3)
    still = np.broadcast_to(np.eye(3), turned.shape)
    found = rotation_distance_pairs(still, turned, WEIGHTS)
    assert np.allclose(found, np.pi * WEIGHTS.sum(), rtol=1e-7)


def test_rotation_distance_of_known_angles():
    """Two joints turned by 90 and 30 degrees with weights 2 and 3 are π + π/2 apart."""
    still = np.stack([np.eye(3)] * 2)[None]
    turned = Rotation.from_euler("X", [[90], [30]], degrees=True).as_matrix()[None]
    found = rotation_distance_pairs(still, turned, np.array([2.0, 3.0]))
    assert found[0] == pytest.approx(np.pi + np.pi / 2)


def test_position_distances_agree_with_the_printed_formula():
    """D_p of all pairs equals the weighted sum of squared joint distances."""
    positions = np.random.default_rng(1).normal(size=(12, 4, 3))
    expected = np.array(
        [[np.sum(WEIGHTS * np.sum((a - b) ** 2, axis=1)) for b in positions] for a in positions]
    )
    assert np.allclose(position_distance_matrix(positions, WEIGHTS), expected)
    first, second = np.array([0, 3]), np.array([7, 2])
    pairs = position_distance_pairs(positions[first], positions[second], WEIGHTS)
    assert np.allclose(pairs, expected[first, second])


_MATRIX = [(rotation_distance_matrix, (3, 3)), (position_distance_matrix, (3,))]
_PAIRS = [(rotation_distance_pairs, (3, 3)), (position_distance_pairs, (3,))]
_UNFIT = {
    "more-weights": ((5, 4), 9),
    "fewer-weights": ((5, 4), 3),
    "no-joints-axis": ((5,), 4),
    "flat": ((), 4),
    "another-axis": ((5, 4, 2), 4),
}


@pytest.mark.parametrize("shape", _UNFIT.values(), ids=_UNFIT.keys())
@pytest.mark.parametrize(
    ("measure", "entries"), [*_MATRIX, *_PAIRS], ids=["d_q", "d_p", "d_q-pairs", "d_p-pairs"]
)
def test_shapes_that_do_not_fit_are_refused(measure, entries, shape):
    """Poses and weights of different joints are refused with both shapes."""
    poses, weights = np.zeros((*shape[0], *entries)), np.ones(shape[1])
    arguments = [poses] if (measure, entries) in _MATRIX else [poses, poses]
    found = re.escape(f"got shapes {poses.shape} and ({shape[1]},)")
    with pytest.raises(WorkbenchError, match=found):
        measure(*arguments, weights)


@pytest.mark.parametrize(("measure", "entries"), _PAIRS, ids=["rotations", "positions"])
def test_pairs_of_different_length_are_refused(measure, entries):
    """Every pose wants a partner of the same joints."""
    for other in [(3, 4), (6, 4), (5, 3)]:
        with pytest.raises(WorkbenchError, match=r"got shapes"):
            measure(np.zeros((5, 4, *entries)), np.zeros((*other, *entries)), np.ones(4))


def test_weights_may_be_whole_numbers(poses):
    """Weights given as integers, or poses as lists, mean the same."""
    expected = rotation_distance_matrix(poses, np.array([2.0, 1.0, 0.0, 3.0]))
    assert np.array_equal(rotation_distance_matrix(poses.tolist(), [2, 1, 0, 3]), expected)
