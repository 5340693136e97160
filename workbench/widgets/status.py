"""A line of text that a screen reader speaks when it changes."""

from __future__ import annotations

import anywidget
import traitlets

from workbench.widgets.module import es_module, style_sheet


class StatusLine(anywidget.AnyWidget):
    """Say what is going on.

    An HTML widget makes its elements anew with each text, and screen readers speak only the
    changes of an element that stays.

    Attributes
    ----------
    value : str
        Plain text.
    """

    _esm = es_module("status")
    _css = style_sheet()

    value = traitlets.Unicode("").tag(sync=True)
