"""Tests of workbench.interpolation.rbf."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.interpolate import RBFInterpolator

from workbench.backprojection.poses import SpatialKeyframes
from workbench.datasets import load_space
from workbench.errors import WorkbenchError
from workbench.interpolation.rbf import RBFInTime
from workbench.mocap.nearest_rotation import nearest_rotations
from workbench.schemes import TemporalScheme

KEYS = np.array([0, 4, 5, 17, 33, 59])


@pytest.mark.parametrize("kernel", ["linear", "cubic"])
def test_agrees_with_a_dense_system_of_radial_basis_functions(waving, kernel):
    """The general interpolant, solved as a dense system, then the nearest rotation."""
    entries = waving.rotations[KEYS].reshape(6, -1)
    dense = RBFInterpolator(KEYS[:, None], entries, kernel=kernel, degree=1)
    expected = nearest_rotations(dense(np.arange(60.0)[:, None]).reshape(60, 4, 3, 3))
    assert np.abs(RBFInTime(kernel).interpolate(waving, KEYS) - expected).max() < 1e-9


def test_it_is_spatial_keyframing_on_a_line(waving):
    """Markers at their times on a line give the same poses."""
    line = np.stack([np.arange(60.0), np.zeros(60)], axis=1)
    expected = SpatialKeyframes().fit(line[KEYS], waving.rotations[KEYS]).predict(line)
    assert np.abs(RBFInTime().interpolate(waving, KEYS) - expected).max() < 1e-9


@pytest.mark.parametrize("kernel", ["linear", "cubic"])
def test_frames_outside_the_keyframes_hold_their_pose(waving, kernel):
    """Before the first and after the last keyframe nothing moves."""
    rebuilt = RBFInTime(kernel).interpolate(waving, [10, 20, 30])
    assert np.allclose(rebuilt[:10], waving.rotations[10])
    assert np.allclose(rebuilt[31:], waving.rotations[30])


@pytest.mark.parametrize("kernel", ["linear", "cubic"])
def test_thousands_of_keyframes_stay_exact(waving, kernel):
    """Keyframes are kept to rounding where a dense system would have lost its digits."""
    rotations = np.concatenate([waving.rotations] * 100)
    long = replace(waving, rotations=rotations, root_translation=np.zeros((6000, 3)))
    keys = np.arange(0, 6000, 2)
    rebuilt = RBFInTime(kernel).interpolate(long, keys)
    assert np.abs(rebuilt[keys] - rotations[keys]).max() < 1e-12


def test_errors_are_those_of_slerp_as_published():
    """Costa 2018, Table 5.1: the medians of 1D-RBF and slerp are 0.729 and 0.732."""
    clip = load_space("cmu/01_01-jump")
    errors = [TemporalScheme(name).run(clip, ratio=0.03).error for name in ("rbf", "slerp")]
    assert errors[0] == pytest.approx(errors[1], rel=0.01)


def test_an_unknown_kernel_is_refused():
    """The message lists the kernels that there are."""
    with pytest.raises(WorkbenchError, match="kernel: got 'quintic', want one of linear, cubic"):
        RBFInTime("quintic")
