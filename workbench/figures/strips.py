"""One dot for each clip, method by method: differences and ratios that belong in pairs."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import plotly.graph_objects as go

from workbench.errors import WorkbenchError
from workbench.figures.style import BLACK, BLUE, TEMPLATE, VERMILLION

_ROW_HEIGHT, _AROUND = 62, 130
#: How far dots of one row are moved apart, in rows.
_SPREAD = 0.24
_RATIO_TICKS = (0.1, 0.2, 0.3, 0.5, 0.7, 1, 1.2, 1.5, 2, 3, 4, 5, 7, 10)


def strip_plot(
    groups: Mapping[str, Mapping[str, float]],
    *,
    x_title: str,
    reference: float,
    medians: Mapping[str, tuple[float, float, float]],
    sides: tuple[str, str] = ("", ""),
    marked: str = "",
    logarithmic: bool = False,
) -> go.Figure:
    """Draw a row of dots for each method, one for each clip, and their median.

    Parameters
    ----------
    groups : mapping of str to mapping of str to float
        For each method its value on each clip.
    x_title : str
        What the values are.
    reference : float
        Where a method equals the one that all are compared with: a line.
    medians : mapping of str to (float, float, float)
        For each method the median and the ends of its interval.
    sides : (str, str)
        What it means to lie left and right of the reference.
    marked : str
        A clip whose dots look different; empty for none.
    logarithmic : bool
        Whether equal ratios are equally far apart; all values are then above 0.

    Returns
    -------
    plotly.graph_objects.Figure

    Raises
    ------
    WorkbenchError
        If there is no value.
    """
    names = [name for name, values in groups.items() if values]
    if not names:
        raise WorkbenchError("groups: got no values to draw")
    figure = go.Figure(layout={"template": TEMPLATE, "height": _AROUND + _ROW_HEIGHT * len(names)})
    places = {name: len(names) - 1 - index for index, name in enumerate(names)}
    for special in (False, True):
        dots = [
            (value, places[name] + shift, f"{name}, {clip}")
            for name in names
            for (clip, value), shift in zip(
                groups[name].items(), _shifts(len(groups[name])), strict=True
            )
            if (clip == marked) == special
        ]
        if dots:
            figure.add_trace(_dots(dots, marked if special else "one clip", special))
    shown = [name for name in names if name in medians]
    values = np.array([medians[name] for name in shown])
    if len(values):
        figure.add_trace(
            go.Scatter(
                name="median, 95 % interval",
                x=values[:, 0],
                y=[places[name] for name in shown],
                mode="markers",
                marker={"symbol": "diamond", "size": 11, "color": BLACK},
                error_x={
                    "array": values[:, 2] - values[:, 0],
                    "arrayminus": values[:, 0] - values[:, 1],
                    "thickness": 2,
                    "width": 6,
                    "color": BLACK,
                },
                text=shown,
                hovertemplate="%{text}: %{x:.3f}<extra>median</extra>",
            )
        )
    figure.add_vline(reference, line={"color": BLACK, "width": 1, "dash": "dot"})
    for text, anchor, shift in zip(sides, ("right", "left"), (-8, 8), strict=True):
        if text:
            figure.add_annotation(
                # Annotations on a logarithmic axis are placed by the logarithm; lines are not.
                x=np.log10(reference) if logarithmic else reference,
                y=len(names) - 0.42,
                text=text,
                showarrow=False,
                xanchor=anchor,
                xshift=shift,
                font={"size": 11},
            )
    figure.update_xaxes(title_text=x_title)
    if logarithmic:
        figure.update_xaxes(type="log", tickvals=_RATIO_TICKS, ticktext=_RATIO_TICKS)
    figure.update_yaxes(
        tickvals=list(places.values()),
        ticktext=list(places),
        range=[-0.55, len(names) - 0.25],
        showgrid=False,
        zeroline=False,
        ticks="",
    )
    return figure


def _dots(dots: list[tuple[float, float, str]], name: str, special: bool) -> go.Scatter:
    x, y, text = zip(*dots, strict=True)
    return go.Scatter(
        name=name,
        x=x,
        y=y,
        mode="markers",
        marker={
            "symbol": "square" if special else "circle",
            "size": 9 if special else 7,
            "color": VERMILLION if special else BLUE,
            "opacity": 1.0 if special else 0.5,
        },
        text=text,
        hovertemplate="%{text}: %{x:.3f}<extra></extra>",
    )


def _shifts(n: int) -> list[float]:
    """Spread dots evenly over a row's height, neighbours in the list far apart."""
    golden = (np.arange(n) * 0.6180339887498949) % 1.0
    return list(_SPREAD * (2.0 * golden - 1.0))
