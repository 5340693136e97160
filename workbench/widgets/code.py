"""Code to be copied into a cell."""

from __future__ import annotations

import anywidget
import traitlets

from workbench.widgets.module import es_module, style_sheet


class CodeView(anywidget.AnyWidget):
    """Show code with a button that copies it.

    Attributes
    ----------
    code : str
        The code.
    """

    _esm = es_module("code")
    _css = style_sheet()

    code = traitlets.Unicode("").tag(sync=True)
