"""Tests of reading Acclaim skeletons and motions."""

from __future__ import annotations

import shutil

import numpy as np
import pytest

from workbench.errors import DataError, MotionFormatError
from workbench.mocap import (
    forward_kinematics,
    joint_positions,
    read_amc,
    read_asf,
    read_asf_amc,
    read_motion,
)
from workbench.mocap.rotations import axis_rotation

_ASF = """# made by hand
:version 1.10
:name test
:units
  mass 1.0
  length 0.45
  angle deg
:documentation
   order, axis and begin mean nothing here
:root
   order TX TY TZ RX RY RZ
   axis XYZ
   position 0 0 0
   orientation 0 0 0
:bonedata
  begin
     id 1
     name hip
     direction 1 0 0
     length 2
     axis 0 0 0 XYZ
  end
  begin
     id 2
     name leg
     direction 0 -1 0
     length 3
     axis 0 0 90 XYZ
    dof rx rz
    limits (-160.0 20.0)
           (-70.0 70.0)
  end
:hierarchy
  begin
    root hip
    hip leg
  end
"""
_AMC = """#!OML:ASF test
:FULLY-SPECIFIED
:DEGREES
1
root 1 2 3 10 20 30
leg 40 50
2
root 1 2 4 11 21 31
leg 41 51
"""


@pytest.fixture
def pair(write_file):
    """Give the paths of a small skeleton and a motion of it."""
    return write_file(_ASF, "test.asf"), write_file(_AMC, "test.amc")


def test_bones_become_joints_at_their_start(pair):
    """A bone turns about its start, which is its parent's end."""
    skeleton = read_asf(pair[0]).skeleton
    assert skeleton.names == ("root", "hip", "leg")
    assert skeleton.offsets.tolist() == [[0, 0, 0], [0, 0, 0], [2, 0, 0]]
    assert [(s.joint, s.offset.tolist()) for s in skeleton.end_sites] == [(2, [0, -3, 0])]
    assert skeleton.unit_cm == pytest.approx(2.54 / 0.45)


def test_rotations_follow_the_formula(pair):
    """R = C · M · Cᵀ with M about fixed axes in the order of dof; missing bones do not turn."""
    motion = read_asf_amc(*pair)
    root = axis_rotation("Z", 30) @ axis_rotation("Y", 20) @ axis_rotation("X", 10)
    axes = axis_rotation("Z", 90)
    leg = axes @ axis_rotation("Z", 50) @ axis_rotation("X", 40) @ axes.T
    np.testing.assert_allclose(motion.rotations[0], [root, np.eye(3), leg], atol=1e-15)
    assert motion.root_translation.tolist() == [[1, 2, 3], [1, 2, 4]]
    assert motion.frame_time == pytest.approx(1 / 120)
    assert motion.name == "test"


def test_order_of_the_dof_list_counts(write_file):
    """Values and turns follow the bone's own list."""
    asf = write_file(_ASF.replace("dof rx rz", "dof rz rx"), "a.asf")
    motion = read_asf_amc(asf, write_file(_AMC, "a.amc"))
    axes = axis_rotation("Z", 90)
    leg = axes @ axis_rotation("X", 50) @ axis_rotation("Z", 40) @ axes.T
    np.testing.assert_allclose(motion.rotations[0, 2], leg, atol=1e-15)
    assert read_amc(write_file(_AMC, "a.amc"), read_asf(asf)).columns[6:] == ("leg.rz", "leg.rx")


def test_order_of_the_root_counts(write_file):
    """The root's list tells which value is which, translations last if it says so."""
    asf = write_file(_ASF.replace("TX TY TZ RX RY RZ", "RZ RY RX TZ TY TX"), "a.asf")
    motion = read_asf_amc(asf, write_file(_AMC, "a.amc"))
    root = axis_rotation("X", 3) @ axis_rotation("Y", 2) @ axis_rotation("Z", 1)
    np.testing.assert_allclose(motion.rotations[0, 0], root, atol=1e-15)
    assert motion.root_translation[0].tolist() == [30, 20, 10]


def test_root_position_and_orientation_are_added(write_file):
    """A root that is placed beforehand moves from there."""
    text = _ASF.replace("position 0 0 0", "position 5 0 0")
    text = text.replace("orientation 0 0 0", "orientation 0 90 0")
    motion = read_asf_amc(write_file(text, "a.asf"), write_file(_AMC, "a.amc"))
    plain = read_asf_amc(write_file(_ASF, "b.asf"), write_file(_AMC, "b.amc"))
    np.testing.assert_allclose(
        motion.rotations[:, 0], axis_rotation("Y", 90) @ plain.rotations[:, 0], atol=1e-15
    )
    np.testing.assert_allclose(motion.root_translation, np.add(plain.root_translation, [5, 0, 0]))


