"""Figures of what is behind the points of a plane: errors, and values that are rebuilt."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import plotly.graph_objects as go
from numpy.typing import NDArray
from plotly.subplots import make_subplots

from workbench.errors import WorkbenchError
from workbench.figures.style import GREY, TEMPLATE, VERMILLION
from workbench.optimization.landscape import ErrorLandscape, PlaneGrid
from workbench.optimization.trace import Trace
from workbench.teaching.figures import for_both_themes

_NONE = np.empty((0, 2))


def landscape_panels(
    landscapes: Mapping[str, ErrorLandscape],
    *,
    control_places: NDArray[np.float64] = _NONE,
    paths: Mapping[str, Trace] | None = None,
) -> go.Figure:
    """Draw error landscapes of one plane side by side, in one scale of colours.

    Parameters
    ----------
    landscapes : mapping of str to ErrorLandscape
        By what to call them.
    control_places : ndarray of shape (n_control_points, 2)
        Drawn as crosses.
    paths : mapping of str to Trace, optional
        Ways of an optimizer, by the landscape on which to draw them.

    Returns
    -------
    plotly.graph_objects.Figure

    Raises
    ------
    WorkbenchError
        If there is none.
    """
    values = {title: landscape.errors for title, landscape in landscapes.items()}
    grids = [landscape.grid for landscape in landscapes.values()]
    figure = _panels(grids, values, control_places, bar_title="error", colors="Viridis")
    for column, title in enumerate(landscapes, start=1):
        if paths and title in paths:
            for trace in _path(paths[title], first=column == 1):
                figure.add_trace(trace, row=1, col=column)
    return figure


def value_panels(
    grid: PlaneGrid,
    values: Mapping[str, NDArray[np.float64]],
    *,
    control_places: NDArray[np.float64],
    value_name: str,
) -> go.Figure:
    """Draw a value that is rebuilt at every place of a plane, side by side.

    Parameters
    ----------
    grid : PlaneGrid
        The places.
    values : mapping of str to ndarray of shape (n_rows · n_columns,)
        The value at each place, by what rebuilds it.
    control_places : ndarray of shape (n_control_points, 2)
        Drawn as crosses.
    value_name : str
        What the value is.

    Returns
    -------
    plotly.graph_objects.Figure

    Raises
    ------
    WorkbenchError
        If there is none.
    """
    shape = (len(grid.y), len(grid.x))
    reshaped = {title: np.asarray(value).reshape(shape) for title, value in values.items()}
    grids = [grid] * len(reshaped)
    return _panels(grids, reshaped, control_places, bar_title=value_name, colors="Cividis")


def _panels(
    grids: list[PlaneGrid],
    values: Mapping[str, NDArray[np.float64]],
    crosses: NDArray[np.float64],
    *,
    bar_title: str,
    colors: str,
) -> go.Figure:
    if not values:
        raise WorkbenchError("panels: got none, want at least one")
    figure = make_subplots(1, len(values), subplot_titles=list(values), horizontal_spacing=0.05)
    low = min(float(value.min()) for value in values.values())
    high = max(float(value.max()) for value in values.values())
    for column, (grid, value) in enumerate(zip(grids, values.values(), strict=True), start=1):
        figure.add_trace(
            go.Heatmap(
                x=grid.x,
                y=grid.y,
                z=np.round(value, 4),
                zmin=low,
                zmax=high,
                colorscale=colors,
                showscale=column == 1,
                colorbar={"title": {"text": bar_title}, "thickness": 14},
                hovertemplate="x %{x:.3f}<br>y %{y:.3f}<br>"
                f"{bar_title} %{{z:.3f}}<extra></extra>",
            ),
            row=1,
            col=column,
        )
        if len(crosses):
            figure.add_trace(
                go.Scatter(
                    x=crosses[:, 0],
                    y=crosses[:, 1],
                    mode="markers",
                    marker={"symbol": "x-thin", "size": 8, "line": {"width": 2, "color": "white"}},
                    name="control point",
                    showlegend=False,
                    hoverinfo="skip",
                ),
                row=1,
                col=column,
            )
        figure.update_yaxes(
            scaleanchor=f"x{column if column > 1 else ''}", constrain="domain", row=1, col=column
        )
    figure.update_xaxes(constrain="domain", showgrid=False)
    figure.update_yaxes(showgrid=False, showticklabels=False, col=2)
    height = {1: 480, 2: 440}.get(len(values), 340)
    legend = {"y": -0.12, "yanchor": "top"}
    figure.update_layout(template=TEMPLATE, height=height, margin={"t": 50}, legend=legend)
    return for_both_themes(figure)


def _path(trace: Trace, *, first: bool) -> list[go.Scatter]:
    """Draw the positions of a sample, its start as a ring and its end as a disc."""
    places = trace.positions
    probes = [tried.position for step in trace.steps for tried in step.tries]
    tried = np.array(probes).reshape(-1, 2)
    return [
        go.Scatter(
            x=tried[:, 0],
            y=tried[:, 1],
            mode="markers",
            marker={"size": 6, "color": "white", "line": {"width": 1, "color": GREY}},
            name="tried",
            legendgroup="tried",
            showlegend=first,
            hoverinfo="skip",
        ),
        go.Scatter(
            x=places[:, 0],
            y=places[:, 1],
            mode="lines+markers",
            line={"color": VERMILLION, "width": 2},
            marker={
                "size": [14] + [5] * max(0, len(places) - 2) + [14] * (len(places) > 1),
                "color": VERMILLION,
                "symbol": ["circle-open"] + ["circle"] * (len(places) - 1),
                "line": {
                    "width": [3] + [0] * max(0, len(places) - 2) + [2] * (len(places) > 1),
                    "color": "white",
                },
            },
            name="way of the sample, from the ring to the disc",
            legendgroup="way",
            showlegend=first,
            text=[f"error {error:.3f}" for error in trace.errors],
            hovertemplate="%{text}<extra></extra>",
        ),
    ]
