"""Embeddings of motions as trajectories, in the manner of Costa 2018, Figure 6.2."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import plotly.graph_objects as go
from numpy.typing import NDArray

from workbench.errors import WorkbenchError
from workbench.figures.embeddings import CROSS, LEGEND_ONLY, Panel
from workbench.figures.panels import panel_grid
from workbench.figures.style import BLACK
from workbench.validation import as_embedding, control_point_indices, whole_number

#: Time from red over green to blue. Each colour is darker than the one before, so that who
#: cannot tell the hues apart still sees which way time goes.
TIME_COLORS = (
    "#ff7e77",
    "#f77200",
    "#c58203",
    "#9c8508",
    "#6f8502",
    "#01861e",
    "#037559",
    "#036563",
    "#025767",
    "#02476b",
    "#012298",
)

_PATH = "#C3CAD1"

_KEY = {"size": 9.5, "line": {"color": BLACK, "width": 1.4}}
_START = {
    "symbol": "triangle-right",
    "size": 13,
    "color": "white",
    "line": {"color": BLACK, "width": 1.6},
}
_END = {**_START, "symbol": "square", "size": 10}


def trajectory_panels(
    panels: Sequence[Panel],
    *,
    n_columns: int = 2,
    seconds: float | None = None,
    crosses: bool = False,
    closed: bool = False,
    gap: float | None = None,
) -> go.Figure:
    """Draw embeddings of motions side by side, as curves that change colour with time.

    Frames are dots, joined in their order; keyframes are bigger dots with a black border. A
    white triangle marks the first frame and a white square the last.

    Parameters
    ----------
    panels : sequence of Panel
        The embeddings, row by row; the control points are the keyframes.
    n_columns : int
        Panels in a row.
    seconds : float, optional
        How long the motion lasts, for the colour bar; by default it tells only start and end.
    crosses : bool
        Whether keyframes are crosses, as in Costa 2018, Figures 5.6 to 5.11.
    closed : bool
        Whether the motion is a cycle: a dotted line leads from the last frame to the first.
    gap : float, optional
        Share of a panel's extent beyond which two successive frames are not joined.

    Returns
    -------
    plotly.graph_objects.Figure

    Raises
    ------
    WorkbenchError
        If there is no panel, positions are not finite ones in the plane, a keyframe is not
        one of them, or a setting is not a number above 0.
    """
    if not panels:
        raise WorkbenchError("panels: got none, want at least one embedding")
    for name, value in (("seconds", seconds), ("gap", gap)):
        if value is not None and not 0 < value < np.inf:
            raise WorkbenchError(f"{name}: got {value!r}, want a number above 0")
    figure, places = panel_grid(
        [panel.title for panel in panels], whole_number("n_columns", n_columns)
    )
    for panel, (row, column) in zip(panels, places, strict=True):
        points = as_embedding(panel.points, f"points of {panel.title!r}")
        if points.shape[1] != 2:
            raise WorkbenchError(f"points of {panel.title!r}: got three dimensions, want two")
        keys = control_point_indices(panel.control_points, len(points), name="keyframes")
        for trace in trajectory_traces(points, keys, crosses=crosses, closed=closed, gap=gap):
            figure.add_trace(trace, row=row, col=column)
    return add_key(figure, seconds, crosses=crosses)


def trajectory_traces(
    points: NDArray[np.float64],
    keys: NDArray[np.intp],
    *,
    crosses: bool = False,
    closed: bool = False,
    gap: float | None = None,
) -> list[go.Scatter]:
    """Make the traces of one curve: path, frames, keyframes, first and last frame.

    Parameters
    ----------
    points : ndarray of shape (n_frames, 2)
        Positions.
    keys : ndarray of shape (n_keyframes,)
        Which of them are keyframes; there may be none.
    crosses, closed, gap
        As :func:`trajectory_panels` takes them.

    Returns
    -------
    list of plotly.graph_objects.Scatter
        Their colours are those of the figure's ``coloraxis``.
    """
    times = np.linspace(0.0, 1.0, len(points))
    dots = np.setdiff1d(np.arange(len(points)), keys)
    traces = [_path(points, gap)]
    if closed:
        ends = points[[-1, 0]]
        line = {"color": _PATH, "width": 1.5, "dash": "dot"}
        traces.append(_silent(x=ends[:, 0], y=ends[:, 1], mode="lines", line=line))
    traces.append(_frames(points, times, dots, {"size": 4.5}, "frame"))
    marker = {**CROSS} if crosses else {**_KEY}
    traces.append(_frames(points, times, keys, marker, "keyframe"))
    for place, marker in ((0, _START), (-1, _END)):
        traces.append(
            _silent(x=points[[place], 0], y=points[[place], 1], mode="markers", marker=marker)
        )
    return traces


def _path(points: NDArray[np.float64], gap: float | None) -> go.Scatter:
    """Join the frames by one thin line, broken where it would jump."""
    shown = points
    if gap is not None:
        extent = float(np.ptp(points, axis=0).max())
        steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
        shown = np.insert(points, np.flatnonzero(steps > gap * extent) + 1, np.nan, axis=0)
    line = {"color": _PATH, "width": 1}
    return _silent(x=shown[:, 0], y=shown[:, 1], mode="lines", line=line)


def _frames(
    points: NDArray[np.float64],
    times: NDArray[np.float64],
    chosen: NDArray[np.intp],
    marker: dict[str, Any],
    name: str,
) -> go.Scatter:
    return go.Scatter(
        x=points[chosen, 0],
        y=points[chosen, 1],
        mode="markers",
        marker={**marker, "color": times[chosen], "coloraxis": "coloraxis"},
        customdata=chosen,
        hovertemplate=f"{name} %{{customdata}}<extra></extra>",
        name=name,
        showlegend=False,
    )


def _silent(**settings: Any) -> go.Scatter:
    return go.Scatter(**settings, hoverinfo="skip", showlegend=False)


def add_key(figure: go.Figure, seconds: float | None, *, crosses: bool = False) -> go.Figure:
    """Put one bar of time and one legend of the marks below all panels.

    Parameters
    ----------
    figure : plotly.graph_objects.Figure
        Panels of curves; it is changed.
    seconds : float or None
        How long the motion lasts; None for a bar that tells only start and end.
    crosses : bool
        Whether keyframes are crosses.

    Returns
    -------
    plotly.graph_objects.Figure
        The same.
    """
    key = CROSS if crosses else {**_KEY, "color": "white"}
    for name, marker in (("keyframe", key), ("first frame", _START), ("last frame", _END)):
        figure.add_trace(go.Scatter(name=name, marker=marker, **LEGEND_ONLY))
    ticks = ["start", "", "end"]
    if seconds is not None:
        ticks = ["0 s", f"{seconds / 2:.1f} s", f"{seconds:.1f} s"]
    rows_height = figure.layout.height - 110
    scale = [[i / (len(TIME_COLORS) - 1), color] for i, color in enumerate(TIME_COLORS)]
    # The legend is below the bar, where it can break into lines on a narrow screen.
    return figure.update_layout(
        height=rows_height + 136,
        margin={"l": 12, "r": 12, "t": 36, "b": 100},
        legend={"yanchor": "top", "y": -66 / rows_height, "x": 0.5, "xanchor": "center"},
        coloraxis={
            "colorscale": scale,
            "cmin": 0.0,
            "cmax": 1.0,
            "colorbar": {
                "orientation": "h",
                "thickness": 11,
                "len": 0.7,
                "x": 0.5,
                "xanchor": "center",
                "y": -8 / rows_height,
                "yanchor": "top",
                "ypad": 0,
                "tickvals": [0.0, 0.5, 1.0],
                "ticktext": ticks,
                "title": {"text": "time", "side": "top", "font": {"size": 12}},
                "outlinewidth": 0,
                "ticks": "",
            },
        },
    )
