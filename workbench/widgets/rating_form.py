"""Ratings of motions that are shown side by side."""

from __future__ import annotations

import anywidget
import traitlets

from workbench.widgets.module import es_module, style_sheet


class RatingForm(anywidget.AnyWidget):
    """Ask for a rating from 1 to 10 of each of several things, each told to Python at once.

    The page shows a rating as stored only when Python has said so in ``stored``, and lets the
    person go on only when all are.

    Attributes
    ----------
    heading : str
        Where in the study this is; the focus goes there when it changes.
    note : str
        What else to know, in small letters.
    question : str
        What is asked.
    letters : list of str
        What to call the things to rate, from left to right.
    stored : list of int
        For each, the rating that is stored; 0 for none.
    ready : bool
        Whether ratings can be given.
    waiting : str
        What must happen first, where they cannot.
    onward : str
        What the button says that goes on.
    message : str
        What went wrong.
    chosen : list of int
        From the page: for each, the rating that was chosen; 0 for none. All of them, because
        choices that follow each other fast reach Python as one. Python sets it with ``stored``.
    finished : int
        From the page: how often the button was pressed.
    """

    _esm = es_module("rating_form")
    _css = style_sheet()

    heading = traitlets.Unicode("").tag(sync=True)
    note = traitlets.Unicode("").tag(sync=True)
    question = traitlets.Unicode("").tag(sync=True)
    letters = traitlets.List(traitlets.Unicode()).tag(sync=True)
    stored = traitlets.List(traitlets.Int()).tag(sync=True)
    ready = traitlets.Bool(False).tag(sync=True)
    waiting = traitlets.Unicode("").tag(sync=True)
    onward = traitlets.Unicode("Next").tag(sync=True)
    message = traitlets.Unicode("").tag(sync=True)
    chosen = traitlets.List(traitlets.Int()).tag(sync=True)
    finished = traitlets.Int(0).tag(sync=True)
