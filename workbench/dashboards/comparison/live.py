"""A comparison at work: what a person does, what is computed, and what is shown of it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.dashboards.comparison.arguments import Settings, checked_moves, checked_selection
from workbench.dashboards.comparison.code_cell import comparison_code
from workbench.dashboards.comparison.comparison_view import ComparisonView
from workbench.dashboards.comparison.controls import Controls
from workbench.dashboards.comparison.exports import comparison_page
from workbench.dashboards.comparison.jobs import Job, Methods, Repetition
from workbench.dashboards.comparison.panels import Panel
from workbench.dashboards.comparison.plan import Plan
from workbench.dashboards.comparison.session import Session
from workbench.dashboards.shared.background import Background
from workbench.dashboards.shared.home import Home
from workbench.dashboards.shared.sources import (
    Source,
    available,
    loaded_here,
    on_one_map,
    reread,
    source_of,
    standardized,
)
from workbench.dashboards.shared.worker import Worker


class LiveComparison:
    """Connect the controls, the plan, the worker and the view of a comparison.

    Parameters
    ----------
    source : Source
        The samples to show first.
    panels : list of Panel
        What to show of them.
    settings : Settings
        Everything else.

    Attributes
    ----------
    controls : Controls
        What can be chosen.
    plan : Plan
        What is wanted, and what of it is there.
    worker : Worker
        Computes what is missing.
    view : ComparisonView
        What is shown.
    """

    def __init__(self, source: Source, panels: list[Panel], settings: Settings) -> None:
        self._methods = Methods()
        self.controls = Controls(
            available(),
            self._methods.projectors.names(),
            self._methods.back_projectors.names(),
            panels,
            settings.color_by,
        )
        self._set_up(settings)
        self.view = ComparisonView(self.controls)
        self.plan = Plan(source, self.controls)
        self.plan.moves.expect(checked_moves(settings.moved))
        self._expected_selection = checked_selection(settings.selection)
        self._quiet = False
        self.background = Background(Session)
        self.worker: Worker[Job] = Worker(
            self.background,
            missing=self.plan.missing,
            failures=self.plan.failures,
            prepare=self._prepared,
            done=self._take,
            changed=self._show,
            report=self._report,
        )
        self._show_choice()
        self._connect()
        self.worker.wake()

    @property
    def message(self) -> str:
        """Why the data that were asked for are not shown; empty if they are."""
        return self.plan.failures.get(self.plan.wanted, "")

    @property
    def moved(self) -> dict[str, NDArray[np.float32]]:
        """Positions of control points that were moved, by the letters of panels."""
        moves = {letter: self.plan.moves.of(letter, run) for letter, run in self.plan.runs.items()}
        return {letter: move.places for letter, move in moves.items() if move is not None}

    @property
    def code(self) -> str:
        """The code of a cell that makes this view again."""
        controls = self.controls
        plan = self.plan
        source = plan.source if plan.source is not None and self.message else plan.wanted
        rounded = {
            letter: [[round(float(x), 6) for x in place] for place in places]
            for letter, places in self.moved.items()
        }
        settings = {
            "standardize": source.standardize,
            "label": source.label,
            "ratio": round(controls.ratio.value, 4),
            "random_state": controls.seed.value,
            "back_projector": controls.back_projector.value or None,
            "color_by": controls.color_by.value,
            "selection": self.view.scatter.selection.tolist() or (),
            "moved": rounded,
            "repeat": controls.n_repeats,
        }
        return comparison_code(source, controls.panels, settings, vars(Settings()))

    def want(self, source: Source) -> None:
        """Show other samples; those shown now stay if the new ones cannot be loaded."""
        self.plan.failures.pop(source, None)
        self.plan.wanted = source
        self._show_choice()
        self.worker.wake()

    def recompute(self) -> None:
        """Compute what failed or was cancelled, or everything anew if nothing did."""
        self.offer()
        plan = self.plan
        wanted = reread(plan.wanted)
        if not plan.failures and wanted == plan.wanted:
            plan.forget()
        plan.failures.clear()
        plan.wanted = wanted
        self.worker.wake()

    def move(self, moved: dict[str, NDArray[np.float32]]) -> None:
        """Put all control points back, and then move those of some panels."""
        plan = self.plan
        plan.moves.forget()
        plan.moves.expect(moved)
        n_control = len(plan.control_points)
        for letter, run in plan.runs.items() if n_control else ():
            plan.moves.settle(letter, run, n_control)
        self.worker.wake()

    def offer(self) -> None:
        """List methods, those registered meanwhile among them."""
        self.controls.offer(self._methods.projectors.names(), self._methods.back_projectors.names())

    # Computing.

    def _prepared(self, job: Job) -> tuple[Job, Methods]:
        return (loaded_here(job) if isinstance(job, Source) else job), self._methods

    def _take(self, job: Job, result: Any) -> None:
        self.plan.take(job, result)
        if isinstance(job, Source):
            given = job.space is not None and not job.registered
            self.controls.suit(result, may_standardize=not (given or result.body))
            with self._silence():
                self.view.show_samples(result)
            expected, self._expected_selection = self._expected_selection, np.empty(0, int)
            self.view.scatter.selection = expected[expected < result.n_samples]
        self.plan.describe()

    def _report(self, text: str, done: float | None) -> None:
        job, jobs = self.worker.current, self.plan.jobs()
        finished = 0 if isinstance(job, Source) else len(jobs) - len(self.plan.missing())
        words = text if job is None else self.plan.words(job, text)
        self.view.progress.show(words, min(1.0, (finished + (done or 0.0)) / max(1, len(jobs))))

    # Showing.

    def _show(self) -> None:
        plan = self.plan
        with self._silence():
            self.view.show_panels(
                plan.summary.n_samples if plan.summary else 0,
                list(plan.states()),
                self.controls.color_by.value,
                plan.influence,
            )
        self.view.progress.show_busy(self.worker.current is not None)
        self.view.show_message(plan.summary, plan.notes, plan.wanted.name, self.message)
        self.view.code.show(self.code)

    def _show_choice(self) -> None:
        """Let the controls show what is wanted, without wanting it again."""
        with self._silence():
            self.controls.choose(self.plan.wanted)

    @contextmanager
    def _silence(self) -> Iterator[None]:
        """Change what is shown without taking it for a person's wish."""
        before, self._quiet = self._quiet, True
        try:
            yield
        finally:
            self._quiet = before

    # What a person does.

    def _set_up(self, settings: Settings) -> None:
        controls = self.controls
        controls.ratio.value, controls.seed.value = settings.ratio, settings.random_state
        controls.standardize.value = settings.standardize
        controls.back_projector.value = settings.back_projector or ""
        if settings.repeat > 1:
            controls.n_seeds.value, controls.repeat.value = settings.repeat, True

    def _connect(self) -> None:
        controls, scatter, here = self.controls, self.view.scatter, Home().here
        controls.on_settings(here(self._on_settings))
        controls.data.observe(here(self._on_data), "value")
        controls.further.observe(here(self._on_further), "value")
        controls.repeat.observe(here(self._on_repeat), "value")
        controls.standardize.observe(here(self._on_standardize), "value")
        controls.open.on_click(here(self._on_open))
        controls.color_by.observe(here(lambda _: self._show()), "value")
        scatter.observe(here(lambda _: self.view.code.show(self.code)), "selection")
        scatter.observe(here(self._on_moved), "moved")
        scatter.on_msg(here(self._on_message))
        self.view.progress.cancel.on_click(here(lambda _: self.worker.cancel()))
        self.view.progress.again.on_click(here(lambda _: self.recompute()))

    def _on_settings(self) -> None:
        self.plan.describe()
        self.worker.wake()

    def _on_repeat(self, _: Any) -> None:
        """Measure what was cancelled before, now that it is wanted again."""
        failures = self.plan.failures
        for job in [job for job in failures if isinstance(job, Repetition)]:
            del failures[job]
        self.worker.wake()

    def _on_data(self, change: Any) -> None:
        if change["new"] and not self._quiet:
            self.want(source_of(change["new"], None, self.controls.standardize.value))

    def _on_further(self, change: Any) -> None:
        if not self._quiet:
            first = (self.plan.wanted.parts or (self.plan.wanted,))[0]
            self.want(on_one_map([first, *map(source_of, change["new"])]))

    def _on_open(self, _: Any) -> None:
        if self.controls.path.value.strip():
            self.want(
                source_of(
                    self.controls.path.value,
                    self.controls.label.value.strip() or None,
                    self.controls.standardize.value,
                )
            )

    def _on_standardize(self, change: Any) -> None:
        plan = self.plan
        base = plan.source if plan.source is not None and self.message else plan.wanted
        self.want(standardized(reread(base), change["new"]))

    def _on_moved(self, change: Any) -> None:
        if not self._quiet:
            self.plan.moves.take(self.plan.runs, change["new"])
            self.worker.wake()

    def _on_message(self, scatter: Any, content: dict[str, Any], _: Any) -> None:
        """Answer the person who wants the views as a file."""
        if content.get("want") != "html":
            return
        try:
            page = comparison_page(self.view, self.plan.summary).encode()
        except Exception as error:  # the person must be told, whatever it is
            scatter.send({"kind": "failure", "text": f"{type(error).__name__}: {error}"})
            return
        scatter.send({"kind": "html", "name": "comparison.html"}, buffers=[page])
