"""Sessions come back to the last bit, and no damage goes unseen."""

from __future__ import annotations

import hashlib
import json
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.authoring import (
    edits,
    read_session,
    save_session,
    session_bytes,
    session_from_bytes,
)
from workbench.authoring.session_file import FORMAT, VERSION
from workbench.errors import DataError, WorkbenchError


@pytest.fixture(scope="module")
def content(scene, jump):
    """Give the content of a session with a new pose and a drawn curve."""
    other = edits.turn_joint(scene, 1, 3, [0.0, 9.0, 0.0], at=[0.1, 0.9])
    return session_bytes(edits.deform(other, 4, [0.1, 0.2], 0.3), jump.motion)


def _remade(content, change):
    """Change a session as a program that knows the format would do it."""
    parts = json.loads(content)
    del parts["checksum"]
    change(parts)
    text = json.dumps(parts, sort_keys=True, separators=(",", ":"))
    parts["checksum"] = hashlib.sha256(text.encode()).hexdigest()
    return json.dumps(parts).encode()


def test_a_session_comes_back_exactly(scene, jump, tmp_path):
    """The scene that is read equals the one that was saved, bit for bit."""
    other = edits.turn_joint(scene, 1, 3, [1 / 3, 9.0, 0.1], at=[0.1, 0.7], name="Größe – »x«")
    other = edits.set_kernel(edits.set_keep_feet(other, True), "gaussian", 1 / 7)
    for saved in (scene, edits.stretch(other, 0, 1, 1.1), edits.deform(other, 9, [0, 0], 0.3)):
        path = tmp_path / "walk.session.json"
        save_session(saved, jump.motion, path)
        session = read_session(path)
        assert session.scene.equals(saved)
        session.check(jump.motion)


@settings(max_examples=30, deadline=None)
@given(st.lists(st.floats(-1e300, 1e300), min_size=6, max_size=6))
def test_any_numbers_come_back(scene, jump, numbers):
    """Tiny, huge and negative zero numbers too."""
    marker = replace(scene.markers[1], position=numbers[:2], root=numbers[2:5], frame=None)
    other = replace(scene, markers=(scene.markers[0], marker, *scene.markers[2:]))
    assert session_from_bytes(session_bytes(other, jump.motion)).scene.equals(other)


def test_numbers_of_any_kind_are_kept(scene, jump):
    """Numbers as numpy has them are stored like Python's own."""
    other = edits.set_kernel(scene, "gaussian", np.float32(0.1))
    other = edits.add_frame(other, jump, np.int32(7))
    other = replace(other, frame_time=np.float32(0.05))
    assert session_from_bytes(session_bytes(other, jump.motion)).scene.equals(other)


def test_the_file_is_what_its_documentation_says(content):
    """One JSON object with the documented members, version 1."""
    parts = json.loads(content)
    assert (parts["format"], parts["version"]) == (FORMAT, VERSION)
    assert set(parts) == {
        *("format", "version", "checksum", "fingerprint", "clip", "frame_time", "markers"),
        *("embedding", "trajectory", "follows", "kernel", "epsilon", "keep_feet"),
    }
    assert set(parts["markers"][0]) == {"name", "position", "rotations", "root", "frame"}


def test_every_cut_is_refused(content):
    """A file that ends anywhere too early is no session."""
    ends = [0, 1, 2, *np.linspace(3, len(content) - 3, 40).astype(int)]
    for end in ends:
        with pytest.raises(DataError, match="upload: is"):
            session_from_bytes(content[:end], "upload")


def test_every_flipped_byte_is_refused_or_without_effect(content):
    """A changed byte anywhere is refused, unless it is a blank that means nothing."""
    whole = session_from_bytes(content).scene
    rng = np.random.default_rng(0)
    blanks = {place for place in range(len(content)) if content[place] in b" \n"}
    structure = [place for place in range(len(content)) if content[place] in b'{}[],:"']
    places = {*range(300), *rng.choice(len(content), 150), *rng.choice(structure, 100)}
    for place in sorted(int(p) for p in places):
        damaged = bytearray(content)
        damaged[place] ^= 1 << int(rng.integers(8))
        try:
            session = session_from_bytes(bytes(damaged))
        except DataError:
            continue
        assert place in blanks or damaged[place] in b"eE"
        assert session.scene.equals(whole)


