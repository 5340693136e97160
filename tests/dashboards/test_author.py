"""The authoring dashboard, driven from Python and by what its pad tells."""

from __future__ import annotations

import asyncio
import dataclasses
import gc
import json
import weakref
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from sklearn.base import BaseEstimator

from workbench.authoring import edits, foot_slide, influence, play, scene_on_circle
from workbench.authoring.scene import Scene
from workbench.dashboards import MotionAuthor, author_motion
from workbench.dashboards.authoring.edits import edited
from workbench.dashboards.authoring.state import AuthorState
from workbench.datasets import load, load_space
from workbench.errors import DataError, WorkbenchError
from workbench.mocap.bvh_writer import write_bvh
from workbench.mocap.motion import Motion
from workbench.mocap.rotations import axis_rotation
from workbench.mocap.skeleton import ROTATION_CHANNELS, EndSite, Skeleton
from workbench.projection import project, register_projector
from workbench.spaces import PoseSpace

CLIP = "cmu/01_01-jump"
OTHER = "cmu/01_03-walk"


@pytest.fixture(scope="module")
def shared() -> Iterator[MotionAuthor]:
    author = author_motion(CLIP, selector="uniform", count=6, projector="pca")
    yield author
    author.close()


@pytest.fixture(scope="module")
def first(shared: MotionAuthor) -> Scene:
    return shared.scene


@pytest.fixture
def author(shared: MotionAuthor, first: Scene) -> MotionAuthor:
    """Give the dashboard with its first scene, whatever the test before did to it."""
    shared.controls.refine.value = False
    shared.controls.projector.value = "pca"
    while shared.view.pad.undo_label:
        shared.undo()
    assert shared.scene is first
    return shared


def do(author: MotionAuthor, kind: str, **parts: Any) -> None:
    """Do what the pad does when a gesture has ended."""
    pad = author.view.pad
    pad.edit = {"number": pad.answered + 1, "kind": kind, **parts}
    assert pad.answered == pad.edit["number"]


EDITS: dict[str, Callable[[Scene], dict[str, Any]]] = {
    "move": lambda _: {"kind": "move", "marker": 2, "to": [0.9, 0.2]},
    "add a frame": lambda scene: {
        "kind": "add",
        "at": scene.embedding[17].tolist(),
        "frame": 17,
        "rotations": [],
        "root": [],
    },
    "add a pose": lambda scene: {
        "kind": "add",
        "at": [0.4, 0.45],
        "frame": None,
        "rotations": scene.poses[1].ravel().tolist(),
        "root": scene.roots[1].tolist(),
    },
    "remove": lambda _: {"kind": "remove", "marker": 0},
    "turn": lambda _: {"kind": "turn", "marker": 1, "joint": 4, "angles": [9, 0, 5], "place": None},
    "turn at a place": lambda _: {
        "kind": "turn",
        "marker": 1,
        "joint": 4,
        "angles": [9, 0, 5],
        "place": [0.3, 0.6],
    },
    "turn, optimizer's place": lambda _: {
        "kind": "turn",
        "marker": 1,
        "joint": 4,
        "angles": [40, 0, 5],
        "place": "best",
    },
    "deform": lambda _: {"kind": "deform", "index": 90, "to": [0.1, 0.9], "radius": 0.4},
    "draw": lambda _: {
        "kind": "draw",
        "points": [[0.1, 0.1], [0.5, 0.6], [0.9, 0.2]],
        "times": [0.0, 0.5, 1.0],
    },
    "retime": lambda scene: {"kind": "retime", "times": (2 * scene.trajectory.times).tolist()},
}


@pytest.mark.parametrize("name", EDITS)
def test_an_edit_of_the_pad_is_done_shown_and_undone(
    author: MotionAuthor, first: Scene, name: str
) -> None:
    """The scene changes, the pad shows it, undo restores it exactly and redo does it again."""
    do(author, **EDITS[name](first))
    changed = author.scene
    assert author.message == ""
    assert not changed.equals(first)
    assert_shown(author, changed)
    label = author.view.pad.undo_label
    assert label
    do(author, "undo")
    assert author.scene.equals(first)
    assert_shown(author, first)
    assert (author.view.pad.undo_label, author.view.pad.redo_label) == ("", label)
    do(author, "redo")
    assert author.scene.equals(changed)
    assert_shown(author, changed)


