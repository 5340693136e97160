"""Each edit does what it says and nothing else."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from workbench.authoring import edits, placed, reconstruction_error, spatial_keyframes
from workbench.errors import WorkbenchError
from workbench.mocap.rotations import axis_rotation
from workbench.projection.rbfp import RBFP


def _others_equal(scene, other, *changed):
    """Tell whether nothing but some of a scene's parts has changed."""
    same = replace(other, **{name: getattr(scene, name) for name in changed})
    return same.equals(scene)


def test_a_moved_marker_takes_the_frames_along(scene, jump):
    """All frames are placed by RBFP around the markers, and the trajectory follows."""
    moved = edits.move_marker(scene, jump, 2, [0.9, 0.1])
    assert moved.markers[2].position.tolist() == [0.9, 0.1]
    frames = moved.frames
    expected = RBFP().fit(jump, frames, moved.positions).transform(jump.samples)
    assert_allclose(moved.embedding, expected, atol=1e-8)
    assert np.array_equal(moved.trajectory.points, moved.embedding)
    assert np.array_equal(moved.trajectory.times, scene.trajectory.times)


def test_a_drawn_trajectory_stays_when_a_marker_moves(scene, jump):
    """Who drew a curve keeps it; the clip's places behind it follow the markers."""
    drawn = edits.draw(scene, [[0.1, 0.1], [0.9, 0.9]], [0.0, 1.0])
    moved = edits.move_marker(drawn, jump, 2, [0.9, 0.1])
    assert np.array_equal(moved.trajectory.points, drawn.trajectory.points)
    assert not np.array_equal(moved.embedding, drawn.embedding)


def test_a_frame_becomes_a_marker_where_it_is(scene, jump):
    """Nothing moves, and the frame is from then on rebuilt exactly."""
    added = edits.add_frame(scene, jump, 5)
    assert _others_equal(scene, added, "markers")
    assert [m.equals(n) for m, n in zip(scene.markers, added.markers, strict=False)] == [True] * 6
    assert np.array_equal(added.markers[-1].position, scene.embedding[5])
    rebuilt = spatial_keyframes(added).predict(added.embedding[[5]])[0]
    assert_allclose(rebuilt, jump.samples[5], atol=1e-9)


def test_a_frame_becomes_a_marker_elsewhere(scene, jump):
    """The frames are placed anew around all markers."""
    added = edits.add_frame(scene, jump, 5, [0.5, 0.9], "crouch")
    assert added.embedding[5].tolist() == [0.5, 0.9]
    assert added.equals(placed(added, jump))
    assert added.markers[-1].name == "crouch"


def test_a_new_pose_moves_nothing(scene, jump):
    """A new pose is rebuilt at its place; numbers of names are not given twice."""
    pose = edits.turned(jump.samples[3], 5, [10.0, 20.0, 30.0])
    added = edits.add_pose(scene, pose, [0.0, 1.0, 0.0], [0.2, 0.7])
    assert _others_equal(scene, added, "markers")
    model = spatial_keyframes(added)
    assert_allclose(model.predict([[0.2, 0.7]])[0], pose, atol=1e-9)
    assert_allclose(model.predict_root([[0.2, 0.7]])[0], [0.0, 1.0, 0.0], atol=1e-9)
    again = edits.add_pose(added, pose, [0.0, 1.0, 0.0], [0.3, 0.7])
    assert [marker.name for marker in again.markers[-2:]] == ["pose 1", "pose 2"]
    fewer = edits.remove_marker(again, 6)
    assert edits.add_pose(fewer, pose, np.zeros(3), [0.4, 0.7]).markers[-1].name == "pose 1"


def test_a_removed_marker_leaves_the_places(scene):
    """Only the marker goes; three have to stay."""
    fewer = edits.remove_marker(scene, 1)
    assert _others_equal(scene, fewer, "markers")
    assert fewer.frames.tolist() == np.delete(scene.frames, 1).tolist()
    fewer = edits.remove_marker(edits.remove_marker(fewer, 0), 0)
    with pytest.raises(WorkbenchError, match="at least 3"):
        edits.remove_marker(fewer, 0)


