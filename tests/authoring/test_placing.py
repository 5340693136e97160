"""Frames and new poses are placed around markers."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from sklearn.base import BaseEstimator

from workbench import load_space
from workbench.authoring import (
    best_place,
    edits,
    influence,
    placed,
    reconstruction_error,
    refined,
    scene_from_clip,
    scene_on_circle,
    spatial_keyframes,
)
from workbench.errors import WorkbenchError
from workbench.optimization.objective import Objective
from workbench.projection.rbfp import RBFP
from workbench.spaces import PoseSpace


def _with_pose(scene, jump):
    """Add a pose that no frame has, between frames in the order of markers."""
    pose = edits.turned(jump.samples[20], 4, [25.0, 0.0, -40.0])
    added = edits.add_pose(scene, pose, np.zeros(3), [0.25, 0.8])
    return edits.add_frame(added, jump, 13)


def test_influence_is_rbfp(scene, jump):
    """Wherever the markers are, their influence places the frames as RBFP does."""
    shares = influence(jump, scene.markers)
    positions = np.random.default_rng(0).random((len(scene.markers), 2))
    expected = RBFP(epsilon=1.0).fit(jump, scene.frames, positions).transform(jump.samples)
    assert_allclose(shares @ positions, expected, atol=1e-9)
    assert np.array_equal(shares[scene.frames], np.eye(len(scene.markers)))


def test_influence_of_new_poses_is_rbfp(scene, jump):
    """A new pose counts like a frame of the clip that is appended to it."""
    other = _with_pose(scene, jump)
    motion = jump.motion
    poses = np.concatenate([motion.rotations, other.poses[6:7]])
    roots = np.concatenate([motion.root_translation, np.zeros((1, 3))])
    extended = PoseSpace(replace(motion, rotations=poses, root_translation=roots))
    frames = np.where(other.frames < 0, len(jump), other.frames)
    order = np.argsort(frames)
    fitted = RBFP().fit(extended, frames[order], other.positions[order])
    shares = influence(jump, other.markers)
    assert shares.shape == (len(jump), len(other.markers))
    assert_allclose(shares @ other.positions, fitted.transform(jump.samples), atol=1e-9)


def test_placing_agrees_with_the_influence(scene, jump):
    """What the browser shows while a marker is dragged is what Python then keeps."""
    other = _with_pose(scene, jump)
    shown = influence(jump, other.markers) @ other.positions
    kept = placed(other, jump)
    assert_allclose(kept.embedding, shown, atol=1e-12)
    assert np.array_equal(kept.embedding[13], other.markers[-1].position)


def test_refining_lowers_the_error_of_every_frame(scene, jump):
    """No frame is rebuilt worse than before, and the whole clip better."""
    moved = edits.move_marker(scene, jump, 3, [0.1, 0.9])
    result = refined(moved, jump)
    free = np.setdiff1d(np.arange(len(jump)), moved.frames)
    objective = Objective.of(jump, spatial_keyframes(moved))
    before = objective(moved.embedding[free], free)
    after = objective(result.scene.embedding[free], free)
    assert np.all(after <= before)
    assert result.after < 0.9 * result.before
    assert result.before == pytest.approx(reconstruction_error(moved, jump), rel=1e-9)
    assert result.after == pytest.approx(reconstruction_error(result.scene, jump), rel=1e-9)
    assert all(a.equals(b) for a, b in zip(result.scene.markers, moved.markers, strict=True))
    assert np.array_equal(result.scene.trajectory.points, result.scene.embedding)


def test_an_optimizer_that_raises_errors_is_not_believed(scene, jump):
    """Frames that an optimizer put where they are worse stay where they were."""

    class Scatter:
        def optimize(self, objective, embedding, free, neighbors, callback=None):
            from workbench.optimization.objective import OptimizationResult

            places = embedding + np.random.default_rng(1).normal(size=embedding.shape)
            errors = objective(places[free], free)
            return OptimizationResult(places, errors, np.zeros(2), 0, "scattered")

    result = refined(scene, jump, optimizer=Scatter())
    assert result.after <= result.before
    assert (result.scene.embedding == scene.embedding).all(axis=1).sum() > len(jump) // 2


def test_refining_can_be_stopped(scene, jump):
    """A true answer to the callback ends the search, with what it has found so far."""
    calls = []
    result = refined(scene, jump, callback=lambda *now: calls.append(now) or True)
    assert len(calls) == 1
    assert "callback" in result.reason
    assert result.after <= result.before


def test_a_scene_of_markers_alone_needs_no_refining(jump):
    """Where every frame has a marker there is nothing to move."""
    few = jump.subset(np.arange(0, 50, 10))
    circle = scene_on_circle(few, "few", selector="uniform", count=4)
    last = int(np.setdiff1d(np.arange(5), circle.frames)[0])
    full = edits.add_frame(circle, few, last)
    assert refined(full, few).scene.equals(full)
    assert reconstruction_error(full, few) == 0.0


def test_the_best_place_of_a_frame_is_where_it_is_rebuilt_best(scene, jump):
    """From a seed nearby the optimizer finds a place at least as good as the seed."""
    seed = scene.embedding[24] + 0.05
    place = best_place(scene, jump, jump.samples[24], seed)
    objective = Objective.of(jump, spatial_keyframes(scene))
    errors = objective(np.stack([seed, place]), [24, 24])
    assert errors[1] < errors[0]


def test_a_new_pose_is_not_placed_on_a_marker(scene, jump):
    """The turned pose of a marker is most like that marker, and gets a place beside it."""
    marker = scene.markers[2]
    pose = edits.turned(marker.rotations, 20, [5.0, 0.0, 0.0])
    place = best_place(scene, jump, pose, marker.position)
    gap = np.linalg.norm(scene.positions - place, axis=1).min()
    extent = np.ptp(scene.positions, axis=0).max()
    assert 0.005 * extent < gap < 0.2 * extent
    added = edits.add_pose(scene, pose, marker.root, place)
    assert_allclose(spatial_keyframes(added).predict([place])[0], pose, atol=1e-6)


@pytest.mark.parametrize("projector", ["pca", "mds", "isomap"])
def test_a_scene_begins_with_a_projection(jump, projector):
    """Markers are the chosen frames, where the projector put them; the curve is the clip's."""
    scene = scene_from_clip(jump, "jump", selector="scs", count=7, projector=projector)
    assert scene.clip == "jump"
    assert np.array_equal(scene.positions, scene.embedding[scene.frames])
    assert_allclose(scene.trajectory.times, np.arange(50) * jump.motion.frame_time)
    assert scene.follows


