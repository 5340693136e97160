"""Tests of what a BVH file may not do."""

from __future__ import annotations

import pickle

import pytest

from workbench.errors import DataError, MotionFormatError
from workbench.mocap import read_bvh

_ROW = "1 2 4 11 21 31 41 51 61\n"
# name: (text to replace, replacement, line, part of what was found, part of what is expected)
_FAULTS = {
    "more-frames-than-rows": ("Frames: 2", "Frames: 3", 20, "2 rows", "3 rows"),
    "fewer-frames-than-rows": ("Frames: 2", "Frames: 1", 20, "more than 1", "1 rows"),
    "absurdly-many-frames": ("Frames: 2", "Frames: 99999999999999", 20, "2 rows", "Frames:"),
    "no-rows": ("1 2 3 10 20 30 40 50 60\n" + _ROW, "", 18, "0 rows", "2 rows"),
    "short-row": (" 41 51 61", " 41 51", 20, "8 numbers", "9"),
    "short-row-before-others": (" 40 50 60", " 40 50", 19, "8 numbers", "9"),
    "long-row": (" 40 50 60", " 40 50 60 7", 19, "10 numbers", "9"),
    "row-over-two-lines": (" 40 50 60", "\n40 50 60", 19, "6 numbers", "9"),
    "two-rows-on-one-line": (" 60\n", " 60 ", 19, "18 numbers", "9"),
    "truncated-row": ("11 21 31 41 51 61\n", "11 2", 20, "5 numbers", "9"),
    "nan": (" 40 ", " nan ", 19, "'nan' in column 7", "finite"),
    "inf": (" 40 ", " inf ", 19, "'inf' in column 7", "finite"),
    "minus-infinity": (" 41 ", " -Infinity ", 20, "'-Infinity'", "finite"),
    "indefinite": (" 41 ", " -1.#IND ", 20, "'-1.#IND'", "finite"),
    "overflow": (" 41 ", " 1e999 ", 20, "'1e999'", "finite"),
    "decimal-commas": (" 40 50 60", " 40,5 50,1 60,2", 19, "'40,5'", "decimal"),
    "underscores": (" 40 ", " 4_0 ", 19, "'4_0'", "decimal"),
    "hexadecimal": (" 40 ", " 0x28 ", 19, "'0x28'", "decimal"),
    "lone-sign": (" 40 ", " - ", 19, "'-'", "decimal"),
    "lone-point": (" 40 ", " . ", 19, "'.'", "decimal"),
    "empty-exponent": (" 40 ", " 4e ", 19, "'4e'", "decimal"),
    "word-in-row": (" 40 ", " forty ", 19, "'forty'", "decimal"),
    "text-after-rows": (_ROW, _ROW + "END\n", 21, "more than 2", "2 rows"),
    "frame-time-zero": ("Time: 0.01", "Time: 0", 18, "Frame Time: 0", "above 0"),
    "frame-time-negative": ("Time: 0.01", "Time: -0.01", 18, "-0.01", "above 0"),
    "frame-time-nan": ("Time: 0.01", "Time: nan", 18, "nan", "above 0"),
    "frame-time-missing": ("Frame Time: 0.01\n", "", 18, "'1 2 3", "Frame Time:"),
    "frames-zero": ("Frames: 2", "Frames: 0", 17, "Frames: 0", "number"),
    "frames-negative": ("Frames: 2", "Frames: -2", 17, "Frames: -2", "number"),
    "frames-fractional": ("Frames: 2", "Frames: 2.5", 17, "Frames: 2.5", "number"),
    "frames-missing": ("Frames: 2\n", "", 17, "Frame Time", "Frames:"),
    "motion-missing": ("MOTION\n", "", 16, "'Frames: 2'", "MOTION"),
    "hierarchy-missing": ("HIERARCHY\n", "", 1, "'ROOT Hips'", "HIERARCHY"),
    "second-root": ("MOTION", "ROOT Other\n{\nOFFSET 0 0 0\n}\nMOTION", 16, "second ROOT", "one"),
    "root-in-root": ("JOINT Leg", "ROOT Leg", 6, "second ROOT 'Leg'", "one ROOT"),
    "joint-before-root": ("ROOT Hips", "JOINT Hips", 2, "JOINT 'Hips'", "ROOT"),
    "missing-closing-brace": ("}\nMOTION", "MOTION", 15, "'MOTION'", "'}'"),
    "extra-closing-brace": ("MOTION", "}\nMOTION", 16, "'}' without", "MOTION"),
    "missing-opening-brace": ("Leg\n    {", "Leg", 7, "'OFFSET 0 -1 0'", "'{'"),
    "two-opening-braces": ("Leg\n    {", "Leg\n    {{", 7, "'{'", "OFFSET"),
    "unknown-channel": ("Xposition", "Wposition", 5, "channel 'Wposition'", "Xposition"),
    "too-few-channels": ("3 Zrotation", "4 Zrotation", 9, "3 channel names", "4"),
    "too-many-channels": ("3 Zrotation", "2 Zrotation", 9, "3 channel names", "2"),
    "number-of-channels-missing": ("3 Zrotation", "Zrotation", 9, "CHANNELS Zrotation", "number"),
    "number-of-channels-huge": ("3 Zrotation", "9" * 5000 + " Zrotation", 9, "3", "99999"),
    "duplicate-channel": (
        "Zrotation Xrotation Yrotation",
        "Zrotation Zrotation Yrotation",
        9,
        "Zrotation twice",
        "once",
    ),
    "second-offset": ("OFFSET 0 -1 0", "OFFSET 0 -1 0\nOFFSET 0 0 0", 9, "second OFFSET", "one"),
    "second-channels": ("JOINT", "CHANNELS 0\nJOINT", 6, "second CHANNELS", "one"),
    "offset-missing": ("        OFFSET 0 -1 0\n", "", 13, "'}'", "OFFSET of joint 'Leg'"),
    "site-offset-missing": ("            OFFSET 0 -2 0\n", "", 12, "'}'", "OFFSET of the End"),
    "short-offset": ("OFFSET 0 -1 0", "OFFSET 0 -1", 8, "'OFFSET 0 -1'", "three"),
    "long-offset": ("OFFSET 0 -1 0", "OFFSET 0 -1 0 0", 8, "OFFSET 0 -1 0 0", "three"),
    "nan-offset": ("OFFSET 0 -1 0", "OFFSET 0 nan 0", 8, "'nan'", "finite"),
    "joint-in-end-site": ("OFFSET 0 -2 0", "JOINT Toe", 12, "JOINT inside", "OFFSET"),
    "channels-in-end-site": ("OFFSET 0 -2 0", "CHANNELS 0", 12, "CHANNELS", "OFFSET"),
    "joint-without-a-name": ("JOINT Leg", "JOINT", 6, "without a name", "name"),
    "unknown-statement": ("OFFSET 0 -1 0", "SCALE 1 1 1", 8, "'SCALE 1 1 1'", "OFFSET"),
}


