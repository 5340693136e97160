"""Tables of ratios as colours: what fell, what rose and by how much, at a glance."""

from __future__ import annotations

import html
from collections.abc import Mapping

import numpy as np
import pandas as pd
import plotly.graph_objects as go
from plotly.subplots import make_subplots

from workbench.errors import WorkbenchError
from workbench.figures.style import BLACK, TEMPLATE

#: From falling to rising; the ends are light enough for black numbers on them.
_SCALE = ((0.0, "#4F9BD0"), (0.5, "#FFFFFF"), (1.0, "#EE8A4A"))
#: Ratios beyond this one or its inverse have the colour of an end.
_FULL = 4.0
_ROW_HEIGHT = 30


def ratio_tables(tables: Mapping[str, pd.DataFrame], *, title: str) -> go.Figure:
    """Draw tables of ratios below each other, a colour and a number in each cell.

    Blue is below 1 and orange above it; equal factors up and down are equally strong.

    Parameters
    ----------
    tables : mapping of str to DataFrame
        For each table what to write above it, and its ratios; missing ones are left blank.
        All have the same columns.
    title : str
        What the ratios are, beside the scale of colours.

    Returns
    -------
    plotly.graph_objects.Figure

    Raises
    ------
    WorkbenchError
        If there is no table, or a ratio is not positive.
    """
    if not tables or all(table.empty for table in tables.values()):
        raise WorkbenchError("tables: got none, want at least one ratio to draw")
    heights = [len(table) for table in tables.values()]
    total = 64 * len(tables) + _ROW_HEIGHT * sum(heights)
    figure = make_subplots(
        rows=len(tables),
        cols=1,
        row_heights=heights,
        vertical_spacing=58 / total if len(tables) > 1 else 0.0,
        subplot_titles=[html.escape(name, quote=False) for name in tables],
    )
    for row, (name, table) in enumerate(tables.items(), 1):
        values = table.to_numpy(dtype=float)
        if (values <= 0).any():
            raise WorkbenchError(f"table {name!r}: got a ratio that is not positive")
        figure.add_trace(
            go.Heatmap(
                x=list(table.columns),
                y=list(table.index),
                z=np.log2(values),
                text=[[_number(value) for value in line] for line in values],
                texttemplate="%{text}",
                textfont={"color": BLACK, "size": 12},
                hovertemplate="%{y}, %{x}: %{text}<extra></extra>",
                hoverongaps=False,
                xgap=2,
                ygap=2,
                coloraxis="coloraxis",
            ),
            row=row,
            col=1,
        )
    figure.update_xaxes(showgrid=False, ticks="", showline=False, tickangle=0, fixedrange=True)
    figure.update_yaxes(
        showgrid=False, ticks="", showline=False, autorange="reversed", fixedrange=True
    )
    figure.update_annotations(font_size=13, x=0, xanchor="left", xshift=-8)
    steps = [1 / _FULL, 1 / 2, 1.0, 2.0, _FULL]
    return figure.update_layout(
        template=TEMPLATE,
        height=total + 96,
        margin={"l": 12, "r": 12, "t": 44, "b": 72},
        coloraxis={
            "colorscale": _SCALE,
            "cmin": -np.log2(_FULL),
            "cmax": np.log2(_FULL),
            "colorbar": {
                "orientation": "h",
                "thickness": 10,
                "len": 0.9,
                "yref": "container",
                "y": 0.01,
                "yanchor": "bottom",
                "title": {"text": title, "side": "top", "font": {"size": 12}},
                "tickvals": np.log2(steps).tolist(),
                "ticktext": ["¼", "½", "1", "2", "4"],
                "outlinewidth": 0,
            },
        },
    )


def _number(value: float) -> str:
    """Write a ratio with as many digits as a cell holds."""
    if np.isnan(value):
        return ""
    return f"{value:.2f}" if 0.01 <= value < 100 else f"{value:.1g}"
