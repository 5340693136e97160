"""What the explained optimizer computes beside the kernel."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.dashboards.explanation.jobs import Area, Body, Job, Method, Original, Plane, Setup
from workbench.dashboards.shared.background import Report
from workbench.dashboards.shared.remarks import said_by_warnings
from workbench.dashboards.shared.sources import Source, load_source
from workbench.errors import WorkbenchError
from workbench.mocap.body_nodes import body_nodes
from workbench.optimization.landscape import (
    ErrorLandscape,
    error_landscape,
    rebuild_grid,
)
from workbench.optimization.recording import Recording, record_optimization
from workbench.optimization.trace import Trace
from workbench.results import SpatialResult
from workbench.spaces import PoseSpace, Space, VectorSpace
from workbench.widgets.radial import radial_function

#: Numbers of the grids, and of an optimizer's recording, kept for other samples: 256 MB.
_KEPT = 2**25


class ExplainSession:
    """Prepare a plane, map errors on it, and follow optimizers, remembering what is shared."""

    def __init__(self) -> None:
        self._source: Source | None = None
        self._space: Space | None = None
        self._notes: tuple[str, ...] = ()
        self._projections: dict[tuple[Method, int], NDArray[np.float64]] = {}
        self._setup: Setup | None = None
        self._result: SpatialResult | None = None
        self._said: tuple[str, ...] = ()
        self._recordings: dict[Method, Recording] = {}
        self._grids: dict[Area, NDArray[np.float64]] = {}

    def answer(self, job: Job, context: Any, *, report: Report) -> Any:  # noqa: ARG002 - the worker's signature
        """Do a job: call the method of its name."""
        calls: dict[str, Callable[..., Any]] = {
            "prepare": self.prepare,
            "original": self.original,
            "landscape": self.landscape,
            "trace": self.trace,
            "rebuild": self.rebuild,
        }
        return calls[job.method](job.setup, *job.rest, report=report)

    def prepare(self, setup: Setup, *, report: Report) -> Plane:
        """Load, project and fit, and describe what came out."""
        result = self._prepared(setup, report)
        space = result.space
        table = isinstance(space, VectorSpace)
        numbers = space.features if table else np.empty((1, 0))
        return Plane(
            name=setup.source.name,
            embedding=result.projected,
            control_points=result.control_points,
            errors=result.errors,
            radial=radial_function(result.back_projector),
            columns=list(space.columns) if isinstance(space, VectorSpace) else [],
            low=numbers.min(axis=0),
            high=numbers.max(axis=0),
            body=_body(space) if isinstance(space, PoseSpace) else None,
            mean_prediction_error=space.mean_prediction_error(),
            notes=(*self._notes, *self._said),
        )

    def original(self, setup: Setup, sample: int, *, report: Report) -> Original:
        """Give one sample's own numbers."""
        space = self._prepared(setup, report).space
        offsets = root = np.empty(0)
        if isinstance(space, PoseSpace):
            offsets, root = _frame(space, sample)
        return Original(space.features[sample].copy(), offsets, root)

    def landscape(self, setup: Setup, sample: int, area: Area, *, report: Report) -> ErrorLandscape:
        """Map one sample's error over a square."""
        result = self._prepared(setup, report)
        grid = area.grid
        rebuilt = self._grids.get(area)
        if rebuilt is None:
            rebuilt = rebuild_grid(
                result.back_projector, grid, lambda done: report("mapping the error", done)
            )
            kept = sum(other.size for other in self._grids.values())
            if kept + rebuilt.size > _KEPT:
                self._grids.clear()
            if rebuilt.size <= _KEPT:
                self._grids[area] = rebuilt
        return error_landscape(result.space, sample, grid, rebuilt)

    def trace(self, setup: Setup, sample: int, optimizer: Method, *, report: Report) -> Trace:
        """Follow an optimizer."""
        result = self._prepared(setup, report)
        if optimizer in self._recordings:
            return self._recordings[optimizer].trace(sample)

        def follow(iteration: int, error: float, embedding: NDArray[np.float64]) -> None:  # noqa: ARG001 - the optimizer's signature
            # How many are to come is not known; most searches end within thirty.
            report(f"{optimizer.name}: iteration {iteration}", 1.0 - 0.93**iteration)

        recording = record_optimization(
            optimizer.build(),
            result.space,
            result.back_projector,
            result.projected,
            result.control_points,
            callback=follow,
        )
        if recording.size <= _KEPT:
            self._recordings[optimizer] = recording
        return recording.trace(sample)

    def rebuild(
        self, setup: Setup, place: tuple[float, float], *, report: Report
    ) -> NDArray[np.float64]:
        """Rebuild a sample at a place, as numbers."""
        result = self._prepared(setup, report)
        rebuilt = np.asarray(result.back_projector.predict(np.array([place])), dtype=np.float64)
        return rebuilt.reshape(-1)

    def _prepared(self, setup: Setup, report: Report) -> SpatialResult:
        if self._result is not None and setup == self._setup:
            return self._result
        from workbench.backprojection import back_projector_for
        from workbench.schemes import SpatialScheme

        space = self._load(setup.source, report)
        with said_by_warnings() as said:
            back_projector = back_projector_for(
                space, setup.back_projector.build(), random_state=setup.seed
            )
            projected = None
            if not hasattr(back_projector, "use_projection"):
                # The projector's own inverse needs the projector; others can share what it did.
                projected = self._project(setup, space, report)
            report("fitting the back-projector", 0.8)
            scheme = SpatialScheme(setup.projector.build(), back_projector=back_projector)
            self._result = scheme.run(
                space, ratio=setup.ratio, random_state=setup.seed, projected=projected
            )
        if self._result.projected.shape[1] != 2:
            shape = self._result.projected.shape
            self._result = None
            raise WorkbenchError(
                f"projector {setup.projector.name!r}: got {shape[1]} dimensions, want 2"
            )
        self._setup, self._said = setup, tuple(said)
        self._grids.clear()
        self._recordings.clear()
        return self._result

    def _load(self, source: Source, report: Report) -> Space:
        if self._space is None or source != self._source:
            report(f"loading {source.name}", None)
            self._space, self._notes = load_source(source)
            self._source = source
            self._projections.clear()
        return self._space

    def _project(self, setup: Setup, space: Space, report: Report) -> NDArray[np.float64]:
        from workbench.projection import project

        key = setup.projector, setup.seed
        if key not in self._projections:
            report(f"projecting with {setup.projector.name}", 0.2)
            self._projections[key] = project(
                space, setup.projector.build(), random_state=setup.seed
            )
        return self._projections[key]


def _body(space: PoseSpace) -> Body:
    return Body(body_nodes(space.motion.skeleton), space.weights)


def _frame(space: PoseSpace, sample: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Give a frame's offsets, those of joints that the file moves too, and its root."""
    motion = space.motion
    offsets = np.array(motion.skeleton.offsets)
    for joint, translations in motion.joint_translations.items():
        offsets[joint] = translations[sample]
    ends = np.array([site.offset for site in motion.skeleton.end_sites]).reshape(-1, 3)
    return np.concatenate([offsets, ends]), np.array(motion.root_translation[sample])
