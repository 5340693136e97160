"""What the preparation of a study shows, and how it is laid out."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from html import escape
from pathlib import Path
from urllib.parse import parse_qs, quote

import ipywidgets as widgets

from workbench.dashboards.shared.home import Home
from workbench.dashboards.shared.layout import FITTING, alert
from workbench.dashboards.shared.progress_view import ProgressView
from workbench.dashboards.study.controls import StudyControls
from workbench.dashboards.study.files import studies_folder
from workbench.dashboards.study.tables import stimuli_table
from workbench.study.answers import Stimulus
from workbench.study.design import StudyDesign
from workbench.study.stimuli import stimulus_motion
from workbench.widgets.player import MotionPlayer, motion_traits

#: Pages of notebooks give links no colour of their own.
_LINK = "color: var(--jp-content-link-color, #1565c0); text-decoration: underline"
_VISIBLE_NAME = (
    "<small>Participants can read the file's name in the address of their page: it should name "
    "no method.</small>"
)


class PreparationView:
    """The preparation of a study, below and above its controls.

    Parameters
    ----------
    controls : StudyControls
        What can be chosen.

    Attributes
    ----------
    progress : ProgressView
        What is being computed.
    player : MotionPlayer
        One clip as participants will see it, but with the methods' names.
    shown : ipywidgets.Dropdown
        Which clip that is.
    message, table, saved : ipywidgets.HTML
        What is missing or how long the study is; what is shown in it; where it is stored.
    root : ipywidgets.Widget
        All of it.
    """

    def __init__(self, controls: StudyControls) -> None:
        self.progress = ProgressView("all stimuli")
        self.player = MotionPlayer(layout=widgets.Layout(width="100%", min_width="0"))
        self.shown = widgets.Dropdown(description="Look at", style=FITTING)
        self.message, self.table, self.saved = (widgets.HTML() for _ in range(3))
        self._controls = controls
        self._items: Sequence[tuple[Stimulus, ...]] = ()
        self._played: tuple[Stimulus, ...] | None = None
        self.shown.observe(Home().here(lambda _: self._show_item()), "value")
        self.root = widgets.VBox(
            [
                controls.view,
                self.progress.view,
                self.message,
                self.table,
                self.shown,
                self.player,
                controls.file_row,
                widgets.HTML(_VISIBLE_NAME),
                self.saved,
            ],
            layout=widgets.Layout(width="100%"),
        )

    def show(
        self, items: Sequence[tuple[Stimulus, ...]], told: Sequence[str], design: StudyDesign | None
    ) -> None:
        """Show what is there.

        Parameters
        ----------
        items : sequence of tuple of Stimulus
            What was made so far.
        told : sequence of str
            What failed or is missing.
        design : StudyDesign or None
            The study, if it is complete.
        """
        self.table.value = stimuli_table(items) if items else ""
        about = "" if design is None else _about(design)
        self.message.value = "".join(alert(words) for words in told) or about
        self._controls.save.disabled = design is None
        self._items = items
        names = [item[0].motion for item in items]
        # While stimuli are made anew, what was looked at is kept for them.
        arrived = design is not None or bool(told) or not self.shown.options
        if arrived and names and list(self.shown.options) != names:
            before = self.shown.value
            self.shown.options = names
            self.shown.value = before if before in names else names[0]
        self._show_item()

    def show_saved(self, path: Path) -> None:
        """Say where the study is and how participants get there."""
        words = f"The study is in <b>{escape(str(path))}</b>. "
        if os.environ.get("SERVER_SOFTWARE", "").startswith("voila"):
            # A folder is nothing that participants need to know.
            name = path.name if path.parent == studies_folder() else str(path)
            address = f"take_part.ipynb?study={quote(name)}{_theme()}"
            link = f'<a href="{escape(address)}" target="_blank" style="{_LINK}">'
            words += f"{link}Open the participants' page</a>."
        else:
            words += "Participants open the notebook <b>take_part.ipynb</b>."
        self.saved.value = f'<div role="status" style="line-height: 1.4">{words}</div>'

    def show_failure(self, words: str) -> None:
        """Say why the study was not stored."""
        self.saved.value = alert(words)

    def _show_item(self) -> None:
        item = next((i for i in self._items if i[0].motion == self.shown.value), None)
        for part in (self.shown, self.player):
            part.layout.display = None if item else "none"
        if item is None or item is self._played:
            return
        self._played = item
        traits = motion_traits({s.name: stimulus_motion(s) for s in item})
        with self.player.hold_sync():
            self.player.frame = 0
            self.player.description = item[0].motion
            for name, value in traits.items():
                setattr(self.player, name, value)


def _about(design: StudyDesign) -> str:
    """Say how long a study is, and after how many participants places are balanced."""
    block = math.lcm(len(design.items), *(len(item) for item in design.items))
    words = (
        f"{len(design.items)} clips, {len(design.stimuli)} ratings, about "
        f"{max(1, round(design.minutes))} minutes for each participant. Orders are balanced over "
        f"each {block} participants who begin."
    )
    return f'<div style="line-height: 1.4">{escape(words)}</div>'


def _theme() -> str:
    """Hand the theme of this page on, as its address tells it."""
    theme = parse_qs(os.environ.get("QUERY_STRING", "")).get("theme", [""])[0]
    return f"&theme={quote(theme)}" if theme else ""