def assert_shown(author: MotionAuthor, scene: Scene) -> None:
    """Compare what the pad has with a scene."""
    pad = author.view.pad
    np.testing.assert_array_equal(pad.markers, scene.positions)
    np.testing.assert_array_equal(pad.marker_poses.reshape(scene.poses.shape), scene.poses)
    np.testing.assert_array_equal(pad.marker_frames, scene.frames)
    np.testing.assert_array_equal(pad.points, scene.trajectory.points)
    np.testing.assert_array_equal(pad.times, scene.trajectory.times)
    np.testing.assert_array_equal(pad.embedding, scene.embedding)
    np.testing.assert_array_equal(pad.influence, influence(author.space, scene.markers))
    assert pad.marker_names == [marker.name for marker in scene.markers]
    assert pad.follows == scene.follows


def test_edits_are_those_of_the_core(author: MotionAuthor, first: Scene) -> None:
    """What the pad asks for gives the same scene as the functions for scripts."""
    do(author, **EDITS["move"](first))
    do(author, **EDITS["deform"](first))
    expected = edits.move_marker(first, author.space, 2, [0.9, 0.2])
    expected = edits.deform(expected, 90, [0.1, 0.9], 0.4)
    assert author.scene.equals(expected)


def test_it_begins_with_the_clips_projection(first: Scene) -> None:
    """Places are the projector's, and markers are at the selector's frames."""
    space = load_space(CLIP)
    np.testing.assert_allclose(first.embedding, project(space, "pca", random_state=0), atol=1e-12)
    assert first.frames.tolist() == np.linspace(0, 299, 6).round().astype(int).tolist()
    assert first.clip == CLIP


def test_a_dragged_marker_is_followed_by_the_optimizer(author: MotionAuthor, first: Scene) -> None:
    """RBFP places the frames, the optimizer lowers the error, and both are one step to undo."""
    author.controls.refine.value = True
    do(author, "move", marker=2, to=[0.9, 0.2])
    by_rbfp = edits.move_marker(first, author.space, 2, [0.9, 0.2])
    assert author.refined is not None
    assert author.refined.after < 0.95 * author.refined.before
    assert "error" in author.view.message
    np.testing.assert_array_equal(author.scene.positions, by_rbfp.positions)
    assert not np.array_equal(author.scene.embedding, by_rbfp.embedding)
    assert_shown(author, author.scene)
    author.undo()
    assert author.scene is first
    assert author.refined is None


def test_an_optimizer_that_is_cancelled_goes_on_after_another_edit(author: MotionAuthor) -> None:
    """An edit that leaves the places ends the optimizer, and what it had to do is still done."""

    async def main() -> None:
        author.controls.refine.value = True
        do(author, "move", marker=2, to=[0.9, 0.2])
        do(author, "retime", times=(2 * author.scene.trajectory.times).tolist())
        await asyncio.wait_for(author.finished(), 60)

    asyncio.run(main())
    assert author.refined is not None
    assert author.view.pad.undo_label == "retime"
    assert author.scene.trajectory.duration == pytest.approx(2 * 299 / 120, rel=1e-4)


def test_a_new_pose_is_placed_before_frames_are_optimized(
    author: MotionAuthor, first: Scene
) -> None:
    """An optimizer that is at work when a joint is turned neither loses the pose nor is lost."""

    async def main() -> None:
        author.controls.refine.value = True
        do(author, "move", marker=2, to=[0.9, 0.2])
        while author._live.worker.current is None:
            await asyncio.sleep(0)
        do(author, **EDITS["turn, optimizer's place"](first))
        await asyncio.wait_for(author.finished(), 60)

    asyncio.run(main())
    assert author.message == ""
    assert len(author.scene.markers) == len(first.markers) + 1
    assert author.view.pad.undo_label == "new pose"
    assert author.view.pad.selected == len(first.markers)
    assert author.refined is not None


