"""The pose view: a stick figure of the hovered frame."""

from __future__ import annotations

from collections.abc import Sequence

import anywidget
import traitlets

from workbench.widgets.arrays import ArrayTrait
from workbench.widgets.module import es_module, style_sheet


class PoseView(anywidget.AnyWidget):
    """Draw one frame of a motion as a stick figure.

    The browser gets the positions of all frames once, so that a hovered frame is drawn
    without asking the kernel.

    Attributes
    ----------
    positions : array of shape (n_frames, n_nodes, 3), float32
        World positions of joints and end sites, y up, in file units.
    parents : list of int
        Parent node of each node, -1 for the root.
    sides : list of {"left", "right", "middle"}
        Which side of the body each node is on.
    frame_time : float
        Seconds between frames.
    frame : int
        The frame to show until one is hovered.
    channel : str
        Views with the same channel follow the hovered sample.
    """

    _esm = es_module("pose")
    _css = style_sheet()

    positions = ArrayTrait("<f4")
    parents = traitlets.List(traitlets.Int()).tag(sync=True)
    sides = traitlets.List(traitlets.Unicode()).tag(sync=True)
    frame_time = traitlets.Float(1.0).tag(sync=True)
    frame = traitlets.Int(0).tag(sync=True)
    channel = traitlets.Unicode("").tag(sync=True)


def joint_sides(names: Sequence[str]) -> list[str]:
    """Tell left from right joints by their names.

    A joint is on the left if exchanging left for right gives the name of another joint
    (``LeftArm``, ``lfemur``, ``hand_l``, ``Bip01 L Foot``), so that ``LowerBack`` and
    ``root`` stay in the middle.

    Parameters
    ----------
    names : sequence of str
        Joint names of one skeleton.

    Returns
    -------
    list of {"left", "right", "middle"}

    Examples
    --------
    >>> joint_sides(["Hips", "LowerBack", "LHipJoint", "RHipJoint"])
    ['middle', 'middle', 'left', 'right']
    """
    known = {name.lower() for name in names}
    return [_side(name.lower(), known) for name in names]


def _side(name: str, known: set[str]) -> str:
    for own, other, side in (("l", "r", "left"), ("r", "l", "right")):
        words = {"l": "left", "r": "right"}
        mirrored = {name.replace(words[own], words[other])}
        mirrored |= {
            name[:place] + other + name[place + 1 :]
            for place, letter in enumerate(name)
            if letter == own and _stands_for_a_side(name, place)
        }
        if (mirrored - {name}) & known:
            return side
    return "middle"


def _stands_for_a_side(name: str, place: int) -> bool:
    """Tell whether a letter can mean a side: at either end, or alone between marks."""
    before, after = name[place - 1 : place], name[place + 1 : place + 2]
    return place == 0 or (not before.isalnum() and not after.isalnum())
