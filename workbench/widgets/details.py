"""The values of the hovered sample of a table."""

from __future__ import annotations

import anywidget
import traitlets

from workbench.widgets.arrays import ArrayTrait
from workbench.widgets.module import es_module, style_sheet


class SampleDetails(anywidget.AnyWidget):
    """List the feature values of the hovered row, each with its place in the column's range.

    Attributes
    ----------
    values : array of shape (n_samples, n_columns), float32
        The table.
    columns : list of str
        Names of the features.
    classes : array of shape (n_samples,), int32
        Class of each row, an index into ``class_names``; empty without classes.
    class_names : list of str
        Names of the classes.
    channel : str
        Views with the same channel follow the hovered sample.
    """

    _esm = es_module("details")
    _css = style_sheet()

    values = ArrayTrait("<f4")
    columns = traitlets.List(traitlets.Unicode()).tag(sync=True)
    classes = ArrayTrait("<i4")
    class_names = traitlets.List(traitlets.Unicode()).tag(sync=True)
    channel = traitlets.Unicode("").tag(sync=True)
