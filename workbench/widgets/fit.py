"""Make plotly figures fit their place in a dashboard."""

from __future__ import annotations

import anywidget
import traitlets

from workbench.widgets.module import es_module


class FigureFit(anywidget.AnyWidget):
    """Keep the figure beside it as wide as the box that holds both; shows nothing itself.

    The figure must be configured with ``responsive: True``.

    Attributes
    ----------
    place : str
        A CSS class of the box.
    """

    _esm = es_module("fit")

    place = traitlets.Unicode("wb-curves").tag(sync=True)
