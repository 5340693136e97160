"""Feet that carry the body rest on the ground."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from workbench import load_space
from workbench.authoring.grounding import (
    STANDING,
    Support,
    find_support,
    foot_points,
    foot_speeds,
    ground_level,
    keep_feet,
)
from workbench.errors import WorkbenchError
from workbench.mocap.motion import Motion
from workbench.mocap.rotations import axis_rotation
from workbench.mocap.skeleton import EndSite, Skeleton

LEG = 10.0


def _walker(swing, height=0.0):
    """Let two straight legs swing below the hips: angles in degrees (n_frames, 2)."""
    skeleton = Skeleton(
        ("Hips", "LeftFoot", "RightFoot"),
        [-1, 0, 0],
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]],
        (EndSite(1, np.array([0.0, -LEG, 0.0])), EndSite(2, np.array([0.0, -LEG, 0.0]))),
        ((), (), ()),
    )
    rotations = np.tile(np.eye(3), (len(swing), 3, 1, 1))
    for leg in (0, 1):
        rotations[:, 1 + leg] = axis_rotation("X", swing[:, leg])
    root = np.zeros((len(swing), 3))
    root[:, 1] = LEG + height
    return Motion(skeleton, rotations, root, 0.1)


def _strides():
    """Give angles of a walk: the standing leg is upright, the other one swings past."""
    beat = np.arange(40) // 10 % 2
    swing = 40.0 * np.sin(np.arange(40) * np.pi / 10)
    lean = np.linspace(-4.0, 4.0, 10)[np.arange(40) % 10]
    return np.where(beat[:, None] == [0, 1], lean[:, None], swing[:, None] + 60.0)


def _slides(motion, support):
    """Measure the horizontal way of the foot that carries, where it stays the same."""
    points = foot_points(motion)
    same = support.foot[1:] == support.foot[:-1]
    steps = np.diff(points, axis=0)[np.arange(len(motion) - 1), support.foot[1:]][same]
    return np.linalg.norm(steps[:, [0, 2]], axis=1)


def test_the_supporting_foot_stays_where_it_is():
    """After the correction it does not slide at all, and it is at the height of the ground."""
    motion = _walker(_strides(), height=0.2)
    support = find_support(motion, ground=0.0)
    assert support.stands.all()
    assert 3 <= np.count_nonzero(np.diff(support.foot)) <= 4
    kept = keep_feet(motion, support)
    assert _slides(motion, support).max() > 0.1
    assert _slides(kept, support).max() < 1e-9
    lowest = foot_points(kept)[:, :, 1].min(axis=1)
    assert_allclose(lowest, 0.0, atol=1e-9)
    assert foot_speeds(motion, support).max() > 1.0
    assert foot_speeds(kept, support).max() < 1e-8


def test_the_body_walks_by_its_feet():
    """Legs that swing under hips that stay give a walk: each step carries the hips along."""
    motion = _walker(_strides(), height=0.0)
    kept = keep_feet(motion, find_support(motion, ground=0.0))
    stride = 2.0 * LEG * np.sin(np.radians(4.0))
    travelled = kept.root_translation[-1, 2] - kept.root_translation[0, 2]
    # Four steps, and three times the way at which the other foot takes over.
    assert abs(travelled) > 3.0 * stride


def test_feet_that_never_slide_are_left_alone():
    """A motion that was corrected is not changed by correcting it again."""
    motion = keep_feet(_walker(_strides()), find_support(_walker(_strides()), ground=0.0))
    again = keep_feet(motion, find_support(motion, ground=0.0))
    assert_allclose(again.root_translation, motion.root_translation, atol=1e-9)


def test_only_the_root_changes():
    """Poses, frame time and name stay."""
    motion = replace(_walker(_strides()), name="walk")
    kept = keep_feet(motion)
    assert kept.rotations is motion.rotations
    assert (kept.frame_time, kept.name) == (motion.frame_time, "walk")


def test_a_jump_stays_a_jump():
    """In the air the root keeps its height, less what it stood above the ground before."""
    frames = np.arange(60)
    up = np.clip(4.0 * np.sin((frames - 20) * np.pi / 20), 0.0, None)
    up[40:] = 0.0
    motion = _walker(np.zeros((60, 2)), height=up)
    support = find_support(motion, ground=0.0)
    kept = keep_feet(motion, support)
    lowered = motion.root_translation[:, 1] - kept.root_translation[:, 1]
    assert_allclose(lowered[~support.stands], 0.0, atol=STANDING * LEG)
    assert np.count_nonzero(~support.stands) >= 18
    steps = np.abs(np.diff(kept.root_translation[:, 1]))
    assert steps.max() < np.abs(np.diff(motion.root_translation[:, 1])).max() + 0.01
    assert np.all(foot_points(kept)[:, :, 1] >= -1e-9)


def test_a_foot_at_the_limit_of_standing_does_not_jump():
    """Where a foot stands in every other frame only, it is at the ground in all of them."""
    wave = np.where(np.arange(30) % 2, 1.01, 0.99) * STANDING * LEG
    motion = _walker(np.zeros((30, 2)), height=wave)
    support = find_support(motion, ground=0.0)
    assert support.stands.tolist() == (np.arange(30) % 2 == 0).tolist()
    assert_allclose(foot_points(keep_feet(motion, support))[:, :, 1], 0.0, atol=0.03 * wave.max())


def test_a_leap_goes_on_at_the_speed_of_the_body():
    """In the air the root's own path is not believed: a jump of it does not show."""
    angles = np.zeros((40, 2))
    angles[:, 0] = angles[:, 1] = -np.linspace(-8.0, 8.0, 40)
    up = np.where((np.arange(40) >= 18) & (np.arange(40) < 23), 3.0, 0.0)
    motion = _walker(angles, height=up)
    motion.root_translation[20:, 2] += 50.0
    kept = keep_feet(motion, find_support(motion, ground=0.0))
    steps = np.diff(kept.root_translation[:, 2])
    assert_allclose(steps, np.median(steps), rtol=0.2)


