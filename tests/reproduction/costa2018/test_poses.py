"""Authoring in pictures: repeatable in place of what the thesis does by hand."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from workbench import load_space
from workbench.authoring import Trajectory
from workbench.errors import WorkbenchError
from workbench.figures.stick_figures import stick_figures
from workbench.figures.views import best_view
from workbench.reproduction.costa2018 import embeddings, poses

ANGLES = np.linspace(0.0, 2 * np.pi, 101)
CIRCLE = np.stack([np.cos(ANGLES), np.sin(ANGLES)], axis=1)
KEYS = np.array([0, 25, 50, 75, 100])


def test_both_projections_are_planned_and_one_is_shared():
    """The curve of MDS is that of Figure 6.2."""
    runs = {str(run) for run in poses.planned_runs("quick", 0)}
    assert len(runs) == 2
    assert runs & {str(run) for run in embeddings.planned_runs("quick", 0)}


def test_a_curve_is_bent_in_its_middle_and_keeps_its_ends():
    """The middle goes to the farthest marker; both ends and all times stay."""
    path = Trajectory.of_frames(CIRCLE, 0.01)
    bent, dragged = poses.bent(path, KEYS)
    assert dragged == 50
    assert np.allclose(bent.points[50], [1.0, 0.0])
    assert np.array_equal(bent.points[[0, -1]], path.points[[0, -1]])
    assert np.array_equal(bent.times, path.times)


def test_keyframes_that_are_kept_are_apart():
    """Of two markers at one place the earlier stays, and what is apart stays."""
    assert poses.apart(CIRCLE, KEYS).tolist() == [0, 25, 50, 75]


def test_markers_show_their_own_poses():
    """At a marker the stick figure is that of its keyframe."""
    motion = load_space("cmu/01_01-jump").motion
    points = np.stack([np.linspace(0, 1, 300), np.linspace(0, 1, 300) ** 2], axis=1)
    keys = np.array([0, 100, 200, 299])
    shown = poses.poses_on_map(motion, points, keys, points[keys])
    own = stick_figures(motion, keys, best_view(motion), in_place=True)
    apart = shown.segments - shown.segments[:, :1, :1] - own.segments + own.segments[:, :1, :1]
    assert np.abs(apart).max() < 1e-6


def test_points_to_look_at_are_four_frames_and_the_centre():
    """The last of five lies in the middle of the map."""
    looked_at = poses.points_to_look_at(CIRCLE)
    assert np.array_equal(looked_at[:4], CIRCLE[[20, 40, 60, 80]])
    assert np.allclose(looked_at[4], 0.0, atol=1e-3)


def test_a_run_that_is_missing_is_told():
    """Without the projection there is nothing to author with."""
    table = pd.DataFrame({"status": ["failed"], "scheme": ["tsne, rols"], "key": ["x"]})
    with pytest.raises(WorkbenchError, match="not finished"):
        poses.arrays_of(table, None, poses.SEPARATING)