_SAME_SKELETON = {
    "crlf": lambda t: t.replace("\n", "\r\n"),
    "comments": lambda t: t.replace("length 2", "length 2 # remark").replace(":root", "# x\n:root"),
    "blank-lines-and-tabs": lambda t: t.replace("\n", "\n\n").replace("     ", "\t"),
    "byte-order-mark": lambda t: "\ufeff" + t,
    "limits-on-one-line": lambda t: t.replace("20.0)\n", "20.0) "),
    "limits-with-commas": lambda t: t.replace("(-160.0 20.0)", "(-160.0, inf)"),
    "lower-case-order": lambda t: t.replace("TX TY TZ RX RY RZ", "tx ty tz rx ry rz"),
    "upper-case-dof": lambda t: t.replace("dof rx rz", "DOF RX RZ"),
    "exponents": lambda t: t.replace("axis 0 0 90", "axis 7.6e-320 0 9e+001"),
    "no-units-section-angle": lambda t: t.replace("  angle deg\n", ""),
    "mass-of-bones": lambda t: t.replace("length 2", "length 2\n bodymass 3"),
    "unknown-section": lambda t: t + ":skin\nfile.obj 1 2\n",
    "radians": lambda t: t.replace("angle deg", "angle rad").replace(
        "0 0 90", "0 0 1.5707963267948966"
    ),
}


@pytest.mark.parametrize("change", _SAME_SKELETON.values(), ids=_SAME_SKELETON.keys())
def test_formatting_of_skeletons_does_not_matter(pair, write_file, change):
    """Ways of writing the same skeleton give the same motion."""
    changed = change(_ASF)
    assert changed != _ASF
    motion, plain = read_asf_amc(write_file(changed, "a.asf"), pair[1]), read_asf_amc(*pair)
    np.testing.assert_allclose(joint_positions(motion), joint_positions(plain), atol=1e-14)
    np.testing.assert_allclose(motion.rotations, plain.rotations, atol=1e-14)


_SAME_MOTION = {
    "crlf": lambda t: t.replace("\n", "\r\n"),
    "comments": lambda t: t.replace("leg 40 50", "leg 40 50 # remark\n# remark"),
    "blank-lines": lambda t: t.replace("\n", "\n\n"),
    "other-order-of-bones": lambda t: t.replace(
        "root 1 2 3 10 20 30\nleg 40 50", "leg 40 50\nroot 1 2 3 10 20 30"
    ),
    "no-header": lambda t: t[t.index("1\nroot") :],
    "lower-case-header": lambda t: t.replace(":DEGREES", ":degrees"),
    "other-first-number": lambda t: t.replace("\n1\nroot", "\n7\nroot").replace(
        "\n2\nroot", "\n8\nroot"
    ),
    "no-final-line-end": lambda t: t.rstrip(),
}


@pytest.mark.parametrize("change", _SAME_MOTION.values(), ids=_SAME_MOTION.keys())
def test_formatting_of_motions_does_not_matter(pair, write_file, change):
    """Ways of writing the same motion give the same motion."""
    changed = change(_AMC)
    assert changed != _AMC
    motion, plain = read_asf_amc(pair[0], write_file(changed, "a.amc")), read_asf_amc(*pair)
    np.testing.assert_array_equal(motion.rotations, plain.rotations)
    np.testing.assert_array_equal(motion.root_translation, plain.root_translation)


def test_radians_of_motions(pair, write_file):
    """A motion in radians is read in degrees, translations left alone."""
    angles = read_amc(write_file(_AMC.replace("DEGREES", "RADIANS"), "a.amc"), read_asf(pair[0]))
    plain = read_amc(pair[1])
    np.testing.assert_allclose(angles.degrees, np.degrees(plain.degrees))
    np.testing.assert_array_equal(angles.values[:, :3], plain.values[:, :3])


