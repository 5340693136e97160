"""Scatter panels with linked selection."""

from __future__ import annotations

import anywidget
import traitlets

from workbench.widgets.arrays import ArrayTrait, SelectionTrait
from workbench.widgets.module import es_module, style_sheet


class ScatterPanels(anywidget.AnyWidget):
    """Show several embeddings of the same samples side by side.

    What is marked or hovered in one panel is marked in all; this happens in the browser.
    Only a finished selection is sent to Python.

    Attributes
    ----------
    panels : list of dict
        One for each panel: ``title``, ``detail`` (a line of quality values), ``message``
        (shown in the panel, for instance why it is empty) and ``state``: "ready", "busy"
        or "failed".
    points : array of shape (n_panels, n_samples, 2), float32
        Positions; NaN where a panel has none yet.
    classes : array of shape (n_samples,), int32
        Class of each sample, an index into ``class_names``; empty without classes.
    class_names : list of str
        Names for the legend.
    color_by : {"class", "time", "none"}
        What colours stand for.
    control_points : array of shape (n_control_points,), int32
        Samples drawn as crosses.
    selection : array of shape (n_selected,), int32
        Sorted indices of the selected samples; can be set.
    sample_word : str
        What a sample is called: "sample" or "frame".
    channel : str
        Views with the same channel follow the hovered sample.

    Examples
    --------
    >>> panels = ScatterPanels(panels=[{"title": "PCA"}], points=[[[0, 0], [1, 1]]])
    >>> panels.selection = [1, 0, 1]
    >>> panels.selection.tolist()
    [0, 1]
    """

    _esm = es_module("panel", "scatter")
    _css = style_sheet()

    panels = traitlets.List(traitlets.Dict()).tag(sync=True)
    points = ArrayTrait("<f4")
    classes = ArrayTrait("<i4")
    class_names = traitlets.List(traitlets.Unicode()).tag(sync=True)
    color_by = traitlets.Enum(["class", "time", "none"], "none").tag(sync=True)
    control_points = SelectionTrait()
    selection = SelectionTrait()
    sample_word = traitlets.Unicode("sample").tag(sync=True)
    channel = traitlets.Unicode("").tag(sync=True)
