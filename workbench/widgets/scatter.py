"""Scatter panels with linked selection."""

from __future__ import annotations

from typing import Any

import anywidget
import numpy as np
import traitlets
from numpy.typing import NDArray

from workbench.errors import WorkbenchError
from workbench.widgets.arrays import ArrayTrait, SelectionTrait
from workbench.widgets.module import es_module, style_sheet

# The browser's side; a part uses only those before it, except within functions.
_PARTS = (
    *("state", "marks", "colours", "legend", "placement", "cloud", "panel"),
    *("stages", "brush", "mover", "input", "picture", "saving", "toolbar"),
)


class ScatterPanels(anywidget.AnyWidget):
    """Show several embeddings of the same samples side by side.

    What is marked, hovered or moved in one panel follows in the browser; only a finished
    selection and a dropped control point are sent to Python. Arrays whose shape does not fit
    ``points`` are not drawn, since they may arrive one after the other.

    Attributes
    ----------
    panels : list of dict
        One for each panel, six at most: ``title``, ``detail`` (a line of quality values),
        ``message`` (shown in the panel, for instance why it is empty) and ``state``: "ready",
        "busy" or "failed"; also ``raw_detail``, which takes the place of ``detail`` before the
        optimization. After control points are moved, the caption says that ``detail`` is from
        before, until ``panels`` is set anew.
    points : array of shape (n_panels, n_samples, 2), float32
        Positions; NaN where a panel has none yet. The same samples travel from their old
        positions to new ones.
    raw_points : array of shape (n_panels, n_samples, 2), float32
        Positions before the optimization; NaN in panels without one, empty if no panel has.
    transition : int
        How long samples travel, in milliseconds; a browser set to reduced motion shows none
        of it.
    classes : array of shape (n_samples,), int32
        Class of each sample, an index into ``class_names``; empty without classes.
    class_names : list of str
        Names for the legend.
    color_by : {"class", "time", "value", "none"}
        What colours stand for.
    values : array of shape (n_panels, n_samples), float32
        A local quality of each sample in each panel; NaN where it is unknown.
    value_name : str
        What ``values`` are, for the legend.
    value_best : {"low", "high"}
        Which end of ``values`` is the better one.
    control_points : array of shape (n_control_points,), int32
        Samples drawn as crosses.
    influence : array of shape (n_samples, n_control_points), float32
        How much each control point's position counts for each sample, so that positions are
        ``influence @ positions[control_points]``; rows of control points are unit vectors.
        Empty if control points cannot be moved.
    movable : bool
        Whether control points can be dragged; needs ``influence``.
    moved : array of shape (n_panels, n_control_points, 2), float32
        Positions of the control points in panels in which one was moved, NaN in the others;
        empty if none was. Set by the browser at the end of a drag; can be set.
    selection : array of shape (n_selected,), int32
        Sorted indices of the selected samples; can be set.
    sample_word : str
        What a sample is called: "sample" or "frame".
    channel : str
        Views with the same channel follow the hovered sample.
    offers_html : bool
        Whether the view offers a single HTML file. It asks for it by the message
        ``{"want": "html"}``, to be answered by ``{"kind": "html", "name": file name}`` with
        the file as the only buffer, or by ``{"kind": "failure", "text": why}``.

    Examples
    --------
    >>> panels = ScatterPanels(panels=[{"title": "PCA"}], points=[[[0, 0], [1, 1]]])
    >>> panels.selection = [1, 0, 1]
    >>> panels.selection.tolist()
    [0, 1]
    """

    _esm = es_module(*_PARTS, "scatter")
    _css = style_sheet()

    panels = traitlets.List(traitlets.Dict(), maxlen=6).tag(sync=True)
    points = ArrayTrait("<f4")
    raw_points = ArrayTrait("<f4")
    transition = traitlets.Int(700).tag(sync=True)
    classes = ArrayTrait("<i4")
    class_names = traitlets.List(traitlets.Unicode()).tag(sync=True)
    color_by = traitlets.Enum(["class", "time", "value", "none"], "none").tag(sync=True)
    values = ArrayTrait("<f4")
    value_name = traitlets.Unicode("").tag(sync=True)
    value_best = traitlets.Enum(["low", "high"], "low").tag(sync=True)
    control_points = SelectionTrait()
    influence = ArrayTrait("<f4")
    movable = traitlets.Bool(False).tag(sync=True)
    moved = ArrayTrait("<f4")
    selection = SelectionTrait()
    sample_word = traitlets.Unicode("sample").tag(sync=True)
    channel = traitlets.Unicode("").tag(sync=True)
    offers_html = traitlets.Bool(False).tag(sync=True)

    @traitlets.validate("moved")
    def _shape_moved(self, proposal: dict[str, Any]) -> NDArray[np.float32]:
        moved: NDArray[np.float32] = proposal["value"]
        shape = (len(self.panels), len(self.control_points), 2)
        if moved.size == 0 or moved.shape == shape:
            return moved
        if moved.ndim > 1:
            raise WorkbenchError(
                f"moved: got an array of shape {moved.shape}, want {shape}: "
                "panels, control points, coordinates"
            )
        # The browser sends flat values. A drop that comes after the panels changed is void.
        fits = moved.size == np.prod(shape)
        return moved.reshape(shape) if fits else np.empty(0, dtype=np.float32)
