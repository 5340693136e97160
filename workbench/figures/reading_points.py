"""Readings of a method as points: how many keyframes, and how good."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import plotly.graph_objects as go

from workbench.errors import WorkbenchError
from workbench.figures.style import BLACK, GREY, PALETTE, TEMPLATE

_SYMBOLS = ("circle", "diamond", "square")
#: Methods nearer to each other than this, in dB, share a label.
_ONE_PLACE = 0.6


def reading_points(
    groups: Mapping[str, Sequence[tuple[float, float, str]]],
    *,
    published: tuple[float, float] | None = None,
    default: tuple[float, float] | None = None,
    others: Mapping[str, tuple[float, float]] | None = None,
    tolerance: tuple[float, float] | None = None,
) -> go.Figure:
    """Draw each reading as a point, with the published values and other methods beside them.

    Parameters
    ----------
    groups : mapping of str to sequence of (float, float, str)
        For each group of readings, their keyframes, their PSNR in dB, and what they are.
    published, default : (float, float), optional
        The published values, and those of the reading that is taken.
    others : mapping of str to (float, float), optional
        Other methods, by name.
    tolerance : (float, float), optional
        How far from the published values is near, in keyframes and dB: a box.

    Returns
    -------
    plotly.graph_objects.Figure

    Raises
    ------
    WorkbenchError
        If there is no reading.
    """
    if not any(groups.values()):
        raise WorkbenchError("groups: got no reading to draw")
    figure = go.Figure(layout={"template": TEMPLATE, "height": 520})
    half = -(-len(groups) // 2)
    for index, (name, points) in enumerate(groups.items()):
        x, y, text = zip(*points, strict=True)
        figure.add_trace(
            go.Scatter(
                name=name,
                x=x,
                y=y,
                mode="markers",
                # One colour for each half of the groups, one symbol for each place in it.
                marker={
                    "color": PALETTE[index // half],
                    "symbol": _SYMBOLS[index % half % len(_SYMBOLS)],
                    "size": 9,
                    "opacity": 0.65,
                },
                text=text,
                hovertemplate="%{x} keyframes, %{y:.1f} dB<br>%{text}<extra>" + name + "</extra>",
            )
        )
    for name, (count, ratio) in _labels(others or {}).items():
        figure.add_annotation(
            x=count,
            y=ratio,
            text=name,
            showarrow=False,
            xanchor="left",
            xshift=8,
            font={"size": 12, "color": GREY},
            bgcolor="rgba(255,255,255,0.85)",
        )
    for name, place in (others or {}).items():
        figure.add_trace(_mark(name, *place, "x-thin", GREY, 9, in_legend=False))
    if default is not None:
        figure.add_trace(_mark("default here", *default, "circle-open", BLACK, 17))
    if published is not None:
        figure.add_trace(_mark("published", *published, "star-open", BLACK, 15))
        if tolerance is not None:
            (count, ratio), (wide, high) = published, tolerance
            figure.add_shape(
                type="rect",
                x0=count - wide,
                x1=count + wide,
                y0=ratio - high,
                y1=ratio + high,
                line={"color": BLACK, "width": 1, "dash": "dot"},
            )
    figure.update_xaxes(title_text="number of keyframes")
    figure.update_yaxes(title_text="PSNR in dB")
    return figure


def _labels(places: Mapping[str, tuple[float, float]]) -> dict[str, tuple[float, float]]:
    """Put the names of methods that lie nearly in one place into one label."""
    labels: list[tuple[list[str], tuple[float, float]]] = []
    for name, (count, ratio) in places.items():
        for names, place in labels:
            if place[0] == count and abs(place[1] - ratio) < _ONE_PLACE:
                names.append(name)
                break
        else:
            labels.append(([name], (count, ratio)))
    return {", ".join(names): place for names, place in labels}


def _mark(
    name: str,
    count: float,
    ratio: float,
    symbol: str,
    color: str,
    size: int,
    *,
    in_legend: bool = True,
) -> go.Scatter:
    return go.Scatter(
        name=name,
        x=[count],
        y=[ratio],
        mode="markers",
        marker={
            "symbol": symbol,
            "color": color,
            "size": size,
            "line": {"width": 2, "color": color},
        },
        showlegend=in_legend,
        hovertemplate="%{x} keyframes, %{y:.2f} dB<extra>" + name + "</extra>",
    )
