"""Tests of motions: validation, slicing, T-poses, resampling."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from workbench.errors import WorkbenchError
from workbench.mocap import drop_tpose, has_tpose, joint_positions, read_bvh, resample
from workbench.mocap.rotations import axis_rotation, geodesic_angles


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"rotations": np.zeros((5, 3, 3, 3))}, "rotations: got shape"),
        ({"rotations": np.zeros((0, 4, 3, 3))}, "at least one frame"),
        ({"root_translation": np.zeros((5, 3))}, "root_translation: got shape"),
        ({"frame_time": 0.0}, "frame_time: got 0"),
        ({"frame_time": float("nan")}, "frame_time: got nan"),
        ({"frame_time": float("inf")}, "frame_time: got inf"),
        ({"joint_translations": {1: np.zeros((5, 3))}}, "joint_translations"),
        ({"joint_translations": {0: np.zeros((60, 3))}}, "joint from 1 to 3"),
    ],
    ids=["joints", "empty", "path", "zero-time", "nan-time", "inf-time", "moved", "moved-root"],
)
def test_parts_that_do_not_fit_are_refused(waving, change, message):
    """A motion whose parts contradict each other cannot be made."""
    with pytest.raises(WorkbenchError, match=message):
        replace(waving, **change)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"channels": (("Xrotation", "Xrotation"),) * 4}, "at most once"),
        ({"channels": (("Wrotation",),) * 4}, "Wrotation"),
        ({"parents": np.array([-1, 2, 0, 0])}, "an earlier joint"),
        ({"offsets": np.zeros((3, 3))}, "skeleton of 4 joints"),
    ],
    ids=["channel-twice", "unknown-channel", "child-first", "offsets"],
)
def test_impossible_skeletons_are_refused(arm, change, message):
    """A skeleton is checked when it is made."""
    with pytest.raises(WorkbenchError, match=message):
        replace(arm, **change)


def test_slice_keeps_frames_and_clock(waving):
    """A slice with a step has the frames it names and the time between them."""
    moved = replace(waving, joint_translations={1: np.arange(180.0).reshape(60, 3)})
    part = moved[10:40:3]
    np.testing.assert_array_equal(joint_positions(part), joint_positions(moved)[10:40:3])
    assert part.frame_time == pytest.approx(0.1)
    assert len(part) == 10


@pytest.mark.parametrize("frames", [slice(5, 5), slice(None, None, -1), 3], ids=str)
def test_slices_without_frames_are_refused(waving, frames):
    """Neither an empty slice, nor one that runs backwards, nor a single frame is a motion."""
    with pytest.raises(WorkbenchError, match="frames: got"):
        waving[frames]


def _with_tpose(motion):
    """Put a frame at rest before a motion."""
    rest = np.tile(np.eye(3), (1, motion.skeleton.n_joints, 1, 1))
    return replace(
        motion,
        rotations=np.concatenate([rest, motion.rotations]),
        root_translation=np.concatenate([motion.root_translation[:1], motion.root_translation]),
    )


def test_prepended_tpose_is_dropped(waving):
    """A rest pose put before a motion is found, and dropping it gives the motion back."""
    longer = _with_tpose(waving)
    assert has_tpose(longer)
    dropped = drop_tpose(longer)
    np.testing.assert_array_equal(dropped.rotations, waving.rotations)
    np.testing.assert_array_equal(dropped.root_translation, waving.root_translation)


def test_motions_without_tpose_stay_whole(waving):
    """Nothing is dropped without both signs of a T-pose."""
    jumping = waving.rotations.copy()
    jumping[0] = axis_rotation("X", 90) @ jumping[1]
    start = np.linspace(0, 60, len(waving))
    starting = np.tile(axis_rotation("Z", start)[:, None], (1, 4, 1, 1))
    still = np.tile(np.eye(3), (60, 4, 1, 1))
    for rotations in (waving.rotations, jumping, starting, still):
        motion = replace(waving, rotations=rotations)
        assert not has_tpose(motion)
        assert drop_tpose(motion) is motion


@pytest.mark.parametrize("n_frames", [1, 2])
def test_too_short_to_tell(waving, n_frames):
    """Two frames have no usual jump to compare with."""
    assert not has_tpose(_with_tpose(waving)[:n_frames])


def test_tposes_of_the_database(real_mocap):
    """Every clip of the conversion has exactly one T-pose in front, at 30 frames a second too."""
    for clip in sorted((real_mocap / "bvh").glob("*.bvh")):
        motion = read_bvh(clip)
        assert has_tpose(motion), clip.name
        assert not has_tpose(motion[1:][::4]), clip.name
        assert has_tpose(_with_tpose(motion[1:][::4])), clip.name
        assert not has_tpose(motion[1:]), clip.name


def test_resampling_at_the_own_rate_changes_nothing(waving):
    """The same frame time gives the same frames, bit for bit."""
    again = resample(waving, waving.frame_time)
    np.testing.assert_array_equal(again.rotations, waving.rotations)
    np.testing.assert_array_equal(again.root_translation, waving.root_translation)


@pytest.mark.parametrize("step", [2, 3, 7])
def test_resampling_at_multiples_takes_frames(waving, step):
    """A frame time k times as long takes every k-th frame."""
    thinned, expected = resample(waving, waving.frame_time * step), waving[::step]
    np.testing.assert_array_equal(thinned.rotations, expected.rotations)
    np.testing.assert_array_equal(thinned.root_translation, expected.root_translation)
    assert thinned.frame_time == pytest.approx(expected.frame_time)


@pytest.mark.parametrize(
    ("frame_time", "count"), [(0.1, 11), (0.3, 4), (0.05, 21), (5.0, 1)], ids=str
)
def test_uniform_motion_stays_uniform(arm, waving, frame_time, count):
    """A steady turn and a steady walk are sampled from their formulas at any rate."""
    time = np.linspace(0, 1, 11)
    motion = replace(
        waving,
        rotations=np.tile(axis_rotation("Y", 300 * time)[:, None], (1, 4, 1, 1)),
        root_translation=np.outer(time, [1, 2, 3]),
        frame_time=0.1,
        joint_translations={2: np.outer(time, [4, 5, 6])},
    )
    sampled = resample(motion, frame_time)
    new_time = np.arange(count) * frame_time
    assert len(sampled) == count
    expected = axis_rotation("Y", 300 * new_time)
    assert geodesic_angles(sampled.rotations, expected[:, None]).max() < 1e-9
    np.testing.assert_allclose(sampled.root_translation, np.outer(new_time, [1, 2, 3]))
    np.testing.assert_allclose(sampled.joint_translations[2], np.outer(new_time, [4, 5, 6]))


def test_resampling_keeps_the_last_frame_of_real_rates(waving):
    """A rate written with few digits still ends on the last frame."""
    motion = replace(waving, frame_time=0.0083333)
    np.testing.assert_array_equal(
        resample(motion, 0.0083333 / 2).rotations[-1], motion.rotations[-1]
    )


@pytest.mark.parametrize("frame_time", [0.0, -1.0, float("nan"), float("inf")], ids=str)
def test_impossible_frame_times_are_refused(waving, frame_time):
    """A frame time is a positive number."""
    with pytest.raises(WorkbenchError, match="frame_time: got"):
        resample(waving, frame_time)
