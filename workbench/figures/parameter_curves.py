"""Errors against a parameter, many motions at once, as in Halit 2010, Figure 4.1."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import pandas as pd
import plotly.graph_objects as go
from plotly.subplots import make_subplots

from workbench.errors import WorkbenchError
from workbench.figures.style import BLACK, BLUE, TEMPLATE, VERMILLION

#: Lines of single motions: light, since it is their spread that counts.
_FAINT = "#C3CBD3"
_PANEL_HEIGHT, _AROUND = 270, 140


@dataclass(frozen=True, eq=False)
class ParameterPanel:
    """One chart.

    Attributes
    ----------
    title : str
        Shown above.
    x_title : str
        The parameter.
    curves : DataFrame of shape (n_motions, n_values)
        A value for each motion, by the parameter's.
    band : (float, float), optional
        The part of the parameter's range that is recommended.
    shown : str
        The motion that has a line of its own; empty for none.
    """

    title: str
    x_title: str
    curves: pd.DataFrame
    band: tuple[float, float] | None = None
    shown: str = ""


def parameter_curves(
    panels: Sequence[ParameterPanel], *, y_title: str, names: Mapping[str, str] | None = None
) -> go.Figure:
    """Draw, for each panel, the motions as faint lines, their median, and one of them.

    Parameters
    ----------
    panels : sequence of ParameterPanel
        The charts, two in a row, each with a y-axis of its own that starts at 0.
    y_title : str
        What the values are.
    names : mapping of str to str, optional
        What to call the motions in tooltips.

    Returns
    -------
    plotly.graph_objects.Figure

    Raises
    ------
    WorkbenchError
        If there is no panel.
    """
    if not panels:
        raise WorkbenchError("panels: got none, want at least one")
    n_rows = -(-len(panels) // 2)
    height = _AROUND + _PANEL_HEIGHT * n_rows
    figure = make_subplots(
        rows=n_rows,
        cols=min(2, len(panels)),
        subplot_titles=[panel.title for panel in panels],
        horizontal_spacing=0.11,
        vertical_spacing=92 / (height - _AROUND) if n_rows > 1 else 0.0,
    )
    labels = names or {}
    in_legend: set[str] = set()
    for index, panel in enumerate(panels):
        place = {"row": index // 2 + 1, "col": index % 2 + 1}
        if panel.band is not None:
            shade = {"fillcolor": "#E4F1EA", "line_width": 0, "layer": "below"}
            figure.add_vrect(*panel.band, **shade, **place, exclude_empty_subplots=False)
        for motion, row in panel.curves.iterrows():
            if motion != panel.shown:
                name = labels.get(str(motion), str(motion))
                figure.add_trace(_line(row, "each motion", name, _FAINT, 1.0, in_legend), **place)
        if panel.shown in panel.curves.index:
            name = labels.get(panel.shown, panel.shown)
            row = panel.curves.T[panel.shown]
            trace = _line(row, "example", name, VERMILLION, 2.0, in_legend, "square")
            figure.add_trace(trace, **place)
        median = panel.curves.median()
        figure.add_trace(_line(median, "median", "median", BLUE, 2.6, in_legend, "circle"), **place)
        figure.update_xaxes(title_text=panel.x_title, **place)
    figure.update_annotations(font={"size": 13, "color": BLACK})
    figure.update_xaxes(showgrid=False, zeroline=False, dtick=2)
    figure.update_yaxes(rangemode="tozero", nticks=6)
    figure.update_yaxes(title_text=y_title, col=1)
    legend = {"y": 1 + 34 / (height - _AROUND), "itemwidth": 40}
    return figure.update_layout(
        template=TEMPLATE, height=height, legend=legend, margin={"t": 84, "b": 56}
    )


def _line(
    row: pd.Series,
    name: str,
    motion: str,
    color: str,
    width: float,
    in_legend: set[str],
    symbol: str = "",
) -> go.Scatter:
    first = name not in in_legend
    in_legend.add(name)
    return go.Scatter(
        name=name,
        x=list(row.index),
        y=list(row),
        mode="lines+markers" if symbol else "lines",
        line={"color": color, "width": width},
        marker={"symbol": symbol or "circle", "size": 6},
        legendgroup=name,
        showlegend=first,
        hovertemplate="%{x:g}: %{y:.2f}<extra>" + motion + "</extra>",
    )
