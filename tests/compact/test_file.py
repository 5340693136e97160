"""Tests of workbench.compact.file, byte by byte."""

from __future__ import annotations

import contextlib
import json
import struct
import subprocess
import sys
import time
import zlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.compact import (
    CompactMotion,
    compact_bytes,
    compact_motion,
    read_compact,
    write_compact,
)
from workbench.compact.file import SIGNATURE
from workbench.errors import DataError
from workbench.interpolation import interpolators
from workbench.schemes import TemporalScheme
from workbench.spaces import PoseSpace


def sealed(stream: bytes, version: int = 2) -> bytes:
    """Give a file of that content with the right checksum."""
    content = SIGNATURE + struct.pack("<H", version) + stream
    return content + struct.pack("<I", zlib.crc32(content))


def test_reading_gives_exactly_what_was_written(compacted, tmp_path):
    """Expanded after reading, every number is the same, bit by bit."""
    compact = compacted[1]
    write_compact(compact, tmp_path / "clip.compact")
    read = read_compact(tmp_path / "clip.compact")
    ours, theirs = compact.expand(), read.expand()
    assert np.array_equal(ours.rotations, theirs.rotations)
    assert np.array_equal(ours.root_translation, theirs.root_translation)
    assert (ours.frame_time, ours.name) == (theirs.frame_time, theirs.name)
    assert ours.skeleton.names == theirs.skeleton.names
    assert ours.skeleton.channels == theirs.skeleton.channels
    assert np.array_equal(ours.skeleton.offsets, theirs.skeleton.offsets)
    for site, other in zip(ours.skeleton.end_sites, theirs.skeleton.end_sites, strict=True):
        assert (site.joint, site.name) == (other.joint, other.name)
        assert np.array_equal(site.offset, other.offset)
    assert (compact.error, compact.scheme_error) == (read.error, read.scheme_error)
    assert compact_bytes(read) == compact_bytes(compact)


def test_writing_tells_the_size(compacted, tmp_path):
    """The number returned is the size of the file."""
    path = tmp_path / "clip.compact"
    assert write_compact(compacted[1], path) == path.stat().st_size


def test_the_header_states_the_bounds(compacted):
    """Read as documented, without this package, the file tells how exact its arrays are."""
    compact = compacted[1]
    body = zlib.decompress(compact_bytes(compact)[10:-4])
    (length,) = struct.unpack("<I", body[:4])
    header = json.loads(body[4 : 4 + length])
    bounds = {entry["name"]: entry["bound"] for entry in header["arrays"]}
    assert bounds["keyframes"] == 0
    assert bounds["keys"] == compact.keys.bound
    assert bounds["path"] == compact.path.bound
    assert ("embedding" in bounds) == (compact.embedding is not None)
    assert header["error"] == compact.error


def test_every_changed_byte_is_refused(compacted, tmp_path):
    """Whichever byte changes, and however, no motion comes out."""
    path = tmp_path / "clip.compact"
    whole = compact_bytes(compacted[1])
    masks = np.random.default_rng(0).integers(1, 256, len(whole)).tolist()
    for position, mask in enumerate(masks):
        damaged = bytearray(whole)
        damaged[position] ^= mask
        path.write_bytes(damaged)
        with pytest.raises(DataError, match=r"clip\.compact: is damaged or no compact file"):
            read_compact(path)


def test_every_truncation_is_refused(compacted, tmp_path):
    """Cut anywhere, or with something behind it, the file is named as damaged."""
    path = tmp_path / "clip.compact"
    whole = compact_bytes(compacted[1])
    for content in [*(whole[:length] for length in range(len(whole))), whole + b"\0"]:
        path.write_bytes(content)
        with pytest.raises(DataError, match=r"clip\.compact: is damaged or no compact file"):
            read_compact(path)


def test_later_versions_are_refused(compacted, tmp_path):
    """A whole file of a later version is said to be one, whatever it holds."""
    path = tmp_path / "clip.compact"
    for stream in (b"", b"something new"):
        path.write_bytes(sealed(stream, version=3))
        with pytest.raises(DataError, match="is of version 3, this program reads 2"):
            read_compact(path)


