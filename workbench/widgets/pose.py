"""The pose view: a stick figure of the hovered frame."""

from __future__ import annotations

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
    head : int
        The far end of the bone around which a head is drawn; -1 for none.
    frame_time : float
        Seconds between frames.
    frame : int
        The frame to show until one is hovered.
    channel : str
        Views with the same channel follow the hovered sample.
    """

    _esm = es_module("stick_figure", "orbit", "pose")
    _css = style_sheet()

    positions = ArrayTrait("<f4")
    parents = traitlets.List(traitlets.Int()).tag(sync=True)
    sides = traitlets.List(traitlets.Unicode()).tag(sync=True)
    head = traitlets.Int(-1).tag(sync=True)
    frame_time = traitlets.Float(1.0).tag(sync=True)
    frame = traitlets.Int(0).tag(sync=True)
    channel = traitlets.Unicode("").tag(sync=True)
