"""The controls with which a study is prepared."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import ipywidgets as widgets

from workbench.dashboards.shared.layout import FITTING, control_row, seed_field
from workbench.dashboards.shared.sources import Choice
from workbench.errors import WorkbenchError
from workbench.validation import whole_number

#: How the number of keyframes is decided.
COUNTS = ("as saliency finds", "a share of the frames", "a number")
_NO_EXERCISE = ""
_ROWS = 10


class StudyControls:
    """Choose clips, methods and how many keyframes, and where the study is stored.

    Parameters
    ----------
    clips : sequence of Choice
        Motions that can be shown.
    selectors : sequence of str
        Names.

    Attributes
    ----------
    clips, methods : ipywidgets.SelectMultiple
        What is shown, and how it is rebuilt.
    own : ipywidgets.Textarea
        Paths of further clips, one a line.
    rule : ipywidgets.Dropdown
        One of :data:`COUNTS`.
    count, share, seconds, seed : ipywidgets.Widget
        Numbers; ``seconds`` is 0 for whole clips.
    exercise : ipywidgets.Dropdown
        The clip to practise on.
    title, file : ipywidgets.Text
        What participants read, and what the study's file is called.
    save : ipywidgets.Button
        To make the file.
    view : ipywidgets.Widget
        All but the last two.
    file_row : ipywidgets.Widget
        These.
    """

    def __init__(self, clips: Sequence[Choice], selectors: Sequence[str]) -> None:
        self._make_choices(clips, selectors)
        self._make_numbers()
        self.title = widgets.Text(
            description="Title for participants",
            style=FITTING,
            layout=widgets.Layout(flex="1 1 300px", max_width="520px"),
        )
        self.file = widgets.Text(
            description="File of the study",
            style=FITTING,
            layout=widgets.Layout(flex="1 1 300px", max_width="640px"),
        )
        self.save = widgets.Button(
            description="Make the study",
            button_style="primary",
            tooltip="Write the file in which answers are gathered",
            layout=widgets.Layout(width="150px"),
        )
        self.rule.observe(lambda _: self._show_parts(), "value")
        self._show_parts()
        self.view = widgets.VBox(
            [
                control_row([self.clips, self.methods]),
                widgets.HTML("<small>Ctrl and Shift choose several clips and methods.</small>"),
                control_row([self.own]),
                control_row([self.rule, self.count, self.share, self.seconds]),
                control_row([self.exercise, self.seed]),
                control_row([self.title]),
            ]
        )
        self.file_row = control_row([self.file, self.save])

    @property
    def names(self) -> list[str]:
        """Clips that are to be shown, each once."""
        own = [line.strip() for line in self.own.value.splitlines() if line.strip()]
        return list(dict.fromkeys([*self.clips.value, *own]))

    @property
    def wanted_count(self) -> int | None:
        """How many keyframes; None if another rule decides."""
        return self.count.value if self.rule.value == COUNTS[2] else None

    @property
    def wanted_ratio(self) -> float | None:
        """Which share of the frames; None if another rule decides."""
        return self.share.value / 100 if self.rule.value == COUNTS[1] else None

    @property
    def wanted_seconds(self) -> float | None:
        """How much of each clip is shown; None for all."""
        return self.seconds.value or None

    def choose(self, names: Sequence[str]) -> None:
        """Choose clips; those that are not listed are the user's own."""
        listed = {value for _, value in self.clips.options}
        self.clips.value = [name for name in names if name in listed]
        self.own.value = "\n".join(name for name in names if name not in listed)

    def choose_exercise(self, name: str | None) -> None:
        """Choose the clip to practise on; None for no exercise."""
        listed = [value for _, value in self.exercise.options]
        if name and name not in listed:
            self.exercise.options = [*self.exercise.options, (name, name)]
        self.exercise.value = name or _NO_EXERCISE

    def set_count(self, count: int | None, ratio: float | None) -> None:
        """Decide the number of keyframes.

        Raises
        ------
        WorkbenchError
            If the count is no whole number from 2, or a share is given as well.
        """
        if count is not None and ratio is not None:
            raise WorkbenchError(f"count and ratio: got {count} and {ratio}, want at most one")
        if count is not None:
            self.count.value = whole_number("count", count, at_least=2)
        if ratio is not None:
            self.share.value = 100 * ratio
        self.rule.value = COUNTS[2 if count is not None else 1 if ratio is not None else 0]

    def on_settings(self, act: Callable[[], None]) -> None:
        """Call back when something changed that stimuli depend on."""
        parts = (self.clips, self.own, self.methods, self.rule, self.count, self.share)
        for part in (*parts, self.seconds, self.seed, self.exercise, self.title):
            part.observe(lambda _: act(), "value")

    def _make_choices(self, clips: Sequence[Choice], selectors: Sequence[str]) -> None:
        options = [(clip.text, clip.name) for clip in clips]
        self.clips = widgets.SelectMultiple(
            options=options,
            rows=_ROWS,
            description="Clips",
            style=FITTING,
            layout=widgets.Layout(flex="3 1 340px", max_width="640px"),
        )
        self.methods = widgets.SelectMultiple(
            options=list(selectors),
            rows=_ROWS,
            description="Methods",
            style=FITTING,
            layout=widgets.Layout(flex="1 1 180px", max_width="260px"),
        )
        self.own = widgets.Textarea(
            placeholder="paths of BVH or AMC files, one a line",
            continuous_update=False,
            rows=2,
            description="Own clips",
            style=FITTING,
            layout=widgets.Layout(flex="1 1 300px", max_width="640px"),
        )
        self.exercise = widgets.Dropdown(
            options=[("no exercise", _NO_EXERCISE), *options],
            description="Exercise",
            style=FITTING,
            layout=widgets.Layout(flex="1 1 300px", max_width="520px"),
        )

    def _make_numbers(self) -> None:
        self.rule = widgets.Dropdown(
            options=COUNTS,
            description="Keyframes",
            style=FITTING,
            layout=widgets.Layout(width="250px"),
        )
        self.count = _field(widgets.BoundedIntText, 20, 2, 100_000, "how many", "160px")
        self.share = _field(widgets.BoundedFloatText, 5.0, 0.1, 90.0, "%", "110px")
        self.seconds = _field(
            widgets.BoundedFloatText, 0.0, 0.0, 600.0, "Show at most (s, 0: all)", "260px"
        )
        self.seed = seed_field()

    def _show_parts(self) -> None:
        for part, rule in ((self.share, COUNTS[1]), (self.count, COUNTS[2])):
            part.layout.display = None if self.rule.value == rule else "none"


def _field(
    kind: type[widgets.Widget], value: float, low: float, high: float, words: str, width: str
) -> widgets.Widget:
    return kind(
        value=value,
        min=low,
        max=high,
        description=words,
        style=FITTING,
        layout=widgets.Layout(width=width),
    )