@pytest.mark.parametrize("meanwhile", ["deform", "undo"])
def test_a_new_pose_that_waits_is_given_up_for_what_comes_next(
    author: MotionAuthor, first: Scene, meanwhile: str
) -> None:
    """The dashboard says so, and the pose does not come back to take what can be redone."""

    async def main() -> None:
        do(author, **EDITS["retime"](first))
        do(author, **EDITS["turn, optimizer's place"](first))
        do(author, **EDITS.get(meanwhile, lambda _: {"kind": meanwhile})(first))
        assert "the new pose was given up" in author.message
        while author.view.pad.undo_label:
            author.undo()
        assert author.scene is first
        await asyncio.wait_for(author.finished(), 60)

    asyncio.run(main())
    assert author.scene is first
    assert author.view.pad.redo_label == "retime"


def test_no_pose_waits_for_its_place_while_markers_are_replaced(author: MotionAuthor) -> None:
    """It would take the place of what a person asked for before."""

    async def main() -> None:
        author.place(projector="circle")
        do(author, **EDITS["turn, optimizer's place"](author.scene))
        assert "other markers are on the way" in author.message
        await asyncio.wait_for(author.finished(), 60)

    asyncio.run(main())
    assert author.view.pad.undo_label == "place 6 markers by circle"


@pytest.mark.parametrize("name", ["move", "add a frame", "remove", "turn", "draw", "retime"])
def test_an_edit_of_what_was_seen_before_the_optimizers_result_is_done(
    author: MotionAuthor, first: Scene, name: str
) -> None:
    """Markers, drawings and times mean the same in the scene that is there by then."""
    author.controls.refine.value = True
    seen = author.view.pad.revision + 1
    do(author, **EDITS["move"](first))
    assert author.view.pad.revision == seen + 1
    author.controls.refine.value = False
    now = author.scene
    edit = EDITS[name](first)
    do(author, **edit, revision=seen)
    assert author.message == ""
    assert author.scene.equals(edited(now, author.space, edit).scene)


def test_a_curve_is_deformed_as_it_was_seen_before_the_optimizers_result(
    author: MotionAuthor, first: Scene
) -> None:
    """The seen curve is dragged, frames are at their better places, and the script agrees."""
    author.controls.refine.value = True
    seen = author.view.pad.revision + 1
    do(author, **EDITS["move"](first))
    better = author.scene
    do(author, **EDITS["deform"](first), revision=seen)
    by_rbfp = edits.move_marker(first, author.space, 2, [0.9, 0.2])
    expected = edits.deform(by_rbfp, 90, [0.1, 0.9], 0.4).trajectory
    np.testing.assert_array_equal(author.scene.trajectory.points, expected.points)
    np.testing.assert_array_equal(author.scene.embedding, better.embedding)
    assert run(author.code)["scene"].equals(author.scene)
    author.undo()
    assert author.scene is better


@pytest.mark.parametrize("name", [*EDITS])
def test_an_edit_of_a_scene_that_is_gone_is_refused(
    author: MotionAuthor, first: Scene, name: str
) -> None:
    """What the person saw is another curve with other markers: nothing is done."""
    seen = author.view.pad.revision
    author.scene = edits.remove_marker(first, 5)
    before = author.scene
    do(author, **EDITS[name](first), revision=seen)
    assert author.message == "the scene has changed meanwhile: please try again"
    assert author.scene is before
    do(author, **EDITS["deform"](first), revision=author.view.pad.revision)
    assert author.message == ""


def test_revisions_count_markers_and_curves_only(author: MotionAuthor) -> None:
    """Keeping the feet changes nothing that a gesture is made on."""
    seen = author.view.pad.revision
    author.keep_feet()
    assert author.view.pad.revision == seen
    do(author, "remove", marker=5, revision=seen)
    assert author.message == ""
    assert author.view.pad.revision == seen + 1


