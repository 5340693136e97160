"""Tests of workbench.mocap.joining."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from workbench.errors import WorkbenchError
from workbench.mocap.joining import join
from workbench.mocap.kinematics import joint_positions


def test_every_frame_of_every_clip_is_kept(waving):
    """Joints are where they were, clip after clip."""
    first, second = waving[:20], replace(waving[20:50], name="rest")
    joined = join([first, second])
    assert joined.name == "waving + rest"
    expected = np.concatenate([joint_positions(first), joint_positions(second)])
    np.testing.assert_array_equal(joint_positions(joined), expected)


def test_joints_that_only_one_clip_moves_rest_in_the_other(waving):
    """Their offset stands in for positions that a clip does not have."""
    path = np.random.default_rng(0).normal(size=(10, 3))
    moving = replace(waving[:10], joint_translations={2: path})
    joined = join([moving, waving[:5]])
    np.testing.assert_array_equal(joined.joint_translations[2][:10], path)
    rest = waving.skeleton.offsets[2]
    np.testing.assert_array_equal(joined.joint_translations[2][10:], np.tile(rest, (5, 1)))


def test_clips_that_do_not_fit_are_refused(waving):
    """The message names the clips and what differs."""
    taller = replace(
        waving,
        skeleton=replace(waving.skeleton, offsets=2 * waving.skeleton.offsets),
        name="taller",
    )
    with pytest.raises(WorkbenchError, match=r"'taller' has another skeleton than 'waving'"):
        join([waving, taller])
    with pytest.raises(WorkbenchError, match=r"15 frames per second and 'waving' 30"):
        join([waving, replace(waving[::2], name="thinned")])
    with pytest.raises(WorkbenchError, match="motions: got none"):
        join([])