def test_a_renamed_marker_has_another_name_only(scene):
    """Blanks around a name go."""
    renamed = edits.rename_marker(scene, 4, "  landing ")
    assert renamed.markers[4].name == "landing"
    assert edits.rename_marker(renamed, 4, scene.markers[4].name).equals(scene)


def test_a_joint_turns_about_its_own_axes(jump):
    """Turns about x, y and z follow each other in the joint's own axes; others stay."""
    pose = edits.turned(jump.samples[0], 3, [30.0, -20.0, 50.0])
    expected = jump.samples[0, 3] @ axis_rotation("X", 30.0)
    expected = expected @ axis_rotation("Y", -20.0) @ axis_rotation("Z", 50.0)
    assert_allclose(pose[3], expected, atol=1e-15)
    assert np.array_equal(np.delete(pose, 3, axis=0), np.delete(jump.samples[0], 3, axis=0))
    assert np.array_equal(edits.turned(jump.samples[0], 3, [0.0, 0.0, 0.0]), jump.samples[0])


def test_a_turned_marker_is_no_frame_any_more(scene):
    """The marker itself gets the pose where no place is given."""
    turned = edits.turn_joint(scene, 2, 8, [0.0, 45.0, 0.0])
    marker = turned.markers[2]
    assert (marker.frame, marker.name) == (None, f"{scene.markers[2].name}, turned")
    assert np.array_equal(marker.position, scene.markers[2].position)
    assert np.array_equal(
        marker.rotations, edits.turned(scene.markers[2].rotations, 8, [0.0, 45.0, 0.0])
    )
    assert _others_equal(scene, turned, "markers")
    again = edits.turn_joint(turned, 2, 8, [0.0, 45.0, 0.0])
    assert again.markers[2].name == marker.name


def test_a_turned_pose_elsewhere_is_a_new_marker(scene):
    """With a place, the marker that was turned stays as it is."""
    turned = edits.turn_joint(scene, 2, 8, [0.0, 45.0, 0.0], at=[0.1, 0.9], name="reach")
    assert edits.remove_marker(turned, 6).equals(scene)
    assert (turned.markers[6].name, turned.markers[6].frame) == ("reach", None)
    assert np.array_equal(turned.markers[6].root, scene.markers[2].root)


def test_deforming_drags_the_curve(scene):
    """The curve is dragged as the trajectory does it, and follows no more."""
    deformed = edits.deform(scene, 20, [0.5, 0.5], 0.3)
    expected = scene.trajectory.dragged(20, [0.5, 0.5], 0.3)
    assert np.array_equal(deformed.trajectory.points, expected.points)
    assert not deformed.follows
    assert _others_equal(scene, deformed, "trajectory", "follows")


def test_a_drawing_replaces_the_trajectory(scene):
    """It begins at 0 s, lasts as long as the hand took, and follows no more."""
    drawn = edits.draw(scene, [[0.0, 0.0], [0.5, 0.5], [1.0, 0.0]], [12.0, 12.05, 12.1])
    assert drawn.trajectory.times[0] == 0.0
    assert drawn.trajectory.duration == pytest.approx(0.1)
    assert drawn.trajectory.points[[0, -1]].tolist() == [[0.0, 0.0], [1.0, 0.0]]
    assert _others_equal(scene, drawn, "trajectory", "follows")


def test_retiming_keeps_the_curve(scene):
    """Points stay and follow on; times begin at 0 s."""
    times = 2.0 + 3.0 * scene.trajectory.times
    slow = edits.retime(scene, times)
    assert slow.follows
    assert np.array_equal(slow.trajectory.points, scene.trajectory.points)
    assert_allclose(slow.trajectory.times, 3.0 * scene.trajectory.times, atol=1e-12)


