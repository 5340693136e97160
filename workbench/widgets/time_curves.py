"""Curves over the frames of a motion, with what was found on them."""

from __future__ import annotations

import anywidget
import traitlets

from workbench.widgets.arrays import ArrayTrait, SelectionTrait
from workbench.widgets.module import es_module, style_sheet


class TimeCurves(anywidget.AnyWidget):
    """Show curves in rows over one axis of time, with candidates, keyframes and contacts.

    Pointing at a frame reads the curves there; pressing shows that frame in all views of the
    channel, and a line follows the frame that they show.

    Attributes
    ----------
    rows : list of dict
        For each curve ``name``, ``unit`` and ``kind``: "curve" for a line coloured by weight,
        "amount" for what is 0 or more; of a curve also ``note``, a word below its name.
    values : array of shape (n_rows, n_frames), float32
        The curves.
    weights : array of shape (n_rows, n_frames), float32
        How salient frames are on a curve, in units of its mean.
    candidates : array of shape (n_rows, n_frames), uint8
        1 for candidates.
    keyframes : array of shape (n_keyframes,), int32
        Chosen frames.
    foot_keyframes : array of shape (n_foot_keyframes,), int32
        Those of them that were found on a foot.
    contacts : list of dict
        For each foot ``name``, ``side`` and ``spans``, a list of [first, last] frames.
    frame_time : float
        Seconds between frames.
    frame : int
        The frame to show at first.
    message : str
        Shown instead, for instance why there are no curves.
    channel : str
        Views with the same channel show the same frame.
    """

    _esm = es_module("colours", "time_curves")
    _css = style_sheet()

    rows = traitlets.List(traitlets.Dict()).tag(sync=True)
    values = ArrayTrait("<f4")
    weights = ArrayTrait("<f4")
    candidates = ArrayTrait("u1")
    keyframes = SelectionTrait()
    foot_keyframes = SelectionTrait()
    contacts = traitlets.List(traitlets.Dict()).tag(sync=True)
    frame_time = traitlets.Float(1.0).tag(sync=True)
    frame = traitlets.Int(0).tag(sync=True)
    message = traitlets.Unicode("").tag(sync=True)
    channel = traitlets.Unicode("").tag(sync=True)
