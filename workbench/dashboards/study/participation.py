"""The participant's page of a user study, from which neither methods nor results can be told."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path
from string import ascii_uppercase
from typing import Any

import ipywidgets as widgets

from workbench.dashboards.shared.home import Home, running_loop
from workbench.dashboards.shared.layout import FITTING, alert, control_row
from workbench.dashboards.study.files import known_studies, study_of_address, study_path
from workbench.dashboards.study.item_view import ItemView
from workbench.dashboards.study.pages import (
    EXERCISE,
    FAILED,
    RATE_ALL,
    WATCH_FIRST,
    onward_text,
    page_button,
    thanks_text,
    welcome_text,
)
from workbench.errors import DataError, WorkbenchError
from workbench.study.design import load_design
from workbench.study.run import StudyRun
from workbench.study.stimuli import stimulus_motion
from workbench.widgets.player import MotionPlayer, motion_traits
from workbench.widgets.tab_memory import TabMemory

#: Seconds between the start of an item and work on the next one.
_PAUSE = 1.0


class _Asked(Exception):  # noqa: N818 - no error: a person can do it
    """Say in words for participants what is to be done first."""


def take_part_in_study(study: str | Path = "") -> StudyParticipation:
    """Show the page on which participants rate motions.

    Parameters
    ----------
    study : str or path-like
        Name or path of a study that was prepared. By default the one that the page's address
        asks for (``take_part.ipynb?study=NAME``), or the one that was prepared or used last.

    Returns
    -------
    StudyParticipation
        Shown by a notebook as the last expression of a cell.
    """
    return StudyParticipation(study)


class StudyParticipation:
    """A page that leads a participant through a study.

    Each rating is on the disk before the page says that it is stored. A page that was reloaded,
    or whose kernel ended, goes on with the item that was on the screen.

    Parameters
    ----------
    study
        As for :func:`take_part_in_study`.

    Attributes
    ----------
    run : StudyRun or None
        Who takes part; None before it is known.
    index : int or None
        The item on the screen, from 0; None for another page, −1 for the exercise.
    form : RatingForm
        Where ratings are given.
    memory : TabMemory
        What the tab remembers.
    failure : str
        What failed last, with the details that participants are not told.
    """

    def __init__(self, study: str | Path = "") -> None:
        self.run: StudyRun | None = None
        self.index: int | None = None
        self.failure = ""
        self.memory = TabMemory()
        self._path = Path()
        self._fetched: dict[int, dict[str, Any]] = {}
        self._here = Home().here
        self._view = ItemView(self._here)
        self.form = self._view.form
        self._message = widgets.HTML()
        self._body = widgets.VBox([])
        self.begin = page_button("Begin", "Take part as a new participant", "primary")
        self.code = widgets.Text(
            description="Your code",
            placeholder="such as 12-KFM",
            style=FITTING,
            layout=widgets.Layout(width="240px"),
        )
        self.go_on = page_button("Go on", "Go on where you were")
        self.next_person = page_button("Next participant", "Begin again with somebody else")
        self.root = widgets.VBox([self.memory, self._message, self._body])
        self.root.add_class("wb-study")
        self._connect()
        self._open(study)

    def _repr_mimebundle_(self, **kwargs: Any) -> Any:
        return self.root._repr_mimebundle_(**kwargs)

    @property
    def player(self) -> MotionPlayer:
        """Where the motions of the item play."""
        return self._view.player

    @property
    def message(self) -> str:
        """What went wrong; empty if nothing did."""
        return str(self.form.message or self._message.value)

    def close(self) -> None:
        """Take the page away."""
        self._view.close()
        self.root.close()

    # Pages.

    def _open(self, study: str | Path) -> None:
        known = known_studies()
        name = str(study) or study_of_address() or (known[0] if known else "")
        if not name:
            self._tell("No study was prepared yet. Prepare one first, then open this page again.")
            return
        try:
            self._path = study_path(name)
            load_design(self._path)
        except WorkbenchError as error:
            self._tell(str(error))
            return
        self._welcome()
        # A tab remembers participants of this file only, and shows its path to nobody.
        self.memory.name = hashlib.sha256(str(self._path).encode()).hexdigest()[:16]

    def _welcome(self) -> None:
        self.run, self.index = None, None
        text = widgets.HTML(welcome_text(load_design(self._path)))
        again = widgets.HTML("<span>Were you here before?</span>")
        self._body.children = [
            text,
            control_row([self.begin]),
            control_row([again, self.code, self.go_on]),
        ]

    def _thanks(self) -> None:
        assert self.run is not None  # somebody has finished
        self.index = None
        self._body.children = [
            widgets.HTML(thanks_text(self.run.code)),
            control_row([self.next_person]),
        ]

    def _enter(self, run: StudyRun) -> None:
        self.run, self._fetched = run, {}
        self.memory.word = run.code
        self._tell("")
        if run.design.practice and not run.has_begun:
            self._show(-1, [0] * len(run.design.practice))
            return
        self._continue()

    def _continue(self) -> None:
        assert self.run is not None  # only participants get here
        index = self.run.current
        if index is None:
            self._thanks()
        else:
            self._show(index, self.run.ratings(index))

    def _show(self, index: int, ratings: list[int]) -> None:
        assert self.run is not None  # only participants get here
        n_items = len(self.run.items)
        name = "Exercise" if index < 0 else f"Movement {index + 1} of {n_items}"
        before = self._body.children
        if index not in self._fetched:
            self._view.show_fetching()
            self._body.children = [self._view.root]
        try:
            motions = self._fetch(index)
        except Exception:
            self._view.show_player()
            self._body.children = before
            raise
        self.index = index
        self._view.show(
            motions,
            ratings,
            heading=name,
            note=f"Your code is {self.run.code}. With it you can go on later.",
            question=self.run.design.question + (EXERCISE if index < 0 else ""),
            onward=onward_text(index, n_items),
        )
        self._body.children = [self._view.root]
        loop = running_loop()
        if loop is not None and index + 1 < n_items:
            loop.call_later(_PAUSE, self._look_ahead, self.run, index + 1)

    def _fetch(self, index: int) -> dict[str, Any]:
        """Make the motions of an item, unless that was done ahead; only one item is kept."""
        assert self.run is not None  # only participants get here
        if index not in self._fetched:
            stimuli = self.run.items[index] if index >= 0 else self.run.design.practice
            letters = ascii_uppercase[: len(stimuli)]
            motions = (stimulus_motion(stimulus) for stimulus in stimuli)
            self._fetched = {index: motion_traits(dict(zip(letters, motions, strict=True)))}
        return self._fetched[index]

    def _look_ahead(self, run: StudyRun, index: int) -> None:
        """Make the motions of the next item while the one before is watched."""
        # What fails is told when the item is to be shown.
        with suppress(Exception):
            if run is self.run and self.index == index - 1:
                self._fetch(index)

    def _tell(self, words: str) -> None:
        self._message.value = alert(words) if words else ""

    # What a person does.

    def _connect(self) -> None:
        here = self._here
        self.begin.on_click(here(lambda _: self._try(self._on_begin)))
        self.go_on.on_click(here(lambda _: self._try(self._on_go_on)))
        self.next_person.on_click(here(lambda _: self._try(self._on_next_person)))
        self.memory.observe(here(lambda _: self._try(self._on_recalled)), "recalled")
        self.form.observe(here(self._on_chosen), "chosen")
        self.form.observe(here(lambda _: self._try(self._on_finished)), "finished")

    def _on_begin(self) -> None:
        # Whoever presses again because something failed is the same person.
        self._enter(self.run or StudyRun.begin(self._path))

    def _on_go_on(self) -> None:
        try:
            run = StudyRun.resume(self._path, self.code.value)
        except DataError:
            raise
        except WorkbenchError as error:
            raise _Asked(str(error)) from None
        self._enter(run)

    def _on_recalled(self) -> None:
        if not self.memory.recalled or self.run is not None:
            return
        try:
            run = StudyRun.resume(self._path, self.memory.recalled)
        except WorkbenchError:
            return  # of a study that was in the same place before
        self._enter(run)

    def _on_next_person(self) -> None:
        self.memory.word = ""
        self.memory.recalled = ""
        self.code.value = ""
        self._welcome()

    def _on_chosen(self, change: Any) -> None:
        if self.index is None or change["new"] == self.form.stored:
            return
        self._try(lambda: self._store(change["new"]))
        # What could not be stored is no longer chosen, so that it can be chosen again.
        self.form.chosen = self.form.stored

    def _store(self, chosen: Sequence[int]) -> None:
        assert self.run is not None  # the form is shown to participants only
        assert self.index is not None
        if not self.form.ready:
            raise _Asked(WATCH_FIRST)
        for place, rating in enumerate(chosen):
            if rating in (0, self.form.stored[place]):
                continue
            if self.index >= 0:
                self.run.rate(self.index, place, rating)
            stored = list(self.form.stored)
            stored[place] = rating
            self.form.stored = stored

    def _on_finished(self) -> None:
        if self.run is None or self.index is None:
            return
        if not all(self.form.stored):
            raise _Asked(RATE_ALL)
        if self.index >= 0:
            self.run.settle(self.index)
        self._continue()

    def _try(self, act: Callable[[], None]) -> None:
        """Do what a person asks for; what fails is told, and nothing is lost by it."""
        shown = self.index is not None
        self.form.message = ""
        try:
            act()
        except _Asked as request:
            words = str(request)
        except Exception as error:  # whatever it is, the person must know that it failed
            # Its words may name the stimulus, which a participant must not learn.
            self.failure, words = f"{type(error).__name__}: {error}", FAILED
        else:
            return
        if shown:
            self.form.message = words
        else:
            self._tell(words)
