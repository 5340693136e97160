"""A plotly figure that follows the page's theme and width."""

from __future__ import annotations

import gzip
from functools import cache
from typing import Any

import anywidget
import traitlets

from workbench.widgets.module import es_module, style_sheet


class FigureView(anywidget.AnyWidget):
    """Show a plotly figure as wide as its place, in colours that suit the page's theme.

    Plotly's own FigureWidget brings a module of 5 MB in each instance, which a slow machine
    does not start within the two seconds that anywidget grants; the whole dashboard suffers.
    Here the library follows when the page asks for it, once for all figures.

    Attributes
    ----------
    figure : str
        The figure as JSON, from ``figure.to_json()``. Colours of lines and markers, of the
        ground and of the text are set by the page.
    description : str
        What the figure shows, for a screen reader.
    """

    _esm = es_module("figure")
    _css = style_sheet()

    figure = traitlets.Unicode('{"data": [], "layout": {}}').tag(sync=True)
    description = traitlets.Unicode("").tag(sync=True)

    def __init__(self, **traits: Any) -> None:
        super().__init__(**traits)
        self.on_msg(_send_library)


def _send_library(view: FigureView, content: dict[str, Any], _: Any) -> None:
    if content.get("want") == "plotly.js":
        view.send({"kind": "plotly.js"}, buffers=[packed_library()])


@cache
def packed_library() -> bytes:
    """Give plotly.js, packed by gzip."""
    from plotly.offline import get_plotlyjs

    return gzip.compress(get_plotlyjs().encode(), compresslevel=1)
