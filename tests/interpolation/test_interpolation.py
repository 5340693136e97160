"""Tests of workbench.interpolation."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp

from workbench.errors import WorkbenchError
from workbench.interpolation import interpolators
from workbench.mocap.motion import Motion
from workbench.mocap.rotations import rotations_from_euler


@pytest.mark.parametrize("name", interpolators.names())
def test_interpolators_keep_the_keyframes(waving, name):
    """Rotations at the keyframes are those of the clip."""
    keys = np.array([0, 7, 20, 59])
    rebuilt = interpolators.create(name).interpolate(waving, keys)
    assert np.abs(rebuilt[keys] - waving.rotations[keys]).max() < 1e-12


@pytest.mark.parametrize("name", ["linear", "hermite", "hermite-keys", "slerp"])
def test_interpolators_rebuild_a_steady_turn(arm, name):
    """A joint that turns about one axis at constant speed is rebuilt from two keyframes."""
    angles = np.zeros((11, 4, 3))
    angles[:, 1, 0] = np.linspace(-80, 80, 11)
    motion = Motion(arm, rotations_from_euler("ZYX", angles), np.zeros((11, 3)), 0.1)
    rebuilt = interpolators.create(name).interpolate(motion, np.array([0, 10]))
    assert np.abs(rebuilt - motion.rotations).max() < 1e-12


def test_slerp_agrees_with_scipy(waving):
    """Every joint follows scipy's spherical interpolation of the keyframes."""
    keys = np.array([0, 13, 30, 59])
    rebuilt = interpolators.create("slerp").interpolate(waving, keys)
    for joint in range(4):
        rotations = Rotation.from_matrix(waving.rotations[keys, joint])
        expected = Slerp(keys, rotations)(np.arange(60)).as_matrix()
        assert np.abs(rebuilt[:, joint] - expected).max() < 1e-12


def test_frames_outside_the_keyframes_hold_their_pose(waving):
    """Before the first and after the last keyframe nothing moves."""
    rebuilt = interpolators.create("slerp").interpolate(waving, np.array([10, 30]))
    assert np.allclose(rebuilt[:10], waving.rotations[10])
    assert np.allclose(rebuilt[31:], waving.rotations[30])


def test_linear_goes_on_across_the_wrap(arm):
    """From 170 to 190 degrees the joint turns by 20, not back by 340."""
    angles = np.zeros((5, 4, 3))
    angles[:, 1, 0] = [170, 175, 180, -175, -170]
    motion = Motion(arm, rotations_from_euler("ZYX", angles), np.zeros((5, 3)), 0.1)
    rebuilt = interpolators.create("linear").interpolate(motion, [0, 4])
    assert np.abs(rebuilt - motion.rotations).max() < 1e-12


@pytest.mark.parametrize("name", interpolators.names())
@pytest.mark.parametrize(
    "keyframes",
    [[5], [], [3, 99], [-1, 5], [9, 5], [5, 5, 9], [0.5, 7.0]],
    ids=["one", "none", "outside", "negative", "unsorted", "repeated", "fractions"],
)
def test_unusable_keyframes_are_refused(waving, name, keyframes):
    """Two keyframes of the clip are the least, sorted and each once."""
    with pytest.raises(WorkbenchError, match="control points"):
        interpolators.create(name).interpolate(waving, keyframes)


@pytest.mark.parametrize("name", interpolators.names())
def test_missing_rotations_are_refused(waving, name):
    """A rotation that is not a number is named, not interpolated."""
    rotations = waving.rotations.copy()
    rotations[30, 2, 0, 0] = np.nan
    with pytest.raises(WorkbenchError, match=r"rotations: got nan at \[30, 2, 0, 0\]"):
        interpolators.create(name).interpolate(replace(waving, rotations=rotations), [0, 59])


def test_only_motions_are_interpolated(waving):
    """Rotations alone do not tell their joints' channels."""
    with pytest.raises(WorkbenchError, match="motion: got ndarray, want a Motion"):
        interpolators.create("linear").interpolate(waving.rotations, [0, 59])
