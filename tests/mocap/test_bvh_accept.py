"""Tests of what BVH files in the wild may look like."""

from __future__ import annotations

import re

import numpy as np
import pytest

from workbench.errors import WorkbenchError
from workbench.mocap import joint_positions, read_bvh
from workbench.mocap.rotations import axis_rotation


def _single(channels: str, row: str, offset: str = "0 0 0") -> str:
    """Give a file whose only joint has the given channels and one frame."""
    return (
        f"HIERARCHY\nROOT A\n{{\nOFFSET {offset}\nCHANNELS {channels}\n}}\n"
        f"MOTION\nFrames: 1\nFrame Time: 1\n{row}\n"
    )


def test_reads_every_part(bvh_text, write_file):
    """All parts of a plain file arrive in the motion."""
    motion = read_bvh(write_file(bvh_text, "walk.bvh"))
    skeleton = motion.skeleton
    assert skeleton.names == ("Hips", "Leg")
    assert skeleton.parents.tolist() == [-1, 0]
    assert skeleton.offsets.tolist() == [[0, 0, 0], [0, -1, 0]]
    assert [(s.joint, s.offset.tolist(), s.name) for s in skeleton.end_sites] == [
        (1, [0, -2, 0], "")
    ]
    assert skeleton.channels[1] == ("Zrotation", "Xrotation", "Yrotation")
    assert motion.root_translation.tolist() == [[1, 2, 3], [1, 2, 4]]
    assert (len(motion), motion.frame_time, motion.name) == (2, 0.01, "walk")


def test_each_joint_has_its_own_rotation_order(bvh_text, write_file):
    """Angles are composed in the order of each joint's own channels."""
    motion = read_bvh(write_file(bvh_text))
    hips = axis_rotation("Z", 10) @ axis_rotation("Y", 20) @ axis_rotation("X", 30)
    leg = axis_rotation("Z", 40) @ axis_rotation("X", 50) @ axis_rotation("Y", 60)
    np.testing.assert_allclose(motion.rotations[0], [hips, leg], atol=1e-15)


_SAME_MOTION = {
    "crlf": lambda t: t.replace("\n", "\r\n"),
    "lone-cr": lambda t: t.replace("\n", "\r"),
    "mixed-line-ends": lambda t: t.replace("\n", "\r\n", 9).replace("MOTION\n", "MOTION\r\n"),
    "tabs": lambda t: t.replace("    ", "\t").replace(" 20 ", "\t20\t"),
    "blank-lines": lambda t: "\n \n" + t.replace("\n", "\n\n \t\n") + "\n\n",
    "byte-order-mark": lambda t: "\ufeff" + t,
    "no-final-line-end": lambda t: t.rstrip(),
    "blanks-at-line-ends": lambda t: t.replace("\n", "  \n"),
    "exponents": lambda t: t.replace("10 20 30", "1e1 2.0E+001 .3e2"),
    "signs-and-bare-points": lambda t: t.replace("10 20 30", "+10 20. +30.0"),
    "no-leading-zero": lambda t: t.replace("Time: 0.01", "Time: .01"),
    "no-blank-after-colon": lambda t: t.replace("Frames: 2", "Frames:2"),
    "blank-before-colon": lambda t: t.replace("Frames: 2", "Frames : 2"),
    "frames-with-leading-zeros": lambda t: t.replace("Frames: 2", "Frames: 0002"),
    "brace-on-the-same-line": lambda t: t.replace("Hips\n{", "Hips {").replace(
        "Site\n        {", "Site {"
    ),
    "brace-glued-to-the-name": lambda t: t.replace("Leg\n    {", "Leg{"),
    "block-on-one-line": lambda t: t.replace(
        "End Site\n        {\n            OFFSET 0 -2 0\n        }", "End Site { OFFSET 0 -2 0 }"
    ),
    "two-closing-braces": lambda t: t.replace("    }\n}\nMOTION", "    } }\nMOTION"),
    "offset-and-channels-on-one-line": lambda t: t.replace("-1 0\n        CHANN", "-1 0 CHANN"),
    "channels-before-offset": lambda t: re.sub(r"( *OFFSET .*\n)( *CHANNELS .*\n)", r"\2\1", t),
    "lower-case-keywords": lambda t: t.lower().replace("hips", "Hips").replace("leg", "Leg"),
    "upper-case-keywords": lambda t: t.upper().replace("HIPS", "Hips").replace("LEG", "Leg"),
}


@pytest.mark.parametrize("change", _SAME_MOTION.values(), ids=_SAME_MOTION.keys())
def test_formatting_does_not_matter(bvh_text, write_file, change):
    """Ways of writing the same file give the same motion."""
    changed = change(bvh_text)
    assert changed != bvh_text
    plain, motion = read_bvh(write_file(bvh_text)), read_bvh(write_file(changed))
    assert motion.skeleton.names == plain.skeleton.names
    assert motion.skeleton.channels == plain.skeleton.channels
    assert motion.frame_time == plain.frame_time
    np.testing.assert_array_equal(motion.rotations, plain.rotations)
    np.testing.assert_array_equal(motion.root_translation, plain.root_translation)
    np.testing.assert_array_equal(joint_positions(motion), joint_positions(plain))


_NAMES = ["Left Arm", "mixamorig:Leg", "leg.001", "CHANNELS", "End Site", "MOTION", "JOINT", "ROOT"]


