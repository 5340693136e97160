"""Estimates with their intervals, as dots on lines, in panels that share an axis."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

import plotly.graph_objects as go
from plotly.subplots import make_subplots

from workbench.errors import WorkbenchError
from workbench.figures.style import BLACK, PALETTE, SYMBOLS, TEMPLATE

#: Pixels of a row with one series, and of each further one; of a panel's title, of a line of the
#: legend, which stand below each other on a phone, and below all panels.
_ROW, _SERIES, _TITLE, _LEGEND, _BELOW = 20, 9, 44, 26, 56
#: How far apart the series of one row lie, in rows.
_STEP = 0.3
_MINOR = "#F1F3F5"


class Interval(Protocol):
    """What is drawn, such as an estimate by the bootstrap."""

    @property
    def value(self) -> float:
        """The estimate."""

    @property
    def low(self) -> float:
        """The lower end of its interval."""

    @property
    def high(self) -> float:
        """The upper end."""

    @property
    def n_units(self) -> int:
        """How many clips, tables or the like it rests on."""


Panel = Mapping[str, Mapping[str, Interval]]


def interval_plot(
    panels: Mapping[str, Panel],
    *,
    x_title: str,
    reference: float | None = None,
    logarithmic: bool = False,
) -> go.Figure:
    """Draw estimates as dots and their intervals as lines, in panels below each other.

    Panels have their own rows and one axis, so that estimates are compared along a line.
    Series of the same row lie below each other; where each row has one series only, series
    are groups of rows.

    Parameters
    ----------
    panels : mapping of str to mapping of str to mapping of str to Interval
        By panel, series and row. Series keep their colour and symbol in all panels.
    x_title : str
        What is estimated.
    reference : float, optional
        A value that all are compared with, which gets a line.
    logarithmic : bool
        Whether equal factors are equally far apart.

    Returns
    -------
    plotly.graph_objects.Figure

    Raises
    ------
    WorkbenchError
        If there is no estimate.
    """
    rows = {
        title: list(dict.fromkeys(name for series in panel.values() for name in series))
        for title, panel in panels.items()
    }
    rows = {title: names for title, names in rows.items() if names}
    if not rows:
        raise WorkbenchError("panels: got no estimate to draw")
    series = list(dict.fromkeys(name for title in rows for name in panels[title]))
    most = max(
        sum(row in found for found in panels[title].values())
        for title in rows
        for row in rows[title]
    )
    row_height = _ROW + _SERIES * (most - 1)
    heights = [row_height * len(names) for names in rows.values()]
    total = sum(heights) + _TITLE * (len(rows) - 1)
    figure = make_subplots(
        rows=len(rows),
        shared_xaxes=True,
        subplot_titles=[f"<b>{title}</b>" for title in rows],
        row_heights=[float(height) for height in heights],
        vertical_spacing=_TITLE / total if len(rows) > 1 else 0.0,
    )
    # A title stands over its rows from the left, where the names of the rows are.
    figure.update_annotations(x=0, xanchor="left", font_size=13)
    for number, (title, names) in enumerate(rows.items(), 1):
        for index, name in enumerate(series):
            found = panels[title].get(name, {})
            if found:
                trace = _dots(name, found, _heights(panels[title], name, names), index)
                trace.showlegend = len(series) > 1 and not any(
                    other.name == name for other in figure.data
                )
                figure.add_trace(trace, row=number, col=1)
        figure.update_yaxes(
            tickvals=list(range(len(names))),
            ticktext=names,
            range=[len(names) - 0.5, -0.5],
            showgrid=False,
            zeroline=False,
            ticks="",
            row=number,
            col=1,
        )
        if reference is not None:
            figure.add_vline(
                reference, line={"color": BLACK, "width": 1, "dash": "dot"}, row=number, col=1
            )
    figure.update_xaxes(zeroline=False, tickformat="~g", tickangle=0)
    if logarithmic:
        figure.update_xaxes(type="log", dtick="D2", minor={"showgrid": True, "gridcolor": _MINOR})
    figure.update_xaxes(title_text=x_title, title_font_size=13, row=len(rows), col=1)
    above = _TITLE + (_LEGEND * len(series) if len(series) > 1 else 0)
    return figure.update_layout(
        template=TEMPLATE,
        height=total + above + _BELOW,
        margin={"t": above, "b": _BELOW},
        legend={"y": 1.0, "yref": "container", "yanchor": "top", "x": 0, "xref": "container"},
    )


def _heights(panel: Panel, series: str, names: list[str]) -> list[float]:
    """Place the estimates of a series, around the middle of their rows if it is not alone."""
    heights = []
    for row in panel[series]:
        present = [name for name, found in panel.items() if row in found]
        shift = _STEP * (present.index(series) - (len(present) - 1) / 2)
        heights.append(names.index(row) + shift)
    return heights


def _dots(name: str, found: Mapping[str, Interval], heights: list[float], index: int) -> go.Scatter:
    color = PALETTE[index % len(PALETTE)]
    estimates = list(found.values())
    return go.Scatter(
        name=name,
        x=[estimate.value for estimate in estimates],
        y=heights,
        mode="markers",
        marker={
            "symbol": SYMBOLS[index % len(SYMBOLS)],
            "size": 9,
            "color": color,
            "line": {"color": "white", "width": 1},
        },
        error_x={
            "type": "data",
            "symmetric": False,
            "array": [estimate.high - estimate.value for estimate in estimates],
            "arrayminus": [estimate.value - estimate.low for estimate in estimates],
            "color": color,
            "thickness": 2,
            "width": 0,
        },
        legendgroup=name,
        customdata=[
            (row, estimate.low, estimate.high, estimate.n_units) for row, estimate in found.items()
        ],
        hovertemplate=(
            "%{customdata[0]}: %{x:.3f} (%{customdata[1]:.3f} to %{customdata[2]:.3f}, "
            "n = %{customdata[3]})<extra>" + name + "</extra>"
        ),
    )
