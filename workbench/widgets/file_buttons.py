"""Buttons that save files which Python makes when they are asked for, and that open some."""

from __future__ import annotations

from typing import Any

import anywidget
import traitlets

from workbench.widgets.module import es_module, style_sheet


class FileButtons(anywidget.AnyWidget):
    """Offer files that are made only when a person wants one, and saved by the browser.

    A button asks by the message ``{"want": name of the offer}``. The answer is
    :meth:`give`, or :meth:`fail` with the reason. A button that opens a file sends
    ``{"given": name of the offer, "name": file name}`` with its content as the only buffer.

    Attributes
    ----------
    offers : list of dict
        For each button ``want`` (what it asks for), ``text`` (on the button) and ``hint``
        (a sentence about the file); with ``takes``, a file ending such as ".json", the button
        opens a file instead.
    enabled : bool
        Whether there is something to save.
    label : str
        What the buttons are for, for a screen reader.

    Examples
    --------
    >>> buttons = FileButtons(offers=[{"want": "bvh", "text": "Save BVH", "hint": ""}])
    >>> buttons.give("bvh", "walk.bvh", b"HIERARCHY")
    """

    _esm = es_module("saving", "file_buttons")
    _css = style_sheet()

    offers = traitlets.List(traitlets.Dict()).tag(sync=True)
    enabled = traitlets.Bool(True).tag(sync=True)
    label = traitlets.Unicode("Files").tag(sync=True)

    def give(self, want: str, name: str, content: bytes, kind: str = "text/plain") -> None:
        """Answer with a file.

        Parameters
        ----------
        want : str
            What was asked for.
        name : str
            The name under which the browser saves it.
        content : bytes
            The file.
        kind : str
            Its media type.
        """
        message: dict[str, Any] = {"answer": want, "name": name, "type": kind}
        self.send(message, buffers=[content])

    def fail(self, want: str, reason: str) -> None:
        """Answer that there is no file, and why."""
        self.send({"answer": want, "failure": reason})