@settings(max_examples=150, deadline=None)
@given(st.data())
def test_wrong_content_under_a_right_checksum_is_no_traceback(tmp_path_factory, data):
    """A program that writes nonsense is refused as damage is, or its numbers are taken."""
    path = tmp_path_factory.getbasetemp() / "nonsense.compact"
    body = bytearray(zlib.decompress(_small()[10:-4]))
    start = data.draw(st.integers(0, len(body)))
    end = data.draw(st.integers(start, min(start + 8, len(body))))
    body[start:end] = data.draw(st.binary(max_size=8))
    path.write_bytes(sealed(zlib.compress(bytes(body))))
    with contextlib.suppress(DataError):
        assert isinstance(read_compact(path), CompactMotion)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('"interpolator":"slerp"', '"interpolator":null'),
        ('"moved_joints":[]', '"moved_joints":[1]'),
        ('"skeleton":{', '"bones":{'),
        ('"name":"keyframes","shape":[5,1]', '"name":"keyframes","shape":[1,5]'),
        ('"frame_time":0.', '"frame_time":"'),
    ],
    ids=["no embedding", "moved joint", "no skeleton", "one keyframe", "text"],
)
def test_headers_that_do_not_fit_are_refused(tmp_path, old, new):
    """Parts that contradict each other are no compact motion."""
    path = tmp_path / "clip.compact"
    body = zlib.decompress(_small()[10:-4])
    (length,) = struct.unpack("<I", body[:4])
    text = body[4 : 4 + length].decode()
    assert old in text
    changed = text.replace(old, new).encode()
    stream = struct.pack("<I", len(changed)) + changed + body[4 + length :]
    path.write_bytes(sealed(zlib.compress(stream)))
    with pytest.raises(DataError, match="is damaged or no compact file"):
        read_compact(path)


def test_an_unknown_interpolator_is_named(waving, tmp_path, monkeypatch):
    """A file made with a method of one's own says which one it needs."""
    path = tmp_path / "clip.compact"
    result = TemporalScheme("slerp").run(PoseSpace(waving), count=12)
    with monkeypatch.context() as patch:
        patch.setitem(interpolators._entries, "mine", interpolators.factory("slerp"))
        write_compact(compact_motion(result, "mine"), path)
    with pytest.raises(DataError, match="needs interpolator 'mine', here are linear"):
        read_compact(path)


def test_a_failed_write_leaves_the_old_file(compacted, tmp_path, monkeypatch):
    """If the new file cannot be moved into place, the old one is as it was."""
    path = tmp_path / "clip.compact"
    path.write_bytes(b"old")

    def refuse(*_):
        raise OSError("no space left")

    monkeypatch.setattr("workbench.files.os.replace", refuse)
    with pytest.raises(OSError, match="no space left"):
        write_compact(compacted[1], path)
    assert path.read_bytes() == b"old"
    assert [p.name for p in tmp_path.iterdir()] == ["clip.compact"]


def test_killed_while_writing_the_file_is_whole(tmp_path):
    """Whenever the writer is killed, a whole file stands under the name."""
    path = tmp_path / "clip.compact"
    path.write_bytes(_small())
    code = (
        "import sys\n"
        "from workbench.compact import read_compact, write_compact\n"
        "compact = read_compact(sys.argv[1])\n"
        "print('writing', flush=True)\n"
        "while True:\n"
        "    write_compact(compact, sys.argv[1])\n"
    )
    words = [sys.executable, "-c", code, str(path)]
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as writer:
        assert writer.stdout.readline() == "writing\n"
        time.sleep(0.05)
        writer.kill()
    assert path.read_bytes() == _small()


def _small() -> bytes:
    """Give the file of a motion of two joints and eight frames."""
    from workbench.mocap import EndSite, Motion, Skeleton
    from workbench.mocap.rotations import rotations_from_euler

    turns = ("Zrotation", "Yrotation", "Xrotation")
    skeleton = Skeleton(
        ("hip", "knee"),
        np.array([-1, 0]),
        np.array([[0.0, 0.0, 0.0], [0.0, -4.0, 0.5]]),
        (EndSite(1, np.array([0.0, -4.0, 0.0])),),
        (("Xposition", "Yposition", "Zposition", *turns), turns),
    )
    degrees = np.linspace(0, 60, 48).reshape(8, 2, 3)
    path = np.linspace(0, 1, 24).reshape(8, 3)
    motion = Motion(skeleton, rotations_from_euler("ZYX", degrees), path, 0.125, name="step")
    result = TemporalScheme("slerp").run(PoseSpace(motion), count=5)
    return compact_bytes(compact_motion(result, "slerp"))
