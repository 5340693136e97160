"""Figures of lessons, from finished numbers, for pages in the light and in the dark theme.

A notebook shows a figure as it was made, whatever the theme of the page. So these have no
ground of their own, and their texts and lines are of a grey that shows on white and on black.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import plotly.graph_objects as go
from numpy.typing import NDArray
from plotly.subplots import make_subplots

from workbench.errors import WorkbenchError
from workbench.figures.embeddings import Panel, embedding_panels
from workbench.figures.lines import LinePanel, line_panels
from workbench.figures.style import TEMPLATE, VERMILLION
from workbench.quality.shepard_diagram import ShepardDiagram
from workbench.spaces import Space

#: Contrast of about 4 : 1 to the grounds of both themes.
_TEXT = "#75797F"
_GRID = "rgba(128, 128, 128, 0.25)"
_CLEAR = "rgba(0, 0, 0, 0)"

#: More pairs, more colour, on any ground.
_PAIRS = [[0.0, "rgba(0, 114, 178, 0.12)"], [1.0, "rgba(0, 114, 178, 1)"]]

_NONE = np.empty(0, dtype=np.intp)


def for_both_themes(figure: go.Figure) -> go.Figure:
    """Let a figure show on the ground of the page, be it light or dark.

    Parameters
    ----------
    figure : plotly.graph_objects.Figure
        A figure in the package's style; it is changed.

    Returns
    -------
    plotly.graph_objects.Figure
        The same.

    Examples
    --------
    >>> for_both_themes(go.Figure()).layout.paper_bgcolor
    'rgba(0, 0, 0, 0)'
    """
    figure.update_layout(paper_bgcolor=_CLEAR, plot_bgcolor=_CLEAR, font_color=_TEXT)
    figure.update_annotations(font_color=_TEXT)
    # Dots that are seen through are pale on white and dim on black.
    figure.update_traces(marker_opacity=1.0, selector=_is_dotted)
    # A black outline is lost on black; a grey one needs more room to be seen on white.
    cross = {"size": 11, "line": {"color": _TEXT, "width": 1.5}}
    figure.update_traces(marker=cross, selector={"marker.symbol": "x"})
    axes = {"gridcolor": _GRID, "zerolinecolor": _GRID}
    return figure.update_xaxes(axes).update_yaxes(axes)


def _is_dotted(trace: Any) -> bool:
    return trace.type in ("scatter", "scattergl") and "markers" in (trace.mode or "")


def maps_side_by_side(
    space: Space,
    maps: Mapping[str, NDArray[np.float64]],
    *,
    control_points: NDArray[np.intp] = _NONE,
) -> go.Figure:
    """Draw maps of the same samples side by side, in the colours of their classes.

    Parameters
    ----------
    space : Space
        The samples, for their classes.
    maps : mapping of str to ndarray of shape (n_samples, 2)
        Positions, by what to call the map.
    control_points : ndarray of shape (n_control_points,)
        Indices of the samples that are drawn as crosses.

    Returns
    -------
    plotly.graph_objects.Figure
    """
    figure = embedding_panels(
        [Panel(title, points, control_points) for title, points in maps.items()],
        labels=space.labels,
        n_columns=min(3, len(maps)),
    )
    if not len(control_points):
        # The legend would explain crosses that are not there.
        figure.for_each_trace(
            lambda trace: trace.update(showlegend=False), {"name": "control point"}
        )
    return for_both_themes(figure)


def curves(
    lines: Mapping[str, Mapping[float, float]],
    *,
    x_title: str,
    y_title: str,
    logarithmic: bool = False,
) -> go.Figure:
    """Draw curves in one chart.

    Parameters
    ----------
    lines : mapping of str to mapping of float to float
        For each curve its values: y by x.
    x_title, y_title : str
        What the values are.
    logarithmic : bool
        Whether both axes are.

    Returns
    -------
    plotly.graph_objects.Figure
    """
    figure = line_panels([LinePanel("", lines)], x_title=x_title, y_title=y_title)
    # Without the room for a chart's title.
    figure.update_layout(height=400, margin={"t": 48}, legend={"y": 1.02})
    if logarithmic:
        figure.update_xaxes(type="log", dtick=1)
        figure.update_yaxes(type="log", dtick=1, rangemode="normal")
    return for_both_themes(figure)


def shepard_panels(diagrams: Mapping[str, ShepardDiagram]) -> go.Figure:
    """Draw Shepard diagrams side by side, darker where there are more pairs.

    Parameters
    ----------
    diagrams : mapping of str to ShepardDiagram
        The diagrams, by what to call the map.

    Returns
    -------
    plotly.graph_objects.Figure

    Raises
    ------
    WorkbenchError
        If there is none.
    """
    if not diagrams:
        raise WorkbenchError("diagrams: got none, want at least one")
    figure = make_subplots(
        rows=1,
        cols=len(diagrams),
        subplot_titles=[
            f"{title}, rank correlation {diagram.correlation:.2f}"
            for title, diagram in diagrams.items()
        ],
        horizontal_spacing=0.12,
    )
    for column, diagram in enumerate(diagrams.values(), start=1):
        figure.add_trace(
            go.Heatmap(
                x=diagram.data_edges,
                y=diagram.embedding_edges,
                z=np.where(diagram.counts == 0, np.nan, diagram.counts).T,
                colorscale=_PAIRS,
                showscale=False,
                hovertemplate="in the data %{x:.2f}<br>on the map %{y:.2f}<br>"
                "%{z} pairs<extra></extra>",
            ),
            row=1,
            col=column,
        )
        figure.add_trace(
            go.Scatter(
                x=diagram.line_data,
                y=diagram.line_embedding,
                mode="lines",
                line={"color": VERMILLION, "width": 2},
                name="best line that never falls",
                showlegend=column == 1,
                hoverinfo="skip",
            ),
            row=1,
            col=column,
        )
    figure.update_xaxes(title_text="distance in the data")
    figure.update_yaxes(title_text="distance on the map", col=1)
    figure.update_annotations(font_size=13)
    figure.update_layout(template=TEMPLATE, height=420, margin={"t": 84}, legend={"y": 1.12})
    return for_both_themes(figure)