def test_cancelling_leaves_the_frames_where_rbfp_put_them(author: MotionAuthor) -> None:
    """The message says so, and computing again brings the better places."""

    async def main() -> None:
        author.controls.refine.value = True
        do(author, "move", marker=2, to=[0.9, 0.2])
        author.cancel()
        await asyncio.wait_for(author.finished(), 60)
        assert "optimizing: cancelled" in author.message
        assert author.refined is None
        author.recompute()
        await asyncio.wait_for(author.finished(), 60)

    asyncio.run(main())
    assert author.message == ""
    assert author.refined is not None


@pytest.mark.parametrize(
    ("edit", "words"),
    [
        ({"kind": "move", "marker": 99, "to": [0, 0]}, "marker: got 99"),
        ({"kind": "move", "marker": 1, "to": [float("nan"), 0]}, "place"),
        ({"kind": "move", "marker": 1}, "got no 'to'"),
        ({"kind": "turn", "marker": 1, "joint": 77, "angles": [1, 0, 0], "place": "best"}, "joint"),
        ({"kind": "draw", "points": [[0, 0], [1, 1]], "times": [0, 1e-4]}, "s"),
        ({"kind": "explode"}, "edit: got 'explode'"),
    ],
    ids=["no marker", "no place", "incomplete", "no joint", "too short", "no edit"],
)
def test_an_edit_that_cannot_be_done_is_answered_in_words(
    author: MotionAuthor, first: Scene, edit: dict[str, Any], words: str
) -> None:
    """The pad gets the state as it was, with the reason; the next edit takes it away."""
    do(author, **edit)
    assert words in author.message
    assert author.view.pad.message == author.message
    assert author.scene is first
    do(author, **EDITS["deform"](first))
    assert author.message == ""


def test_markers_never_get_fewer_than_a_plane_needs(author: MotionAuthor) -> None:
    """Three are left, whatever a person deletes."""
    for _ in range(5):
        do(author, "remove", marker=0)
    assert len(author.scene.markers) == 3
    assert "at least 3" in author.message


def test_feet_are_kept_and_their_speed_is_shown(author: MotionAuthor) -> None:
    """Roots of the pad are those of the motion, curves are those of the core."""
    assert len(author.view.pad.roots) == 0
    author.controls.keep_feet.value = True
    np.testing.assert_array_equal(
        author.view.pad.roots.reshape(-1, 3), author.motion.root_translation
    )
    slide = foot_slide(author.scene, author.space)
    before, after = np.reshape(author.view.feet.values, (2, -1))
    centimetres = author.space.motion.skeleton.unit_cm
    np.testing.assert_allclose(before, slide.before * centimetres, rtol=1e-5, atol=1e-4)
    assert before.max() > 1.0
    np.testing.assert_allclose(after, slide.after * centimetres, rtol=1e-5, atol=1e-4)
    assert author.view.pad.undo_label == "keep the feet"
    author.undo()
    assert not author.controls.keep_feet.value
    assert len(author.view.pad.roots) == 0


def test_a_page_has_roots_and_feet_of_the_motion_that_is_saved(
    author: MotionAuthor, first: Scene, tmp_path: Path
) -> None:
    """Even if it is saved before they were computed beside the kernel."""
    pad, feet = author.view.pad, author.view.feet

    async def main() -> None:
        author.keep_feet()
        do(author, **EDITS["draw"](first))
        assert len(pad.roots) == 0
        author.export_html(tmp_path / "drawn.html")
        np.testing.assert_array_equal(pad.roots.reshape(-1, 3), author.motion.root_translation)
        assert feet.values.size == 2 * len(author.motion)
        await asyncio.wait_for(author.finished(), 60)

    asyncio.run(main())


