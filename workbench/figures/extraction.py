"""Three families of keyframe extraction side by side, as in Halit 2010, Figure 2.1."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import plotly.graph_objects as go
from numpy.typing import NDArray
from plotly.subplots import make_subplots

from workbench.figures.style import BLACK, BLUE, GREY, TEMPLATE, VERMILLION, class_style

#: Distances from none to the largest; darker is farther.
_SCALE = [[0.0, "#FFFFFF"], [0.5, "#9DBBD3"], [1.0, "#1F3A5F"]]

_KEY = {"size": 10, "color": VERMILLION, "line": {"color": BLACK, "width": 1.4}}

#: Rows and columns of a matrix that are drawn; more would not be seen.
_MOST_CELLS = 200


@dataclass(frozen=True, eq=False)
class Families:
    """What the three families make of one clip.

    Attributes
    ----------
    seconds : ndarray of shape (n_frames,)
        Time of each frame.
    curve : ndarray of shape (n_frames,)
        One joint angle, in degrees.
    curve_keyframes : ndarray of shape (n_keyframes,)
        Where the straight lines of its simplification meet.
    plane : ndarray of shape (n_frames, 2)
        Frames in the plane of two principal components.
    clusters : ndarray of shape (n_frames,)
        The cluster of each.
    cluster_keyframes : ndarray of shape (n_keyframes,)
        The frame that stands for each cluster, sorted.
    distances : ndarray of shape (n_frames, n_frames)
        Between all frames.
    matrix_keyframes : ndarray of shape (n_keyframes,)
        Frames whose columns describe the matrix, sorted.
    """

    seconds: NDArray[np.float64]
    curve: NDArray[np.float64]
    curve_keyframes: NDArray[np.intp]
    plane: NDArray[np.float64]
    clusters: NDArray[np.intp]
    cluster_keyframes: NDArray[np.intp]
    distances: NDArray[np.float64]
    matrix_keyframes: NDArray[np.intp]


def families_figure(families: Families) -> go.Figure:
    """Draw curve simplification, clustering and matrix factorization of one clip.

    Parameters
    ----------
    families : Families
        What they found.

    Returns
    -------
    plotly.graph_objects.Figure
    """
    figure = make_subplots(
        rows=1,
        cols=3,
        subplot_titles=["(a) curve simplification", "(b) clustering", "(c) matrix factorization"],
        horizontal_spacing=0.075,
    )
    for column, traces in enumerate(
        (_curve(families), _clusters(families), _matrix(families)), start=1
    ):
        for trace in traces:
            figure.add_trace(trace, row=1, col=column)
    figure.add_trace(go.Scatter(x=[None], y=[None], mode="markers", marker=_KEY, name="keyframe"))
    figure.update_xaxes(title_text="seconds", showgrid=False, row=1, col=1)
    figure.update_yaxes(title_text="joint angle, degrees", row=1, col=1)
    blank = {"showticklabels": False, "ticks": "", "showgrid": False, "zeroline": False}
    frame = {**blank, "mirror": True, "showline": True}
    figure.update_xaxes(title_text="first principal component", **frame, row=1, col=2)
    figure.update_yaxes(title_text="second", **frame, scaleanchor="x2", row=1, col=2)
    end = float(families.seconds[-1])
    figure.update_xaxes(
        title_text="seconds", range=[0, end], showgrid=False, constrain="domain", row=1, col=3
    )
    figure.update_yaxes(
        title_text="seconds", range=[end, 0], showgrid=False, scaleanchor="x3", row=1, col=3
    )
    figure.update_annotations(font_size=13)
    figure.update_xaxes(title_font_size=12)
    figure.update_yaxes(title_font_size=12)
    return figure.update_layout(
        template=TEMPLATE,
        height=380,
        margin={"l": 56, "r": 12, "t": 36, "b": 70},
        legend={"yanchor": "top", "y": -0.16, "x": 0},
    )


def _curve(families: Families) -> list[go.Scatter]:
    keys = families.curve_keyframes
    at, height = families.seconds[keys], families.curve[keys]
    return [
        _quiet(families.seconds, families.curve, mode="lines", line={"color": GREY, "width": 3}),
        _quiet(at, height, mode="lines", line={"color": VERMILLION, "width": 1.5, "dash": "dash"}),
        _quiet(at, height, mode="markers", marker=_KEY),
    ]


def _clusters(families: Families) -> list[go.Scatter]:
    colors, symbols = zip(*(class_style(int(c)) for c in families.clusters), strict=True)
    x, y = families.plane.T
    keys = families.cluster_keyframes
    marker = {"size": 5, "color": colors, "symbol": symbols, "opacity": 0.75}
    return [
        _quiet(x, y, mode="markers", marker=marker),
        _quiet(x[keys], y[keys], mode="markers", marker=_KEY),
    ]


def _matrix(families: Families) -> list[go.Heatmap | go.Scatter]:
    step = -(-len(families.seconds) // _MOST_CELLS)
    shown = families.seconds[::step]
    keys = families.seconds[families.matrix_keyframes]
    ends = [families.seconds[0], families.seconds[-1]]
    lines = go.Scatter(
        x=[x for key in keys for x in (key, key, None)],
        y=[y for _ in keys for y in (*ends, None)],
        mode="lines",
        line={"color": BLUE, "width": 1},
        hoverinfo="skip",
        showlegend=False,
    )
    return [
        go.Heatmap(
            x=shown,
            y=shown,
            z=families.distances[::step, ::step].round(2),
            colorscale=_SCALE,
            showscale=False,
            hovertemplate="%{x:.2f} s and %{y:.2f} s: %{z:.2f}<extra>distance</extra>",
        ),
        lines,
        _quiet(keys, keys, mode="markers", marker=_KEY),
    ]


def _quiet(x: NDArray[np.float64], y: NDArray[np.float64], **settings: object) -> go.Scatter:
    return go.Scatter(x=x, y=y, hoverinfo="skip", showlegend=False, **settings)
