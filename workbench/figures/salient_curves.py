"""Curves of a motion with their salient frames, as in Halit 2010, Figures 3.3 and 3.4."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import plotly.graph_objects as go
from numpy.typing import ArrayLike, NDArray
from plotly.subplots import make_subplots

from workbench.figures.style import BLACK, BLUE, GREY, TEMPLATE, VERMILLION

#: From hardly salient to most salient; dark at the salient end, also in black and white.
_SCALE = ((0.0, "#D7E3EE"), (0.35, "#7FB2DB"), (0.7, "#2B6CA8"), (1.0, "#0B1F3A"))
_LIGHT = "#C9D1D9"


def saliency_figure(
    seconds: ArrayLike, curve: ArrayLike, saliency: ArrayLike, *, y_title: str
) -> go.Figure:
    """Draw a curve coloured by saliency, and the saliency below it.

    Parameters
    ----------
    seconds, curve, saliency : array-like of shape (n_frames,)
        Time, value and saliency of each frame; the saliency in units of its mean.
    y_title : str
        What the curve is.

    Returns
    -------
    plotly.graph_objects.Figure
    """
    times, values, weights = (np.asarray(part, dtype=float) for part in (seconds, curve, saliency))
    figure = _two_panels((0.56, 0.44))
    figure.add_trace(
        go.Scatter(
            x=times,
            y=values,
            mode="markers",
            marker={
                "color": weights,
                "colorscale": _SCALE,
                "size": 6,
                "colorbar": {
                    "title": {"text": "saliency / mean", "side": "right"},
                    "thickness": 10,
                    "len": 0.56,
                    "y": 1.0,
                    "yanchor": "top",
                    "outlinewidth": 0,
                },
            },
            customdata=weights,
            hovertemplate="%{x:.2f} s: %{y:.1f}, saliency %{customdata:.2f}<extra></extra>",
        ),
        row=1,
        col=1,
    )
    figure.add_trace(
        go.Scatter(
            x=times,
            y=weights,
            mode="lines",
            line={"color": BLUE, "width": 1.8},
            fill="tozeroy",
            fillcolor="rgba(0,114,178,0.15)",
            hovertemplate="%{x:.2f} s: %{y:.2f}<extra></extra>",
        ),
        row=2,
        col=1,
    )
    _mean_line(figure, row=2)
    figure.update_yaxes(title_text=y_title, row=1)
    figure.update_yaxes(title_text="saliency / mean", rangemode="tozero", row=2)
    return figure.update_layout(height=480, showlegend=False, margin={"t": 16})


def candidate_figure(
    seconds: ArrayLike, curve: ArrayLike, candidates: ArrayLike, *, y_title: str
) -> go.Figure:
    """Draw a curve with its candidate keyframes.

    Parameters
    ----------
    seconds, curve : array-like of shape (n_frames,)
        Time and value of each frame.
    candidates : array-like of bool, of shape (n_frames,)
        Which frames are candidates.
    y_title : str
        What the curve is.

    Returns
    -------
    plotly.graph_objects.Figure
    """
    times, values = np.asarray(seconds, dtype=float), np.asarray(curve, dtype=float)
    chosen = np.asarray(candidates, dtype=bool)
    figure = go.Figure(layout={"template": TEMPLATE, "height": 380})
    figure.add_trace(
        go.Scatter(
            name="not a candidate",
            x=times,
            y=values,
            mode="lines",
            line={"color": GREY, "width": 1.6},
            hovertemplate="%{x:.2f} s: %{y:.1f}<extra></extra>",
        )
    )
    figure.add_trace(
        go.Scatter(
            name="candidate keyframe: more salient than the mean",
            x=times[chosen],
            y=values[chosen],
            mode="markers",
            marker={
                "color": VERMILLION,
                "size": 8,
                "symbol": "circle",
                "line": {"color": "white", "width": 0.8},
            },
            hovertemplate="%{x:.2f} s: %{y:.1f}<extra>candidate</extra>",
        )
    )
    figure.update_xaxes(title_text="time in seconds", showgrid=False)
    figure.update_yaxes(title_text=y_title, zeroline=False)
    return figure


def candidate_rows(
    seconds: ArrayLike,
    candidates: ArrayLike,
    clusters: Sequence[tuple[int, int]] | NDArray[np.intp],
    keyframes: ArrayLike,
    *,
    names: Sequence[str],
) -> go.Figure:
    """Draw the candidates of all curves as rows, and below them what the clusters make of them.

    Parameters
    ----------
    seconds : array-like of shape (n_frames,)
        Time of each frame.
    candidates : array-like of bool, of shape (n_frames, n_curves)
        Candidates of each curve.
    clusters : sequence of (int, int)
        First and last frame of each cluster.
    keyframes : array-like of shape (n_keyframes,)
        The frames that stand for the clusters.
    names : sequence of str
        Names of the curves.

    Returns
    -------
    plotly.graph_objects.Figure
    """
    times = np.asarray(seconds, dtype=float)
    chosen = np.asarray(candidates, dtype=bool)
    keys = np.asarray(keyframes, dtype=int)
    step = float(times[1] - times[0])
    figure = go.Figure(layout={"template": TEMPLATE, "barmode": "overlay"})
    for row, name in enumerate(names):
        spans = _runs(chosen[:, row])
        figure.add_trace(_bars(times, spans, step, name, VERMILLION, "candidates", 0.55, row == 0))
    bars = [(int(first), int(last)) for first, last in clusters]
    figure.add_trace(_bars(times, bars, step, "clusters", _LIGHT, "clusters", 0.8, True))
    figure.add_trace(
        go.Scatter(
            name="keyframes",
            x=times[keys],
            y=["clusters"] * len(keys),
            mode="markers",
            marker={"symbol": "line-ns", "size": 16, "line": {"color": BLACK, "width": 2.4}},
            hovertemplate="%{x:.2f} s<extra>keyframe</extra>",
        )
    )
    figure.update_xaxes(title_text="time in seconds", range=[times[0], times[-1]])
    figure.update_yaxes(
        categoryorder="array", categoryarray=[*names, "clusters"][::-1], showgrid=False, ticks=""
    )
    return figure.update_layout(height=130 + 32 * (len(names) + 1))


def _bars(
    times: NDArray[np.float64],
    spans: Sequence[tuple[int, int]],
    step: float,
    row: str,
    color: str,
    name: str,
    width: float,
    in_legend: bool,
) -> go.Bar:
    return go.Bar(
        name=name,
        y=[row] * len(spans),
        base=[times[first] - step / 2 for first, _ in spans],
        x=[times[last] - times[first] + step for first, last in spans],
        orientation="h",
        width=width,
        marker={"color": color, "line": {"color": "white", "width": 1}},
        legendgroup=name,
        showlegend=in_legend,
        hovertemplate="%{y}: from %{base:.2f} s<extra></extra>",
    )


def _runs(chosen: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Find the first and last frame of each run of true values."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], chosen, [False]]).astype(int)))
    return [
        (int(first), int(last) - 1) for first, last in zip(edges[::2], edges[1::2], strict=True)
    ]


def _two_panels(heights: tuple[float, float]) -> go.Figure:
    figure = make_subplots(
        rows=2, cols=1, shared_xaxes=True, row_heights=list(heights), vertical_spacing=0.07
    )
    figure.update_xaxes(showgrid=False, zeroline=False)
    figure.update_xaxes(title_text="time in seconds", row=2)
    return figure.update_layout(template=TEMPLATE)


def _mean_line(figure: go.Figure, row: int) -> None:
    figure.add_hline(
        1.0,
        row=row,
        col=1,
        line={"color": BLACK, "width": 1.2, "dash": "dash"},
        annotation={"text": "mean", "font": {"size": 11}, "xanchor": "right"},
    )