def test_a_body_without_feet_is_told_of_and_can_be_authored(author: MotionAuthor) -> None:
    """The switch goes back, the reason is said, and everything else works."""
    joints = ("hip", "waist", "neck")
    skeleton = Skeleton(
        joints,
        np.array([-1, 0, 1]),
        np.array([[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 1.0, 0.0]]),
        (EndSite(2, np.array([0.0, 1.0, 0.0])),),
        (ROTATION_CHANNELS,) * 3,
    )
    turns = np.linspace(0.0, 90.0, 40)[:, None] * [0.2, 1.0, -0.7]
    bones = Motion(skeleton, axis_rotation("Z", turns), np.zeros((40, 3)), 1 / 30, name="bones")
    author.open(PoseSpace(bones))
    assert author.scene.clip == "bones"
    assert author.message == ""
    assert "no speed of the feet" in author.view.feet.message
    author.controls.keep_feet.value = True
    assert "feet" in author.message
    assert not author.controls.keep_feet.value
    assert not author.scene.keep_feet
    do(author, "remove", marker=0)
    assert author.message == ""


def test_controls_follow_the_scene(author: MotionAuthor, first: Scene) -> None:
    """The radial function is an edit like others; the clip's own curve can be had back."""
    assert author.controls.follow.disabled
    author.controls.kernel.value = "thin-plate"
    assert author.scene.kernel == author.view.pad.kernel == "thin-plate"
    do(author, **EDITS["draw"](first))
    assert not author.controls.follow.disabled
    author.controls.follow.click()
    assert author.scene.follows
    np.testing.assert_array_equal(author.scene.trajectory.points, first.embedding)
    for _ in range(3):
        author.undo()
    assert author.controls.kernel.value == "linear"


def test_markers_can_be_placed_anew(author: MotionAuthor, first: Scene) -> None:
    """Another count on a circle; undo brings the old ones back."""
    author.place(selector="scs", count=8, projector="circle")
    gaps = np.linalg.norm(author.scene.positions - 0.5, axis=1)
    np.testing.assert_allclose(gaps, 0.5)
    assert len(author.scene.markers) == 8
    assert author.view.pad.undo_label == "place 8 markers by circle"
    author.undo()
    assert author.scene is first


def test_a_file_of_ones_own_is_authored(author: MotionAuthor, tmp_path: Path) -> None:
    """A BVH file is opened by its path, and its poses are those of the markers."""
    own = tmp_path / "mine.bvh"
    write_bvh(load(OTHER), own)
    author.open(own)
    assert author.message == ""
    assert author.scene.clip == str(own)
    read = load(str(own))
    np.testing.assert_array_equal(author.scene.poses, read.rotations[author.scene.frames])


def test_another_clip_is_a_step_that_can_be_undone(author: MotionAuthor, first: Scene) -> None:
    """Its skeleton and frames are shown, then those of the clip before."""
    do(author, **EDITS["deform"](first))
    deformed = author.scene
    author.controls.data.value = OTHER
    walk = load(OTHER)
    assert author.scene.clip == OTHER
    np.testing.assert_array_equal(author.space.samples, walk.rotations)
    assert author.view.pad.ghost.size == len(walk) * len(author.view.pad.parents) * 3
    author.undo()
    assert author.scene is deformed
    assert author.space.name == load_space(CLIP).name
    assert author.controls.data.value == CLIP
    assert author.view.pad.ghost.size == 300 * len(author.view.pad.parents) * 3


@pytest.mark.parametrize(
    ("wrong", "words"),
    [("uci/iris", "want a motion"), ("cmu/none", "cmu/none"), ("/no/such.bvh", "no/such")],
    ids=["a table", "an unknown name", "a missing file"],
)
def test_a_wrong_clip_loses_nothing(
    author: MotionAuthor, first: Scene, wrong: str, words: str
) -> None:
    """The reason is told in words, what was shown stays and can be edited."""
    author.open(wrong)
    assert words in author.message
    assert f"still shown: {CLIP}" in author.message
    assert author.scene is first
    assert author.controls.data.value == CLIP
    do(author, **EDITS["deform"](first))
    assert author.message == ""


