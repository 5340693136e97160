"""The error landscape of one sample, and the ways of optimizers across it."""

from __future__ import annotations

import anywidget
import traitlets

from workbench.widgets.arrays import ArrayTrait, SelectionTrait
from workbench.widgets.module import es_module, style_sheet


class LandscapeView(anywidget.AnyWidget):
    """Show a plane with a sample's error at every place, and optimizers step by step on it.

    Hovering, stepping and playing happen in the browser; a picked sample, the step that is
    shown, the chosen optimizer and a clicked place are sent to Python.

    Attributes
    ----------
    points : array of shape (n_samples, 2), float32
        The embedding.
    control_points : array of shape (n_control_points,), int32
        Samples drawn as crosses.
    sample : int
        The picked one, -1 for none; can be set.
    sample_word : str
        What a sample is called: "sample" or "frame".
    mapped : int
        The sample that ``errors`` and ``traces`` belong to; while it is another than the
        picked one, they are drawn faintly.
    errors : array of shape (n_rows, n_columns), float32
        Errors of that sample over a grid, rows from the bottom; empty before they are there.
    columns : int
        Columns of the grid.
    extent : list of float
        x of the first and last column, y of the first and last row.
    error_name : str
        What the errors are, with their unit.
    traces : list of dict
        For each optimizer ``name``, ``title``, ``message`` (why it has no steps, or how it
        ended) and ``steps``: dicts with ``iteration``, ``x``, ``y``, ``error``, ``text`` and
        ``tries``, a list of [x, y, error, stage].
    active : str
        Name of the optimizer whose steps are shown.
    zoomed : bool
        Whether the map is to show the surroundings of the ways only; Python sends it.
    step : int
        The step that is shown; 0 is the start.
    place : list of float
        A clicked place of the plane, or empty.
    message : str
        Shown in the plane, for instance why it is empty.
    channel : str
        Views with the same channel follow the place in the plane.
    """

    _esm = es_module("places", "heat_map", "plane", "stepper", "landscape")
    _css = style_sheet()

    points = ArrayTrait("<f4")
    control_points = SelectionTrait()
    sample = traitlets.Int(-1).tag(sync=True)
    sample_word = traitlets.Unicode("sample").tag(sync=True)
    mapped = traitlets.Int(-1).tag(sync=True)
    errors = ArrayTrait("<f4")
    columns = traitlets.Int(0).tag(sync=True)
    extent = traitlets.List(traitlets.Float(), [0.0, 1.0, 0.0, 1.0]).tag(sync=True)
    error_name = traitlets.Unicode("error").tag(sync=True)
    traces = traitlets.List(traitlets.Dict()).tag(sync=True)
    active = traitlets.Unicode("").tag(sync=True)
    zoomed = traitlets.Bool(False).tag(sync=True)
    step = traitlets.Int(0).tag(sync=True)
    place = traitlets.List(traitlets.Float()).tag(sync=True)
    message = traitlets.Unicode("").tag(sync=True)
    channel = traitlets.Unicode("").tag(sync=True)
