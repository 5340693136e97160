"""Which scene a person saw when a gesture began, and what the gesture means by now."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any
from weakref import WeakValueDictionary

import numpy as np

from workbench.authoring import Scene
from workbench.dashboards.authoring.code import REFINED
from workbench.dashboards.authoring.edits import Edited, edited
from workbench.dashboards.authoring.state import AuthorState
from workbench.errors import WorkbenchError

#: Why an edit of a scene that is gone is refused.
CHANGED = "the scene has changed meanwhile: please try again"


class Revisions:
    """Number what the pad shows, and do edits on what their gestures began with.

    Attributes
    ----------
    number : int
        Counts up whenever other markers or another trajectory are shown.
    """

    def __init__(self) -> None:
        self.number = 0
        self._last: Scene | None = None
        self._scenes: WeakValueDictionary[int, Scene] = WeakValueDictionary()

    def show(self, scene: Scene) -> int:
        """Take notice of what is shown now.

        Returns
        -------
        int
            Its number.
        """
        if self._last is None or _looks_other(scene, self._last):
            self.number += 1
        self._last = self._scenes[self.number] = scene
        return self.number

    def edited(self, state: AuthorState, scene: Scene, edit: Mapping[str, Any]) -> Edited:
        """Do an edit of the pad.

        The optimizer's result may come while the hand is at work: markers and drawings mean the
        same before and after it, and a deformed curve is made of the one that was seen.

        Parameters
        ----------
        state : AuthorState
            Knows how scenes were made.
        scene : Scene
            The scene that is shown.
        edit : mapping
            As for :func:`~workbench.dashboards.authoring.edits.edited`; without ``revision``
            it is one of the scene that is shown.

        Raises
        ------
        WorkbenchError
            If it cannot be done, or something else than the optimizer's result came between.
        """
        clip = state.clip
        assert clip is not None  # that of the scene
        seen = self.seen(state, edit)
        if seen is scene or edit.get("kind") != "deform":
            return edited(scene, clip.space, edit)
        done = edited(seen, clip.space, edit)
        steps = [
            done.code.replace("scene =", "deformed =", 1),
            *[REFINED] * (state.optimized_since(seen) or 0),
            "scene = replace(deformed, embedding=scene.embedding)",
        ]
        result = replace(done.scene, embedding=scene.embedding)
        return replace(done, scene=result, code="\n".join(steps), before=seen)

    def seen(self, state: AuthorState, edit: Mapping[str, Any]) -> Scene:
        """Find the scene with which an edit's gesture began.

        Raises
        ------
        WorkbenchError
            If something else than the optimizer's result came between.
        """
        revision = edit.get("revision")
        seen = state.scene if revision is None else self._scenes.get(revision)
        if seen is None or state.optimized_since(seen) is None:
            raise WorkbenchError(CHANGED)
        return seen


def _looks_other(scene: Scene, before: Scene) -> bool:
    now, then = scene.trajectory, before.trajectory
    return not (
        scene.clip == before.clip
        and len(scene.markers) == len(before.markers)
        and all(a.equals(b) for a, b in zip(scene.markers, before.markers, strict=True))
        and np.array_equal(now.points, then.points)
        and np.array_equal(now.times, then.times)
    )
