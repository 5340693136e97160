"""What a comparison is to show, what of it is there, and what is missing."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.dashboards.comparison.comparison_view import PanelState
from workbench.dashboards.comparison.controls import Controls
from workbench.dashboards.comparison.jobs import (
    Description,
    Influence,
    Job,
    Move,
    PanelResult,
    Repetition,
    Run,
    Values,
)
from workbench.dashboards.comparison.moves import Moves
from workbench.dashboards.comparison.panels import LETTERS
from workbench.dashboards.comparison.summaries import Summary
from workbench.dashboards.shared.sources import Source


class Plan:
    """Compare what is wanted with what is there; results are kept for when they are wanted again.

    Parameters
    ----------
    wanted : Source
        The samples to show.
    controls : Controls
        What to show of them.

    Attributes
    ----------
    wanted : Source
        The samples that were asked for.
    source : Source or None
        Those that are shown.
    summary : Summary or None
        What is known of these.
    moves : Moves
        Control points that were moved.
    failures : dict of Job to str
        Why something is not there, in plain words.
    """

    def __init__(self, wanted: Source, controls: Controls) -> None:
        self.wanted = wanted
        self.source: Source | None = None
        self.summary: Summary | None = None
        self.moves = Moves()
        self.failures: dict[Job, str] = {}
        self._controls = controls
        self._done: dict[Job, Any] = {}

    @property
    def runs(self) -> dict[str, Run]:
        """What the panels are to show, by their letters; nothing without data."""
        if self.source is None:
            return {}
        controls = self._controls
        ratio, seed = round(controls.ratio.value, 4), controls.seed.value
        name = controls.back_projector.value or None
        panels = zip(LETTERS, controls.panels, strict=False)
        return {letter: Run(self.source, panel, ratio, seed, name) for letter, panel in panels}

    @property
    def control_points(self) -> NDArray[np.intp]:
        """Control points of the panels, as far as they are known."""
        results = (self._done[run] for run in self.runs.values() if run in self._done)
        found: NDArray[np.intp] = next((r.control_points for r in results), np.empty(0, np.intp))
        return found

    @property
    def influence(self) -> NDArray[np.float32] | None:
        """How control points count for the samples, as far as that is known."""
        job = self._influence()
        return None if job is None else self._done.get(job)

    @property
    def results(self) -> dict[str, PanelResult]:
        """What the panels show, by their letters, as far as it is there."""
        measured = {letter: self._measured(letter) for letter in self.runs}
        return {letter: result for letter, result in measured.items() if result is not None}

    @property
    def notes(self) -> list[str]:
        """What a person should know of the panels."""
        told = [
            f"{letter}: {note}" for letter, result in self.results.items() for note in result.notes
        ]
        job = self._influence()
        if job is not None and job in self.failures:
            told.append(self.failures[job])
        return told

    def jobs(self) -> list[Job]:
        """List everything that is wanted, the most urgent first."""
        if self.wanted != self.source and self.wanted not in self.failures:
            return [self.wanted]
        runs = self.runs
        jobs: dict[Job, None] = dict.fromkeys(runs.values())
        moves = (self.moves.of(letter, run) for letter, run in runs.items())
        jobs.update((move, None) for move in moves if move is not None)
        if (influence := self._influence()) is not None:
            jobs[influence] = None
        jobs.update((Description(run.panel.projector), None) for run in runs.values())
        for run in runs.values():
            jobs.update((repetition, None) for repetition in self._repetitions(run))
        return list(jobs)

    def missing(self) -> list[Job]:
        """List what is wanted and neither there nor failed."""
        return [job for job in self.jobs() if job not in self._done and job not in self.failures]

    def take(self, job: Job, result: Any) -> None:
        """Keep a result. Of samples it becomes what is shown."""
        if isinstance(job, Source):
            self.source, self.summary = job, result
            return
        if isinstance(job, Influence):
            # Large, and only those of the present control points are of use.
            for other in [other for other in self._done if isinstance(other, Influence)]:
                del self._done[other]
        self._done[job] = result
        if isinstance(job, Run):
            for letter, run in self.runs.items():
                if run == job:
                    self.moves.settle(letter, run, len(result.control_points))

    def forget(self) -> None:
        """Drop all results, so that everything is computed anew."""
        self._done.clear()

    def states(self) -> Iterator[PanelState]:
        """Describe what there is to show in each panel."""
        runs = self.runs
        lost = "no data" if self.failures.get(self.wanted) else ""
        for letter, panel in zip(LETTERS, self._controls.panels, strict=False):
            run = runs.get(letter)
            title = f"{letter} · {panel.title}"
            if run is None:
                yield PanelState(title, None, lost)
                continue
            move = self.moves.of(letter, run)
            yield PanelState(
                title=title,
                result=self._done.get(run),
                failure=self.failures.get(move if move is not None else run, ""),
                measured=self._measured(letter),
                moved=None if move is None else move.places,
                repeated=[] if move is not None else self._repeated(run),
            )

    def describe(self) -> None:
        """Tell the controls of projectors' parameters, as far as they are known."""
        for chooser in self._controls.choosers:
            name = chooser.projector.value
            if (known := self._done.get(Description(name))) is not None:
                chooser.describe(name, known)

    def words(self, job: Job, text: str) -> str:
        """Say for which panels a job is."""
        run = job.run if isinstance(job, (Repetition, Move)) else job
        if not isinstance(run, Run):
            return text
        shown = replace(run, seed=self._controls.seed.value)
        letters = " and ".join(letter for letter, other in self.runs.items() if other == shown)
        seed = f", seed {run.seed}" if isinstance(job, Repetition) else ""
        return f"{letters} ({run.panel.projector}{seed}): {text}"

    def _measured(self, letter: str) -> PanelResult | None:
        run = self.runs[letter]
        move = self.moves.of(letter, run)
        found: PanelResult | None = self._done.get(run if move is None else move)
        return found

    def _influence(self) -> Influence | None:
        control = self.control_points
        if self.source is None or not control.size:
            return None
        return Influence(self.source, tuple(control.tolist()))

    def _repetitions(self, run: Run) -> list[Repetition]:
        """List the further seeds that a run is repeated with."""
        count = self._controls.n_repeats
        return [Repetition(replace(run, seed=run.seed + step)) for step in range(1, count)]

    def _repeated(self, run: Run) -> list[Values]:
        jobs = self._repetitions(run)
        return [self._done[job] for job in jobs if job in self._done]
