"""Tests of forward kinematics."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings

from tests.mocap.strategies import motions
from workbench.errors import WorkbenchError
from workbench.mocap import (
    body_positions,
    end_site_positions,
    forward_kinematics,
    joint_positions,
    root_relative_positions,
)
from workbench.mocap.rotations import axis_rotation


def _by_recursion(motion, frame, joint):
    """Give a joint's world rotation and position from the definition, one joint at a time."""
    rotation = motion.rotations[frame, joint]
    parent = motion.skeleton.parents[joint]
    if parent < 0:
        return rotation, motion.root_translation[frame]
    world, origin = _by_recursion(motion, frame, parent)
    moved = motion.joint_translations.get(joint)
    offset = motion.skeleton.offsets[joint] if moved is None else moved[frame]
    return world @ rotation, origin + world @ offset


def test_known_geometry(arm):
    """An arm bent at right angles is where a drawing puts it."""
    rotations = np.tile(np.eye(3), (1, 4, 1, 1))
    rotations[0, 0] = axis_rotation("Z", 90)
    rotations[0, 1] = axis_rotation("X", 90)
    positions = forward_kinematics(arm, rotations, [[10, 0, 0]])
    np.testing.assert_allclose(
        positions[0], [[10, 0, 0], [10, 1, 0], [10, 1, 2], [10, 0, 1]], atol=1e-15
    )


def test_end_sites_hang_on_their_joints(waving):
    """End sites are fixed points of their joints' frames."""
    ends = end_site_positions(waving)
    for row, site in enumerate(waving.skeleton.end_sites):
        for frame in (0, 17, 59):
            world, origin = _by_recursion(waving, frame, site.joint)
            np.testing.assert_allclose(ends[frame, row], origin + world @ site.offset, atol=1e-12)


@settings(max_examples=50, deadline=None)
@given(motion=motions())
def test_agrees_with_the_definition(motion):
    """The compiled loop gives what the recursive definition gives."""
    positions = joint_positions(motion)
    expected = [
        [_by_recursion(motion, frame, joint)[1] for joint in range(motion.skeleton.n_joints)]
        for frame in range(len(motion))
    ]
    np.testing.assert_allclose(positions, expected, atol=1e-9)


def test_bones_keep_their_length(waving):
    """Rotations never stretch a bone."""
    positions = joint_positions(waving)
    parents = waving.skeleton.parents[1:]
    lengths = np.linalg.norm(positions[:, 1:] - positions[:, parents], axis=2)
    expected = np.linalg.norm(waving.skeleton.offsets[1:], axis=1)
    np.testing.assert_allclose(lengths, np.tile(expected, (len(waving), 1)), atol=1e-12)


def test_root_relative_positions_lose_the_path_only(waving):
    """Positions seen from the root are world positions minus the root's."""
    world = joint_positions(waving)
    np.testing.assert_allclose(root_relative_positions(waving), world - world[:, :1], atol=1e-12)


def test_body_positions_ignore_place_and_heading(waving):
    """Walking elsewhere and facing another way does not change body positions."""
    turned = waving.rotations.copy()
    turned[:, 0] = axis_rotation("Y", np.linspace(0, 300, len(waving))) @ turned[:, 0]
    elsewhere = replace(waving, rotations=turned, root_translation=3.0 - waving.root_translation)
    np.testing.assert_allclose(body_positions(elsewhere), body_positions(waving), atol=1e-12)
    world = root_relative_positions(waving)
    unturned = np.einsum("fij,fkj->fki", waving.rotations[:, 0].swapaxes(1, 2), world)
    np.testing.assert_allclose(body_positions(waving), unturned, atol=1e-12)


def test_inputs_are_left_alone(waving):
    """Computing positions changes nothing in the motion."""
    rotations, path = waving.rotations.copy(), waving.root_translation.copy()
    joint_positions(waving)[:] = 0
    body_positions(waving)[:] = 0
    np.testing.assert_array_equal(waving.rotations, rotations)
    np.testing.assert_array_equal(waving.root_translation, path)


@pytest.mark.parametrize(
    ("rotations", "translation", "message"),
    [
        (np.zeros((5, 3, 3, 3)), np.zeros((5, 3)), "rotations: got shape"),
        (np.zeros((5, 4, 3)), np.zeros((5, 3)), "rotations: got shape"),
        (np.zeros((5, 4, 3, 3)), np.zeros((4, 3)), "root_translation: got shape"),
    ],
    ids=["joints", "dimensions", "frames"],
)
def test_shapes_that_do_not_fit_are_refused(arm, rotations, translation, message):
    """A wrong shape is named before anything is computed."""
    with pytest.raises(WorkbenchError, match=message):
        forward_kinematics(arm, rotations, translation)
