"""What the projection comparison shows, and how it is laid out."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import ipywidgets as widgets
import numpy as np
from numpy.typing import NDArray

from workbench.dashboards.comparison.code_cell import CodeControls
from workbench.dashboards.comparison.controls import Controls
from workbench.dashboards.comparison.jobs import LOCAL_MEASURES, PanelResult, Values
from workbench.dashboards.comparison.quality_view import QualityView
from workbench.dashboards.comparison.summaries import Summary
from workbench.dashboards.shared.layout import alert, remark, view_row
from workbench.dashboards.shared.progress_view import ProgressView
from workbench.widgets import PoseView, SampleDetails, ScatterPanels

_channels = itertools.count(1)


@dataclass(frozen=True, eq=False)
class PanelState:
    """What there is to show in one panel.

    Attributes
    ----------
    title : str
        What the panel shows.
    result : PanelResult or None
        Its embedding; None as long as it is not there.
    failure : str
        Why it is not there, in plain words; empty while it is still to come.
    measured : PanelResult or None
        What quality is shown of: the same, or the embedding after control points were moved.
    moved : ndarray of shape (n_control_points, 2) or None
        Where control points were moved to, None if they were not.
    repeated : sequence of Values
        Quality with other seeds.
    """

    title: str
    result: PanelResult | None
    failure: str = ""
    measured: PanelResult | None = None
    moved: NDArray[np.float32] | None = None
    repeated: Sequence[Values] = ()


class ComparisonView:
    """The views of the projection comparison around its controls.

    Parameters
    ----------
    controls : Controls
        What can be chosen.

    Attributes
    ----------
    root : ipywidgets.Widget
        All of it.
    scatter : ScatterPanels
        The panels.
    pose : PoseView
        The hovered frame; hidden for tables.
    details : SampleDetails
        The hovered row; hidden for motions.
    quality : QualityView
        Quality values.
    code : CodeControls
        The view as code.
    progress : ProgressView
        What is being computed.
    """

    def __init__(self, controls: Controls) -> None:
        channel = f"comparison-{next(_channels)}"
        self.scatter = ScatterPanels(channel=channel, offers_html=True)
        self.pose = PoseView(channel=channel)
        self.details = SampleDetails(channel=channel)
        self.quality = QualityView()
        self.code = CodeControls()
        self.progress = ProgressView("all panels", [controls.repeat, controls.n_seeds])
        self._message = widgets.HTML()
        self.root = self._laid_out(controls)

    def show_samples(self, summary: Summary) -> None:
        """Show other samples; the panels are empty until they have embeddings."""
        scatter, body = self.scatter, summary.body
        with scatter.hold_sync():
            scatter.selection = []
            for name in ("moved", "influence", "points", "raw_points", "values", "control_points"):
                setattr(scatter, name, [])
            scatter.movable = False
            scatter.classes = summary.classes
            scatter.class_names = summary.class_names
            scatter.sample_word = "frame" if body else "sample"
        self.pose.layout.display = None if body else "none"
        self.details.layout.display = "none" if body else None
        if body:
            with self.pose.hold_sync():
                self.pose.parents, self.pose.sides = body.nodes.parents, body.nodes.sides
                self.pose.head = body.nodes.head
                self.pose.frame_time, self.pose.frame = body.frame_time, 0
                self.pose.positions = body.positions
            return
        with self.details.hold_sync():
            self.details.columns = summary.columns
            self.details.classes = summary.classes
            self.details.class_names = summary.class_names
            self.details.values = summary.values

    def show_panels(
        self,
        n_samples: int,
        states: Sequence[PanelState],
        color_by: str,
        influence: NDArray[np.float32] | None,
    ) -> None:
        """Show what the panels have so far.

        Parameters
        ----------
        n_samples : int
            Number of samples.
        states : sequence of PanelState
            One for each panel.
        color_by : str
            What colours stand for, see :data:`workbench.dashboards.comparison.controls.COLORS`.
        influence : ndarray of shape (n_samples, n_control_points) or None
            How control points count; None as long as they cannot be moved.
        """
        scatter = self.scatter
        results = [state.result for state in states]
        control = next((r.control_points for r in results if r is not None), np.empty(0, int))
        with scatter.hold_sync():
            # Before what has a row for each panel, whose shape is checked.
            scatter.panels = [_panel(state) for state in states]
            self._set("points", _points(n_samples, [r.embedding if r else None for r in results]))
            raw = [r.projected if r else None for r in results]
            has_raw = any(embedding is not None for embedding in raw)
            self._set("raw_points", _points(n_samples, raw) if has_raw else np.empty(0))
            self._set("control_points", control)
            self._show_colors(n_samples, states, color_by)
            self._set("influence", np.empty(0) if influence is None else influence)
            scatter.movable = influence is not None
            self._show_moved(len(control), states)
        self.quality.show(
            [state.title + " (moved)" * (state.moved is not None) for state in states],
            [state.measured for state in states],
            [state.repeated for state in states],
        )

    def show_message(
        self, summary: Summary | None, notes: Sequence[str], wanted: str, failure: str
    ) -> None:
        """Say what the samples are, how they were treated, and what could not be loaded."""
        lines = []
        if failure:
            words = failure if failure.startswith(wanted) else f"{wanted}: {failure}"
            kept = f"; still shown: {summary.name}" if summary else ""
            lines.append(alert(words + kept))
        if summary is not None:
            text = "; ".join([_content(summary), *summary.notes, *notes])
            lines.append(remark(summary.name, text))
        self._message.value = "".join(lines)

    def _show_colors(self, n_samples: int, states: Sequence[PanelState], color_by: str) -> None:
        by_value = color_by in LOCAL_MEASURES
        if by_value:
            values = np.full((len(states), n_samples), np.nan, dtype=np.float32)
            for place, state in zip(values, states, strict=True):
                if state.measured is not None:
                    place[:] = state.measured.local[color_by]
            self._set("values", values)
            self.scatter.value_name, self.scatter.value_best = color_by, LOCAL_MEASURES[color_by]
        self.scatter.color_by = "value" if by_value else color_by

    def _show_moved(self, n_control: int, states: Sequence[PanelState]) -> None:
        if all(state.moved is None for state in states):
            self._set("moved", np.empty(0))
            return
        moved = np.full((len(states), n_control, 2), np.nan, dtype=np.float32)
        for place, state in zip(moved, states, strict=True):
            if state.moved is not None:
                place[:] = state.moved
        self._set("moved", moved)

    def _set(self, name: str, values: NDArray[Any]) -> None:
        """Send values only if they changed: a busy panel reports often, and points are many."""
        before = getattr(self.scatter, name)
        if before.size != values.size or not np.array_equal(
            before.ravel(), values.ravel().astype(before.dtype), equal_nan=values.dtype.kind == "f"
        ):
            setattr(self.scatter, name, values)

    def _laid_out(self, controls: Controls) -> widgets.Widget:
        self.scatter.layout = widgets.Layout(flex="3 1 440px", min_width="0")
        for view in (self.pose, self.details):
            view.layout = widgets.Layout(flex="1 1 210px", min_width="0", display="none")
        for part in (self.quality.table, self.quality.figures):
            part.layout = widgets.Layout(flex="1 1 360px", min_width="0")
        views = [self.scatter, self.pose, self.details]
        return widgets.VBox(
            [
                controls.view,
                self.progress.view,
                self._message,
                view_row(views),
                view_row([self.quality.table, self.quality.figures]),
                self.code.view,
            ],
            layout=widgets.Layout(width="100%"),
        )


def _points(
    n_samples: int, embeddings: Sequence[NDArray[np.float64] | None]
) -> NDArray[np.float32]:
    points = np.full((len(embeddings), n_samples, 2), np.nan, dtype=np.float32)
    for place, embedding in zip(points, embeddings, strict=True):
        if embedding is not None:
            place[:] = embedding
    return points


def _panel(state: PanelState) -> dict[str, str]:
    if state.result is None:
        if state.failure:
            return {"title": state.title, "message": state.failure, "state": "failed"}
        return {"title": state.title, "message": "computing …", "state": "busy"}
    panel = {"title": state.title, "state": "ready"}
    if state.measured is None:
        return panel | {"detail": state.failure or "measuring …"}
    panel["detail"] = _caption(state.measured)
    if state.measured.before is not None:
        panel["raw_detail"] = _caption(state.measured.before)
    return panel


def _caption(measured: PanelResult | Values) -> str:
    return f"trustworthiness {measured.quality.trustworthiness:.3f} · error {measured.error:.3g}"


def _content(summary: Summary) -> str:
    if summary.body:
        joints = len(set(summary.body.nodes.names))
        clips = f" of {len(summary.class_names)} clips" if summary.class_names else ""
        return f"{summary.n_samples} frames{clips}, {joints} joints"
    classes = f", {len(summary.class_names)} classes" if summary.class_names else ""
    return f"{summary.n_samples} samples, {summary.n_features} features{classes}"