def test_after_a_wrong_clip_markers_of_the_one_shown_are_placed(author: MotionAuthor) -> None:
    """The button acts on what a person sees."""
    author.open("cmu/none")
    author.controls.count.value = 7
    author.controls.place.click()
    assert author.message == ""
    assert len(author.scene.markers) == 7
    assert author.scene.clip == CLIP
    author.controls.count.value = 6


def test_a_projector_that_fails_is_told_in_words(author: MotionAuthor, first: Scene) -> None:
    """A user's own projector may fail in any way; markers stay."""

    class Broken(BaseEstimator):
        def __init__(self, n_components: int = 2) -> None:
            self.n_components = n_components

        def fit_transform(self, samples: object) -> None:
            raise ZeroDivisionError("nothing to divide")

    register_projector("broken", Broken)
    author.place(projector="broken")
    assert "ZeroDivisionError: nothing to divide" in author.message
    assert author.scene is first
    author.place(projector="pca")
    assert author.message == ""


def test_a_session_goes_on_where_it_was_saved(
    author: MotionAuthor, first: Scene, tmp_path: Path
) -> None:
    """It is equal bit for bit, opened by path or uploaded, and opening it can be undone."""
    do(author, **EDITS["turn at a place"](first))
    do(author, **EDITS["deform"](first))
    saved = author.scene
    path = author.save(tmp_path / "jump.session.json")
    author.open(OTHER)
    author.open_session(path)
    assert author.scene.equals(saved)
    assert author.view.pad.undo_label == "open jump.session.json"
    author.undo()
    assert author.scene.clip == OTHER
    give(author, "mine.json", path.read_bytes())
    assert author.scene.equals(saved)
    assert author.view.pad.undo_label == "open mine.json"
    assert "# scene: the one of 'mine.json', a session that was uploaded" in author.code
    assert "read_session" not in author.code


def give(author: MotionAuthor, name: str, content: bytes) -> None:
    """Send a file as the browser does."""
    message = {"given": "opened", "name": name}
    author.view.files._handle_custom_msg(message, [memoryview(content)])


@pytest.mark.parametrize("how", ["from Python", "by path", "uploaded"])
def test_a_damaged_session_is_refused_and_nothing_lost(
    author: MotionAuthor, first: Scene, tmp_path: Path, how: str
) -> None:
    """The dashboard says that it is damaged; scene and history stay."""
    do(author, **EDITS["deform"](first))
    deformed = author.scene
    path = author.save(tmp_path / "jump.session.json")
    path.write_bytes(path.read_bytes().replace(b"0.9", b"0.8", 1))
    if how == "from Python":
        with pytest.raises(DataError, match="damaged"):
            author.open_session(path)
    else:
        if how == "by path":
            author.controls.session.value = str(path)
            author.controls.open_session.click()
        else:
            give(author, path.name, path.read_bytes())
        assert "damaged" in author.message
    assert author.scene is deformed
    do(author, "undo")
    assert author.scene is first
    assert author.message == ""


def test_a_session_of_a_clip_that_has_changed_is_refused(
    author: MotionAuthor, first: Scene, tmp_path: Path
) -> None:
    """Markers of one motion are not put on another that has its name."""
    path = author.save(tmp_path / "jump.session.json")
    other = load_space(OTHER)
    other.name = CLIP
    author.open(other)
    shown = author.scene
    with pytest.raises(DataError, match="not the one that the session was made with"):
        author.open_session(path)
    assert author.scene is shown


def test_a_session_whose_clip_is_elsewhere_now_goes_on_with_the_clip_that_is_shown(
    author: MotionAuthor, tmp_path: Path
) -> None:
    """Without the clip the message says what to do; a clip of the same content will do."""
    old, new = tmp_path / "old.bvh", tmp_path / "new.bvh"
    write_bvh(load(CLIP), old)
    author.open(old)
    saved = author.scene
    path = author.save(tmp_path / "jump.session.json")
    for _ in range(2):
        author.undo()
    old.rename(new)
    author.open(OTHER)
    author.open_session(path)
    assert "open the session's clip first" in author.message
    assert author.scene.clip == OTHER
    author.open(new)
    author.open_session(path)
    assert author.message == ""
    assert author.scene.equals(dataclasses.replace(saved, clip=str(new)))
    assert run(author.code)["scene"].equals(author.scene)


