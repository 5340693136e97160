"""The steps of an author as a script that makes the same motion without the dashboard."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Any

from workbench.dashboards.authoring.jobs import CIRCLE, Placing, Posing
from workbench.dashboards.shared.sources import Source

#: What a script may need, by where it is found.
_HOMES = {
    "replace": "dataclasses",
    "load_space": "workbench",
    "best_place": "workbench.authoring",
    "edits": "workbench.authoring",
    "play": "workbench.authoring",
    "read_session": "workbench.authoring",
    "refined": "workbench.authoring",
    "scene_from_clip": "workbench.authoring",
    "scene_on_circle": "workbench.authoring",
}

REFINED = "scene = refined(scene, space).scene"


def script(source: Source, steps: Iterable[str]) -> str:
    """Write the script that makes a scene and its motion again.

    Parameters
    ----------
    source : Source
        The clip; one in memory is called ``space`` in the script.
    steps : iterable of str
        What made the scene, step by step.

    Returns
    -------
    str
    """
    lines = [_clip_code(source), *steps, "motion = play(scene, space)"]
    words = set(re.findall(r"[a-z_]+", "\n".join(lines)))
    imports: dict[str, list[str]] = {}
    for name, home in _HOMES.items():
        if name in words:
            imports.setdefault(home, []).append(name)
    head = [f"from {home} import {', '.join(names)}" for home, names in imports.items()]
    return "\n".join([*head, "", *lines, ""])


def placing_code(job: Placing) -> str:
    """Write the step that places markers anew."""
    arguments = f"selector={job.selector!r}, count={job.count}"
    if job.projector == CIRCLE:
        begin = "scene_on_circle"
    else:
        begin, arguments = "scene_from_clip", f"{arguments}, projector={job.projector!r}"
    name = repr(job.source.name)
    return f"scene = {begin}(space, {name}, {arguments}, random_state={job.seed})"


def posing_code(job: Posing) -> str:
    """Write the step that makes a new pose and lets the optimizer place it."""
    marker = f"scene.markers[{job.marker}]"
    return "\n".join(
        [
            f"pose = edits.turned({marker}.rotations, {job.joint}, {list(job.degrees)})",
            f"place = best_place(scene, space, pose, {marker}.position)",
            f"scene = edits.add_pose(scene, pose, {marker}.root, place)",
        ]
    )


def edit_code(edit: Mapping[str, Any]) -> str:
    """Write the step that an edit of the pad is.

    Parameters
    ----------
    edit : mapping
        One that was done.
    """
    kind = edit["kind"]
    if kind == "add" and edit["frame"] is not None:
        return f"scene = edits.add_frame(scene, space, {edit['frame']})"
    if kind == "add":
        # Nine numbers for each joint, in rows.
        numbers = list(edit["rotations"])
        pose = [[numbers[k : k + 3] for k in range(j, j + 9, 3)] for j in range(0, len(numbers), 9)]
        return f"scene = edits.add_pose(scene, {pose}, {list(edit['root'])}, {list(edit['at'])})"
    arguments = {
        "move": ("marker", "to"),
        "remove": ("marker",),
        "turn": ("marker", "joint", "angles", "place"),
        "deform": ("index", "to", "radius"),
        "draw": ("points", "times"),
        "retime": ("times",),
    }[kind]
    name = {"move": "move_marker", "remove": "remove_marker", "turn": "turn_joint"}.get(kind, kind)
    first = "scene, space" if kind == "move" else "scene"
    words = ", ".join(repr(edit[argument]) for argument in arguments)
    return f"scene = edits.{name}({first}, {words})"


def _clip_code(source: Source) -> str:
    if source.token and not source.registered:
        return f"# space: poses that were in memory as {source.name!r}"
    return f"space = load_space({source.name!r})"
