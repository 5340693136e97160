"""What the comparison computes beside the kernel: load data, run schemes, measure."""

from __future__ import annotations

from dataclasses import replace
from inspect import signature
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from workbench.dashboards.comparison.jobs import (
    Description,
    Influence,
    Job,
    Methods,
    Move,
    PanelResult,
    Repetition,
    Run,
    Values,
)
from workbench.dashboards.comparison.measuring import panel_result
from workbench.dashboards.comparison.panels import check_parameters
from workbench.dashboards.comparison.summaries import Summary, summarize
from workbench.dashboards.shared.background import Report
from workbench.dashboards.shared.remarks import said_by_warnings
from workbench.dashboards.shared.sources import Source, load_source
from workbench.errors import (
    WorkbenchError,
)
from workbench.spaces import PoseSpace, Space

if TYPE_CHECKING:
    from workbench.results import SpatialResult

#: Values of the table of influences that the page gets: 16 MB.
MAX_INFLUENCES = 4_000_000


class Session:
    """Load samples and run schemes, remembering distances and projections."""

    def __init__(self) -> None:
        self._source: Source | None = None
        self._space: Space | None = None
        self._notes: tuple[str, ...] = ()
        self._projections: dict[Any, tuple[NDArray[np.float64], tuple[str, ...]]] = {}
        self._influences: dict[tuple[int, ...], NDArray[np.float64]] = {}

    def answer(self, job: Job, methods: Methods, *, report: Report) -> Any:
        """Do a job and give what its class says."""
        if isinstance(job, Source):
            return self.load(job, report=report)
        if isinstance(job, Run):
            return self.run(job, methods, report=report)
        if isinstance(job, Repetition):
            return self.repeat(job, methods, report=report)
        if isinstance(job, Move):
            return self.move(job, methods, report=report)
        if isinstance(job, Influence):
            return self.influence(job, report=report)
        return self.describe(job, methods, report=report)

    def load(self, source: Source, *, report: Report) -> Summary:
        """Load samples and describe them."""
        space = self._load(source, report)
        report("preparing the views", None)
        return summarize(space, self._notes)

    def run(self, run: Run, methods: Methods, *, report: Report) -> PanelResult:
        """Compute what a panel shows.

        Parameters
        ----------
        run : Run
            The samples, the method and its settings.
        methods : Methods
            The kernel's methods.
        report : callable
            Gets the progress.
        """
        result, notes = self._scheme_result(run, methods, report)
        return panel_result(run, result, notes, report)

    def repeat(self, job: Repetition, methods: Methods, *, report: Report) -> Values:
        """Measure the quality of a run."""
        result, _ = self._scheme_result(job.run, methods, report)
        report("measuring quality", 0.9)
        return Values(result.quality, result.error)

    def move(self, job: Move, methods: Methods, *, report: Report) -> PanelResult:
        """Measure the embedding that follows from moved control points."""
        from workbench.schemes import choose_control_points

        space = self._load(job.run.source, report)
        control = choose_control_points(
            space, _selector(space), ratio=job.run.ratio, random_state=job.run.seed
        )
        places = job.places.astype(np.float64)
        if len(places) != len(control):
            raise WorkbenchError(f"moved: got {len(places)} positions, want {len(control)}")
        report("placing samples", 0.2)
        embedding = self._influence(space, control) @ places
        raw = replace(job.run, panel=replace(job.run.panel, optimized=False))
        result, notes = self._rebuilt(raw, methods, space, embedding, report)
        return panel_result(raw, result, tuple(notes), report)

    def influence(self, job: Influence, *, report: Report) -> NDArray[np.float32]:
        """Say how much each control point counts for each sample.

        Raises
        ------
        WorkbenchError
            If that is too much for the page.
        """
        space = self._load(job.source, report)
        if len(space) * len(job.control_points) > MAX_INFLUENCES:
            raise WorkbenchError(
                f"control points cannot be moved: {len(space)} samples by "
                f"{len(job.control_points)} control points are more than the "
                f"{MAX_INFLUENCES // 1_000_000} million values that the page takes; "
                "choose fewer control points"
            )
        report("preparing to move control points", 0.5)
        influence = self._influence(space, np.array(job.control_points))
        return influence.astype(np.float32)

    def describe(self, job: Description, methods: Methods, *, report: Report) -> dict[str, Any]:
        """List a projector's parameters with their defaults."""
        report(f"looking up the parameters of {job.projector}", None)
        return _defaults(methods.projectors.factory(job.projector))

    def _scheme_result(
        self, run: Run, methods: Methods, report: Report
    ) -> tuple[SpatialResult, tuple[str, ...]]:
        from workbench.schemes import choose_control_points

        space = self._load(run.source, report)
        report("measuring distances", 0.05)
        _ = space.distances
        control = choose_control_points(
            space, _selector(space), ratio=run.ratio, random_state=run.seed
        )
        report("projecting", 0.2)
        projected, notes = self._project(run, methods, space, control)
        result, said = self._rebuilt(run, methods, space, projected, report)
        if result.optimization is not None:
            ended = result.optimization
            said.append(f"optimized in {ended.iterations} iterations: {ended.reason}")
        return result, tuple(dict.fromkeys([*notes, *said]))

    def _rebuilt(
        self,
        run: Run,
        methods: Methods,
        space: Space,
        embedding: NDArray[np.float64] | None,
        report: Report,
    ) -> tuple[SpatialResult, list[str]]:
        """Optimize an embedding if that is wanted, and rebuild the samples from it."""
        from workbench.optimization import VISUALIZATION_OPTIMIZER
        from workbench.schemes import SpatialScheme

        def follow(iteration: int, error: float, embedding: NDArray[np.float64]) -> None:  # noqa: ARG001 - the optimizer's signature
            # How many are to come is not known; most samples rest within twenty.
            report(f"optimizing, iteration {iteration}", 0.85 - 0.35 * 0.9**iteration)

        report("back-projecting", 0.5)
        panel, name = run.panel, run.back_projector
        scheme = SpatialScheme(
            _created(methods, run) if embedding is None else panel.projector,
            selector=_selector(space),
            back_projector=None if name is None else methods.back_projectors.create(name),
            optimizer=VISUALIZATION_OPTIMIZER if panel.optimized else None,
            two_step="rbfp" if panel.two_step else None,
        )
        with said_by_warnings() as said:
            result = scheme.run(
                space,
                ratio=run.ratio,
                random_state=run.seed,
                projected=embedding,
                callback=follow,
            )
        return result, said

    def _load(self, source: Source, report: Report) -> Space:
        if self._space is None or source != self._source:
            report(f"loading {source.name}", None)
            space, notes = load_source(source)
            self._source, self._space, self._notes = source, space, notes
            self._projections.clear()
            self._influences.clear()
        return self._space

    def _influence(self, space: Space, control: NDArray[np.intp]) -> NDArray[np.float64]:
        from workbench.projection.rbfp import RBFP

        key = tuple(control.tolist())
        if key not in self._influences:
            self._influences.clear()  # large, and only those of one choice are on the page
            self._influences[key] = RBFP().influence(space, control)
        return self._influences[key]

    def _project(
        self, run: Run, methods: Methods, space: Space, control: NDArray[np.intp]
    ) -> tuple[NDArray[np.float64] | None, tuple[str, ...]]:
        """Project, or remember a projection; None if the scheme has to do it.

        Of a projection that is given, a scheme cannot know the inverse.
        """
        from workbench.projection import project
        from workbench.projection.two_step import project_in_two_steps

        panel = run.panel
        inverts = run.back_projector is not None and hasattr(
            methods.back_projectors.create(run.back_projector), "use_projection"
        )
        # The factory is part of the key because a user may register another by that name.
        factory = methods.projectors.factory(panel.projector)
        around = control.tobytes() if panel.two_step else b""
        key = (factory, repr(sorted(panel.parameters.items())), run.seed, around)
        if inverts and not panel.two_step:
            _check_dimensions(panel.projector, getattr(_created(methods, run), "n_components", 2))
            return None, ()
        if key not in self._projections:
            projector = _created(methods, run)
            with said_by_warnings() as said:
                embedding = (
                    project_in_two_steps(space, projector, "rbfp", control, random_state=run.seed)
                    if panel.two_step
                    else project(space, projector, random_state=run.seed)
                )
            _check_dimensions(panel.projector, embedding.shape[1])
            self._projections[key] = embedding, tuple(said)
        return self._projections[key]


def _selector(space: Space) -> str:
    """Name the usual selector: rows of a table have no order in time."""
    return "uniform" if isinstance(space, PoseSpace) else "random"


def _created(methods: Methods, run: Run) -> Any:
    """Make a panel's projector with its parameters."""
    factory, panel = methods.projectors.factory(run.panel.projector), run.panel
    known = _defaults(factory)
    if known:
        check_parameters(panel.projector, panel.parameters, known)
    return factory(**panel.parameters)


def _defaults(factory: Any) -> dict[str, Any]:
    """List the parameters of a class or function that have defaults; none if it takes any."""
    try:
        parameters = signature(factory).parameters.values()
    except (TypeError, ValueError):  # one that is compiled, for instance
        return {}
    if any(p.kind is p.VAR_KEYWORD for p in parameters):
        return {}
    return {p.name: p.default for p in parameters if p.default is not p.empty}


def _check_dimensions(projector: str, found: int) -> None:
    if found != 2:
        raise WorkbenchError(
            f"projector {projector!r}: got {found} dimensions, want 2 to show them in a panel"
        )
