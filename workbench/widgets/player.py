"""The motion player: motions of one skeleton that play in step."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import anywidget
import numpy as np
import traitlets

from workbench.errors import WorkbenchError
from workbench.mocap.body_nodes import body_nodes, node_positions
from workbench.mocap.motion import Motion, check_motion
from workbench.widgets.arrays import ArrayTrait, SelectionTrait
from workbench.widgets.module import es_module, style_sheet


class MotionPlayer(anywidget.AnyWidget):
    """Play motions side by side or one over the other, always at the same frame.

    All positions go to the browser once; playing, scrubbing and turning ask nothing of the
    kernel. ``frame`` is sent when playing pauses and after each step by hand, ``ends``
    whenever the end was reached while playing.

    Attributes
    ----------
    motions : list of str
        What to call the motions. The first is the ghost where they are drawn over each other.
    positions : array of shape (n_motions, n_frames, n_nodes, 3), float32
        World positions of joints and end sites, y up, in file units.
    parents : list of int
        Parent node of each node, -1 for the root; the same in all motions.
    sides : list of {"left", "right", "middle"}
        Which side of the body each node is on.
    head : int
        The far end of the bone around which a head is drawn; -1 for none.
    frame_time : float
        Seconds between frames.
    keyframes : array of shape (n_keyframes,), int32
        Frames that are marked on the time bar.
    contacts : list of dict
        For each foot ``name``, ``side`` and ``spans``, a list of [first, last] frames in which
        it stands on the ground.
    frame : int
        The frame to show; can be set.
    speed : float
        1/4, 1/2, 1 or 2 times as fast as recorded.
    loop : bool
        Whether the end is followed by the start.
    overlaid : bool
        Whether the motions are drawn over each other.
    autoplay : bool
        Whether to start by itself; where a person prefers reduced motion it never does.
    ends : int
        How often the end was reached while playing.
    description : str
        What is played, for a screen reader.
    channel : str
        Views with the same channel show the same frame.
    """

    _esm = es_module("stick_figure", "orbit", "stage", "time_bar", "player")
    _css = style_sheet()

    motions = traitlets.List(traitlets.Unicode()).tag(sync=True)
    positions = ArrayTrait("<f4")
    parents = traitlets.List(traitlets.Int()).tag(sync=True)
    sides = traitlets.List(traitlets.Unicode()).tag(sync=True)
    head = traitlets.Int(-1).tag(sync=True)
    frame_time = traitlets.Float(1.0).tag(sync=True)
    keyframes = SelectionTrait()
    contacts = traitlets.List(traitlets.Dict()).tag(sync=True)
    frame = traitlets.Int(0).tag(sync=True)
    speed = traitlets.Float(1.0).tag(sync=True)
    loop = traitlets.Bool(True).tag(sync=True)
    overlaid = traitlets.Bool(False).tag(sync=True)
    autoplay = traitlets.Bool(False).tag(sync=True)
    ends = traitlets.Int(0).tag(sync=True)
    description = traitlets.Unicode("motions").tag(sync=True)
    channel = traitlets.Unicode("").tag(sync=True)


def motion_traits(motions: Mapping[str, Motion]) -> dict[str, Any]:
    """Give the traits by which a player shows motions of one skeleton.

    Parameters
    ----------
    motions : mapping of str to Motion
        One or more, by what to call them, of the same skeleton and number of frames.

    Returns
    -------
    dict
        ``motions``, ``positions``, ``parents``, ``sides``, ``head`` and ``frame_time``, for
        :class:`MotionPlayer`.

    Raises
    ------
    WorkbenchError
        If there is none, or they cannot play in step.

    Examples
    --------
    >>> from workbench.datasets import load_space
    >>> jump = load_space("cmu/01_01-jump").motion
    >>> player = MotionPlayer(**motion_traits({"A": jump, "B": jump}))
    >>> player.motions, len(player.parents)
    (['A', 'B'], 38)
    """
    if not motions:
        raise WorkbenchError("motions: got none, want at least one")
    for motion in motions.values():
        check_motion(motion)
    first, *others = motions.values()
    skeleton = first.skeleton
    for name, motion in zip(list(motions)[1:], others, strict=True):
        same = np.array_equal(motion.skeleton.parents, skeleton.parents)
        if not same or len(motion) != len(first) or motion.frame_time != first.frame_time:
            raise WorkbenchError(
                f"motions: {name!r} has another skeleton, length or frame time than "
                f"{next(iter(motions))!r}, want motions that play in step"
            )
    body = body_nodes(skeleton)
    return {
        "motions": list(motions),
        "positions": np.array([node_positions(m) for m in motions.values()], dtype=np.float32),
        "parents": body.parents,
        "sides": body.sides,
        "head": body.head,
        "frame_time": float(first.frame_time),
    }
