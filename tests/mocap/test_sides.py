"""Joints are told left from right by their names."""

from __future__ import annotations

import pytest

from workbench.mocap.sides import joint_sides


@pytest.mark.parametrize(
    ("names", "sides"),
    [
        (["Hips", "LeftUpLeg", "RightUpLeg", "LowerBack"], "mlrm"),
        (["LHipJoint", "RHipJoint", "LThumb", "RThumb"], "lrlr"),
        (["root", "lfemur", "rfemur", "lowerback", "lclavicle", "rclavicle"], "mlrmlr"),
        (["hand_l", "hand_r", "Bip01 L Foot", "Bip01 R Foot", "pelvis"], "lrlrm"),
        (["mixamorig:LeftArm", "mixamorig:RightArm"], "lr"),
        (["leg", "reg"], "lr"),
        (["LeftArm", "Spine"], "mm"),
    ],
    ids=["words", "capitals", "asf", "suffixes", "prefixes", "letters", "no partner"],
)
def test_sides_come_from_pairs_of_names(names: list[str], sides: str) -> None:
    """A joint has a side only if its mirrored name is another joint's."""
    words = {"l": "left", "r": "right", "m": "middle"}
    assert joint_sides(names) == [words[letter] for letter in sides]
