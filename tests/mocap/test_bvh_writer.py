"""Tests of writing BVH files and reading them back."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings

from tests.mocap.strategies import motions
from workbench.errors import DataError, WorkbenchError
from workbench.mocap import Motion, joint_positions, read_bvh, write_bvh
from workbench.mocap.rotations import axis_rotation, geodesic_angles


def _assert_same(read: Motion, written: Motion) -> None:
    skeleton, expected = read.skeleton, written.skeleton
    assert skeleton.names == expected.names
    assert skeleton.channels == expected.channels
    np.testing.assert_array_equal(skeleton.parents, expected.parents)
    offsets = expected.offsets.copy()
    for joint, translation in written.joint_translations.items():
        offsets[joint] = translation.mean(axis=0)
    moved = np.isin(np.arange(skeleton.n_joints), list(written.joint_translations))
    np.testing.assert_array_equal(skeleton.offsets[~moved], offsets[~moved])
    np.testing.assert_allclose(skeleton.offsets[moved], offsets[moved], atol=1e-8)
    assert [s.joint for s in skeleton.end_sites] == [s.joint for s in expected.end_sites]
    for site, wanted in zip(skeleton.end_sites, expected.end_sites, strict=True):
        np.testing.assert_array_equal(site.offset, wanted.offset)
    assert read.frame_time == written.frame_time
    assert np.degrees(geodesic_angles(read.rotations, written.rotations).max()) < 1e-6
    np.testing.assert_allclose(read.root_translation, written.root_translation, atol=1e-8)
    np.testing.assert_allclose(joint_positions(read), joint_positions(written), atol=1e-5)


@settings(
    max_examples=150,
    deadline=None,
    # The folder is only written to, and every example overwrites the file of the one before.
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(motion=motions())
def test_round_trip_of_random_motions(tmp_path, motion):
    """Any motion that its channels can express comes back from a file within 1e-6 degrees."""
    for rule in ("replace", "add"):
        write_bvh(motion, tmp_path / "clip.bvh", positions=rule)
        _assert_same(read_bvh(tmp_path / "clip.bvh", positions=rule), motion)


def test_round_trip_of_real_files(real_mocap, tmp_path):
    """All files of the database survive a round trip, angle by angle modulo full turns."""
    clips = sorted((real_mocap / "bvh").glob("*.bvh"))
    assert clips
    for clip in clips:
        motion = read_bvh(clip)
        write_bvh(motion, tmp_path / "clip.bvh")
        _assert_same(read_bvh(tmp_path / "clip.bvh"), motion)
        original, written = _angles(clip), _angles(tmp_path / "clip.bvh")
        apart = np.abs((written - original + 180.0) % 360.0 - 180.0).max(axis=2)
        # The other triple of Euler angles that stands for the same rotation.
        other = np.stack(
            [written[..., 0] + 180, 180 - written[..., 1], written[..., 2] + 180], axis=2
        )
        apart_otherwise = np.abs((other - original + 180.0) % 360.0 - 180.0).max(axis=2)
        # In gimbal lock only the rotation is comparable, which was done above.
        locked = np.abs(np.cos(np.radians(original[..., 1]))) < 1e-4
        assert np.minimum(apart, apart_otherwise)[~locked].max() < 1e-6
        assert locked.mean() < 0.01


def _angles(path: Path) -> np.ndarray:
    """Read the angles of a file with 31 joints independently, as (n_frames, 31, 3)."""
    lines = path.read_text().splitlines()
    start = next(i for i, line in enumerate(lines) if line.startswith("Frame Time"))
    return np.loadtxt(lines[start + 1 :])[:, 3:].reshape(-1, 31, 3)


def test_written_curves_are_continuous(waving, tmp_path):
    """A joint that turns on and on is written without jumps."""
    turns = np.linspace(0, 1500, len(waving))
    rotations = waving.rotations.copy()
    rotations[:, 2] = axis_rotation("Z", turns) @ axis_rotation("Y", turns / 5)
    write_bvh(replace(waving, rotations=rotations), tmp_path / "clip.bvh")
    rows = np.loadtxt((tmp_path / "clip.bvh").read_text().split("Frame Time: ")[1].splitlines()[1:])
    np.testing.assert_allclose(rows[:, 9], turns, atol=1e-6)
    np.testing.assert_allclose(rows[:, 10], turns / 5, atol=1e-6)


_INEXPRESSIBLE = {
    "rotation": (
        lambda m: replace(m, skeleton=_with_channels(m, 2, ("Xrotation",))),
        r"joint 2 \(lower\).*channels \(X\) can express",
    ),
    "no-rotation-channels": (
        lambda m: replace(m, skeleton=_with_channels(m, 1, ())),
        r"joint 1 \(upper\).*\(none\)",
    ),
    "root-path": (
        lambda m: replace(m, skeleton=_with_channels(m, 0, m.skeleton.channels[1])),
        r"joint 0 \(root\): is moved by .* no channel Xposition",
    ),
    "joint-path": (
        lambda m: replace(m, joint_translations={1: np.ones((60, 3))}),
        r"joint 1 \(upper\): is moved by .* no channel Yposition",
    ),
    "nan-rotation": (lambda m: replace(m, rotations=m.rotations * np.nan), "joint 0"),
    "nan-translation": (
        lambda m: replace(m, root_translation=m.root_translation * np.nan),
        "finite",
    ),
    "brace-in-name": (lambda m: replace(m, skeleton=_renamed(m, "a{b")), "'a{b'.*without braces"),
    "line-end-in-name": (lambda m: replace(m, skeleton=_renamed(m, "a\nb")), "in one line"),
    "empty-name": (lambda m: replace(m, skeleton=_renamed(m, "")), "joint name"),
    "order-of-joints": (
        lambda m: replace(m, skeleton=replace(m.skeleton, parents=np.array([-1, 0, 0, 1]))),
        "another order",
    ),
}


def _with_channels(motion, joint, channels):
    kept = motion.skeleton.channels
    return replace(motion.skeleton, channels=(*kept[:joint], channels, *kept[joint + 1 :]))


def _renamed(motion, name):
    return replace(motion.skeleton, names=(name, *motion.skeleton.names[1:]))


@pytest.mark.parametrize("case", _INEXPRESSIBLE.values(), ids=_INEXPRESSIBLE.keys())
def test_what_a_file_cannot_hold_is_refused(waving, tmp_path, case):
    """A motion is written whole or not at all, and a file already there stays."""
    change, message = case
    path = tmp_path / "clip.bvh"
    path.write_text("kept")
    with pytest.raises(WorkbenchError, match=message):
        write_bvh(change(waving), path)
    assert path.read_text() == "kept"
    assert list(tmp_path.iterdir()) == [path]


def test_failed_write_leaves_nothing(waving, tmp_path, monkeypatch):
    """When the disk fails, the old file stays and no half-written one remains."""
    path = tmp_path / "clip.bvh"
    path.write_text("kept")

    def fail(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("workbench.files.os.replace", fail)
    with pytest.raises(DataError, match="No space left"):
        write_bvh(waving, path)
    assert path.read_text() == "kept"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("place", ["none/clip.bvh", "file/clip.bvh", "."], ids=str)
def test_impossible_places_are_refused(waving, tmp_path, place):
    """A folder that is missing, is a file, or is the target itself is one plain line."""
    (tmp_path / "file").write_text("")
    with pytest.raises(DataError, match="cannot be written"):
        write_bvh(waving, tmp_path / place)
    assert [p.name for p in tmp_path.iterdir()] == ["file"]