def test_a_scene_begins_with_an_own_projector(jump):
    """Any object with ``fit_transform`` will do that gives a plane; space is refused."""

    class Firsts(BaseEstimator):
        def __init__(self, width=2):
            self.width = width

        def fit_transform(self, samples, y=None):
            return samples[:, : self.width]

    scene = scene_from_clip(jump, selector="uniform", count=4, projector=Firsts())
    assert scene.embedding.shape == (50, 2)
    with pytest.raises(WorkbenchError, match="gives 3 dimensions"):
        scene_from_clip(jump, selector="uniform", count=4, projector=Firsts(3))


def test_a_scene_begins_on_a_circle(jump):
    """Markers are on a circle in the order of time; the frames between them follow RBFP."""
    scene = scene_on_circle(jump, "jump", selector="scs", count=8)
    away = scene.positions - 0.5
    assert_allclose(np.linalg.norm(away, axis=1), 0.5)
    turns = np.diff(np.unwrap(np.arctan2(away[:, 1], away[:, 0])))
    assert_allclose(turns, -np.pi / 4)
    assert np.all(np.diff(scene.frames) > 0)
    assert scene.equals(placed(scene, jump))


def test_a_start_needs_a_motion_and_three_markers(jump):
    """Tables have no poses; two markers make no plane."""
    with pytest.raises(WorkbenchError, match="want a motion"):
        scene_on_circle(load_space("uci/iris"), count=5)
    with pytest.raises(WorkbenchError, match="at least 3"):
        scene_from_clip(jump, selector="uniform", count=2, projector="pca")


def test_markers_of_another_skeleton_or_clip_are_refused(scene, jump):
    """Influence and places are asked for a clip that has these frames and joints."""
    with pytest.raises(WorkbenchError, match="frame 49 of the 40"):
        influence(jump.subset(np.arange(40)), scene.markers)
    short = [replace(marker, rotations=marker.rotations[:9]) for marker in scene.markers]
    with pytest.raises(WorkbenchError, match="9 joints"):
        influence(jump, short)
    with pytest.raises(WorkbenchError, match="9 joints"):
        best_place(scene, jump, jump.samples[0, :9], [0.0, 0.0])
    with pytest.raises(WorkbenchError, match="want a motion"):
        refined(scene, load_space("uci/iris"))