@pytest.mark.parametrize(
    "other",
    [b"", b"null", b"[]", b"{}", b'{"format": 3}', b"\xff\xfe", b"[" * 100_000, b"HIERARCHY\n"],
    ids=["empty", "null", "list", "object", "number", "no text", "nested", "bvh"],
)
def test_what_is_no_session_is_refused(other):
    """Other files are refused in words."""
    with pytest.raises(DataError, match="authoring session"):
        session_from_bytes(other)


def test_a_later_version_is_refused(content):
    """A whole file of a later version says which version it is."""
    later = _remade(content, lambda parts: parts.update(version=2))
    with pytest.raises(DataError, match="is of version 2, this program reads 1"):
        session_from_bytes(later)


@pytest.mark.parametrize(
    "change",
    [
        lambda parts: parts.pop("markers"),
        lambda parts: parts.update(markers=parts["markers"][:2]),
        lambda parts: parts.update(markers=7),
        lambda parts: parts["markers"][0].pop("root"),
        lambda parts: parts["markers"][0].update(name=3),
        lambda parts: parts["markers"][0].update(frame=1e9),
        lambda parts: parts["markers"][0]["rotations"].pop(),
        lambda parts: parts["markers"][0]["rotations"][0].pop(),
        lambda parts: parts["markers"][0]["rotations"][0][0].__setitem__(0, 3.0),
        lambda parts: parts["embedding"].pop(),
        lambda parts: parts["embedding"][0].pop(),
        lambda parts: parts["embedding"][0].__setitem__(0, "left"),
        lambda parts: parts["trajectory"]["times"].reverse(),
        lambda parts: parts.update(trajectory=None),
        lambda parts: parts.update(kernel=["linear"]),
        lambda parts: parts.update(frame_time=None),
        lambda parts: parts.update(follows="no"),
        lambda parts: parts.update(clip={}),
        lambda parts: parts.update(fingerprint=None),
    ],
    ids=[
        *("no markers", "two markers", "number of markers", "no root", "name", "frame"),
        *("joints", "matrix", "no rotation", "frames", "place", "word", "times", "trajectory"),
        *("kernel", "frame time", "follows", "clip", "fingerprint"),
    ],
)
def test_content_that_is_no_scene_is_refused(content, change):
    """A file with the right checksum is checked like any other input."""
    with pytest.raises(DataError, match="session: holds no valid scene"):
        session_from_bytes(_remade(content, change))


@pytest.mark.parametrize("number", ["NaN", "Infinity", "1e999"])
def test_numbers_that_are_not_finite_are_refused(content, number):
    """JSON of some programs holds them; a scene has none."""
    text = content.decode().replace(
        f'"embedding": [[{json.loads(content)["embedding"][0][0]}', f'"embedding": [[{number}', 1
    )
    assert text.encode() != content
    with pytest.raises(DataError):
        session_from_bytes(text.encode())


def test_another_clip_is_refused(content, jump):
    """Another pose, path or name of a joint is not the session's clip."""
    session = session_from_bytes(content)
    motion = jump.motion
    session.check(motion)
    turned = np.array(motion.rotations)
    turned[7] = edits.turned(turned[7], 2, [0.01, 0.0, 0.0])
    skeleton = replace(motion.skeleton, names=("Pelvis", *motion.skeleton.names[1:]))
    for other in (
        replace(motion, rotations=turned),
        replace(motion, root_translation=motion.root_translation + 1.0),
        replace(motion, skeleton=skeleton),
    ):
        with pytest.raises(DataError, match="not the one that the session was made with"):
            session.check(other)
    with pytest.raises(DataError, match=r"want 50 frames of 31 joints.*got 40"):
        session.check(motion[:40])


def test_files_that_cannot_be_read_or_written(scene, jump, tmp_path):
    """A missing file and a folder are refused in words; a file that is there stays whole."""
    with pytest.raises(DataError, match="cannot be read"):
        read_session(tmp_path / "missing.json")
    with pytest.raises(DataError, match="cannot be written"):
        save_session(scene, jump.motion, tmp_path)
    path = tmp_path / "kept.json"
    save_session(scene, jump.motion, path)
    with pytest.raises(WorkbenchError, match="40 frames"):
        save_session(scene, jump.motion[:40], path)
    assert read_session(path).scene.equals(scene)
    assert [file.name for file in tmp_path.iterdir()] == ["kept.json"]
