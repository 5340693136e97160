"""Tests of workbench.mocap.contacts."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from workbench.datasets import load_space
from workbench.errors import WorkbenchError
from workbench.mocap import (
    Motion,
    Skeleton,
    joint_positions,
    read_asf,
    read_bvh,
    rotations_from_channels,
)
from workbench.mocap.contacts import feet_by_height, feet_by_name, find_feet, foot_heights


def skeleton_of(names):
    """Hang all joints on the first."""
    n = len(names)
    parents = np.array([-1] + [0] * (n - 1))
    return Skeleton(tuple(names), parents, np.ones((n, 3)), (), ((),) * n)


@pytest.fixture
def walker():
    """Give a body with arms that hang, and feet with two toes each; it sways a little."""
    names = [
        "hips",
        "b1",
        "b2",
        "b3",
        "b3a",
        "b3b",
        "c1",
        "c2",
        "c3",
        "c3a",
        "c3b",
        "t",
        "a1",
        "a2",
    ]
    parents = [-1, 0, 1, 2, 3, 3, 0, 6, 7, 8, 8, 0, 11, 12]
    offsets = [[0, 90, 0]]
    for side in (1, -1):
        offsets += [[10 * side, 0, 0], [0, -40, 0], [0, -42 - side, 0], [0, -3, 9], [2, -4, 9]]
    offsets += [[0, 50, 0], [20, 0, 0], [0, -60, 0]]
    turns = ("Zrotation", "Yrotation", "Xrotation")
    skeleton = Skeleton(
        tuple(names), np.array(parents), np.array(offsets, dtype=float), (), (turns,) * len(names)
    )
    degrees = 5 * np.sin(np.arange(40)[:, None] / 6 + np.arange(3 * len(names)))
    rotations = rotations_from_channels(skeleton, degrees)
    return Motion(skeleton, rotations, np.tile([0.0, 90.0, 0.0], (40, 1)), 1 / 30, name="walker")


@pytest.mark.parametrize(
    ("left", "right"),
    [
        ("LeftFoot", "RightFoot"),
        ("lfoot", "rfoot"),
        ("LFoot", "RFoot"),
        ("L_Foot", "R_Foot"),
        ("l_foot", "r_foot"),
        ("foot_l", "foot_r"),
        ("foot.L", "foot.R"),
        ("mixamorig:LeftFoot", "mixamorig:RightFoot"),
        ("Bip01 L Foot", "Bip01 R Foot"),
        ("Bip01_L_Foot", "Bip01_R_Foot"),
        ("LeftAnkle", "RightAnkle"),
        ("ltoes", "rtoes"),
        ("LeftToeBase", "RightToeBase"),
        ("LEFTFOOT", "RIGHTFOOT"),
        ("left_toe", "right_toe"),
    ],
)
def test_feet_are_known_by_many_names(left, right):
    """Whatever their place in the file, and whatever stands around them."""
    others = ["Hips", "LeftLeg", "RightLeg", "LeftHand", "Football", "lforearm", "rollBone"]
    assert feet_by_name(skeleton_of([*others, right, left])) == (8, 7)
    assert feet_by_name(skeleton_of(["Hips", left, *others, right])) == (1, 9)


def test_the_foot_comes_before_its_toes():
    """Of foot, ankle and toes the foot is taken, of two feet of one side the first."""
    names = ["Hips", "LeftToe", "LeftFoot", "LeftFoot", "RightAnkle", "RightToeBase", "rightfoot"]
    assert feet_by_name(skeleton_of(names)) == (2, 6)


@pytest.mark.parametrize(
    "names",
    [["root", "a", "b"], ["Hips", "LeftFoot", "Foot"], ["Hips", "LeftFoot", "rightside"]],
    ids=["none", "no side", "one only"],
)
def test_one_foot_is_not_enough(names):
    """Without a name for each side, names tell nothing."""
    assert feet_by_name(skeleton_of(names)) == ()


def test_feet_of_bundled_and_real_skeletons(real_mocap):
    """On all conversions and originals at hand, both feet are found, and are the lowest limbs."""
    originals = sorted((real_mocap / "asf_amc").glob("*.asf"))
    conversions = sorted((real_mocap / "bvh").glob("0[15]_0[13].bvh"))
    assert originals
    assert conversions
    for path in originals:
        skeleton = read_asf(path).skeleton
        assert [skeleton.names[joint] for joint in feet_by_name(skeleton)] == ["lfoot", "rfoot"]
    for path in conversions:
        motion = read_bvh(path)[1:]
        names = motion.skeleton.names
        assert [names[joint] for joint in find_feet(motion)] == ["LeftFoot", "RightFoot"]
        assert [names[joint] for joint in feet_by_height(motion)] == ["LeftToeBase", "RightToeBase"]


def test_feet_of_the_bundled_jump():
    """The names of the bundled clip are understood, and its feet leave the ground."""
    motion = load_space("cmu/01_01-jump").motion
    heights = foot_heights(motion)
    assert heights.shape == (len(motion), 2)
    assert np.ptp(heights, axis=0).min() > 4.0


def test_feet_are_found_by_height_where_names_tell_nothing(walker):
    """The lowest end of each leg, neither two toes of one foot nor a hand."""
    found = [walker.skeleton.names[joint] for joint in find_feet(walker)]
    assert [name[:2] for name in found] == ["b3", "c3"]


def test_permuted_joints_give_the_same_feet(walker):
    """Feet do not depend on the order in which a file lists the limbs."""
    order = [0, 11, 12, 13, *range(6, 11), *range(1, 6)]
    old = walker.skeleton
    place = {joint: i for i, joint in enumerate(order)}
    skeleton = Skeleton(
        tuple(old.names[j] for j in order),
        np.array([-1] + [place[int(old.parents[j])] for j in order[1:]]),
        old.offsets[order],
        (),
        tuple(old.channels[j] for j in order),
    )
    moved = replace(walker, skeleton=skeleton, rotations=walker.rotations[:, order])
    assert {skeleton.names[j] for j in find_feet(moved)} == {
        old.names[j] for j in find_feet(walker)
    }


def test_heights_are_world_positions_along_the_axis(walker):
    """Of the joints that the user names, in that order, along the axis that points up."""
    positions = joint_positions(walker)
    heights = foot_heights(walker, ["a2", "hips", "b3"])
    assert np.array_equal(heights, positions[:, [13, 0, 3], 1])
    assert np.array_equal(foot_heights(walker, "b3", up="z"), positions[:, [3], 2])


def test_the_axis_that_points_up_can_be_another(walker):
    """Turned to lie on its back, with z up, the body has the same feet."""
    quarter = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])
    rotations = walker.rotations.copy()
    rotations[:, 0] = quarter @ rotations[:, 0]
    lying = replace(
        walker, rotations=rotations, root_translation=walker.root_translation @ quarter.T
    )
    assert find_feet(lying, up="z") == find_feet(walker)
    assert np.allclose(foot_heights(lying, up="z"), foot_heights(walker))


@pytest.mark.parametrize(
    ("feet", "up", "message"),
    [
        (("b33",), "y", "feet: got 'b33', want names of joints such as .*b3"),
        ((), "y", "feet: got no names"),
        ((3,), "y", "feet: got 3, want names"),
        (3, "y", "feet: got 3, want names"),
        (None, "w", "up: got 'w', want 'x', 'y' or 'z'"),
    ],
    ids=["unknown", "none", "number", "no list", "axis"],
)
def test_bad_feet_are_refused(walker, feet, up, message):
    """The message names the argument and what would do."""
    with pytest.raises(WorkbenchError, match=message):
        foot_heights(walker, feet, up=up)


def test_a_body_without_limbs_says_that_feet_must_be_named():
    """One chain of joints has no two feet."""
    skeleton = Skeleton(
        ("tail", "mid", "tip"), np.array([-1, 0, 1]), np.ones((3, 3)), (), ((),) * 3
    )
    worm = Motion(skeleton, np.tile(np.eye(3), (5, 3, 1, 1)), np.zeros((5, 3)), 0.01, name="worm")
    with pytest.raises(WorkbenchError, match=r"feet of 'worm': .*want the names of the feet"):
        foot_heights(worm)