@pytest.mark.parametrize("fault", _FAULTS.values(), ids=_FAULTS.keys())
def test_fault_is_refused_with_its_line(bvh_text, write_file, fault):
    """A broken file is refused; the error tells file, line, what was found and expected."""
    old, new, line, found, expected = fault
    assert old in bvh_text
    path = write_file(bvh_text.replace(old, new, 1))
    with pytest.raises(MotionFormatError) as caught:
        read_bvh(path)
    assert caught.value.path == path
    assert caught.value.line == line
    assert found in caught.value.found
    assert expected in caught.value.expected
    assert len(str(caught.value)) - len(str(path)) < 200


def test_no_channels_at_all_is_refused(write_file):
    """A skeleton that cannot move holds no motion."""
    text = "HIERARCHY\nROOT A\n{\nOFFSET 0 0 0\n}\nMOTION\nFrames: 1\nFrame Time: 1\n\n"
    with pytest.raises(MotionFormatError, match="line 6: found no channels"):
        read_bvh(write_file(text))


@pytest.mark.parametrize(
    ("content", "found"),
    [
        (b"", "an empty file"),
        (b" \r\n\t\n", "an empty file"),
        (b"\xef\xbb\xbf", "an empty file"),
        (b"\x7fELF\x02\x01\x00\x00", "binary"),
        (bytes(range(1, 256)) * 4, "HIERARCHY"),
        ("HIERARCHY\nROOT A".encode("utf-16"), "binary"),
        (b"HIERARCHY", "the end of the file"),
        (b"HIERARCHY\nMOTION\n", "'MOTION'"),
    ],
    ids=["empty", "blank", "only-bom", "nul", "bytes", "utf-16", "first-line-only", "no-root"],
)
def test_other_content_is_refused(write_file, content, found):
    """A file that is no BVH at all is refused in plain words."""
    with pytest.raises(MotionFormatError, match=found):
        read_bvh(write_file(content))


def test_binary_among_the_rows_is_refused(bvh_text, write_file):
    """A damaged disk block is found and its line told."""
    content = bvh_text.encode().replace(b" 41 ", b" \0\0 ")
    with pytest.raises(MotionFormatError, match="line 20: found binary data"):
        read_bvh(write_file(content))


@pytest.mark.parametrize("cut", range(0, 420, 7))
def test_a_file_cut_anywhere_is_refused(bvh_text, write_file, cut):
    """Wherever a download breaks off before the last number, the file is refused."""
    whole = bvh_text[: bvh_text.rindex(" ")]
    content = whole[: min(cut, len(whole))]
    with pytest.raises(MotionFormatError):
        read_bvh(write_file(content))


def test_missing_file(tmp_path):
    """A path without a file is told as such."""
    with pytest.raises(DataError, match="no such file"):
        read_bvh(tmp_path / "none.bvh")


def test_folder(tmp_path):
    """A folder is not a file."""
    with pytest.raises(DataError, match="is a folder"):
        read_bvh(tmp_path)


def test_error_survives_pickling(write_file):
    """A worker process can hand the error back whole."""
    with pytest.raises(MotionFormatError) as caught:
        read_bvh(write_file(""))
    copy = pickle.loads(pickle.dumps(caught.value))
    assert (str(copy), copy.line) == (str(caught.value), caught.value.line)
