"""Controls with which a dashboard's data are chosen."""

from __future__ import annotations

from collections.abc import Sequence

import ipywidgets as widgets

from workbench.dashboards.shared.layout import FITTING, control_row
from workbench.dashboards.shared.sources import Choice, Source

_OWN = ""  # the drop-down's value while data come from elsewhere


class DataControls:
    """Choose a data set by name, or a file of one's own.

    Parameters
    ----------
    choices : sequence of Choice
        Data that can be shown.
    word : str
        What to call them.
    files : str
        Which kinds of files can be opened.

    Attributes
    ----------
    data : ipywidgets.Dropdown
        Names.
    own : ipywidgets.ToggleButton
        Shows the row for a file.
    path, label : ipywidgets.Text
        The file, and the column that holds the classes of a table.
    open : ipywidgets.Button
        To load the file.
    own_row : ipywidgets.Box
        The file's controls.
    """

    def __init__(
        self,
        choices: Sequence[Choice],
        word: str = "Data",
        files: str = "CSV, TSV, Parquet, ARFF, BVH or AMC",
    ) -> None:
        self.data = widgets.Dropdown(
            options=[("your own", _OWN), *((choice.text, choice.name) for choice in choices)],
            description=word,
            style=FITTING,
            layout=widgets.Layout(flex="1 1 300px", max_width="520px"),
        )
        self.own = widgets.ToggleButton(
            description="Own file",
            icon="folder-open",
            tooltip="Open a file of your own",
            layout=widgets.Layout(width="110px"),
        )
        self.path = widgets.Text(
            placeholder=f"path of a {files} file",
            description="File",
            style=FITTING,
            layout=widgets.Layout(flex="1 1 300px"),
        )
        self.label = widgets.Text(
            placeholder="optional",
            description="Class column",
            style=FITTING,
            layout=widgets.Layout(width="200px"),
        )
        self.open = widgets.Button(
            description="Open", tooltip="Load this file", layout=widgets.Layout(width="80px")
        )
        self.own_row = control_row([self.path, self.label, self.open])
        self.own.observe(lambda _: self._show_own(), "value")
        self._show_own()

    def choose(self, source: Source) -> None:
        """Show the name of the data; what is not listed is the user's own."""
        first = source.names[0]
        known = source.registered or not source.token
        listed = {value for _, value in self.data.options}
        self.data.value = first if known and first in listed else _OWN

    def _show_own(self) -> None:
        self.own_row.layout.display = None if self.own.value else "none"
