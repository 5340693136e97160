"""What a person does in the authoring pad, as edits of a scene."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from workbench.authoring import edits
from workbench.authoring.scene import Scene
from workbench.dashboards.authoring.code import edit_code
from workbench.errors import WorkbenchError
from workbench.spaces import PoseSpace

#: Where a new pose goes if the optimizer is to find its place.
BEST = "best"


@dataclass(frozen=True, eq=False)
class Edited:
    """What came of an edit.

    Attributes
    ----------
    scene : Scene
        The scene.
    label : str
        What undoing it is called.
    code : str
        The step of a script that does the same; a comment if there is none.
    moved : bool
        Whether markers have changed, so that the frames between them can be placed better.
    selected : int or None
        The marker to select, -1 for none; None if that stays as it is.
    before : Scene or None
        What the script's step begins with; None for the scene that is shown.
    """

    scene: Scene
    label: str
    code: str
    moved: bool = False
    selected: int | None = None
    before: Scene | None = None


def edited(scene: Scene, space: PoseSpace, edit: Mapping[str, Any]) -> Edited:
    """Do an edit that the pad tells of.

    Parameters
    ----------
    scene : Scene
        The scene.
    space : PoseSpace
        Its clip.
    edit : mapping
        As :class:`~workbench.widgets.authoring.AuthoringPad` describes it; not "undo" and
        "redo", which make no scene.

    Returns
    -------
    Edited

    Raises
    ------
    WorkbenchError
        If it cannot be done, in words for the person who did it.
    """
    kind = edit.get("kind")
    act = _EDITS.get(kind) if isinstance(kind, str) else None
    if act is None:
        raise WorkbenchError(f"edit: got {kind!r}, want one of {', '.join(_EDITS)}")
    try:
        return act(scene, space, edit)
    except KeyError as error:
        raise WorkbenchError(f"edit {kind!r}: got no {error.args[0]!r}") from None


def _move(scene: Scene, space: PoseSpace, edit: Mapping[str, Any]) -> Edited:
    moved = edits.move_marker(scene, space, edit["marker"], edit["to"])
    return Edited(moved, f"move {scene.markers[edit['marker']].name}", edit_code(edit), moved=True)


def _add(scene: Scene, space: PoseSpace, edit: Mapping[str, Any]) -> Edited:
    if edit["frame"] is not None:
        # Where the frame is, so that adding a marker on the curve moves nothing.
        added = edits.add_frame(scene, space, edit["frame"])
    else:
        pose = np.reshape(np.asarray(edit["rotations"], dtype=np.float64), (-1, 3, 3))
        added = edits.add_pose(scene, pose, edit["root"], edit["at"])
    last = len(added.markers) - 1
    return Edited(
        added, f"add {added.markers[last].name}", edit_code(edit), moved=True, selected=last
    )


def _remove(scene: Scene, space: PoseSpace, edit: Mapping[str, Any]) -> Edited:  # noqa: ARG001 - as the others
    removed = edits.remove_marker(scene, edit["marker"])
    name = scene.markers[edit["marker"]].name
    return Edited(removed, f"remove {name}", edit_code(edit), moved=True, selected=-1)


def _turn(scene: Scene, space: PoseSpace, edit: Mapping[str, Any]) -> Edited:
    joint = edit["joint"]
    place = edit["place"]
    turned = edits.turn_joint(scene, edit["marker"], joint, edit["angles"], place)
    word = space.motion.skeleton.names[joint]
    if place is None:
        return Edited(turned, f"turn {word}", edit_code(edit), moved=True)
    return Edited(
        turned,
        f"new pose: turn {word}",
        edit_code(edit),
        moved=True,
        selected=len(turned.markers) - 1,
    )


def _deform(scene: Scene, space: PoseSpace, edit: Mapping[str, Any]) -> Edited:  # noqa: ARG001 - as the others
    return Edited(
        edits.deform(scene, edit["index"], edit["to"], edit["radius"]), "deform", edit_code(edit)
    )


def _draw(scene: Scene, space: PoseSpace, edit: Mapping[str, Any]) -> Edited:  # noqa: ARG001 - as the others
    return Edited(edits.draw(scene, edit["points"], edit["times"]), "draw", edit_code(edit))


def _retime(scene: Scene, space: PoseSpace, edit: Mapping[str, Any]) -> Edited:  # noqa: ARG001 - as the others
    return Edited(edits.retime(scene, edit["times"]), "retime", edit_code(edit))


_EDITS: dict[str, Callable[[Scene, PoseSpace, Mapping[str, Any]], Edited]] = {
    "move": _move,
    "add": _add,
    "remove": _remove,
    "turn": _turn,
    "deform": _deform,
    "draw": _draw,
    "retime": _retime,
}
