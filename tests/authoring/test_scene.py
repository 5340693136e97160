"""A scene holds what fits together and cannot be changed in place."""

from __future__ import annotations

import pickle
from dataclasses import replace

import numpy as np
import pytest

from workbench.authoring import Marker, Trajectory, edits
from workbench.errors import WorkbenchError


def test_a_scene_cannot_be_written(scene):
    """Whoever keeps a scene to undo finds it as it was."""
    for array in (scene.embedding, scene.trajectory.times, scene.markers[0].rotations):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0.0
    assert not np.shares_memory(scene.positions, scene.markers[0].position)


def test_equal_scenes_are_equal_to_the_bit(scene):
    """A copy is equal; the last bit of one number, or the sign of a zero, makes another scene."""
    assert pickle.loads(pickle.dumps(scene)).equals(scene)
    points = np.array(scene.trajectory.points)
    points[3, 0] = np.nextafter(points[3, 0], 9.0)
    other = replace(scene, trajectory=Trajectory(points, scene.trajectory.times), follows=False)
    assert not other.equals(replace(scene, follows=False))
    zero = replace(scene.markers[0], root=np.zeros(3))
    assert not zero.equals(replace(zero, root=-np.zeros(3)))


def test_frames_of_markers_are_where_their_markers_are(scene):
    """Laying a scene out takes markers' places and the trajectory along."""
    markers = (replace(scene.markers[0], position=[3.0, 4.0]), *scene.markers[1:])
    other = scene.laid_out(markers, scene.embedding)
    assert other.embedding[scene.frames[0]].tolist() == [3.0, 4.0]
    assert np.array_equal(other.trajectory.points, other.embedding)
    drawn = replace(scene, follows=False).laid_out(markers, scene.embedding)
    assert np.array_equal(drawn.trajectory.points, scene.trajectory.points)


def test_lists_for_views_are_in_the_order_of_markers(scene, jump):
    """Positions, poses, roots and frames have a row for each marker, −1 for a new pose."""
    other = edits.add_pose(scene, jump.samples[7], [1.0, 2.0, 3.0], [0.3, 0.9])
    assert other.frames.tolist() == [*scene.frames.tolist(), -1]
    assert np.array_equal(other.poses[:-1], jump.samples[scene.frames])
    assert other.roots[-1].tolist() == [1.0, 2.0, 3.0]
    assert other.positions[-1].tolist() == [0.3, 0.9]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"clip": ""}, "clip"),
        ({"frame_time": 0.0}, "frame_time"),
        ({"keep_feet": 1}, "keep_feet"),
        ({"kernel": "round"}, "kernel"),
        ({"epsilon": -1.0}, "epsilon"),
        ({"embedding": np.zeros((50, 3))}, "embedding"),
        ({"embedding": np.full((50, 2), np.nan)}, "embedding"),
        ({"embedding": np.zeros((50, 2))}, "another place than its marker"),
        ({"trajectory": Trajectory([[0, 0], [1, 1]], [0, 1])}, "follows the clip"),
        ({"trajectory": Trajectory(np.zeros((2, 3)), [0, 1]), "follows": False}, "plane"),
    ],
    ids=lambda value: next(iter(value)) if isinstance(value, dict) else "",
)
def test_parts_that_do_not_fit_are_refused(scene, change, message):
    """Each part is checked, and what they have to do with each other."""
    with pytest.raises(WorkbenchError, match=message):
        replace(scene, **change)


@pytest.mark.parametrize(
    ("markers", "message"),
    [
        (lambda m: m[:2], "at least 3"),
        (lambda m: [*m, m[0]], "frame 0 has a marker already"),
        (lambda m: [replace(m[0], frame=50), *m[1:]], "frame 50 of 50"),
        (lambda m: [replace(m[0], rotations=m[0].rotations[1:]), *m[1:]], "joints"),
    ],
    ids=["too few", "twice", "no frame", "another skeleton"],
)
def test_markers_that_do_not_fit_are_refused(scene, markers, message):
    """A plane needs three markers, of one skeleton and of different frames."""
    with pytest.raises(WorkbenchError, match=message):
        replace(scene, markers=tuple(markers(scene.markers)))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"name": " \n"}, "name"),
        ({"position": [1.0, np.inf]}, "position"),
        ({"position": [1.0, 2.0, 3.0]}, "position"),
        ({"rotations": np.zeros((31, 3, 3))}, "rotations"),
        ({"rotations": -np.tile(np.eye(3), (31, 1, 1))}, "mirrored"),
        ({"root": [[0.0, 0.0, 0.0]]}, "one root"),
        ({"frame": -1}, "frame"),
        ({"frame": 2.0}, "frame"),
    ],
    ids=lambda value: next(iter(value)) if isinstance(value, dict) else "",
)
def test_markers_are_checked(scene, change, message):
    """A marker is a named pose at a finite place."""
    with pytest.raises(WorkbenchError, match=message):
        replace(scene.markers[0], **change)


def test_a_marker_of_a_frame_has_its_pose(jump):
    """A frame gives its pose, its root and a name."""
    marker = Marker.of_frame(jump, 12, [0.0, 1.0])
    assert np.array_equal(marker.rotations, jump.samples[12])
    assert np.array_equal(marker.root, jump.motion.root_translation[12])
    assert (marker.frame, marker.name) == (12, "frame 12")
    with pytest.raises(WorkbenchError, match="from 0 to 49"):
        Marker.of_frame(jump, 50, [0.0, 1.0])