@pytest.mark.parametrize("name", [*_NAMES, "OFFSET 1 2 3", "Frames: 2", "Füße", "2"])
def test_joint_names_are_free(bvh_text, write_file, name):
    """Names may have blanks, colons and dots, or be words of the format."""
    motion = read_bvh(write_file(bvh_text.replace("JOINT Leg", f"JOINT {name}")))
    assert motion.skeleton.names == ("Hips", name)


def test_names_in_latin_1(bvh_text, write_file):
    """A name that is no UTF-8 is read as Latin-1."""
    content = bvh_text.replace("Leg", "Fuß").encode("latin-1")
    assert read_bvh(write_file(content)).skeleton.names[1] == "Fuß"


def test_duplicate_names_stay_apart(bvh_text, write_file):
    """Two joints of one name are two joints."""
    motion = read_bvh(write_file(bvh_text.replace("JOINT Leg", "JOINT Hips")))
    assert motion.skeleton.names == ("Hips", "Hips")


def test_leaf_without_end_site(bvh_text, write_file):
    """A joint at the end of a chain needs no end site."""
    site = "        End Site\n        {\n            OFFSET 0 -2 0\n        }\n"
    motion = read_bvh(write_file(bvh_text.replace(site, "")))
    assert motion.skeleton.end_sites == ()


def test_named_end_site(bvh_text, write_file):
    """A name after End Site is kept."""
    motion = read_bvh(write_file(bvh_text.replace("End Site", "End Site Big Toe")))
    assert motion.skeleton.end_sites[0].name == "Big Toe"


@pytest.mark.parametrize(
    ("channels", "row", "degrees"),
    [
        ("1 Yrotation", "30", {"Y": 30}),
        ("2 Xrotation Zrotation", "10 20", {"X": 10, "Z": 20}),
        ("4 Xrotation Yrotation Zrotation Yposition", "10 20 30 9", {"X": 10, "Y": 20, "Z": 30}),
        ("3 Xposition Yposition Zposition", "1 2 3", {}),
    ],
    ids=["one", "two", "rotations-first", "positions-only"],
)
def test_numbers_of_channels(write_file, channels, row, degrees):
    """A joint may have any set of channels in any order."""
    motion = read_bvh(write_file(_single(channels, row)))
    expected = np.eye(3)
    for axis, angle in degrees.items():
        expected = expected @ axis_rotation(axis, angle)
    np.testing.assert_allclose(motion.rotations[0, 0], expected, atol=1e-15)


@pytest.mark.parametrize("line", ["        CHANNELS 0\n", ""], ids=["zero", "no-line"])
def test_joint_without_channels(bvh_text, write_file, line):
    """A joint may have no channels at all; it does not turn."""
    text = bvh_text.replace("        CHANNELS 3 Zrotation Xrotation Yrotation\n", line)
    text = text.replace(" 40 50 60", "").replace(" 41 51 61", "")
    motion = read_bvh(write_file(text))
    np.testing.assert_array_equal(motion.rotations[:, 1], [np.eye(3)] * 2)


def test_rotations_before_positions(write_file):
    """A column's meaning comes from its name, not its place."""
    channels = "6 Zrotation Zposition Yrotation Yposition Xrotation Xposition"
    motion = read_bvh(write_file(_single(channels, "90 3 0 2 0 1")))
    assert motion.root_translation.tolist() == [[1, 2, 3]]
    np.testing.assert_allclose(motion.rotations[0, 0], axis_rotation("Z", 90), atol=1e-15)


def test_missing_position_channel_keeps_the_offset(write_file):
    """A root that moves along one axis keeps its OFFSET in the others."""
    motion = read_bvh(write_file(_single("2 Yposition Xrotation", "9 0", offset="1 2 3")))
    assert motion.root_translation.tolist() == [[1, 9, 3]]


@pytest.mark.parametrize(
    ("rule", "root", "leg"),
    [("replace", [1, 2, 3], [7, 8, 9]), ("add", [2, 2, 3], [7, 7, 9])],
    ids=["replace", "add"],
)
def test_position_rule_of_six_channel_joints(bvh_text, write_file, rule, root, leg):
    """Positions replace the OFFSET or add to it, as asked."""
    text = bvh_text.replace("OFFSET 0 0 0", "OFFSET 1 0 0").replace(
        "CHANNELS 3 Zrotation Xrotation",
        "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation",
    )
    text = text.replace("10 20 30 40 50 60", "0 0 0 7 8 9 0 0 0").replace(
        "11 21 31 41 51 61", "0 0 0 7 8 9 0 0 0"
    )
    motion = read_bvh(write_file(text), positions=rule)
    assert motion.root_translation[0].tolist() == root
    np.testing.assert_allclose(joint_positions(motion)[0, 1], np.add(root, leg))


def test_unknown_position_rule_is_refused(bvh_text, write_file):
    """A rule that does not exist is named in the error."""
    with pytest.raises(WorkbenchError, match=r"'ignore'.*'replace' or 'add'"):
        read_bvh(write_file(bvh_text), positions="ignore")


def test_deep_skeleton(write_file, tmp_path):
    """Thousands of nested joints exhaust no stack."""
    depth = 3000
    opening = "".join(f"JOINT J{i}\n{{\nOFFSET 0 1 0\nCHANNELS 0\n" for i in range(depth))
    text = _single("1 Xrotation", "0").replace(
        "Xrotation\n}", f"Xrotation\n{opening}" + "}" * depth + "}"
    )
    motion = read_bvh(write_file(text))
    assert motion.skeleton.n_joints == depth + 1
    assert joint_positions(motion)[0, -1].tolist() == [0, depth, 0]
