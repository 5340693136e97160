"""Tests of Euler angles by channel."""

from __future__ import annotations

from dataclasses import replace
from itertools import permutations

import numpy as np
import pytest
from hypothesis import given, settings

from tests.mocap.strategies import motions
from workbench.errors import WorkbenchError
from workbench.mocap import (
    Motion,
    Skeleton,
    channels_from_rotations,
    motion_to_euler,
    rotations_from_channels,
)
from workbench.mocap.channels import rotation_columns
from workbench.mocap.rotations import geodesic_angles, rotations_from_euler

_ORDERS = ["".join(axes) for n in (1, 2, 3) for axes in permutations("XYZ", n)]


def _single(order):
    channels = tuple(f"{axis}rotation" for axis in order)
    return Skeleton(("joint",), np.array([-1]), np.zeros((1, 3)), (), (channels,))


@pytest.mark.parametrize("order", _ORDERS)
def test_angles_of_every_order_come_back(order):
    """Angles within the range of a joint's channels are found again exactly."""
    limit = {1: [179], 2: [179, 179], 3: [179, 89, 179]}[len(order)]
    degrees = np.random.default_rng(0).uniform(-1, 1, (500, len(order))) * limit
    rotations = rotations_from_channels(_single(order), degrees)
    np.testing.assert_allclose(rotations[:, 0], rotations_from_euler(order, degrees), atol=1e-14)
    np.testing.assert_allclose(
        channels_from_rotations(_single(order), rotations), degrees, atol=1e-10
    )


@settings(max_examples=100, deadline=None)
@given(motion=motions())
def test_rotations_come_back(motion):
    """Decomposing and composing again gives the same rotations, unwrapped or not."""
    for unwrap in (False, True):
        degrees = motion_to_euler(motion, unwrap=unwrap)
        rotations = rotations_from_channels(motion.skeleton, degrees)
        assert np.degrees(geodesic_angles(rotations, motion.rotations).max()) < 1e-6


def test_columns_follow_the_joints(arm):
    """Joints with fewer channels take fewer columns."""
    channels = (arm.channels[0], (), ("Yrotation",), ("Zrotation", "Xrotation"))
    columns = rotation_columns(replace(arm, channels=channels))
    assert [(c.start, c.stop) for c in columns] == [(0, 3), (3, 3), (3, 4), (4, 6)]


@pytest.mark.parametrize("order", ["ZYX", "XYZ", "YXZ"])
def test_unwrapped_curves_pass_the_gimbal(order):
    """A smooth path through half turns and gimbal lock gives the smooth curves it was made of."""
    t = np.linspace(0, 1, 401)
    degrees = np.stack([20 + 700 * t, -30 + 410 * t, 50 - 300 * t], axis=1)
    skeleton = _single(order)
    motion = Motion(skeleton, rotations_from_channels(skeleton, degrees), np.zeros((401, 3)), 0.01)
    wrapped, curves = motion_to_euler(motion), motion_to_euler(motion, unwrap=True)
    np.testing.assert_allclose(curves, degrees, atol=1e-8)
    assert np.abs(np.diff(wrapped, axis=0)).max() > 170
    assert np.abs(np.diff(curves, axis=0)).max() < 2


def test_inexpressible_rotation_is_refused(arm):
    """A hinge cannot hold a rotation about another axis; the error names joint and frame."""
    hinge = replace(arm, channels=(*arm.channels[:3], ("Xrotation",)))
    rotations = np.tile(np.eye(3), (5, 4, 1, 1))
    rotations[3, 3] = rotations_from_euler("ZX", [10.0, 40.0])
    with pytest.raises(WorkbenchError, match=r"joint 3 \(other\) has in frame 3 .* by 10 degrees"):
        channels_from_rotations(hinge, rotations)


@pytest.mark.parametrize("shape", [(5, 11), (12,), (5, 4, 3)], ids=str)
def test_wrong_number_of_columns_is_refused(arm, shape):
    """Angles that do not fit the channels are refused."""
    with pytest.raises(WorkbenchError, match=r"want \(n_frames, 12\)"):
        rotations_from_channels(arm, np.zeros(shape))
