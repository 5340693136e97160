"""What the keyframe inspector wants, what of it is there, and what failed."""

from __future__ import annotations

from typing import Any

from workbench.dashboards.inspection.controls import InspectorControls
from workbench.dashboards.inspection.jobs import (
    Clip,
    CountErrors,
    ErrorCurve,
    Extraction,
    Job,
    KeyframeResult,
    LeastErrors,
)
from workbench.dashboards.shared.sources import Source

#: What the errors of the best keyframes are called.
BEST = "the best of all"


class InspectorPlan:
    """Derive jobs from the controls, and keep their results.

    Parameters
    ----------
    source : Source
        The clip to show first.
    controls : InspectorControls
        What can be chosen.

    Attributes
    ----------
    wanted : Source
        The clip that was asked for.
    source : Source or None
        The clip that is shown.
    last : KeyframeResult or None
        The keyframes that are shown; those of settings before, until there are new ones.
    failures : dict of Job to str
        Why jobs have no result, in plain words.
    """

    def __init__(self, source: Source, controls: InspectorControls) -> None:
        self.wanted = source
        self.source: Source | None = None
        self.last: KeyframeResult | None = None
        self.failures: dict[Job, str] = {}
        self._controls = controls
        self._results: dict[Job, Any] = {}

    @property
    def clip(self) -> Clip | None:
        """The clip that is shown."""
        return None if self.source is None else self._results.get(self.source)

    @property
    def extraction(self) -> Extraction:
        """The keyframes that are wanted."""
        return Extraction(self.wanted, self._controls.method, self._controls.wanted_count)

    @property
    def result(self) -> KeyframeResult | None:
        """What the wanted keyframes gave, if it is there."""
        return self._results.get(self.extraction)

    @property
    def curves(self) -> dict[str, ErrorCurve]:
        """Errors against the number of keyframes, by method, as far as they are there."""
        jobs = self._curve_jobs()
        return {name: self._results[job] for name, job in jobs.items() if job in self._results}

    def jobs(self) -> list[Job]:
        """List what is wanted; keyframes of a clip that cannot be loaded are not."""
        if self.wanted in self.failures or self.wanted not in self._results:
            return [self.wanted]
        return [self.wanted, self.extraction, *self._curve_jobs().values()]

    def missing(self) -> list[Job]:
        """List what of clip and keyframes is neither done nor failed."""
        return [job for job in self._unfinished() if isinstance(job, (Source, Extraction))]

    def missing_curves(self) -> list[Job]:
        """List the error curves that are neither done nor failed."""
        return [job for job in self._unfinished() if not isinstance(job, (Source, Extraction))]

    def share_done(self) -> float:
        """Tell how much of what is wanted is done or failed, 0 to 1."""
        return 1.0 - len(self._unfinished()) / len(self.jobs())

    def take(self, job: Job, result: Any) -> None:
        """Keep a result; those of the clip before are dropped with the next clip."""
        if isinstance(job, Source):
            self._results.clear()
            self.source, self.last = job, None
        self._results[job] = result

    def forget(self) -> None:
        """Drop all results, so that everything is computed anew."""
        self._results.clear()

    def told(self) -> list[str]:
        """Say in words what of the wanted clip and keyframes failed."""
        told = []
        for job in self.jobs():
            failure = self.failures.get(job, "")
            if failure and isinstance(job, Source):
                words = failure if failure.startswith(job.name) else f"{job.name}: {failure}"
                told.append(words + (f"; still shown: {self.source.name}" if self.source else ""))
            elif failure and isinstance(job, Extraction):
                told.append(f"keyframes: {failure}" + "; shown as before" * bool(self.last))
        return told

    def about_curves(self) -> str:
        """Say which error curves are still to come, and why others are not there."""
        missing, lines = self.missing_curves(), []
        for name, job in self._curve_jobs().items():
            if job in self.failures:
                lines.append(f"{name}: {self.failures[job]}")
            elif job in missing:
                lines.append(f"{name} …")
        return "; ".join(lines)

    def _unfinished(self) -> list[Job]:
        return [job for job in self.jobs() if job not in self._results and job not in self.failures]

    def _curve_jobs(self) -> dict[str, Job]:
        controls, jobs = self._controls, dict[str, Job]()
        if controls.selector.value != "optimal":
            method = controls.method.for_counts
            jobs[controls.selector.value] = CountErrors(self.wanted, method)
        if controls.exact.value or controls.selector.value == "optimal":
            jobs[BEST] = LeastErrors(self.wanted)
        return jobs
