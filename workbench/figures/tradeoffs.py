"""Curves of one quantity against another that it has to be paid with."""

from __future__ import annotations

import html
from collections.abc import Sequence
from dataclasses import dataclass

import plotly.graph_objects as go

from workbench.errors import WorkbenchError
from workbench.figures.style import BLACK, PALETTE, TEMPLATE

_SYMBOLS = ("circle", "square", "diamond", "triangle-up", "triangle-down", "x", "star")
_DASHES = ("solid", "solid", "dash", "dash", "dot", "dot", "dashdot")


@dataclass(frozen=True)
class Curve:
    """One curve.

    Attributes
    ----------
    name : str
        What to call it in the legend.
    x, y : sequence of float
        Its points, from left to right.
    text : sequence of str, optional
        What is said of each point when it is pointed at.
    labels : sequence of str, optional
        What is written beside each point.
    low, high : sequence of float, optional
        Ends of an interval at each point, drawn as a band.
    """

    name: str
    x: Sequence[float]
    y: Sequence[float]
    text: Sequence[str] = ()
    labels: Sequence[str] = ()
    low: Sequence[float] = ()
    high: Sequence[float] = ()


def trade_off(
    curves: Sequence[Curve],
    *,
    x_title: str,
    y_title: str,
    log_x: bool = False,
    log_y: bool = False,
    x_ticks: Sequence[float] | None = None,
    y_ticks: Sequence[float] | None = None,
    reference: float | None = None,
) -> go.Figure:
    """Draw curves that can be told apart by colour, by marker and by dashes.

    Parameters
    ----------
    curves : sequence of Curve
        At least one, in the order of the legend.
    x_title, y_title : str
        What the axes show.
    log_x, log_y : bool
        Whether an axis is logarithmic.
    x_ticks, y_ticks : sequence of float, optional
        Where an axis has numbers.
    reference : float, optional
        A height that all are compared with, drawn as a line.

    Returns
    -------
    plotly.graph_objects.Figure

    Raises
    ------
    WorkbenchError
        If there is no point.
    """
    if not any(len(curve.x) for curve in curves):
        raise WorkbenchError("curves: got no point to draw")
    figure = go.Figure(layout={"template": TEMPLATE, "height": 520})
    for index, curve in enumerate(curves):
        color = PALETTE[index % len(PALETTE)]
        name = html.escape(curve.name, quote=False)
        if len(curve.low):
            figure.add_trace(
                go.Scatter(
                    x=[*curve.x, *reversed(curve.x)],
                    y=[*curve.high, *reversed(curve.low)],
                    fill="toself",
                    fillcolor=color,
                    opacity=0.14,
                    line={"width": 0},
                    hoverinfo="skip",
                    showlegend=False,
                    legendgroup=name,
                )
            )
        figure.add_trace(
            go.Scatter(
                name=name,
                x=list(curve.x),
                y=list(curve.y),
                customdata=list(curve.text) or None,
                text=list(curve.labels) or None,
                # On either side in turn, so that those of curves that lie close do not meet.
                textposition=("bottom left", "top right")[index % 2],
                textfont={"color": color, "size": 11},
                mode="lines+markers+text" if len(curve.labels) else "lines+markers",
                legendgroup=name,
                line={"color": color, "width": 2, "dash": _DASHES[index % len(_DASHES)]},
                marker={"symbol": _SYMBOLS[index % len(_SYMBOLS)], "size": 9, "color": color},
                hovertemplate=f"{name}: %{{y:.3g}} at %{{x:.3g}}"
                + ("<br>%{customdata}" if len(curve.text) else "")
                + "<extra></extra>",
            )
        )
    if reference is not None:
        figure.add_hline(reference, line={"color": BLACK, "width": 1, "dash": "dot"})
    figure.update_xaxes(title_text=x_title, **_axis(log_x, x_ticks))
    figure.update_yaxes(title_text=y_title, **_axis(log_y, y_ticks))
    return figure.update_layout(legend={"itemwidth": 40})


def _axis(logarithmic: bool, ticks: Sequence[float] | None) -> dict[str, object]:
    axis: dict[str, object] = {"type": "log"} if logarithmic else {}
    if ticks is not None:
        axis |= {"tickvals": list(ticks), "ticktext": [f"{tick:g}" for tick in ticks]}
    return axis
