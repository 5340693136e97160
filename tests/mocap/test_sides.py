"""Joints are told left from right by their names."""

from __future__ import annotations

import pytest

from workbench.mocap.sides import joint_sides


@pytest.mark.parametrize(
    ("names", "sides"),
    [
        (["Hips", "LeftUpLeg", "RightUpLeg", "LowerBack"], ["middle", "left", "right", "middle"]),
        (["root", "lfemur", "rfemur", "lowerback"], ["middle", "left", "right", "middle"]),
        (["pelvis", "hand_l", "hand_r"], ["middle", "left", "right"]),
        (["Bip01", "Bip01 L Foot", "Bip01 R Foot"], ["middle", "left", "right"]),
        (["l1", "r2"], ["middle", "middle"]),
    ],
    ids=["BVH", "ASF", "suffix", "between marks", "no pair"],
)
def test_sides_follow_from_pairs_of_names(names, sides):
    """Only a joint whose mirrored name exists is on a side."""
    assert joint_sides(names) == sides