def test_bvh_reads_back_as_the_motion(author: MotionAuthor, first: Scene, tmp_path: Path) -> None:
    """File, message to the browser and motion in Python are the same."""
    do(author, **EDITS["draw"](first))
    author.keep_feet()
    motion = load(str(author.export_bvh(tmp_path / "drawn.bvh")))
    assert len(motion) == len(author.motion) == 121
    np.testing.assert_allclose(motion.rotations, author.motion.rotations, atol=1e-8)
    np.testing.assert_allclose(motion.root_translation, author.motion.root_translation, atol=1e-8)
    np.testing.assert_array_equal(
        author.motion.rotations, play(author.scene, author.space).rotations
    )


def test_what_the_browser_asks_for_is_sent(
    author: MotionAuthor, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each button gets the file that Python writes, or the reason why there is none."""
    sent: list[tuple[dict[str, Any], list[bytes]]] = []
    files = author.view.files
    monkeypatch.setattr(files, "send", lambda content, buffers=(): sent.append((content, buffers)))
    for want in ("bvh", "session", "html"):
        files._handle_custom_msg({"want": want}, [])
    names = [content["name"] for content, _ in sent]
    assert names == ["01_01-jump.bvh", "01_01-jump.session.json", "01_01-jump.html"]
    assert sent[0][1][0] == author.export_bvh(tmp_path / "a.bvh").read_bytes()
    assert json.loads(sent[1][1][0])["clip"] == CLIP

    def fail(*_: object) -> None:
        raise WorkbenchError("no room")

    monkeypatch.setattr("workbench.dashboards.authoring.events.content", fail)
    files._handle_custom_msg({"want": "bvh"}, [])
    assert sent[-1][0]["failure"] == "no room"


def test_a_page_has_the_words_that_were_given(author: MotionAuthor, tmp_path: Path) -> None:
    """Title and text stand in it, and it holds no address of another machine."""
    page = author.export_html(tmp_path / "a.html", title="A <jump>", text="Look & move").read_text()
    assert "<h1>A &lt;jump&gt;</h1>" in page
    assert "Look &amp; move" in page
    assert "http:" not in page
    assert "https:" not in page
    assert (author.view.title.value, author.view.text.value) == ("", "")


def test_a_scene_can_be_set_from_python(author: MotionAuthor, first: Scene) -> None:
    """It is shown, can be undone, and one of another clip is refused."""
    author.scene = edits.deform(first, 120, [0.4, 0.6], radius=0.3)
    assert author.view.pad.undo_label == "set from Python"
    assert_shown(author, author.scene)
    before = author.scene
    foreign = author_scene_of_another_clip()
    with pytest.raises(WorkbenchError, match="scene: got one of clip"):
        author.scene = foreign
    assert author.scene is before


def test_a_scene_of_the_history_can_be_set_again(author: MotionAuthor, first: Scene) -> None:
    """It is another step; the one that it had keeps its script."""
    script = author.code
    do(author, **EDITS["deform"](first))
    author.scene = first
    assert author.scene.equals(first)
    assert "# scene: the one that was set from Python" in author.code
    for _ in range(2):
        author.undo()
    assert author.scene is first
    assert author.code == script


def author_scene_of_another_clip() -> Scene:
    """Make a scene that does not fit the clip."""
    return scene_on_circle(load_space(OTHER), selector="uniform", count=4)


@pytest.mark.parametrize(
    ("argument", "value", "words"),
    [
        ("selector", "best", "selector: got 'best'"),
        ("projector", "best", "projector: got 'best'"),
        ("count", 2, "count: got 2"),
        ("count", 61, "count: got 61"),
        ("random_state", -1, "random_state: got -1"),
    ],
    ids=["selector", "projector", "too few", "too many", "random_state"],
)
def test_arguments_are_checked(argument: str, value: object, words: str) -> None:
    """The message names the argument and what it got."""
    with pytest.raises(WorkbenchError, match=words):
        author_motion(CLIP, **{argument: value})


@pytest.mark.parametrize(
    ("save", "ending"),
    [("save", ".json"), ("export_bvh", ".bvh"), ("export_html", ".html")],
    ids=["session", "BVH", "page"],
)
def test_other_endings_are_refused(
    author: MotionAuthor, tmp_path: Path, save: str, ending: str
) -> None:
    """A file's name tells what it is."""
    with pytest.raises(WorkbenchError, match=rf"ends in \{ending}"):
        getattr(author, save)(tmp_path / "a.txt")


@pytest.mark.parametrize(
    ("save", "ending"),
    [("save", ".json"), ("export_bvh", ".bvh"), ("export_html", ".html")],
    ids=["session", "BVH", "page"],
)
def test_a_file_that_cannot_be_written_is_told_in_words(
    author: MotionAuthor, tmp_path: Path, save: str, ending: str
) -> None:
    """The message names the file."""
    (tmp_path / "file").write_text("no folder")
    target = tmp_path / "file" / f"a{ending}"
    with pytest.raises(DataError, match=rf"a\{ending}: cannot be written \("):
        getattr(author, save)(target)


def test_an_edit_costs_the_same_however_long_the_session_is(
    author: MotionAuthor, first: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The script is written where it is looked at only; the motion that is shown is kept only."""
    written: list[str] = []
    code = AuthorState.code.fget
    monkeypatch.setattr(AuthorState, "code", property(lambda s: written.append("") or code(s)))
    played = weakref.ref(author._live.state.played)
    do(author, **EDITS["deform"](first))
    gc.collect()
    assert played() is None
    assert written == []
    author.view.code.button.value = True
    assert written == [""]
    author.view.code.button.value = False
    author.view.code.cell.code = ""


def test_the_script_makes_the_same_scene(author: MotionAuthor, first: Scene) -> None:
    """Run as it is shown, it gives the scene to the last bit, after edits of every kind."""
    author.controls.refine.value = True
    do(author, **EDITS["move"](first))
    author.controls.refine.value = False
    for name in ("add a frame", "turn at a place", "turn, optimizer's place", "remove", "turn"):
        do(author, **EDITS[name](author.scene))
    do(author, **EDITS["deform"](author.scene))
    do(author, "undo")
    do(author, **EDITS["retime"](author.scene))
    author.keep_feet()
    assert author.message == ""
    assert author.view.code.cell.code == ""
    author.view.code.button.value = True
    assert author.view.code.cell.code == author.code
    made = run(author.code)
    assert made["scene"].equals(author.scene)
    np.testing.assert_array_equal(made["motion"].rotations, author.motion.rotations)
    do(author, **EDITS["add a pose"](author.scene))
    do(author, **EDITS["draw"](author.scene))
    author.follow_clip()
    author.set_kernel("cubic")
    assert run(author.view.code.cell.code)["scene"].equals(author.scene)
    author.view.code.button.value = False


def test_the_script_of_a_session_begins_with_its_file(
    author: MotionAuthor, first: Scene, tmp_path: Path
) -> None:
    """What was before it does not matter; a scene set from Python is said to be one."""
    do(author, **EDITS["deform"](first))
    path = author.save(tmp_path / "jump.json")
    author.open_session(path)
    do(author, **EDITS["retime"](author.scene))
    assert "deform" not in author.code
    assert run(author.code)["scene"].equals(author.scene)
    author.scene = first
    assert "# scene: the one that was set from Python" in author.code


def run(code: str) -> dict[str, Any]:
    """Run a script and give its names."""
    names: dict[str, Any] = {}
    exec(code, names)
    return names
