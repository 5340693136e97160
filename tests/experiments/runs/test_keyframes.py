"""Runs of keyframe selectors, against what the library gives step by step."""

from __future__ import annotations

import json

import numpy as np
import pytest

from workbench import load_space
from workbench.errors import WorkbenchError
from workbench.experiments.runs.base import content_key
from workbench.experiments.runs.keyframes import KeyframeRun, motion_curves
from workbench.experiments.runs.shared import SharedSteps
from workbench.interpolation import interpolators
from workbench.mocap.channels import motion_to_euler
from workbench.mocap.kinematics import body_positions
from workbench.quality.animation import body_coordinate_error, femur_length, psnr
from workbench.schemes import TemporalScheme
from workbench.selection import selectors
from workbench.spaces import VectorSpace

CLIP = "cmu/01_01-two-jumps"
CALM = (("sigma", 8.0), ("n_components", 5))


@pytest.fixture(scope="module")
def shared():
    """Give the bundled two jumps."""
    return SharedSteps(load_space(CLIP))


@pytest.fixture(scope="module")
def angles(shared):
    """Give the same jumps as a table of joint angles, as an AMC file without its skeleton."""
    return SharedSteps(VectorSpace(motion_to_euler(shared.space.motion, unwrap=True)))


def test_quality_is_that_of_the_rebuilt_motion(shared):
    """Linear angles and slerp are rebuilt by the library's interpolators and measured by it."""
    row, arrays = KeyframeRun(CLIP, parameters=CALM).execute(shared)
    keys = arrays["control_points"]
    motion = shared.space.motion
    assert np.array_equal(keys, selectors.create("saliency", **dict(CALM)).select(shared.space))
    assert row["n_control_points"] == len(keys)
    linear, slerp = (interpolators.create(n).interpolate(motion, keys) for n in ("linear", "slerp"))
    assert row["psnr"] == pytest.approx(psnr(motion, linear))
    assert row["psnr_slerp"] == pytest.approx(psnr(motion, slerp))
    assert row["body_error"] == pytest.approx(body_coordinate_error(motion, slerp))
    assert row["psnr"] == pytest.approx(20 * np.log10(360 / np.sqrt(row["mean_squared_error"])))


@pytest.mark.parametrize("selector", ["uniform", "pb", "chord", "scs"])
def test_others_get_as_many_keyframes_as_saliency_chooses(shared, selector):
    """The error is that of the scheme with this selector and count."""
    row, _ = KeyframeRun(CLIP, selector, counted_by=CALM).execute(shared)
    count = len(selectors.create("saliency", **dict(CALM)).select(shared.space))
    expected = TemporalScheme("slerp", selector=selector).run(shared.space, count=count)
    assert row["n_control_points"] == count
    assert row["error"] == pytest.approx(expected.error)


def test_no_other_choice_has_a_higher_ratio_than_the_exact_one(shared):
    """The exact selection is the best of all at the same count."""
    ratios = {
        name: KeyframeRun(CLIP, name, counted_by=CALM).execute(shared)[0]["psnr"]
        for name in ("exact", "uniform", "pb", "scs", "chord")
    }
    assert ratios["exact"] == max(ratios.values())


@pytest.mark.parametrize("selector", ["saliency", "chord", "exact", "uniform"])
def test_joint_angles_without_a_skeleton_have_the_same_keyframes(shared, angles, selector):
    """A table gives what the clip gives, but for what needs poses."""
    counted_by = None if selector == "saliency" else CALM
    parameters = CALM if selector == "saliency" else ()
    run = KeyframeRun(CLIP, selector, parameters, counted_by)
    ours, theirs = run.execute(angles), run.execute(shared)
    assert np.array_equal(ours[1]["control_points"], theirs[1]["control_points"])
    assert ours[0]["psnr"] == pytest.approx(theirs[0]["psnr"])
    assert "error" not in ours[0]
    assert "body_error" not in ours[0]


def test_body_coordinates_are_rebuilt_as_positions(shared):
    """Eq. 4.1 by its formula, for positions interpolated linearly."""
    run = KeyframeRun(CLIP, "pb", counted_by=CALM, curves="positions")
    row, arrays = run.execute(shared)
    keys, motion = arrays["control_points"], shared.space.motion
    positions = body_positions(motion).reshape(len(motion), -1)
    frames = np.arange(len(motion))
    rebuilt = np.stack([np.interp(frames, keys, c[keys]) for c in positions.T], axis=1)
    scale = 3.21 / femur_length(motion.skeleton)
    expected = scale**2 * np.sum((positions - rebuilt) ** 2) / (len(motion) * 62)
    assert row["body_error"] == pytest.approx(expected)
    assert "psnr" not in row


def test_values_can_be_stored(shared):
    """JSON holds the row, also where nothing is lost: a ratio that is infinite is None."""
    still = VectorSpace(np.outer(np.arange(40.0), [1.0, 2.0]))
    run = KeyframeRun(CLIP, "uniform", counted_by=(("sigma", 2.0),))
    for steps in (shared, SharedSteps(still)):
        row, _ = run.execute(steps)
        json.dumps({**row, **run.specification()}, allow_nan=False)


@pytest.mark.parametrize(
    "other",
    [
        KeyframeRun(CLIP, parameters=CALM, curves="positions"),
        KeyframeRun(CLIP, parameters=(("sigma", 9.0),)),
        KeyframeRun(CLIP, "pb", counted_by=CALM),
        KeyframeRun(CLIP, "pb", counted_by=(("sigma", 9.0),)),
    ],
    ids=str,
)
def test_runs_that_differ_have_different_keys(other):
    """No run finds the result of another."""
    assert content_key(other, "data") != content_key(KeyframeRun(CLIP, parameters=CALM), "data")


def test_runs_without_a_count_and_unknown_curves_are_refused(angles):
    """The message names what is missing; a table has no positions."""
    with pytest.raises(WorkbenchError, match="counted_by: got None for 'pb'"):
        KeyframeRun(CLIP, "pb")
    with pytest.raises(WorkbenchError, match="curves: got 'quaternions'"):
        KeyframeRun(CLIP, curves="quaternions")
    with pytest.raises(WorkbenchError, match="no skeleton"):
        motion_curves(angles.space, "positions")
