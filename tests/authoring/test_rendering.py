"""A scene plays as a motion, which its file gives back."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from workbench.authoring import edits, foot_slide, foot_speeds, play, scene_from_clip
from workbench.authoring.animation import poses_at
from workbench.authoring.grounding import find_support, ground_level
from workbench.authoring.placing import spatial_keyframes
from workbench.authoring.rendering import _support
from workbench.errors import WorkbenchError
from workbench.mocap.bvh import read_bvh
from workbench.mocap.bvh_writer import write_bvh
from workbench.mocap.contacts import find_feet
from workbench.mocap.rotations import axis_rotation
from workbench.spaces import PoseSpace


@pytest.fixture(scope="module")
def authored(scene, jump):
    """Give a scene that every kind of edit has changed."""
    other = edits.turn_joint(scene, 1, 12, [0.0, 0.0, 40.0], at=[0.6, 0.9])
    other = edits.move_marker(other, jump, 3, [0.2, 0.8])
    other = edits.deform(other, 25, other.trajectory.points[25] + 0.1, 0.4)
    return edits.set_keep_feet(edits.stretch(other, 0.5, 1.0, 1.7), True)


def test_a_scene_plays_its_trajectory(scene, jump):
    """Each frame is rebuilt from where the trajectory is; markers' frames are the clip's own."""
    motion = play(scene, jump)
    assert len(motion) == len(jump)
    assert motion.frame_time == jump.motion.frame_time
    assert motion.name == "cmu/01_01-jump (authored)"
    frames = scene.frames
    assert_allclose(motion.rotations[frames], jump.samples[frames], atol=1e-9)
    assert_allclose(
        motion.root_translation[frames], jump.motion.root_translation[frames], atol=1e-7
    )
    expected = poses_at(scene.trajectory.points, spatial_keyframes(scene), jump.motion)
    assert np.array_equal(motion.rotations, expected.rotations)


def test_the_feet_are_those_of_the_clip(jump):
    """Where names do not tell, what is lowest in a handstand is not taken for the feet."""
    skeleton = jump.motion.skeleton
    names = tuple(f"joint {rank}" for rank in range(skeleton.n_joints))
    clip = replace(jump.motion, skeleton=replace(skeleton, names=names))
    rotations = clip.rotations.copy()
    rotations[:, 0] = axis_rotation("X", 180.0) @ rotations[:, 0]
    handstand = replace(clip, rotations=rotations)
    assert find_feet(handstand) != find_feet(clip)
    _, feet = _support(handstand, PoseSpace(clip))
    assert feet == tuple(names[joint] for joint in find_feet(clip))


def test_a_clip_whose_y_is_not_up_is_played_as_it_is(scene, jump):
    """Keeping its feet is refused, playing it is not."""
    turn = axis_rotation("X", 90.0)
    rotations = jump.motion.rotations.copy()
    rotations[:, 0] = turn @ rotations[:, 0]
    roots = jump.motion.root_translation @ turn.T
    fallen = PoseSpace(replace(jump.motion, rotations=rotations, root_translation=roots))
    lying = scene_from_clip(fallen, scene.clip, selector="uniform", count=6, projector="pca")
    assert len(play(lying, fallen)) == len(jump)
    for refused in (play, foot_slide):
        with pytest.raises(WorkbenchError, match="want y up"):
            refused(edits.set_keep_feet(lying, True), fallen)


def test_a_slower_trajectory_gives_more_frames(scene, jump):
    """The clip's frame time is kept, so twice the time is twice the frames."""
    slow = edits.retime(scene, 2.0 * scene.trajectory.times)
    assert len(play(slow, jump)) == 2 * len(jump) - 1


def test_feet_are_kept(scene, jump):
    """With the switch the supporting foot rests; poses are the same with and without."""
    free, kept = play(scene, jump), play(edits.set_keep_feet(scene, True), jump)
    assert np.array_equal(free.rotations, kept.rotations)
    slide = foot_slide(scene, jump)
    support = find_support(free, ground_level(jump.motion))
    assert np.array_equal(slide.before, foot_speeds(free, support))
    assert np.array_equal(slide.after, foot_speeds(kept, support))
    assert slide.before.max() > 1.0
    assert slide.after.max() < 1e-9


def test_the_file_reads_back_as_what_was_written(authored, jump, tmp_path):
    """Positions and rotations come back to the file's nine decimals, in a fresh process too."""
    motion = play(authored, jump)
    path = tmp_path / "authored.bvh"
    write_bvh(motion, path)
    back = read_bvh(path)
    assert back.skeleton.names == motion.skeleton.names
    assert back.frame_time == motion.frame_time
    assert_allclose(back.root_translation, motion.root_translation, atol=1e-9)
    assert_allclose(back.rotations, motion.rotations, atol=1e-9)
    again = tmp_path / "again.bvh"
    script = (
        "import sys; from workbench.mocap.bvh import read_bvh; "
        "from workbench.mocap.bvh_writer import write_bvh; "
        "write_bvh(read_bvh(sys.argv[1]), sys.argv[2])"
    )
    subprocess.run([sys.executable, "-c", script, path, again], check=True, timeout=120)
    assert_allclose(read_bvh(again).rotations, motion.rotations, atol=2e-9)


def test_a_motion_written_twice_gives_the_same_bytes(authored, jump, tmp_path):
    """Playing and writing have nothing random."""
    contents = []
    for name in ("one.bvh", "two.bvh"):
        write_bvh(play(authored, jump), tmp_path / name)
        contents.append((tmp_path / name).read_bytes())
    assert contents[0] == contents[1]


def test_another_clip_is_refused(scene, jump):
    """A clip with other frames cannot be what the scene was made of."""
    with pytest.raises(WorkbenchError, match="40 frames"):
        play(scene, jump.subset(np.arange(40)))
