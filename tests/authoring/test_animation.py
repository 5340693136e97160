"""Trajectories are played as motions."""

from __future__ import annotations

import numpy as np
import pytest

from workbench import load_space
from workbench.authoring import Trajectory, animate
from workbench.backprojection.poses import SpatialKeyframes
from workbench.errors import WorkbenchError

SPACE = load_space("cmu/01_01-jump")
KEYS = np.array([0, 60, 120, 180, 240, 299])
ANGLES = np.linspace(0.0, 4.0, len(SPACE))
POINTS = np.stack([np.cos(ANGLES), np.sin(ANGLES)], axis=1)


def _model(roots=None):
    return SpatialKeyframes().fit(POINTS[KEYS], SPACE.samples[KEYS], roots)


def test_markers_play_their_own_poses():
    """The trajectory of all frames has the key poses at the keyframes."""
    motion = SPACE.motion
    played = animate(Trajectory.of_frames(POINTS, motion.frame_time), _model(), motion)
    assert len(played) == len(motion)
    assert np.allclose(played.rotations[KEYS], motion.rotations[KEYS], atol=1e-9)
    assert np.array_equal(played.root_translation, np.tile(motion.root_translation[0], (300, 1)))


def test_a_root_that_was_learnt_moves():
    """With root translations the key positions of the root come back too."""
    motion = SPACE.motion
    model = _model(motion.root_translation[KEYS])
    played = animate(Trajectory.of_frames(POINTS, motion.frame_time), model, motion)
    assert np.allclose(played.root_translation[KEYS], motion.root_translation[KEYS], atol=1e-8)


def test_a_deformed_trajectory_gives_another_animation_where_it_was_deformed():
    """Poses change within the radius of a drag and nowhere else."""
    motion = SPACE.motion
    path = Trajectory.of_frames(POINTS, motion.frame_time)
    other = path.dragged(150, POINTS[150] * 0.4, 0.5)
    before, after = animate(path, _model(), motion), animate(other, _model(), motion)
    errors = SPACE.errors(np.arange(300), after.rotations) - SPACE.errors(
        np.arange(300), before.rotations
    )
    assert errors[150] != 0
    assert not errors[:100].any()
    assert not errors[200:].any()


def test_another_skeleton_is_refused():
    """A model of one joint cannot move a body."""
    model = SpatialKeyframes().fit(POINTS[KEYS], SPACE.samples[KEYS][:, :1])
    with pytest.raises(WorkbenchError, match="joints"):
        animate(Trajectory.of_frames(POINTS, 0.01), model, SPACE.motion)
