"""Error against the number of keyframes, from which a number can be chosen."""

from __future__ import annotations

import anywidget
import traitlets

from workbench.widgets.module import es_module, style_sheet


class CountCurve(anywidget.AnyWidget):
    """Show how the error falls with the number of keyframes, and let a number be picked.

    Attributes
    ----------
    series : list of dict
        For each method ``name``, ``counts`` and ``errors``, lists of equal length; the counts
        rise.
    count : int
        The number that is shown elsewhere; 0 for none.
    most : int
        The largest number that there can be; 0 if it is not known.
    error : float
        Its error; None if it is not known.
    picked : int
        The number that a person asks for; Python sets it back to 0.
    waiting : bool
        Whether keyframes are being found: what was picked is shown until they are, or will not
        be.
    unit : str
        What the error is.
    message : str
        What is still to come, or why it is not there.
    """

    _esm = es_module("count_curve")
    _css = style_sheet()

    series = traitlets.List(traitlets.Dict()).tag(sync=True)
    count = traitlets.Int(0).tag(sync=True)
    most = traitlets.Int(0).tag(sync=True)
    error = traitlets.Float(None, allow_none=True).tag(sync=True)
    picked = traitlets.Int(0).tag(sync=True)
    waiting = traitlets.Bool(False).tag(sync=True)
    unit = traitlets.Unicode("error").tag(sync=True)
    message = traitlets.Unicode("").tag(sync=True)
