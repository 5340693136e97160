"""The optimizer explained: one sample's error landscape, and the ways across it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from numbers import Integral
from pathlib import Path
from typing import Any

from workbench.backprojection import BackProjector
from workbench.dashboards.explanation.controls import ExplainControls
from workbench.dashboards.explanation.jobs import Job, Plane, Setup
from workbench.dashboards.explanation.methods import Methods
from workbench.dashboards.explanation.session import ExplainSession
from workbench.dashboards.explanation.state import ExplainState
from workbench.dashboards.explanation.view import ExplainView
from workbench.dashboards.shared.background import Background
from workbench.dashboards.shared.home import Home
from workbench.dashboards.shared.sources import (
    Source,
    available,
    loaded_here,
    reread,
    source_of,
    standardized,
)
from workbench.dashboards.shared.worker import Worker
from workbench.errors import WorkbenchError
from workbench.optimization.landscape import ErrorLandscape
from workbench.optimization.trace import Trace
from workbench.spaces import Space

_RATIOS = (0.01, 0.5)


def explain_optimizer(
    data: str | Path | Space = "uci/iris",
    projector: str = "pca",
    sample: int | None = None,
    back_projector: str | BackProjector | None = None,
    *,
    ratio: float = 0.03,
    standardize: bool = False,
    label: str | None = None,
    random_state: int = 0,
) -> OptimizerExplanation:
    """Explain in a dashboard how an embedding is optimized.

    It shows the error of one sample at every place of the plane, and how Costa 2018,
    Alg. 12, and the other optimizers find their way on it.

    Parameters
    ----------
    data : str, path-like or Space
        A data set's name, a file's path, or samples in memory.
    projector : str
        A registered name.
    sample : int, optional
        The sample to explain; by default, of those that are no control points, that with the
        largest error.
    back_projector : str, back-projector or None
        A registered name, or an object such as any scikit-learn regressor; by default spatial
        keyframes for motions and RBF for tables.
    ratio : float
        Share of control points, 0.01 to 0.5.
    standardize : bool
        Whether to standardise the columns of a table.
    label : str, optional
        The column of a table of your own that holds the classes.
    random_state : int
        Seed of the choice of control points and of the methods.

    Returns
    -------
    OptimizerExplanation
        Shown by a notebook as the last expression of a cell.

    Raises
    ------
    WorkbenchError
        If an argument is not valid. Data that cannot be loaded are told in the dashboard.
    """
    return OptimizerExplanation(
        data,
        projector,
        sample,
        back_projector,
        ratio=ratio,
        standardize=standardize,
        label=label,
        random_state=random_state,
    )


class OptimizerExplanation:
    """A dashboard of one sample's error landscape and of optimizers on it.

    It computes beside the kernel; :meth:`finished` waits for that. Outside a notebook, where
    nothing could show progress, each change is computed before it returns. See
    :func:`explain_optimizer` for the parameters.

    Attributes
    ----------
    controls : ExplainControls
        What can be chosen.
    view : ExplainView
        What is shown.
    """

    def __init__(
        self,
        data: str | Path | Space = "uci/iris",
        projector: str = "pca",
        sample: int | None = None,
        back_projector: str | BackProjector | None = None,
        *,
        ratio: float = 0.03,
        standardize: bool = False,
        label: str | None = None,
        random_state: int = 0,
    ) -> None:
        if not _RATIOS[0] <= ratio <= _RATIOS[1]:
            raise WorkbenchError(f"ratio: got {ratio}, want {_RATIOS[0]} to {_RATIOS[1]}")
        if sample is not None and (not isinstance(sample, Integral) or sample < 0):
            raise WorkbenchError(f"sample: got {sample!r}, want an index from 0")
        self._choice = Methods()
        self._choice.check_projector(projector)
        self._source = source_of(data, label, standardize)
        self._state = ExplainState(-1 if sample is None else int(sample), self._choice.optimizers)
        self._there: Setup | None = None
        self._setting = False

        name = self._choice.offered(back_projector)
        self.controls = ExplainControls(
            available(), list(self._choice.projectors), list(self._choice.back_projectors)
        )
        self.controls.projector.value = projector
        self.controls.back_projector.value = name
        self.controls.ratio.value = ratio
        self.controls.seed.value = random_state
        self.controls.standardize.value = standardize
        self.view = ExplainView(self.controls)
        self.view.landscape.active = self._state.active
        self._worker: Worker[Job] = Worker(
            Background(ExplainSession),
            missing=self._missing,
            failures=self._state.failures,
            prepare=self._prepare,
            done=self._done,
            changed=self._show,
            report=self._report,
        )
        self._show_choice()
        self._connect()
        self._worker.wake()

    def _repr_mimebundle_(self, **kwargs: Any) -> Any:
        self._offer_methods()
        return self.view.root._repr_mimebundle_(**kwargs)

    @property
    def sample(self) -> int:
        """Index of the explained sample, -1 before there are data; set it to pick another."""
        return self._state.sample

    @sample.setter
    def sample(self, sample: int) -> None:
        limit = len(self.plane.embedding) if self.plane else 0
        if not isinstance(sample, Integral) or not 0 <= sample < limit:
            raise WorkbenchError(
                f"sample: got {sample!r}, want an index below {limit}"
                if limit
                else "sample: got an index before there are data to pick from"
            )
        self._pick(int(sample))

    @property
    def back_projector(self) -> str:
        """Name of the back-projector; set it to another name, or to any regressor."""
        return str(self.controls.back_projector.value)

    @back_projector.setter
    def back_projector(self, method: str | BackProjector | None) -> None:
        name = self._choice.offered(method)
        self._offer_methods()
        self.controls.back_projector.value = name

    @property
    def optimizer(self) -> str:
        """Name of the optimizer whose steps are shown; can be set."""
        return str(self.view.landscape.active)

    @optimizer.setter
    def optimizer(self, name: str) -> None:
        self._offer_methods()
        self._choice.check_optimizer(name)
        self.view.landscape.active = name
        self.view.landscape.step = 0

    @property
    def traces(self) -> dict[str, Trace]:
        """What the optimizers do with the sample, by their names, as far as it is there."""
        return self._state.traces

    @property
    def trace(self) -> Trace | None:
        """What the chosen optimizer does with the sample, None before that is there."""
        return self.traces.get(self.optimizer)

    @property
    def step(self) -> int:
        """The step of the trace that is shown; can be set."""
        return int(self.view.landscape.step)

    @step.setter
    def step(self, step: int) -> None:
        limit = len(self.trace.steps) if self.trace else 0
        if not isinstance(step, Integral) or not 0 <= step < limit:
            raise WorkbenchError(f"step: got {step!r}, want a number below {limit}")
        self.view.landscape.step = int(step)

    @property
    def landscape(self) -> ErrorLandscape | None:
        """The sample's errors over the whole plane, None before they are there."""
        return self._state.landscape

    @property
    def plane(self) -> Plane | None:
        """The embedding and what belongs to it, None before it is there."""
        return self._state.plane

    @property
    def message(self) -> str:
        """Why what was asked for is not shown; empty if it is."""
        failures = self._state.failures
        first = failures.get(Job("prepare", self._wanted()), "")
        return "; ".join([first] * bool(first) + self._state.faults())

    async def finished(self) -> None:
        """Wait until everything is computed: ``await dashboard.finished()``."""
        await self._worker.finished()

    def open(self, data: str | Path | Space, label: str | None = None) -> None:
        """Explain other data; those shown now stay if the new ones cannot be loaded.

        Parameters
        ----------
        data : str, path-like or Space
            A data set's name, a file's path, or samples in memory.
        label : str, optional
            The column of a table of your own that holds the classes.
        """
        self._want(source_of(data, label, self.controls.standardize.value))

    def cancel(self) -> None:
        """End what is being computed; what is complete stays."""
        self._there = None
        self._worker.cancel()

    def recompute(self) -> None:
        """Compute what failed or was cancelled, or everything anew if nothing did.

        A file that was edited meanwhile is read again.
        """
        self._offer_methods()
        source, state = reread(self._source), self._state
        self._there = None
        if not state.failures and source == self._source:
            state.forget()
        state.failures.clear()
        self._source = source
        self._worker.wake()

    def close(self) -> None:
        """End the process that computes, and take the dashboard out of the page."""
        self.cancel()
        self.view.root.close()

    # Computing.

    def _wanted(self) -> Setup:
        controls, choice = self.controls, self._choice
        return Setup(
            self._source,
            choice.projectors[controls.projector.value],
            choice.back_projectors[controls.back_projector.value],
            round(controls.ratio.value, 4),
            int(controls.seed.value),
        )

    def _missing(self) -> list[Job]:
        """List what is to be computed; the plane comes before what is on it."""
        state, wanted = self._state, Job("prepare", self._wanted())
        if (state.stale or wanted.setup != state.setup) and wanted not in state.failures:
            return [wanted]
        jobs = state.missing()
        current = self._worker.current
        # What belongs to this plane is soon done; a new process would take longer.
        if current is not None and current not in jobs and state.lacks(current):
            jobs.append(current)
        return jobs

    def _prepare(self, job: Job) -> tuple[Job, None]:
        """Load what only this kernel can; samples in memory are sent once."""
        setup = job.setup
        if setup == self._there:
            source = replace(setup.source, space=None)
        else:
            source, self._there = loaded_here(setup.source), None
        return replace(job, setup=replace(setup, source=source)), None

    def _done(self, job: Job, answer: Any) -> None:
        if job.method != "prepare":
            self._state.remember(job, answer)
            return
        self._there = job.setup
        self._state.take(job.setup, answer)
        source = job.setup.source
        given = source.space is not None and not source.registered
        with self._set_quietly():
            self.controls.suit(
                len(answer.embedding),
                "frame" if answer.body else "sample",
                may_standardize=not (given or answer.body),
            )
            self.view.show_plane(answer)

    def _report(self, text: str, done: float | None) -> None:
        missing, every = len(self._missing()), len(self._state.jobs()) + 1
        finished = every - missing if self._state.setup == self._wanted() else 0
        self.view.progress.show(text, min(1.0, max(0.0, (finished + (done or 0.0)) / every)))

    # Showing.

    def _show(self) -> None:
        state, view = self._state, self.view
        busy = self._worker.current is not None
        view.progress.show_busy(busy)
        view.show_message(state.plane, state.setup, self.message)
        with self._set_quietly():
            if state.plane is None:
                view.landscape.message = "computing …" if busy else "no data"
                return
            view.landscape.sample = self.controls.sample.value = state.sample
            original = state.answer_of("original", state.sample)
            if original is not None:
                view.show_original(original)
                rebuilt = state.answer_of("rebuild", state.asked_place)
                if rebuilt is not None:
                    view.show_rebuilt(rebuilt, state.asked_place)
            view.show_errors(state.best_map, busy=busy)
            view.show_traces(state.told, self.optimizer, self.step)

    def _show_choice(self) -> None:
        """Let the drop-down show what is wanted, without wanting it again."""
        with self._set_quietly():
            self.controls.choose(self._source)

    @contextmanager
    def _set_quietly(self) -> Iterator[None]:
        """Change controls and views without taking it for a wish of the user's."""
        before, self._setting = self._setting, True
        try:
            yield
        finally:
            self._setting = before

    # Listening.

    def _connect(self) -> None:
        controls, landscape, here = self.controls, self.view.landscape, Home().here
        controls.on_settings(here(self._wake_unless_set))
        controls.data.observe(here(self._on_data), "value")
        controls.standardize.observe(here(self._on_standardize), "value")
        controls.open.on_click(here(self._on_open))
        controls.sample.observe(here(self._on_sample), "value")
        landscape.observe(here(self._on_sample), "sample")
        landscape.observe(here(self._on_view), ["active", "place", "zoomed"])
        self.view.progress.cancel.on_click(here(lambda _: self.cancel()))
        self.view.progress.again.on_click(here(lambda _: self.recompute()))

    def _wake_unless_set(self) -> None:
        if not self._setting:
            self._worker.wake()

    def _on_view(self, _: Any) -> None:
        landscape, state = self.view.landscape, self._state
        state.active, state.zoomed = landscape.active, landscape.zoomed
        state.place = tuple(landscape.place) or None
        self._wake_unless_set()

    def _on_sample(self, change: Any) -> None:
        if not self._setting and self.plane is not None:
            self._pick(change["new"])

    def _pick(self, sample: int) -> None:
        if sample == self._state.sample:
            return
        self._state.sample = sample
        self.view.landscape.step = 0
        self._worker.wake()

    def _on_data(self, change: Any) -> None:
        if change["new"] and not self._setting:
            self.open(change["new"])

    def _on_open(self, _: Any) -> None:
        if self.controls.path.value.strip():
            self.open(self.controls.path.value, self.controls.label.value.strip() or None)

    def _on_standardize(self, change: Any) -> None:
        if not self._setting:
            self._want(standardized(reread(self._source), change["new"]))

    def _want(self, source: Source) -> None:
        self._state.failures.clear()
        self._source = source
        self._show_choice()
        self._worker.wake()

    def _offer_methods(self) -> None:
        """List methods that were registered, and regressors that were made, meanwhile."""
        self._choice.read(in_use=self.controls.back_projector.value)
        self._state.optimizers = self._choice.optimizers
        with self._set_quietly():
            self.controls.offer(list(self._choice.projectors), list(self._choice.back_projectors))
