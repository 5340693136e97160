"""A word that a page's tab remembers when it is reloaded."""

from __future__ import annotations

import anywidget
import traitlets

from workbench.widgets.module import es_module


class TabMemory(anywidget.AnyWidget):
    """Keep a word in the tab, so that a reloaded page, with another kernel, can go on.

    The browser forgets it with the tab, and never sends it elsewhere. Whoever duplicates a tab
    duplicates its memory, so a page should tell what it has recalled.

    Attributes
    ----------
    name : str
        What the word is kept as; nothing is recalled before there is one.
    word : str
        What to remember; empty forgets it.
    recalled : str
        From the page: what the tab remembered when it was opened; empty for nothing.
    """

    _esm = es_module("tab_memory")

    name = traitlets.Unicode("").tag(sync=True)
    word = traitlets.Unicode("").tag(sync=True)
    recalled = traitlets.Unicode("").tag(sync=True)
