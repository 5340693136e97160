"""Tests of workbench.quality.reconstruction."""

from __future__ import annotations

import numpy as np
import pytest

from workbench.errors import WorkbenchError
from workbench.mocap.rotations import axis_rotation
from workbench.quality.reconstruction import compression_ratio, position_distances


def test_d_p_of_a_turned_bone(waving):
    """A quarter turn moves the joint 2 units away by 2·√2, so D_p is 8 in that frame alone."""
    rebuilt = waving.rotations.copy()
    rebuilt[7, 1] = rebuilt[7, 1] @ axis_rotation("X", 90)
    found = position_distances(waving, rebuilt)
    assert found[7] == pytest.approx(8)
    assert np.delete(found, 7) == pytest.approx(np.zeros(59), abs=1e-12)


def test_weights_choose_the_joints(waving):
    """The moved joint counts by its weight, the others not at all."""
    rebuilt = waving.rotations.copy()
    rebuilt[:, 1] = rebuilt[:, 1] @ axis_rotation("X", 90)
    assert position_distances(waving, rebuilt, [1, 1, 3, 1]) == pytest.approx(np.full(60, 24))
    assert position_distances(waving, rebuilt, [1, 1, 0, 1]) == pytest.approx(np.zeros(60))


@pytest.mark.parametrize(
    ("shape", "weights", "message"),
    [
        ((59, 4, 3, 3), None, r"rotations: got shape \(59, 4, 3, 3\), want \(60, 4, 3, 3\)"),
        ((60, 4, 9), None, r"rotations: got shape"),
        ((60, 4, 3, 3), [1, 1, 1], r"weights: got shapes .* \(3,\)"),
    ],
    ids=["frames", "entries", "weights"],
)
def test_what_does_not_fit_the_motion_is_refused(waving, shape, weights, message):
    """The message names the argument and both shapes."""
    with pytest.raises(WorkbenchError, match=message):
        position_distances(waving, np.zeros(shape), weights)


def test_equal_sizes_need_two_ninety_fourths_more_keyframes():
    """Two coordinates a frame cost as much as 2 / 94 = 2.13 % keyframes (section 5.1)."""
    n = 94 * 1000
    spatial = compression_ratio(n, 3 * n // 100, 31, n_coordinates=2)
    temporal = compression_ratio(n, 3 * n // 100 + 2 * n // 94, 31)
    assert spatial == pytest.approx(temporal, rel=1e-12)
    assert pytest.approx(2.13, abs=0.005) == 100 * 2 / 94


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((10, 11, 31), "n_keyframes: got 11, want from 1 to 10"),
        ((0, 0, 31), "n_keyframes"),
        ((10, 3, 0), "n_joints"),
    ],
    ids=["more-keys", "no-frames", "no-joints"],
)
def test_impossible_clips_have_no_ratio(arguments, message):
    """Counts that no clip has are refused."""
    with pytest.raises(WorkbenchError, match=message):
        compression_ratio(*arguments)
