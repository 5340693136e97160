"""Figures of the quality of embeddings."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np

from workbench.dashboards.comparison.jobs import PanelResult
from workbench.dashboards.comparison.panels import LETTERS

if TYPE_CHECKING:
    import plotly.graph_objects as go

_DASHES = ("solid", "dash", "dot", "dashdot", "longdash", "longdashdot")
_SYMBOLS = ("circle", "square", "diamond", "triangle-up", "cross", "x")
_GRID = "rgba(128, 128, 128, 0.3)"
# One hue that grows denser: it is seen on a light and on a dark ground.
_DENSITY = [[0, "rgba(40, 130, 220, 0)"], [1e-6, "rgba(40, 130, 220, 0.12)"]]
_DENSITY += [[1, "rgba(40, 130, 220, 1)"]]
_COLUMNS = 3


def preservation_figure(titles: Sequence[str], results: Sequence[PanelResult | None]) -> go.Figure:
    """Draw neighbourhood preservation against k, one curve for each panel.

    A panel without a result has an empty curve, so that the others keep their colours.

    Parameters
    ----------
    titles : sequence of str
        What each panel shows.
    results : sequence of PanelResult or None
        As many.

    Returns
    -------
    plotly Figure
        Without colours; :class:`workbench.widgets.FigureView` gives them.
    """
    import plotly.graph_objects as go

    figure = go.Figure(layout={"template": "none"})
    for index, (title, result) in enumerate(zip(titles, results, strict=True)):
        figure.add_scatter(
            name=LETTERS[index],
            x=[] if result is None else result.k.tolist(),
            y=[] if result is None else result.preservation.tolist(),
            mode="lines+markers",
            line={"dash": _DASHES[index]},
            marker={"symbol": _SYMBOLS[index], "size": 6},
            hovertemplate=f"{escape(title)}<br>k = %{{x}}: %{{y:.3f}}<extra></extra>",
            showlegend=result is not None,
        )
    figure.update_layout(
        xaxis={"title": {"text": "k, number of neighbours"}, "rangemode": "tozero"},
        yaxis={"title": {"text": "preserved share"}, "range": [0, 1.02]},
        title=_title("Neighbourhood preservation against k"),
        font={"size": 12},
        height=300,
        margin={"l": 55, "r": 10, "t": 40, "b": 45},
        legend={"orientation": "h", "y": 0.02, "yanchor": "bottom", "x": 1, "xanchor": "right"},
    )
    return figure


def shepard_figure(titles: Sequence[str], results: Sequence[PanelResult | None]) -> go.Figure:
    """Draw a Shepard diagram of each panel: how many pairs have which two distances.

    Parameters
    ----------
    titles : sequence of str
        What each panel shows.
    results : sequence of PanelResult or None
        As many.

    Returns
    -------
    plotly Figure
        Lines first, in the colours of :class:`workbench.widgets.FigureView`, then densities.
    """
    import plotly.graph_objects as go

    figure = go.Figure(layout={"template": "none"})
    shown = list(zip(titles, results, strict=True))
    # Four look best as two and two.
    columns = 2 if len(shown) == 4 else min(_COLUMNS, max(1, len(shown)))
    rows = -(-len(shown) // columns)
    for index, (title, result) in enumerate(shown):
        axes = _axes(index)
        figure.add_scatter(
            name=LETTERS[index],
            x=[] if result is None else result.shepard.line_data.tolist(),
            y=[] if result is None else result.shepard.line_embedding.tolist(),
            mode="lines",
            line={"width": 2},
            hovertemplate=f"{escape(title)}<br>best line that never falls<extra></extra>",
            showlegend=False,
            **axes,
        )
    for index, (_, result) in enumerate(shown):
        if result is not None:
            figure.add_heatmap(**_density(result), **_axes(index))
        row, column = divmod(index, columns)
        _place(figure, (index, len(shown)), (row, rows), (column, columns), result)
    figure.update_layout(
        title=_title("Shepard diagram; ρ: rank correlation of the distances"),
        font={"size": 12},
        height=90 + 215 * rows,
        margin={"l": 45, "r": 10, "t": 60, "b": 40},
    )
    return figure


def _density(result: PanelResult) -> dict[str, Any]:
    diagram = result.shepard
    counts = diagram.counts.T
    return {
        "x": _middles(diagram.data_edges),
        "y": _middles(diagram.embedding_edges),
        # Few pairs are still seen beside many.
        "z": np.sqrt(counts).round(2).tolist(),
        "text": counts.tolist(),
        "colorscale": _DENSITY,
        "showscale": False,
        "hovertemplate": "data %{x:.3g}, plane %{y:.3g}<br>%{text} pairs<extra></extra>",
    }


def _place(
    figure: go.Figure,
    panel: tuple[int, int],
    row: tuple[int, int],
    column: tuple[int, int],
    result: PanelResult | None,
) -> None:
    """Give a panel's diagram its place in the grid, and its heading."""
    index, n_panels = panel
    left, right = _span(*column, gap=0.07)
    low, high = _span(row[1] - 1 - row[0], row[1], gap=0.24 if row[1] > 1 else 0.0)
    number = "" if index == 0 else str(index + 1)
    common = {"gridcolor": _GRID, "zerolinecolor": _GRID, "linecolor": _GRID, "nticks": 4}
    lowest = index + column[1] >= n_panels
    figure.update_layout(
        {
            f"xaxis{number}": {
                **common,
                "domain": [left, right],
                "anchor": f"y{number}",
                "title": {"text": "distance in data" if lowest else "", "standoff": 4},
            },
            f"yaxis{number}": {
                **common,
                "domain": [low, high],
                "anchor": f"x{number}",
                "title": {"text": "in plane" if column[0] == 0 else "", "standoff": 4},
            },
        }
    )
    words = LETTERS[index]
    if result is not None and np.isfinite(result.shepard.correlation):
        words += f": ρ = {result.shepard.correlation:.2f}"
    figure.add_annotation(
        text=words,
        x=left,
        y=high,
        xref="paper",
        yref="paper",
        xanchor="left",
        yanchor="bottom",
        showarrow=False,
    )


def _span(index: int, count: int, gap: float) -> tuple[float, float]:
    size = (1 - gap * (count - 1)) / count
    start = index * (size + gap)
    return start, min(1.0, start + size)


def _axes(index: int) -> dict[str, str]:
    number = "" if index == 0 else str(index + 1)
    return {"xaxis": f"x{number}", "yaxis": f"y{number}"}


def _middles(edges: Any) -> list[float]:
    return [float(f"{value:.5g}") for value in (edges[:-1] + edges[1:]) / 2]


def _title(text: str) -> dict[str, Any]:
    return {"text": text, "font": {"size": 14}, "x": 0.02, "xanchor": "left"}
