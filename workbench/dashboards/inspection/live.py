"""A keyframe inspector at work: what a person does, what is computed, and what is shown of it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from workbench.dashboards.inspection.controls import InspectorControls
from workbench.dashboards.inspection.jobs import Clip, Job, Selectors
from workbench.dashboards.inspection.plan import InspectorPlan
from workbench.dashboards.inspection.session import InspectorSession
from workbench.dashboards.inspection.view import InspectorView
from workbench.dashboards.shared.background import Background
from workbench.dashboards.shared.home import Home, running_loop
from workbench.dashboards.shared.sources import Source, available, loaded_here, reread, source_of
from workbench.dashboards.shared.worker import Worker
from workbench.registry import Registry

#: Up to so many frames the best of all keyframes take seconds only.
_FEW_FRAMES = 400


class LiveInspector:
    """Connect the controls, the plan, the workers and the view of a keyframe inspector.

    Nothing is computed before :meth:`start`, so that the controls can be set up.

    Parameters
    ----------
    source : Source
        The clip to show first.

    Attributes
    ----------
    controls : InspectorControls
        What can be chosen.
    plan : InspectorPlan
        What is wanted, and what of it is there.
    view : InspectorView
        What is shown.
    """

    def __init__(self, source: Source) -> None:
        self._quiet = True
        self._methods = Selectors()
        clips = [choice for choice in available() if choice.clip or choice.name == choice.text]
        self.controls = InspectorControls(clips, self.selectors.names())
        self.controls.choose(source)
        self.plan = InspectorPlan(source, self.controls)
        self.view = InspectorView(self.controls)
        self._backgrounds: list[Background] = []
        # Two processes, so that keyframes need not wait for curves, which take seconds.
        self._worker = self._worker_for(self.plan.missing)
        self._curve_worker = self._worker_for(self.plan.missing_curves)
        self._live = False
        self._connect()

    @property
    def selectors(self) -> Registry:
        """The kernel's selectors."""
        return self._methods.registry

    def start(self) -> None:
        """Compute what the controls ask for, from now on."""
        self._quiet = False
        self._wake()

    def offer(self) -> None:
        """List selectors that were registered meanwhile."""
        self.controls.offer(self.selectors.names())

    async def finished(self) -> None:
        """Wait until everything is computed."""
        for worker in (self._worker, self._curve_worker):
            await worker.finished()

    def want(self, source: Source) -> None:
        """Show another clip; the one shown now stays if the new one cannot be loaded."""
        self.plan.failures.pop(source, None)
        self.plan.wanted = source
        with self._silence():
            self.controls.choose(source)
        self._wake()

    def cancel(self) -> None:
        """End what is being computed; what is complete stays."""
        for worker in (self._worker, self._curve_worker):
            worker.cancel()

    def recompute(self) -> None:
        """Compute what failed or was cancelled, or everything anew if nothing did."""
        self.offer()
        plan = self.plan
        wanted = reread(plan.wanted)
        # What failed of another clip or method is not what a person wants again.
        failed = any(job in plan.failures for job in plan.jobs())
        if not failed and wanted == plan.wanted:
            plan.forget()
        plan.failures.clear()
        plan.wanted = wanted
        self._wake()

    def close(self) -> None:
        """End the processes that compute, and take the dashboard out of the page."""
        for background in self._backgrounds:
            background.stop()
        self.view.root.close()

    # Computing.

    def _worker_for(self, missing: Callable[[], list[Job]]) -> Worker[Job]:
        background = Background(InspectorSession)
        self._backgrounds.append(background)
        return Worker(
            background,
            missing=missing,
            failures=self.plan.failures,
            prepare=self._prepared,
            done=self._take,
            changed=self._show,
            report=self._report,
        )

    def _wake(self) -> None:
        self._live = running_loop() is not None
        self._worker.wake()
        self._curve_worker.wake()

    def _prepared(self, job: Job) -> tuple[Job, Selectors]:
        return (loaded_here(job) if isinstance(job, Source) else job), self._methods

    def _take(self, job: Job, result: Any) -> None:
        self.plan.take(job, result)
        if isinstance(result, Clip):
            with self._silence():
                self.controls.suit(len(result.motion))
                self.controls.exact.value = len(result.motion) <= _FEW_FRAMES
            self.view.show_clip(result)
            if self._live:  # otherwise they are computed when this is done
                self._curve_worker.wake()

    def _report(self, text: str, done: float | None) -> None:
        part = (done or 0.0) / len(self.plan.jobs())
        self.view.progress.show(text, min(1.0, self.plan.share_done() + part))

    # Showing.

    def _show(self) -> None:
        plan, view = self.plan, self.view
        clip, result = plan.clip, plan.result
        if clip is not None and result is not None:
            plan.last = result
            view.show_keyframes(clip, result)
        waiting = self._worker.current is not None
        view.show_counts(
            plan.curves,
            plan.last,
            plan.about_curves(),
            most=self.controls.count.max,
            waiting=waiting,
        )
        view.progress.show_busy(waiting or self._curve_worker.current is not None)
        view.show_message(clip, plan.last, plan.told())

    @contextmanager
    def _silence(self) -> Iterator[None]:
        """Change what is shown without taking it for a person's wish."""
        before, self._quiet = self._quiet, True
        try:
            yield
        finally:
            self._quiet = before

    # What a person does.

    def _connect(self) -> None:
        here = Home().here
        self.controls.on_settings(here(self._on_settings))
        self.controls.data.observe(here(self._on_clip), "value")
        self.controls.open.on_click(here(self._on_open))
        self.view.counts.observe(here(self._on_picked), "picked")
        self.view.progress.cancel.on_click(here(lambda _: self.cancel()))
        self.view.progress.again.on_click(here(lambda _: self.recompute()))

    def _on_settings(self) -> None:
        if not self._quiet:
            self._wake()

    def _on_clip(self, change: Any) -> None:
        if change["new"] and not self._quiet:
            self.want(source_of(change["new"]))

    def _on_open(self, _: Any) -> None:
        if self.controls.path.value.strip():
            self.want(source_of(self.controls.path.value))

    def _on_picked(self, change: Any) -> None:
        if change["new"] < 2:
            return
        with self._silence():
            self.controls.set_count(min(change["new"], self.controls.count.max))
            self.view.counts.picked = 0
        self._wake()
