"""Names for the handles of sliders, which ipywidgets leaves without."""

from __future__ import annotations

import anywidget
import ipywidgets

from workbench.widgets.module import es_module


class SliderNames(anywidget.AnyWidget):
    """Tell screen readers what the sliders beside it are called.

    ipywidgets shows a slider's description next to it, but the handle, which is what a keyboard
    reaches, has no name. Put one of these, which shows nothing, into the box of the sliders.
    """

    _esm = es_module("slider_names")

    def __init__(self) -> None:
        super().__init__(layout=ipywidgets.Layout(display="none"))
