"""Tests of motions that move joints other than the root."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from workbench.mocap import forward_kinematics, joint_positions, read_bvh, write_bvh
from workbench.mocap.rotations import axis_rotation
from workbench.quality.reconstruction import position_error

# The bones' lengths stand in the position channels alone: 5 to the knee, 2 on to the foot.
_ZERO_OFFSETS = """HIERARCHY
ROOT Hips
{
    OFFSET 0 0 0
    CHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation Xrotation
    JOINT Knee
    {
        OFFSET 0 0 0
        CHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation Xrotation
        JOINT Foot
        {
            OFFSET 0 0 0
            CHANNELS 4 Yposition Zrotation Yrotation Xrotation
            End Site
            {
                OFFSET 0 0 1
            }
        }
    }
}
MOTION
Frames: 2
Frame Time: 0.01
9 9 9 10 20 30 0 -4.5 0 40 50 60 -2 0 0 0
9 9 8 11 21 31 0 -5.5 0 41 51 61 -2 0 0 0
"""


@pytest.fixture
def moved(write_file):
    """Give a motion of a leg whose bones are known from position channels only."""
    return read_bvh(write_file(_ZERO_OFFSETS))


@pytest.mark.parametrize("rule", ["replace", "add"])
def test_moved_joints_rest_at_their_mean_translation(write_file, rule):
    """Bones that only position channels tell have their mean length, and weigh by it."""
    skeleton = read_bvh(write_file(_ZERO_OFFSETS), positions=rule).skeleton
    assert skeleton.offsets.tolist() == [[0, 0, 0], [0, -5, 0], [0, -2, 0]]
    assert skeleton.path_weights.tolist() == [8, 3, 1]


def test_offset_of_a_joint_that_stays_there_is_kept_exactly(write_file):
    """Position channels that only repeat the OFFSET do not round it."""
    text = _ZERO_OFFSETS.replace(
        "JOINT Knee\n    {\n        OFFSET 0 0 0", "JOINT Knee\n    {\n        OFFSET 0.1 -4.7 0.3"
    )
    text = text.replace("0 -4.5 0 40", "0.1 -4.7 0.3 40").replace("0 -5.5 0 41", "0.1 -4.7 0.3 41")
    skeleton = read_bvh(write_file(text)).skeleton
    assert skeleton.offsets[1].tolist() == [0.1, -4.7, 0.3]


@pytest.mark.parametrize("rule", ["replace", "add"])
def test_moved_joints_survive_a_round_trip(moved, tmp_path, rule):
    """Written and read again, bones, weights and every position are the same."""
    write_bvh(moved, tmp_path / "again.bvh", positions=rule)
    again = read_bvh(tmp_path / "again.bvh", positions=rule)
    np.testing.assert_allclose(again.skeleton.offsets, moved.skeleton.offsets, atol=1e-9)
    np.testing.assert_allclose(again.skeleton.path_weights, moved.skeleton.path_weights)
    np.testing.assert_allclose(joint_positions(again), joint_positions(moved), atol=1e-8)


def test_position_error_counts_the_moved_bones(moved):
    """A turn of the hips swings the joints along the bones of the frame."""
    still = np.tile(np.eye(3), (2, 3, 1, 1))
    rebuilt = still.copy()
    rebuilt[:, 0] = axis_rotation("Z", [90, 180])
    # The knee is 4.5, then 5.5 below, the foot 2 below the knee; a quarter turn moves a joint
    # by √2 times its distance, a half turn by twice that distance.
    quarter, half = np.sqrt(2) * np.array([0, 4.5, 6.5]), 2 * np.array([0, 5.5, 7.5])
    expected = np.mean([quarter, half])
    assert position_error(replace(moved, rotations=still), rebuilt) == pytest.approx(expected)


def test_position_error_agrees_with_forward_kinematics(moved):
    """Translations of joints enter both sides, so the same rotations have no error."""
    assert position_error(moved, moved.rotations) == 0.0
    rebuilt = moved.rotations @ axis_rotation("X", 25)
    ours = forward_kinematics(moved.skeleton, rebuilt, 0.0, moved.joint_translations)
    theirs = joint_positions(moved) - moved.root_translation[:, None]
    expected = np.linalg.norm(ours - theirs, axis=2).mean()
    assert position_error(moved, rebuilt) == pytest.approx(expected)