def test_a_stretched_span_takes_longer(scene):
    """Only the span is slower, between the nearest frames, and the curve follows on."""
    step = scene.frame_time
    slow = edits.stretch(scene, 10.2 * step, 19.9 * step, 2.0)
    lasts = np.diff(slow.trajectory.times) / step
    assert_allclose(lasts, np.where((np.arange(49) >= 10) & (np.arange(49) < 20), 2.0, 1.0))
    assert slow.follows


def test_back_to_the_clip(scene):
    """The clip's own curve and timing come back, whatever was done to them."""
    other = edits.stretch(edits.deform(scene, 5, [0.0, 0.0], 1.0), 0.0, 1.0, 3.0)
    assert edits.follow_clip(other).equals(scene)


def test_settings(scene, jump):
    """Feet and kernel are set and set back; another kernel rebuilds otherwise."""
    kept = edits.set_keep_feet(scene, True)
    assert kept.keep_feet
    assert edits.set_keep_feet(kept, False).equals(scene)
    cubic = edits.set_kernel(scene, "cubic")
    assert reconstruction_error(cubic, jump) != reconstruction_error(scene, jump)
    assert edits.set_kernel(cubic, "linear").equals(scene)


@pytest.mark.parametrize(
    ("edit", "message"),
    [
        (lambda s, c: edits.move_marker(s, c, 6, [0, 0]), "marker"),
        (lambda s, c: edits.move_marker(s, c, -1, [0, 0]), "marker"),
        (lambda s, c: edits.move_marker(s, c, 0, [0, np.nan]), "place"),
        (lambda s, c: edits.move_marker(s, c, 0, s.positions[1]), "there is the marker"),
        (lambda s, c: edits.add_frame(s, c, 50), "frame"),
        (lambda s, c: edits.add_frame(s, c, int(s.frames[1]), [0.5, 0.5]), "already"),
        (lambda s, c: edits.add_frame(s, c, int(s.frames[1])), "already"),
        (lambda s, _: edits.add_pose(s, np.eye(3), np.zeros(3), [0, 0]), "pose"),
        (lambda s, c: edits.add_pose(s, c.samples[0, :5], np.zeros(3), [0, 0.1]), "joints"),
        (lambda s, _: edits.turn_joint(s, 0, 99, [0, 0, 0]), "joint"),
        (lambda s, _: edits.turn_joint(s, 0, 1, [0, 0]), "degrees"),
        (lambda s, _: edits.rename_marker(s, 0, ""), "name"),
        (lambda s, _: edits.deform(s, 50, [0, 0], 1.0), "index"),
        (lambda s, _: edits.deform(s, 5, [0, 0], 0.0), "radius"),
        (lambda s, _: edits.draw(s, [[0, 0], [1, 1]], [0.0, 0.001]), "draw slower"),
        (lambda s, _: edits.retime(s, s.trajectory.times[::-1]), "growing"),
        (lambda s, _: edits.retime(s, 1e-3 * s.trajectory.times), "at least a frame"),
        (lambda s, _: edits.retime(s, 3.0), "times"),
        (lambda s, _: edits.stretch(s, 1.0, 0.5, 2.0), "start and stop"),
        (lambda s, _: edits.stretch(s, 0.0, 1.0, 0.0), "factor"),
        (lambda s, _: edits.set_keep_feet(s, None), "keep_feet"),
        (lambda s, _: edits.set_kernel(s, "round"), "kernel"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_what_cannot_be_done_is_refused_in_words(scene, jump, edit, message):
    """A wrong edit says which argument is wrong."""
    with pytest.raises(WorkbenchError, match=message):
        edit(scene, jump)


def test_another_clip_is_refused(scene, jump):
    """A clip with another number of frames is not the scene's."""
    other = jump.subset(np.arange(40))
    with pytest.raises(WorkbenchError, match="40 frames"):
        edits.move_marker(scene, other, 0, [0.0, 0.0])