_SKELETON_FAULTS = {
    "nan": ("direction 1 0 0", "direction 1 nan 0", 19, "nan", "3 finite"),
    "two-numbers": ("direction 1 0 0", "direction 1 0", 19, "direction 1 0", "3 finite"),
    "decimal-comma": ("length 3", "length 3,5", 27, "3,5", "1 finite"),
    "no-length": ("     length 3\n", "", 31, "end", "length of bone 'leg'"),
    "no-direction": ("     direction 1 0 0\n", "", 21, "end", "direction of bone 'hip'"),
    "no-axis": ("     axis 0 0 0 XYZ\n", "", 21, "end", "axis of bone 'hip'"),
    "bad-axis-order": ("0 0 0 XYZ", "0 0 0 XXZ", 21, "'XXZ'", "axis order"),
    "no-axis-order": ("0 0 0 XYZ", "0 0 0", 21, "''", "axis order"),
    "unknown-dof": ("dof rx rz", "dof rx qz", 29, "dof rx qz", "rx, ry, rz"),
    "stretching-dof": ("dof rx rz", "dof rx l", 29, "dof rx l", "rx, ry, rz"),
    "dof-twice": ("dof rx rz", "dof rx rx", 29, "dof rx rx", "once"),
    "bone-twice": ("name leg", "name hip", 32, "bone name 'hip'", "of its own"),
    "bone-called-root": ("name leg", "name root", 32, "bone name 'root'", "of its own"),
    "unnamed-bone": ("     name leg\n", "", 31, "bone name ''", "of its own"),
    "unknown-property": ("id 2", "colour 2", 24, "'colour'", "property"),
    "unknown-in-root": ("axis XYZ\n", "axle XYZ\n", 12, "'axle'", "axis"),
    "bad-root-order": ("TX TY TZ RX", "TX TY RX", 11, "order", "TX TY TZ RX RY RZ"),
    "bad-angle": ("angle deg", "angle grad", 7, "angle grad", "angle deg or"),
    "zero-length-unit": ("length 0.45", "length 0", 6, "length 0", "above 0"),
    "unknown-bone": ("hip leg", "hip arm", 36, "bone 'arm'", ":bonedata"),
    "bone-without-parent": ("    hip leg\n", "", 36, "end", "a parent for bone 'leg'"),
    "two-parents": ("hip leg", "hip leg\nroot leg", 37, "bone 'leg' again", "one parent"),
    "cycle": ("root hip\n    hip leg", "leg hip\n    hip leg", 35, "'leg'", "a parent first"),
    "no-begin": ("begin\n     id 2", "id 2", 23, "'id 2'", "begin"),
    "truncated-bone": (_ASF[_ASF.index("    limits") :], "", 29, "end of the file", "line 23"),
    "truncated-hierarchy": ("    hip leg\n  end\n", "", 35, "end of the file", "end of the hi"),
    "no-hierarchy": (_ASF[_ASF.index(":hierarchy") :], "", 32, "end of the file", ":hierarchy"),
    "no-root": (
        _ASF[_ASF.index(":root") : _ASF.index(":bone")],
        "",
        32,
        "end of the file",
        ":root",
    ),
    "text-before-keywords": (":version 1.10", "version 1.10", 2, "'version 1.10'", ":version"),
}


@pytest.mark.parametrize("fault", _SKELETON_FAULTS.values(), ids=_SKELETON_FAULTS.keys())
def test_faults_of_skeletons_are_refused(write_file, fault):
    """A broken skeleton is refused with line, finding and expectation."""
    old, new, line, found, expected = fault
    assert old in _ASF
    with pytest.raises(MotionFormatError) as caught:
        read_asf(write_file(_ASF.replace(old, new, 1), "a.asf"))
    assert found in caught.value.found
    assert expected in caught.value.expected
    assert caught.value.line == line


_MOTION_FAULTS = {
    "missing-bone": ("leg 40 50\n", "", 5, "frame 1 without leg", "all bones"),
    "missing-bone-at-the-end": ("leg 41 51\n", "", 8, "frame 2 without leg", "all bones"),
    "missing-root": ("root 1 2 4 11 21 31\n", "", 8, "frame 2 without root", "all bones"),
    "truncated-name": ("leg 41 51\n", "le", 9, "bone 'le'", "one of 2 bones"),
    "truncated-values": ("leg 41 51\n", "leg 41", 9, "1 values of leg", "2"),
    "too-many-values": ("leg 40 50", "leg 40 50 60", 6, "3 values of leg", "2"),
    "short-root": ("1 2 3 10 20 30", "1 2 3 10 20", 5, "5 values of root", "6"),
    "bone-twice": ("leg 40 50", "leg 40 50\nleg 40 50", 7, "bone 'leg' again", "once"),
    "unknown-bone": ("leg 40 50", "leg 40 50\ntail 1 2", 7, "bone 'tail'", "one of 2"),
    "bone-without-dof": ("leg 40 50", "leg 40 50\nhip 1", 7, "bone 'hip'", "one of 2"),
    "nan": ("leg 41 51", "leg nan 51", 9, "'nan'", "finite"),
    "indefinite": ("leg 41 51", "leg -1.#IND 51", 9, "'-1.#IND'", "finite"),
    "decimal-comma": ("leg 41 51", "leg 41,0 51", 9, "'41,0'", "finite"),
    "frame-skipped": ("2\nroot", "3\nroot", 7, "frame number 3", "frame number 2"),
    "frame-repeated": ("2\nroot", "1\nroot", 7, "frame number 1", "frame number 2"),
    "no-frame-number": ("1\nroot", "root", 4, "'root 1 2 3", "frame number"),
    "unknown-keyword": (":DEGREES", ":GRADS", 3, "':grads'", ":RADIANS"),
    "header-alone": (_AMC[_AMC.index("1\nroot") :], "", 3, "no frame", "frame number"),
}


