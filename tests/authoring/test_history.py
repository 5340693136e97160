"""Undo and redo restore every state exactly, after any edits in any order."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import (
    RuleBasedStateMachine,
    initialize,
    invariant,
    precondition,
    rule,
    run_state_machine_as_test,
)

from workbench.authoring import (
    History,
    best_place,
    edits,
    refined,
    session_bytes,
    session_from_bytes,
)

COORDINATES = st.floats(-0.5, 1.5, width=32)
PLACES = st.tuples(COORDINATES, COORDINATES)
ANGLES = st.tuples(*[st.floats(-180.0, 180.0)] * 3)


def _far_from_markers(scene, place, besides=-1):
    """Tell whether a place is one that a marker may have."""
    others = np.delete(scene.positions, besides, axis=0) if besides >= 0 else scene.positions
    return np.linalg.norm(others - place, axis=1).min() > 0.01


class Authoring(RuleBasedStateMachine):
    """An author who edits, undoes and redoes as it comes."""

    def __init__(self, scene, jump):
        super().__init__()
        self.clip = jump
        self.first = scene

    @initialize()
    def begin(self):
        """Begin, and keep what the file of each scene that was shown says."""
        self.history = History(self.first)
        self.shown = [self._content()]
        self.at = 0

    def _content(self):
        return session_bytes(self.history.scene, self.clip.motion)

    def _edit(self, label, scene):
        self.history.do(label, scene)
        self.at += 1
        self.shown = [*self.shown[: self.at], self._content()]
        assert self.history.undo_label == label
        assert self.history.redo_label == ""

    @property
    def scene(self):
        """Give the scene that is shown."""
        return self.history.scene

    def _marker(self, number):
        return number % len(self.scene.markers)

    @rule(number=st.integers(0, 50), place=PLACES)
    def move_marker(self, number, place):
        marker = self._marker(number)
        if _far_from_markers(self.scene, place, marker):
            self._edit("move", edits.move_marker(self.scene, self.clip, marker, place))

    @rule(frame=st.integers(0, 49), place=st.none() | PLACES)
    def add_frame(self, frame, place):
        where = self.scene.embedding[frame] if place is None else place
        if frame not in self.scene.frames and _far_from_markers(self.scene, where):
            self._edit("add", edits.add_frame(self.scene, self.clip, frame, place))

    @rule(number=st.integers(0, 50), angles=ANGLES, place=PLACES)
    def turn_joint(self, number, angles, place):
        if _far_from_markers(self.scene, place):
            marker = self._marker(number)
            self._edit("turn", edits.turn_joint(self.scene, marker, 6, angles, at=place))

    @rule(number=st.integers(0, 50), angles=ANGLES)
    def turn_in_place(self, number, angles):
        self._edit("turn", edits.turn_joint(self.scene, self._marker(number), 9, angles))

    @rule(number=st.integers(0, 50), angles=ANGLES)
    def add_pose_at_its_best_place(self, number, angles):
        marker = self.scene.markers[self._marker(number)]
        pose = edits.turned(marker.rotations, 2, angles)
        place = best_place(self.scene, self.clip, pose, marker.position)
        self._edit("pose", edits.add_pose(self.scene, pose, marker.root, place))

    @precondition(lambda self: len(self.history.scene.markers) > 3)
    @rule(number=st.integers(0, 50))
    def remove_marker(self, number):
        self._edit("remove", edits.remove_marker(self.scene, self._marker(number)))

    @rule(number=st.integers(0, 50), name=st.text(min_size=1).filter(str.strip))
    def rename_marker(self, number, name):
        self._edit("rename", edits.rename_marker(self.scene, self._marker(number), name))

    @rule(number=st.integers(0, 999), place=PLACES, radius=st.floats(0.01, 3.0))
    def deform(self, number, place, radius):
        index = number % len(self.scene.trajectory)
        self._edit("deform", edits.deform(self.scene, index, place, radius))

    @rule(points=st.lists(PLACES, min_size=2, max_size=9))
    def draw(self, points):
        self._edit("draw", edits.draw(self.scene, points, 0.1 * np.arange(len(points))))

    @rule(power=st.floats(0.5, 2.0))
    def retime(self, power):
        times = self.scene.trajectory.times
        other = times[-1] * (times / times[-1]) ** power
        if np.diff(other).min() > 1e-9:
            self._edit("retime", edits.retime(self.scene, other))

    @rule(factor=st.floats(0.7, 1.5))
    def stretch(self, factor):
        duration = self.scene.trajectory.duration
        self._edit("stretch", edits.stretch(self.scene, 0.0, 0.6 * duration, factor))

    @rule()
    def follow_clip(self):
        self._edit("follow", edits.follow_clip(self.scene))

    @rule(keep=st.booleans(), kernel=st.sampled_from(["linear", "cubic", "gaussian"]))
    def settings(self, keep, kernel):
        scene = edits.set_kernel(edits.set_keep_feet(self.scene, keep), kernel)
        self._edit("settings", scene)

    @rule()
    def refine(self):
        """Amend the step before by what the optimizer finds."""
        self.history.amend(refined(self.scene, self.clip).scene)
        self.shown[self.at] = self._content()

    @rule(steps=st.integers(1, 4))
    def undo(self, steps):
        for _ in range(steps):
            assert bool(self.history.undo_label) == (self.at > 0)
            self.history.undo()
            self.at = max(0, self.at - 1)

    @rule(steps=st.integers(1, 4))
    def redo(self, steps):
        for _ in range(steps):
            assert bool(self.history.redo_label) == (self.at < len(self.shown) - 1)
            self.history.redo()
            self.at = min(len(self.shown) - 1, self.at + 1)

    @invariant()
    def shows_what_it_showed(self):
        """Check that what is shown is what was shown at this place, and is valid."""
        if not hasattr(self, "history"):
            return
        content = self._content()
        assert content == self.shown[self.at]
        assert session_from_bytes(content).scene.equals(self.scene)
        replace(self.scene)  # which validates all parts anew

    def teardown(self):
        """Undo everything and make all of it again."""
        if not hasattr(self, "history"):
            return
        for _ in self.shown:
            self.history.undo()
        assert self._content() == self.shown[0]
        assert self.history.undo_label == ""
        for content in self.shown[1:]:
            self.history.redo()
            assert self._content() == content
        assert self.history.redo_label == ""
        assert len(self.history) == len(self.shown)


def test_any_edits_can_be_undone_and_redone(scene, jump):
    """After any edits, undoing all restores the first state and redoing all the last."""
    run_state_machine_as_test(
        lambda: Authoring(scene, jump),
        settings=settings(max_examples=10, stateful_step_count=12, deadline=None),
    )


def test_an_edit_after_undo_forgets_what_was_undone(scene):
    """Redo ends where another way was taken."""
    history = History(scene)
    kept = history.do("keep the feet", edits.set_keep_feet(scene, True))
    assert history.undo() is scene
    assert history.redo_label == "keep the feet"
    assert history.redo() is kept
    history.undo()
    history.do("cubic", edits.set_kernel(scene, "cubic"))
    assert history.redo_label == ""
    assert (len(history), history.redo().kernel) == (2, "cubic")


def test_an_amended_step_is_undone_at_once(scene, jump):
    """What the optimizer found after an edit goes with it."""
    history = History(scene)
    moved = history.do("move", edits.move_marker(scene, jump, 1, [0.5, 0.5]))
    better = history.amend(refined(moved, jump).scene)
    assert history.scene is better
    assert history.undo() is scene
    assert history.redo() is better
