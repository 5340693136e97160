"""Progress of what a dashboard computes, and the buttons that end and repeat it."""

from __future__ import annotations

from collections.abc import Sequence

import ipywidgets as widgets

from workbench.widgets.status import StatusLine


class ProgressView:
    """Say what is being computed and how much of it is done.

    Parameters
    ----------
    what : str
        What is computed anew where nothing failed.
    others : sequence of ipywidgets.Widget
        Further controls of the computation, behind the first button.

    Attributes
    ----------
    cancel, again : ipywidgets.Button
        To end a computation and to repeat it.
    view : ipywidgets.Widget
        All of it.
    """

    def __init__(self, what: str = "everything", others: Sequence[widgets.Widget] = ()) -> None:
        self.cancel = widgets.Button(description="Cancel", icon="stop")
        self.again = widgets.Button(
            description="Compute again",
            tooltip=f"Compute what failed or was cancelled, or else {what} anew",
        )
        self._bar = widgets.FloatProgress(min=0, max=1, layout=widgets.Layout(width="200px"))
        self._doing = StatusLine(layout=widgets.Layout(flex="1 1 200px", min_width="0"))
        self.view = widgets.Box(
            [self.again, *others, self.cancel, self._bar, self._doing],
            layout=widgets.Layout(flex_flow="row wrap", align_items="center", grid_gap="4px 8px"),
        )

    @property
    def text(self) -> str:
        """What it says."""
        return str(self._doing.value)

    def show(self, text: str, done: float) -> None:
        """Say what is being computed, and how much of everything is done (0 to 1)."""
        self._bar.value = done
        self._doing.value = f"{text} …" if text else ""

    def show_busy(self, busy: bool) -> None:
        """Show or hide the progress; hidden, it keeps its place so that nothing jumps."""
        for part in (self._bar, self.cancel):
            part.layout.visibility = "visible" if busy else "hidden"
        self.again.disabled = busy
        if not busy:
            self.show("", 0.0)