@pytest.mark.parametrize("fault", _MOTION_FAULTS.values(), ids=_MOTION_FAULTS.keys())
def test_faults_of_motions_are_refused(pair, write_file, fault):
    """A broken motion is refused with line, finding and expectation."""
    old, new, line, found, expected = fault
    assert old in _AMC
    path = write_file(_AMC.replace(old, new, 1), "a.amc")
    with pytest.raises(MotionFormatError) as caught:
        read_asf_amc(pair[0], path)
    assert found in caught.value.found
    assert expected in caught.value.expected
    assert caught.value.line == line


_WITHOUT_SKELETON = ["missing-bone-at-the-end", "too-many-values", "nan", "frame-skipped"]


@pytest.mark.parametrize("name", _WITHOUT_SKELETON)
def test_faults_are_found_without_a_skeleton_too(write_file, name):
    """The first frame settles what every frame must have."""
    old, new, *_ = _MOTION_FAULTS[name]
    with pytest.raises(MotionFormatError):
        read_amc(write_file(_AMC.replace(old, new, 1), "a.amc"))


def test_root_of_other_than_six_values_is_refused_without_a_skeleton(write_file):
    """What the root's values mean cannot be guessed."""
    with pytest.raises(MotionFormatError, match="line 5: found 2 values of root"):
        read_amc(write_file(_AMC.replace("1 2 3 10 20 30", "1 2"), "a.amc"))


@pytest.mark.parametrize("read", [read_asf, read_amc], ids=["asf", "amc"])
@pytest.mark.parametrize("content", ["", " \n", b"\x00\x01\x02"], ids=["empty", "blank", "binary"])
def test_other_content_is_refused(write_file, read, content):
    """Empty and binary files are told as such."""
    with pytest.raises(MotionFormatError, match=r"an empty file|binary data"):
        read(write_file(content, "file"))


def test_bytes_in_all_their_variety_are_refused(write_file):
    """Random bytes are neither skeleton nor motion."""
    path = write_file(bytes(range(1, 256)) * 9, "file")
    for read in (read_asf, read_amc):
        with pytest.raises(MotionFormatError):
            read(path)


@pytest.mark.parametrize("name", ["05_09", "05"], ids=["same-stem", "subject"])
def test_skeleton_is_found_beside_the_motion(pair, tmp_path, name):
    """The skeleton of the same name or of the subject is taken, whatever else lies there."""
    shutil.move(pair[1], tmp_path / "05_09.amc")
    shutil.copy(pair[0], tmp_path / f"{name}.ASF")
    (tmp_path / "test.asf").write_text("broken")
    assert len(read_motion(tmp_path / "05_09.amc")) == 2


def test_the_only_skeleton_of_a_folder_is_taken(pair):
    """Where there is no choice a name that tells no subject does not matter."""
    pair[1].rename(pair[1].with_name("walk.AMC"))
    assert read_motion(pair[1].with_name("walk.AMC")).name == "walk"


@pytest.mark.parametrize(
    ("files", "asked", "message"),
    [
        (["05_09.amc"], "05_09.amc", "want 05_09.asf or 05.asf in its folder"),
        (["walk.amc", "a.asf", "b.asf"], "walk.amc", "has no skeleton beside it"),
        (["05_09.amc", "07.asf"], "05_09.amc", "has no skeleton beside it"),
        (["05.asf"], "05.asf", "a skeleton without motion"),
        (["clip.fbx"], "clip.fbx", "is of kind .fbx"),
        (["clip"], "clip", "is of kind none"),
        ([], "none.amc", "no such file"),
        ([], "none.bvh", "no such file"),
    ],
    ids=[
        "no-asf",
        "two-asf",
        "other-subject",
        "asf",
        "fbx",
        "no-ending",
        "missing-amc",
        "missing-bvh",
    ],
)
def test_what_is_no_motion_is_refused(tmp_path, files, asked, message):
    """A path that cannot be read as a motion gets an answer that says what is wanted."""
    for name in files:
        (tmp_path / name).write_text("x")
    with pytest.raises(DataError, match=message):
        read_motion(tmp_path / asked)


def test_bvh_is_read_by_its_ending(write_file, bvh_text):
    """A BVH file is read as such, in capitals too."""
    assert len(read_motion(write_file(bvh_text, "CLIP.BVH"))) == 2


def test_bare_rotations_of_a_pair_have_positions(pair):
    """The rotations alone, with the skeleton, give the positions of the motion."""
    motion = read_asf_amc(*pair)
    np.testing.assert_array_equal(
        forward_kinematics(motion.skeleton, motion.rotations, motion.root_translation),
        joint_positions(motion),
    )
