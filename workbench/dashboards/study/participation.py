"""The participant's page of a user study, from which neither methods nor results can be told."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

import ipywidgets as widgets

from workbench.dashboards.shared.home import Home, running_loop
from workbench.dashboards.shared.layout import FITTING, alert, control_row
from workbench.dashboards.study.files import known_studies, study_of_address, study_path
from workbench.dashboards.study.item_motions import ItemMotions
from workbench.dashboards.study.item_view import ItemView
from workbench.dashboards.study.pages import (
    CHANGED,
    CLOSED,
    EXERCISE,
    FAILED,
    RATE_ALL,
    WATCH_FIRST,
    onward_text,
    page_button,
    recalled_text,
    thanks_text,
    welcome_text,
)
from workbench.dashboards.study.remembered import MEMORY_NAME, Remembered
from workbench.errors import DataError, WorkbenchError
from workbench.study.design import load_design
from workbench.study.participation import RatingChangedError
from workbench.study.run import StudyRun
from workbench.widgets.player import MotionPlayer
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
        asks for (``take_part.ipynb?study=NAME``), else the one that the tab was in before it was
        reloaded, else the one that was prepared or used last.

    Returns
    -------
    StudyParticipation
        Shown by a notebook as the last expression of a cell.
    """
    return StudyParticipation(study)


class StudyParticipation:
    """A page that leads a participant through a study.

    Each rating is on the disk before the page says that it is stored. A page that was reloaded,
    or whose kernel ended, goes on with the item that was on the screen, of the same study even if
    another one was prepared meanwhile.

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
        What the tab remembers, see :class:`Remembered`.
    failure : str
        What failed last, with the details that participants are not told.
    """

    def __init__(self, study: str | Path = "") -> None:
        self.run: StudyRun | None = None
        self.index: int | None = None
        self.failure = ""
        self.memory = TabMemory(name=MEMORY_NAME)
        self._asked = str(study) or study_of_address()
        self._path: Path | None = None
        self._enrolled: StudyRun | None = None
        self._motions: ItemMotions | None = None
        self._here = Home().here
        self._view = ItemView(self._here)
        self.form = self._view.form
        self._message = widgets.HTML()
        self._recalled = control_row([])
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
        self.somebody_else = page_button("I am somebody else", "Leave this place to them")
        self.root = widgets.VBox([self.memory, self._message, self._recalled, self._body])
        self.root.add_class("wb-study")
        self._connect()
        self._open()

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

    def _open(self) -> None:
        known = known_studies()
        name = self._asked or (known[0] if known else "")
        if not name:
            self._tell("No study was prepared yet. Prepare one first, then open this page again.")
            return
        try:
            path = study_path(name)
            load_design(path)
        except WorkbenchError as error:
            # Its words tell a path of this machine.
            self.failure = str(error)
            self._tell(CLOSED)
            return
        self._path = path
        self._welcome()

    def _welcome(self) -> None:
        assert self._path is not None  # there is a study to welcome to
        self.run, self.index, self._enrolled = None, None, None
        self._recalled.children = []
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

    def _enter(self, run: StudyRun, *, practised: bool = False) -> None:
        self.run, self._motions = run, ItemMotions(run)
        self._remember(practised=practised)
        self._tell("")
        if run.design.practice and not practised and not run.has_begun:
            self._show(-1, [0] * len(run.design.practice))
            return
        self._continue()

    def _remember(self, *, practised: bool) -> None:
        assert self.run is not None  # only participants are remembered
        self.memory.word = Remembered(self.run.design.study_id, self.run.code, practised).word

    def _continue(self) -> None:
        assert self.run is not None  # only participants get here
        index = self.run.current
        if index is None:
            self._thanks()
        else:
            self._show(index, self.run.ratings(index))

    def _show(self, index: int, ratings: list[int]) -> None:
        assert self.run is not None  # only participants get here
        assert self._motions is not None
        n_items = len(self.run.items)
        name = "Exercise" if index < 0 else f"Movement {index + 1} of {n_items}"
        before = self._body.children
        if index not in self._motions:
            self._view.show_fetching()
            self._body.children = [self._view.root]
        try:
            motions = self._motions.fetch(index)
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
            loop.call_later(_PAUSE, self._look_ahead, self._motions, index + 1)

    def _look_ahead(self, motions: ItemMotions, index: int) -> None:
        """Make the motions of the next item while the one before is watched."""
        # What fails is told when the item is to be shown.
        with suppress(Exception):
            if motions is self._motions and self.index == index - 1:
                motions.fetch(index)

    def _tell(self, words: str) -> None:
        self._message.value = alert(words) if words else ""

    # What a person does.

    def _connect(self) -> None:
        here = self._here
        self.begin.on_click(here(lambda _: self._try(self._on_begin)))
        self.go_on.on_click(here(lambda _: self._try(self._on_go_on)))
        for button in (self.next_person, self.somebody_else):
            button.on_click(here(lambda _: self._try(self._on_next_person)))
        self.memory.observe(here(lambda _: self._try(self._on_recalled)), "recalled")
        self.form.observe(here(self._on_chosen), "chosen")
        self.form.observe(here(lambda _: self._try(self._on_finished)), "finished")

    def _on_begin(self) -> None:
        assert self._path is not None  # the button belongs to a study
        # Whoever presses again because something failed is the same person.
        self._enrolled = self._enrolled or StudyRun.begin(self._path)
        self._enter(self._enrolled)

    def _on_go_on(self) -> None:
        assert self._path is not None  # the button belongs to a study
        try:
            run = StudyRun.resume(self._path, self.code.value)
        except DataError:
            raise
        except WorkbenchError as error:
            raise _Asked(str(error)) from None
        self._enter(run)

    def _on_recalled(self) -> None:
        if self.run is not None:
            return
        remembered = Remembered.of(self.memory.recalled)
        path = remembered.path(self._path, self._asked)
        run = None if path is None else remembered.run(path)
        if run is None:
            return
        self._enter(run, practised=remembered.practised)
        self._path = path  # only now: what failed leaves the welcome of the other study
        if self.index is not None:
            # The tab may be a copy of somebody else's.
            words = widgets.HTML(recalled_text(run.code))
            self._recalled.children = [words, self.somebody_else]

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
            self._settle(self.run, self.index)
        else:
            self._remember(practised=True)
        self._recalled.children = []
        self._continue()

    def _settle(self, run: StudyRun, index: int) -> None:
        """Settle on what the page shows; if something else is stored, show that first."""
        try:
            run.settle(index, self.form.stored)
        except RatingChangedError:
            self.form.stored = self.form.chosen = run.ratings(index)
            raise _Asked(CHANGED) from None

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