def test_without_a_foot_on_the_ground_the_root_keeps_its_path():
    """Who hangs or sits for long is not moved."""
    motion = _walker(_strides(), height=5.0)
    motion.root_translation[:, 2] = np.linspace(0.0, 3.0, 40)
    support = find_support(motion, ground=0.0)
    assert not support.stands.any()
    kept = keep_feet(motion, support)
    assert_allclose(kept.root_translation, motion.root_translation, atol=1e-12)
    assert not foot_speeds(motion, support).any()


def test_feet_below_the_ground_come_up():
    """A foot that has sunk in is lifted by the root, however deep it is."""
    motion = _walker(_strides(), height=-3.0)
    kept = keep_feet(motion, find_support(motion, ground=0.0))
    assert_allclose(foot_points(kept)[:, :, 1].min(axis=1), 0.0, atol=1e-9)


@pytest.mark.parametrize("name", ["cmu/01_01-jump", "cmu/01_03"])
def test_captured_feet(name):
    """On captured clips feet stop sliding, and the root stays within a leg's length of itself."""
    motion = load_space(name).motion[:300]
    support = find_support(motion)
    kept = keep_feet(motion, support)
    assert foot_speeds(motion, support).max() > 1.0
    assert foot_speeds(kept, support).max() < 1e-9 / motion.frame_time
    leg = np.median(motion.root_translation[:, 1]) - ground_level(motion)
    away = np.linalg.norm(kept.root_translation - motion.root_translation, axis=1)
    assert away.max() < leg
    # Where the other foot takes over the path goes on: no frame differs more than a foot moves.
    steps = np.linalg.norm(np.diff(kept.root_translation, axis=0), axis=1)
    own = np.linalg.norm(np.diff(motion.root_translation, axis=0), axis=1)
    assert steps.max() < own.max() + 0.05 * leg


@pytest.mark.parametrize("lean", [90.0, -90.0, 180.0], ids=["on its back", "on its face", "down"])
def test_y_must_be_up(lean):
    """Else the path of the root would be destroyed: the words say what is wanted."""
    stride = 30.0 * np.sin(np.arange(40) * np.pi / 10)
    upright = _walker(np.stack([stride, -stride], axis=1))
    turn = axis_rotation("X", lean)
    rotations = upright.rotations.copy()
    rotations[:, 0] = turn @ rotations[:, 0]
    fallen = replace(
        upright, rotations=rotations, root_translation=upright.root_translation @ turn.T
    )
    with pytest.raises(WorkbenchError, match="want y up"):
        keep_feet(fallen)
    with pytest.raises(WorkbenchError, match="want y up"):
        ground_level(fallen)
    assert ground_level(upright) < 1.0


def test_the_ball_of_the_foot_is_taken():
    """The joint below the foot's own touches the ground, not the ankle."""
    motion = load_space("cmu/01_01-jump").motion
    from workbench.mocap.kinematics import joint_positions

    names = motion.skeleton.names
    balls = [names.index("LeftToeBase"), names.index("RightToeBase")]
    assert np.array_equal(foot_points(motion), joint_positions(motion)[:, balls])


def test_wrong_input_is_refused():
    """Support of another motion and a ground that is no height are named."""
    motion = _walker(_strides())
    with pytest.raises(WorkbenchError, match="want the 40"):
        keep_feet(motion, Support(np.zeros(3, dtype=np.intp), np.ones(3, dtype=bool), 0.0))
    with pytest.raises(WorkbenchError, match="ground"):
        find_support(motion, ground=np.nan)
    with pytest.raises(WorkbenchError, match="feet"):
        keep_feet(motion, feet=["Paw"])
