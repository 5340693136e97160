"""Tests of workbench.quality.animation."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.datasets import load_space
from workbench.errors import WorkbenchError
from workbench.interpolation.linear import Linear
from workbench.mocap import body_positions, motion_to_euler, rotations_from_channels
from workbench.mocap.rotations import axis_rotation
from workbench.mocap.skeleton import Skeleton
from workbench.quality.animation import (
    angle_errors,
    body_coordinate_error,
    body_coordinate_errors,
    femur_length,
    joint_angle_errors,
    psnr,
    psnr_of_error,
)


@pytest.fixture(scope="module")
def jump():
    """Give the bundled jump and its linear reconstruction from every 20th frame."""
    motion = load_space("cmu/01_01-jump").motion
    keys = np.union1d(np.arange(0, len(motion), 20), [len(motion) - 1])
    return motion, Linear().interpolate(motion, keys)


def test_body_coordinate_error_of_a_known_turn(arm, waving):
    """A lower arm of length 3 under a turned joint: each shift is known by hand."""
    # The joint "lower" hangs 2 from "upper": turned by 90 degrees, it moves by 2·√2.
    rotations = np.tile(np.eye(3), (60, 4, 1, 1))
    straight = replace(waving, rotations=rotations)
    turned = rotations.copy()
    turned[:30, 1] = axis_rotation("Z", 90.0)
    errors = body_coordinate_errors(straight, turned, femur=3.21, n_dimensions=4)
    assert np.allclose(errors[:30], 8.0 / 4)
    assert np.allclose(errors[30:], 0.0)
    assert body_coordinate_error(straight, turned, femur=6.42, n_dimensions=4) == pytest.approx(
        8.0 / 4 / 4 / 2
    )


def test_body_coordinate_error_is_the_printed_formula(jump):
    """Eq. 4.1 over frames and joints, scaled to a femur of 3.21, with j = 62."""
    motion, rebuilt = jump
    scale = 3.21 / femur_length(motion.skeleton)
    total = 0.0
    original, other = body_positions(motion), body_positions(replace(motion, rotations=rebuilt))
    for i in range(len(motion)):
        for k in range(motion.skeleton.n_joints):
            total += sum((scale * (original[i, k] - other[i, k])) ** 2)
    assert body_coordinate_error(motion, rebuilt) == pytest.approx(total / (len(motion) * 62))


def test_body_coordinates_know_neither_the_root_nor_the_scale(jump):
    """A turned root costs nothing, and a body twice as large has the same error."""
    motion, rebuilt = jump
    turned = rebuilt.copy()
    turned[:, 0] = axis_rotation("X", 33.0) @ turned[:, 0]
    expected = body_coordinate_error(motion, rebuilt)
    assert body_coordinate_error(motion, turned) == pytest.approx(expected)
    large = replace(motion.skeleton, offsets=2 * motion.skeleton.offsets)
    assert body_coordinate_error(replace(motion, skeleton=large), rebuilt) == pytest.approx(
        expected
    )


def test_the_femur_is_the_bone_above_the_lower_leg(jump):
    """By the names of the CMU conversion: from LeftUpLeg to LeftLeg."""
    skeleton = jump[0].skeleton
    expected = np.linalg.norm(skeleton.offsets[skeleton.names.index("LeftLeg")])
    assert femur_length(skeleton) == pytest.approx(expected)


@pytest.mark.parametrize(
    "leg",
    [("Hip", "Knee", "Ankle"), ("UpLeg", "Leg", "Foot", "Toe"), ("Hip", "Knee", "Ankle", "Foot")],
    ids=["ankle", "foot", "ankle and foot"],
)
def test_the_femur_hangs_on_the_hip_whatever_the_foot_is_called(leg):
    """The second joint of the leg is the knee, also where the foot is below the ankle."""
    assert femur_length(two_legs(leg)) == 2.0


def test_toes_alone_do_not_tell_the_femur():
    """There may be a joint between the toes and the shin."""
    with pytest.raises(WorkbenchError, match="femur: found no leg"):
        femur_length(two_legs(("Thigh", "Shin", "Heel", "Toe")))


def two_legs(leg):
    """Make a skeleton of two equal legs, whose bones are 1, 2, 3, … long."""
    names, parents, offsets = ["Hips"], [-1], [[0.0, 9.0, 0.0]]
    for side in ("Left", "Right"):
        for i, part in enumerate(leg):
            parents.append(len(names) - 1 if i else 0)
            names.append(side + part)
            offsets.append([0.0, -1.0 - i, 0.0])
    return Skeleton(tuple(names), np.array(parents), np.array(offsets), (), ((),) * len(names))


def test_psnr_is_the_printed_formula():
    """An error of 3.6 degrees everywhere is a hundredth of 360: 40 dB; none is infinite."""
    assert psnr_of_error(3.6**2) == pytest.approx(40.0)
    assert np.allclose(psnr_of_error([0.0, 360.0**2]), [np.inf, 0.0])


def test_psnr_of_a_motion_is_that_of_its_angles(jump):
    """On angles that stay away from gimbal lock, rotations and their angles agree."""
    motion, rebuilt = jump
    keys = np.union1d(np.arange(0, len(motion), 20), [len(motion) - 1])
    original = motion_to_euler(motion, unwrap=True)
    frames = np.arange(len(motion))
    linear = np.stack([np.interp(frames, keys, c[keys]) for c in original.T], axis=1)
    errors = angle_errors(original, linear)
    assert np.allclose(joint_angle_errors(motion, rebuilt), errors, atol=1e-9)
    assert psnr(motion, rebuilt) == pytest.approx(psnr_of_error(errors.mean()))


def test_one_turned_joint_has_a_known_ratio(waving):
    """Four degrees in one of twelve angles."""
    angles = motion_to_euler(waving)
    angles[:, 4] += 4.0
    rebuilt = rotations_from_channels(waving.skeleton, angles)
    assert np.allclose(joint_angle_errors(waving, rebuilt), 16.0 / 12)
    assert psnr(waving, rebuilt) == pytest.approx(20 * np.log10(360 / np.sqrt(16 / 12)))


@settings(max_examples=30, deadline=None)
@given(seed=st.integers(0, 2**32 - 1))
def test_angles_that_stand_for_one_rotation_are_one(waving_far, seed):
    """Full turns and the other representative of three angles cost nothing."""
    rng = np.random.default_rng(seed)
    angles = motion_to_euler(waving_far)
    turns = angles + 360.0 * rng.integers(-3, 4, angles.shape)
    assert np.allclose(angle_errors(angles, turns), 0.0, atol=1e-18)
    small = rng.normal(size=angles.shape)
    rebuilt = rotations_from_channels(waving_far.skeleton, angles + small)
    assert np.all(joint_angle_errors(waving_far, rebuilt) <= np.mean(small**2, axis=1) + 1e-9)


@pytest.fixture(scope="module")
def waving_far():
    """Give a motion whose angles pass 180 degrees and the gimbal lock."""
    motion = load_space("cmu/01_01-jump").motion[:40]
    n_angles = motion_to_euler(motion).shape[1]
    degrees = np.linspace(-300, 300, 40)[:, None] * np.linspace(-1, 1, n_angles)
    return replace(motion, rotations=rotations_from_channels(motion.skeleton, degrees))


def test_a_perfect_reconstruction_has_no_error(jump):
    """Nothing lost: no error in body coordinates, an infinite ratio but for rounding."""
    motion = jump[0]
    assert body_coordinate_error(motion, motion.rotations) == 0.0
    assert psnr(motion, motion.rotations) > 250


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda m: psnr(m, m.rotations[1:]), r"rotations: got shape \(59, 4, 3, 3\), want \(60"),
        (lambda m: psnr(m, m.rotations * np.nan), "rotations: got nan"),
        (lambda m: psnr(m, "none"), "rotations: got what is no array of numbers"),
        (lambda m: psnr(m, -m.rotations), "rotations: got matrices .* mirrored"),
        (lambda m: body_coordinate_errors(m, 2 * m.rotations), "rotations: got matrices .* orth"),
        (lambda m: body_coordinate_error(m, m.rotations, femur="long"), "femur: got 'long'"),
        (lambda m: body_coordinate_error(m, m.rotations), "femur: found no leg"),
        (lambda m: body_coordinate_error(m, m.rotations, femur=0), "femur: got 0"),
        (
            lambda m: body_coordinate_error(m, m.rotations, femur=1, n_dimensions=0),
            "n_dimensions: got 0",
        ),
        (lambda m: angle_errors([[1.0]], [[1.0, 2.0]]), r"got shapes \(1, 1\) and \(1, 2\)"),
        (lambda m: angle_errors([[np.inf]], [[1.0]]), "original: got inf"),
        (lambda m: angle_errors([["a"]], [[1.0]]), "original: got what is no array of numbers"),
        (lambda m: psnr_of_error("loud"), "mean_squared_error: got what is no array"),
        (lambda m: psnr_of_error(-1.0), "mean_squared_error: got a negative"),
        (lambda m: psnr_of_error(np.nan), "mean_squared_error: got a negative or missing"),
    ],
    ids=[
        "shape",
        "nan",
        "word",
        "mirrored",
        "scaled",
        "femur word",
        "no leg",
        "femur",
        "j",
        "shapes",
        "inf",
        "letters",
        "error word",
        "negative",
        "missing",
    ],
)
def test_bad_input_is_refused(waving, call, message):
    """The message names the argument."""
    with pytest.raises(WorkbenchError, match=message):
        call(waving)
