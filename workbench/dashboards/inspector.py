"""The keyframe inspector: how keyframes of a motion are found, and what they rebuild."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.dashboards.background import Background
from workbench.dashboards.home import Home, running_loop
from workbench.dashboards.inspector_controls import COMPONENTS, SIGMAS, InspectorControls
from workbench.dashboards.inspector_jobs import (
    Clip,
    ErrorCurve,
    Job,
    KeyframeResult,
    Selectors,
)
from workbench.dashboards.inspector_plan import InspectorPlan
from workbench.dashboards.inspector_session import InspectorSession
from workbench.dashboards.inspector_view import InspectorView
from workbench.dashboards.sources import Source, available, loaded_here, reread, source_of
from workbench.dashboards.worker import Worker
from workbench.errors import WorkbenchError
from workbench.files import write_atomically
from workbench.spaces import PoseSpace
from workbench.validation import whole_number

Data = str | Path | PoseSpace

#: Up to so many frames the best of all keyframes take seconds only.
_FEW_FRAMES = 400


def inspect_keyframes(
    clip: Data = "cmu/01_01-jump",
    *,
    selector: str = "saliency",
    sigma: float = 10.0,
    components: int | None = None,
    count: int | None = None,
    random_state: int = 0,
) -> KeyframeInspector:
    """Inspect keyframes of a motion in a dashboard.

    Parameters
    ----------
    clip : str, path-like or PoseSpace
        A motion's name, a file's path, or a motion in memory.
    selector : str
        Name of a selector.
    sigma : float
        σ of the saliency method in frames, 1 to 30. The thesis takes 7 to 10 for slow and at
        most 3 for fast motions, at 120 frames a second.
    components : int, optional
        k, its number of principal components, 1 to 30; by default as many as keep 90 % of the
        variance, but at least 7.
    count : int, optional
        How many keyframes; by default as many as the saliency method finds by its own rule.
    random_state : int
        Seed of a selector that draws at random.

    Returns
    -------
    KeyframeInspector
        Shown by a notebook as the last expression of a cell.

    Raises
    ------
    WorkbenchError
        If an argument is not valid. A clip that cannot be loaded is told in the dashboard.
    """
    return KeyframeInspector(
        clip,
        selector=selector,
        sigma=sigma,
        components=components,
        count=count,
        random_state=random_state,
    )


class KeyframeInspector:
    """A dashboard with the keyframes of a motion and what they rebuild.

    It computes beside the kernel; :meth:`finished` waits for that. Outside a notebook, where
    nothing could show progress, each change is computed before it returns.

    Parameters
    ----------
    clip, selector, sigma, components, count, random_state
        As for :func:`inspect_keyframes`.

    Attributes
    ----------
    controls : InspectorControls
        What can be chosen.
    view : InspectorView
        What is shown.
    """

    def __init__(
        self,
        clip: Data = "cmu/01_01-jump",
        *,
        selector: str = "saliency",
        sigma: float = 10.0,
        components: int | None = None,
        count: int | None = None,
        random_state: int = 0,
    ) -> None:
        self._quiet = True
        source = source_of(clip)
        self._methods = Selectors()
        clips = [choice for choice in available() if choice.clip or choice.name == choice.text]
        self.controls = InspectorControls(clips, self._methods.registry.names())
        self.selector, self.sigma, self.components = selector, sigma, components
        self.count = count
        self.controls.seed.value = whole_number("random_state", random_state, at_least=0)
        self.controls.choose(source)
        self._plan = InspectorPlan(source, self.controls)
        self.view = InspectorView(self.controls)
        self._backgrounds: list[Background] = []
        # Two processes, so that keyframes need not wait for curves, which take seconds.
        self._worker = self._worker_for(self._plan.missing)
        self._curve_worker = self._worker_for(self._plan.missing_curves)
        self._live = False
        self._connect()
        self._quiet = False
        self._wake()

    def _repr_mimebundle_(self, **kwargs: Any) -> Any:
        self.controls.offer(self._methods.registry.names())
        return self.view.root._repr_mimebundle_(**kwargs)

    # What a notebook reads and sets.

    @property
    def result(self) -> KeyframeResult | None:
        """What is shown; None as long as there are no keyframes."""
        return self._plan.last

    @property
    def keyframes(self) -> NDArray[np.intp]:
        """The chosen frames, sorted; empty as long as there are none."""
        return np.empty(0, dtype=np.intp) if self._plan.last is None else self._plan.last.keyframes

    @property
    def errors(self) -> NDArray[np.float64]:
        """Error of each rebuilt frame per joint, in radians; empty as long as there are none."""
        return np.empty(0) if self._plan.last is None else self._plan.last.errors

    @property
    def psnr(self) -> float:
        """Peak signal-to-noise ratio of the joint angles in dB; not a number if unknown."""
        return float("nan") if self._plan.last is None else self._plan.last.psnr

    @property
    def error_curves(self) -> dict[str, ErrorCurve]:
        """Errors against the number of keyframes, by method, as far as they are there."""
        return self._plan.curves

    @property
    def message(self) -> str:
        """Why what was asked for is not shown; empty if it is."""
        return "; ".join(self._plan.told())

    @property
    def selector(self) -> str:
        """Name of the method; set it to choose another."""
        chosen: str = self.controls.selector.value
        return chosen

    @selector.setter
    def selector(self, name: str) -> None:
        self._methods.registry.factory(name)  # refuses it and says which there are
        self.controls.offer(self._methods.registry.names())
        self.controls.selector.value = name

    @property
    def sigma(self) -> float:
        """σ of the saliency method, in frames."""
        sigma: float = self.controls.sigma.value
        return sigma

    @sigma.setter
    def sigma(self, sigma: float) -> None:
        if not isinstance(sigma, (int, float)) or not SIGMAS[0] <= sigma <= SIGMAS[1]:
            raise WorkbenchError(f"sigma: got {sigma!r}, want {SIGMAS[0]:g} to {SIGMAS[1]:g}")
        self.controls.sigma.value = sigma

    @property
    def components(self) -> int | None:
        """Number k of components of the saliency method; None if 90 % of the variance decides."""
        return self.controls.method.n_components

    @components.setter
    def components(self, components: int | None) -> None:
        if components is not None and not (
            COMPONENTS[0] <= whole_number("components", components) <= COMPONENTS[1]
        ):
            low, high = COMPONENTS
            raise WorkbenchError(f"components: got {components}, want {low} to {high}, or None")
        self.controls.set_components(components)

    @property
    def count(self) -> int | None:
        """How many keyframes are wanted; None for as many as saliency finds."""
        return self.controls.wanted_count

    @count.setter
    def count(self, count: int | None) -> None:
        if count is not None:
            whole_number("count", count, at_least=2)
        self.controls.set_count(count)

    # What a notebook and a person do.

    async def finished(self) -> None:
        """Wait until everything is computed: ``await inspector.finished()``."""
        for worker in (self._worker, self._curve_worker):
            await worker.finished()

    def open(self, clip: Data) -> None:
        """Show another clip; the one shown now stays if the new one cannot be loaded."""
        source = source_of(clip)
        self._plan.failures.pop(source, None)
        self._plan.wanted = source
        with self._silence():
            self.controls.choose(source)
        self._wake()

    def cancel(self) -> None:
        """End what is being computed; what is complete stays."""
        for worker in (self._worker, self._curve_worker):
            worker.cancel()

    def recompute(self) -> None:
        """Compute what failed or was cancelled, or everything anew if nothing did.

        A file that was edited meanwhile is read again.
        """
        self.controls.offer(self._methods.registry.names())
        plan = self._plan
        wanted = reread(plan.wanted)
        if not plan.failures and wanted == plan.wanted:
            plan.forget()
        plan.failures.clear()
        plan.wanted = wanted
        self._wake()

    def save_filmstrip(self, path: str | Path) -> Path:
        """Write the filmstrip as an SVG file; one that exists is replaced."""
        return self._save(path, "filmstrip")

    def save_thumbnail(self, path: str | Path) -> Path:
        """Write the thumbnail as an SVG file; one that exists is replaced."""
        return self._save(path, "thumbnail")

    def close(self) -> None:
        """End the process that computes, and take the dashboard out of the page."""
        for background in self._backgrounds:
            background.stop()
        self.view.root.close()

    def _save(self, path: str | Path, picture: str) -> Path:
        target = Path(path)
        if target.suffix.lower() != ".svg":
            raise WorkbenchError(f"path: got {str(path)!r}, want a name that ends in .svg")
        if self._plan.last is None:
            raise WorkbenchError("keyframes: got none so far, want some to draw")
        write_atomically(target, getattr(self._plan.last, picture).encode())
        return target

    # Computing.

    def _worker_for(self, missing: Callable[[], list[Job]]) -> Worker[Job]:
        background = Background(InspectorSession)
        self._backgrounds.append(background)
        return Worker(
            background,
            missing=missing,
            failures=self._plan.failures,
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
        self._plan.take(job, result)
        if isinstance(result, Clip):
            with self._silence():
                self.controls.suit(len(result.motion))
                self.controls.exact.value = len(result.motion) <= _FEW_FRAMES
            self.view.show_clip(result)
            if self._live:  # otherwise they are computed when this is done
                self._curve_worker.wake()

    def _report(self, text: str, done: float | None) -> None:
        part = (done or 0.0) / len(self._plan.jobs())
        self.view.progress.show(text, min(1.0, self._plan.share_done() + part))

    # Showing.

    def _show(self) -> None:
        plan, view = self._plan, self.view
        clip, result = plan.clip, plan.result
        if clip is not None and result is not None:
            plan.last = result
            view.show_keyframes(clip, result)
        view.show_counts(plan.curves, plan.last, plan.about_curves())
        view.progress.show_busy(
            any(w.current is not None for w in (self._worker, self._curve_worker))
        )
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
            self.open(change["new"])

    def _on_open(self, _: Any) -> None:
        if self.controls.path.value.strip():
            self.open(self.controls.path.value)

    def _on_picked(self, change: Any) -> None:
        if change["new"] < 2:
            return
        with self._silence():
            self.count = min(change["new"], self.controls.count.max)
            self.view.counts.picked = 0
        self._wake()
