"""What the explained optimizer shows, and how it is laid out."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from typing import Any

import ipywidgets as widgets
import numpy as np
from numpy.typing import NDArray

from workbench.dashboards.explanation.controls import ExplainControls
from workbench.dashboards.explanation.jobs import Original, Plane, Setup
from workbench.dashboards.explanation.methods import USUAL
from workbench.dashboards.explanation.words import title_of, told
from workbench.dashboards.shared.layout import alert, remark, view_row
from workbench.dashboards.shared.progress_view import ProgressView
from workbench.optimization.landscape import ErrorLandscape
from workbench.optimization.trace import Trace
from workbench.widgets.landscape import LandscapeView
from workbench.widgets.reconstruction import ReconstructionView

_channels = itertools.count(1)
_VECTORS = "error (distance)"
_POSES = "error per joint"
_ASK = (
    "The browser cannot evaluate this back-projector: click a place of the plane, or move it "
    "with Shift and the arrow keys, and Python rebuilds the sample there."
)
_FOLLOWS = "Follows the mouse, a clicked place, or the sample on its way."


class ExplainView:
    """The views of the explained optimizer around its controls.

    Parameters
    ----------
    controls : ExplainControls
        What can be chosen.

    Attributes
    ----------
    root : ipywidgets.Widget
        All of it.
    landscape : LandscapeView
        The plane with the errors and the ways across it.
    reconstruction : ReconstructionView
        The sample beside what is rebuilt.
    progress : ProgressView
        What is being computed.
    """

    def __init__(self, controls: ExplainControls) -> None:
        channel = f"explanation-{next(_channels)}"
        self.landscape = LandscapeView(channel=channel)
        self.reconstruction = ReconstructionView(channel=channel)
        self.progress = ProgressView()
        self._message = widgets.HTML()
        self.root = self._laid_out(controls)

    def show_plane(self, plane: Plane) -> None:
        """Show other samples, or the same ones under other methods; errors are to come."""
        view = self.landscape
        with view.hold_sync():
            view.errors, view.columns, view.mapped = [], 0, -1
            view.traces, view.step, view.place = [], 0, []
            view.points = plane.embedding
            view.control_points = plane.control_points
            view.sample_word = "frame" if plane.body else "sample"
            view.error_name = _POSES if plane.body else _VECTORS
        view = self.reconstruction
        radial, body = plane.radial, plane.body
        with view.hold_sync():
            view.original, view.rebuilt, view.rebuilt_at = [], [], []
            view.columns, view.low, view.high = plane.columns, plane.low, plane.high
            view.parents = body.nodes.parents if body else []
            view.sides = body.nodes.sides if body else []
            view.head = body.nodes.head if body else -1
            view.weights = body.weights if body else []
            view.kernel = radial.kernel if radial else ""
            view.epsilon = radial.epsilon if radial else 1.0
            view.centers = radial.centers if radial else []
            view.coefficients = radial.coefficients if radial else []
            view.note = _FOLLOWS if radial else _ASK

    def show_original(self, original: Original) -> None:
        """Show another sample's own values or pose."""
        view = self.reconstruction
        if np.array_equal(view.original, original.numbers):
            return
        with view.hold_sync():
            view.offsets, view.root = original.offsets, original.root
            view.rebuilt, view.rebuilt_at = [], []
            view.original = original.numbers

    def show_rebuilt(self, numbers: NDArray[np.float64], place: Sequence[float]) -> None:
        """Show what Python rebuilt at a place."""
        view = self.reconstruction
        if list(view.rebuilt_at) != list(place) or not np.array_equal(view.rebuilt, numbers):
            with view.hold_sync():
                view.rebuilt, view.rebuilt_at = numbers, list(place)

    def show_errors(self, landscape: ErrorLandscape | None, *, busy: bool) -> None:
        """Show errors over the plane; those before stay faintly until there are others."""
        view = self.landscape
        if landscape is None:
            wanting = "computing …" if busy else "no map"
            view.message = "" if len(view.errors) else wanting
            return
        view.message = ""
        grid = landscape.grid
        extent = [float(end) for axis in (grid.x, grid.y) for end in (axis[0], axis[-1])]
        errors = landscape.errors.astype(np.float32).ravel()
        if view.mapped == landscape.sample and np.array_equal(view.errors, errors):
            return
        with view.hold_sync():
            view.columns, view.extent = len(grid.x), extent
            view.errors, view.mapped = errors, landscape.sample

    def show_traces(self, traces: Mapping[str, Trace | str], active: str, step: int) -> None:
        """Show the ways of optimizers, or in words why there are none."""
        view = self.landscape
        shown = [_trace(name, trace) for name, trace in traces.items()]
        with view.hold_sync():
            if view.traces != shown:
                view.traces = shown
            view.active, view.step = active, step

    def show_message(self, plane: Plane | None, setup: Setup | None, failure: str) -> None:
        """Say what is shown, how well it is rebuilt, and what could not be computed."""
        lines = []
        methods = _methods(setup, plane) if setup and plane else ""
        if failure:
            kept = f"; still shown: {plane.name}, {methods}" if plane else ""
            lines.append(alert(failure + kept))
        if plane is not None:
            free = plane.free
            mean = float(plane.errors[free].mean()) if len(free) else 0.0
            text = "; ".join(
                [
                    f"{methods}, {len(plane.control_points)} control points",
                    f"mean error of the {len(free)} other samples, which it was not fitted on, "
                    f"where the projection put them: {mean:.4g} "
                    f"(predicting the mean: {plane.mean_prediction_error:.4g} over all samples)",
                    *plane.notes,
                ]
            )
            lines.append(remark(plane.name, text))
        value = "".join(lines)
        if self._message.value != value:
            self._message.value = value

    def _laid_out(self, controls: ExplainControls) -> widgets.Widget:
        self.landscape.layout = widgets.Layout(flex="3 1 420px", min_width="0")
        self.reconstruction.layout = widgets.Layout(flex="2 1 300px", min_width="0")
        views = view_row([self.landscape, self.reconstruction])
        return widgets.VBox(
            [controls.view, self.progress.view, self._message, views],
            layout=widgets.Layout(width="100%"),
        )


def _methods(setup: Setup, plane: Plane) -> str:
    """Name projector and back-projector; the usual one by its own name."""
    name = setup.back_projector.name
    if name == USUAL:
        name = "spatial-keyframes" if plane.body else "rbf"
    return f"{setup.projector.name} with back-projector {name}"


def _trace(name: str, trace: Trace | str) -> dict[str, Any]:
    """Put a trace into what travels to the browser."""
    title = title_of(name)
    if isinstance(trace, str):
        return {"name": name, "title": title, "message": trace, "steps": []}
    steps = [
        {
            "iteration": step.iteration,
            "x": float(step.position[0]),
            "y": float(step.position[1]),
            "error": step.error,
            "text": text,
            "tries": [
                [float(tried.position[0]), float(tried.position[1]), tried.error, tried.stage]
                for tried in step.tries
            ],
        }
        for step, text in zip(trace.steps, told(trace), strict=True)
    ]
    return {"name": name, "title": title, "message": trace.reason, "steps": steps}
