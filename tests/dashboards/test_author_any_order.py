"""Edits of a motion in any order, while the optimizer is at work on those before."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from workbench.authoring.scene import Scene
from workbench.dashboards import MotionAuthor, author_motion

#: What a person does: its kind and two numbers, of which it takes what it needs.
_KINDS = (
    *("move", "move", "add", "remove", "turn", "best", "best", "deform", "draw", "retime"),
    *("undo", "undo", "redo", "look", "wait"),
)
_ACTS = st.tuples(st.sampled_from(_KINDS), st.integers(0, 299), st.floats(0.05, 0.95))


@pytest.fixture(scope="module")
def author() -> Iterator[MotionAuthor]:
    author = author_motion("cmu/01_01-jump", selector="uniform", count=6, projector="pca")
    yield author
    author.close()


def edit_of(kind: str, scene: Scene, number: int, share: float) -> dict[str, Any]:
    """Make what the pad would tell of a scene."""
    marker, place = number % len(scene.markers), [share, 0.7 - 0.5 * share]
    turn = {"marker": marker, "joint": 4, "angles": [50.0 * share, 5.0, 0.0]}
    return {
        "move": {"kind": "move", "marker": marker, "to": place},
        "add": {"kind": "add", "frame": number, "at": place, "rotations": [], "root": []},
        "remove": {"kind": "remove", "marker": marker},
        "turn": {"kind": "turn", "place": None, **turn},
        "best": {"kind": "turn", "place": "best", **turn},
        "deform": {"kind": "deform", "index": 5, "to": place, "radius": 0.4},
        "draw": {"kind": "draw", "points": [[0.1, 0.1], place], "times": [0.0, 0.2 + share]},
        "retime": {"kind": "retime", "times": (1.2 * scene.trajectory.times).tolist()},
        "undo": {"kind": "undo"},
        "redo": {"kind": "redo"},
    }[kind]


class Expected:
    """What a person expects of undo and redo: a list of markers, and a place in it."""

    def __init__(self, author: MotionAuthor, undone: Scene) -> None:
        self.author = author
        self.steps = [author.scene, undone]
        self.place = 0
        self.waits = False  # for the place of a new pose

    def act(self, kind: str, number: int, share: float) -> None:
        """Do something in the pad and expect what it says."""
        self.look()
        before, pad = self.author.scene, self.author.view.pad
        edit = edit_of(kind, before, number, share)
        pad.edit = {"number": pad.answered + 1, **edit}
        if kind in ("undo", "redo"):
            self.waits = False
            self.place += -1 if kind == "undo" else 1
            self.place = min(max(self.place, 0), len(self.steps) - 1)
        elif kind == "best":
            self.waits = True
        elif self.author.scene is not before:
            self.waits = False
            self.go_on()

    def look(self) -> None:
        """Expect a new pose as soon as it is there."""
        if self.waits and len(self.author.scene.markers) > len(self.steps[self.place].markers):
            self.waits = False
            self.go_on()

    def go_on(self) -> None:
        """Expect a step after the present one."""
        self.steps[self.place + 1 :] = [self.author.scene]
        self.place += 1

    def check(self) -> None:
        """Compare markers, which the optimizer leaves alone."""
        expected, scene = self.steps[self.place], self.author.scene
        assert len(scene.markers) == len(expected.markers)
        assert all(a.equals(b) for a, b in zip(scene.markers, expected.markers, strict=True))
        assert scene.follows == expected.follows
        np.testing.assert_array_equal(scene.trajectory.times, expected.trajectory.times)


@settings(
    max_examples=6, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@example([("move", 2, 0.9), ("best", 1, 0.5), ("deform", 0, 0.3), ("undo", 0, 0.5)])
@example([("deform", 0, 0.3), ("best", 1, 0.5), ("undo", 0, 0.5), ("wait", 0, 0.5)])
@given(acts=st.lists(_ACTS, min_size=4, max_size=10))
def test_any_edits_without_waiting_can_be_undone(
    author: MotionAuthor, acts: list[tuple[str, int, float]]
) -> None:
    """Every step is there and no other, undoing all restores the first scene, redoing the last."""
    while author.view.pad.undo_label:
        author.undo()
    first = author.scene
    author.keep_feet(False)  # what the example before has left to redo is gone
    undone = author.scene
    author.undo()

    async def main() -> None:
        expected = Expected(author, undone)
        for kind, number, share in acts:
            if kind == "look":
                await asyncio.sleep(0)
            elif kind == "wait":
                await asyncio.wait_for(author.finished(), 60)
            else:
                expected.act(kind, number, share)
        await asyncio.wait_for(author.finished(), 60)
        expected.look()
        assert not expected.waits
        expected.check()
        while author.view.pad.redo_label:
            expected.act("redo", 0, 0.0)
        last = author.scene
        assert expected.place == len(expected.steps) - 1
        while author.view.pad.undo_label:
            expected.act("undo", 0, 0.0)
            expected.check()
        assert expected.place == 0
        assert author.scene.equals(first)
        while author.view.pad.redo_label:
            author.redo()
        assert author.scene.equals(last)
        await asyncio.wait_for(author.finished(), 60)

    asyncio.run(main())
