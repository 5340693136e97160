"""A drawing that can be saved."""

from __future__ import annotations

import anywidget
import traitlets

from workbench.widgets.module import es_module, style_sheet


class PictureView(anywidget.AnyWidget):
    """Show a drawing with buttons that save it as SVG and as PNG, made by the browser.

    Attributes
    ----------
    svg : str
        The drawing as the text of an SVG file; empty for none.
    name : str
        Name of the saved files, without ending.
    title : str
        What to call it.
    description : str
        What it shows, for those who cannot see it.
    """

    _esm = es_module("saving", "drawing")
    _css = style_sheet()

    svg = traitlets.Unicode("").tag(sync=True)
    name = traitlets.Unicode("picture").tag(sync=True)
    title = traitlets.Unicode("Picture").tag(sync=True)
    description = traitlets.Unicode("").tag(sync=True)
