"""An item of a study as a participant sees it: motions that play, and the form to rate them."""

from __future__ import annotations

from collections.abc import Callable
from time import monotonic
from typing import Any

import ipywidgets as widgets

from workbench.dashboards.shared.layout import view_row
from workbench.dashboards.study.pages import FETCHING, WATCH_FIRST
from workbench.widgets.player import MotionPlayer
from workbench.widgets.rating_form import RatingForm


class ItemView:
    """The motions of an item beside the form in which they are rated.

    Parameters
    ----------
    here : callable
        Brings what the page reports to the thread of the dashboard.

    Attributes
    ----------
    form : RatingForm
        Where ratings are given; ready once the motions were seen.
    player : MotionPlayer
        Where the motions play, another one for each item.
    root : ipywidgets.Widget
        All of it.
    """

    def __init__(self, here: Callable[..., Any]) -> None:
        self.form = RatingForm(layout=widgets.Layout(flex="1 1 450px", max_width="500px"))
        self.player = MotionPlayer()
        self._here = here
        self._seen_at = 0.0
        self._stage = widgets.Box([], layout=widgets.Layout(flex="3 1 440px", min_width="0"))
        # The form stays in the page from item to item, so that it can lead the focus.
        self.root = view_row([self._stage, self.form])

    def show_fetching(self) -> None:
        """Say that motions are on their way."""
        self._stage.children = [widgets.HTML(FETCHING)]

    def show_player(self) -> None:
        """Show the motions of the item before again."""
        self._stage.children = [self.player]

    def show(
        self,
        motions: dict[str, Any],
        ratings: list[int],
        *,
        heading: str,
        note: str,
        question: str,
        onward: str,
    ) -> None:
        """Show another item.

        Parameters
        ----------
        motions : dict
            From :func:`workbench.widgets.player.motion_traits`, by letters.
        ratings : list of int
            What is stored of it; 0 for what is not.
        heading, note, question, onward : str
            As :class:`~workbench.widgets.rating_form.RatingForm` has them.
        """
        before = self.player
        # Another player, so that nothing of the item before stays: neither turn nor ends.
        self.player = MotionPlayer(
            **motions,
            description=f"{heading}, motions side by side",
            autoplay=True,
            layout=widgets.Layout(width="100%", min_width="0"),
        )
        self.player.observe(self._here(self._on_end), "ends")
        # Whoever jumps to the end has not seen it: it takes as long as the motion is.
        n_frames = motions["positions"].shape[1]
        self._seen_at = monotonic() + 0.9 * n_frames * motions["frame_time"]
        form = self.form
        with form.hold_sync():
            form.heading, form.note, form.question, form.onward = heading, note, question, onward
            form.letters = motions["motions"]
            form.stored = form.chosen = ratings
            # Who has rated something has seen it.
            form.ready = any(ratings)
            form.waiting, form.message = WATCH_FIRST, ""
        self._stage.children = [self.player]
        before.close()

    def close(self) -> None:
        """Take the item out of the page."""
        for part in (self.player, self.form, self.root):
            part.close()

    def _on_end(self, change: Any) -> None:
        if change["new"] > 0 and monotonic() >= self._seen_at:
            self.form.ready = True
