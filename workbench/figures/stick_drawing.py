"""Drawing stick figures: limbs in the colour of their side, heads, shadows and the ground."""

from __future__ import annotations

from typing import Any

import numpy as np
import plotly.graph_objects as go
from numpy.typing import NDArray

from workbench.figures.stick_figures import StickFigures, stick_figures
from workbench.figures.stick_look import COLORS, TRUNK, Stroke, limb_strokes, limb_width
from workbench.figures.style import TEMPLATE
from workbench.figures.views import View, best_view
from workbench.mocap.motion import Motion
from workbench.mocap.sides import LEFT, MIDDLE, RIGHT

_INK = COLORS["light"]

#: Colours of the ground's line or grid, and of shadows on it.
GROUND, SHADOW = _INK["ground"], _INK["shadow"]

#: Pixels of a picture of one pose, and of the body in it, about.
_TALL, _BODY_TALL = 460, 300

_CIRCLE = np.stack(
    [np.cos(np.linspace(0.0, 2 * np.pi, 25)), np.sin(np.linspace(0.0, 2 * np.pi, 25))], axis=1
)


def stick_figure(motion: Motion, frame: int, view: View | None = None) -> go.Figure:
    """Draw one pose on a grid of the ground.

    Parameters
    ----------
    motion : Motion
        The clip.
    frame : int
        The frame.
    view : View, optional
        Where to look from; by default where the pose spreads most.

    Returns
    -------
    plotly.graph_objects.Figure

    Raises
    ------
    WorkbenchError
        If the frame is not one of the clip's.
    """
    view = view or best_view(motion, [frame])
    figures = stick_figures(motion, [frame], view, in_place=True)
    figure = go.Figure(layout={"template": TEMPLATE})
    figure.add_trace(_ground_grid(figures, view))
    for trace in body_traces(figures, width=limb_width(_BODY_TALL), legend=True):
        figure.add_trace(trace)
    hide_axes(figure)
    return figure.update_layout(height=_TALL, margin={"l": 8, "r": 8, "t": 40, "b": 8})


def body_traces(
    figures: StickFigures, *, width: float = 3.0, legend: bool = False
) -> list[go.Scatter]:
    """Make the traces of all poses: shadows, far limbs, trunks, heads, near limbs.

    Left limbs are solid, right ones open, or dashed where they are too thin for that.

    Parameters
    ----------
    figures : StickFigures
        The poses, where they are to stand.
    width : float
        Of the limbs, in pixels.
    legend : bool
        Whether the sides get entries.

    Returns
    -------
    list of plotly.graph_objects.Scatter
        A constant number, however many poses there are.
    """
    sides, nearer = np.array(figures.sides), np.array(figures.nearer)
    traces = [_lines(figures.shadows, Stroke(SHADOW, 1.2 * width), "shadow")]
    for is_near in (False, True):
        for side in (LEFT, RIGHT):
            poses = (nearer == side) == is_near
            chosen = figures.segments[poses][:, sides == side]
            traces += _limbs(chosen, side, width)
        if not is_near:
            trunk = figures.segments[:, sides == MIDDLE]
            traces.append(_lines(trunk, Stroke(_INK[MIDDLE], TRUNK * width), "trunk"))
            traces.append(_heads(figures))
    if legend:
        for name, side in (("left limbs", LEFT), ("right limbs (open)", RIGHT)):
            line = {"color": _INK[side], "width": width}
            traces.append(
                go.Scatter(x=[None], y=[None], mode="lines", name=name, line=line, showlegend=True)
            )
    return traces


def hide_axes(figure: go.Figure) -> None:
    """Leave one scale and no axes: a picture of a body needs no ticks."""
    figure.update_xaxes(visible=False)
    figure.update_yaxes(visible=False, scaleanchor="x")


def segment_path(segments: NDArray[np.float64]) -> tuple[list[float | None], list[float | None]]:
    """Join segments to one line with gaps, as plotly draws it.

    Parameters
    ----------
    segments : ndarray of shape (..., 2, 2)
        Both ends of each.

    Returns
    -------
    x, y : list of float or None
    """
    flat = segments.reshape(-1, 2, 2).round(4)
    xs: list[float | None] = []
    ys: list[float | None] = []
    for (x0, y0), (x1, y1) in flat.tolist():
        xs += [x0, x1, None]
        ys += [y0, y1, None]
    return xs, ys


def stroke_trace(
    path: tuple[list[float | None], list[float | None]], stroke: Stroke, **settings: Any
) -> go.Scatter:
    """Make the trace of a line with gaps, with round joints where it is solid.

    Parameters
    ----------
    path : (list, list)
        As :func:`segment_path` gives it.
    stroke : Stroke
        How it is drawn.
    **settings
        Of the trace.

    Returns
    -------
    plotly.graph_objects.Scatter
    """
    return go.Scatter(
        x=path[0],
        y=path[1],
        # Dots as wide as the line make its joints round; they would fill the gaps of dashes.
        mode="lines" if stroke.dash else "lines+markers",
        marker={"size": stroke.width, "color": stroke.color, "line": {"width": 0}},
        line={"color": stroke.color, "width": stroke.width, "dash": stroke.dash or None},
        showlegend=False,
        **settings,
    )


def circle_points(center: NDArray[np.float64], radius: float) -> NDArray[np.float64]:
    """Give the corners of a polygon that looks like a circle: (25, 2), closed."""
    return center + radius * _CIRCLE


def _limbs(segments: NDArray[np.float64], side: str, width: float) -> list[go.Scatter]:
    solid, *inside = limb_strokes(side, _INK[side], width)
    return [_lines(segments, solid, side), *(_lines(segments, stroke, "open") for stroke in inside)]


def _lines(segments: NDArray[np.float64], stroke: Stroke, name: str) -> go.Scatter:
    return stroke_trace(segment_path(segments), stroke, name=name, hoverinfo="skip")


def _heads(figures: StickFigures) -> go.Scatter:
    xs: list[float | None] = []
    ys: list[float | None] = []
    for center in figures.heads.reshape(-1, 2):
        corners = circle_points(center, figures.head_radius).round(4)
        xs += [*corners[:, 0].tolist(), None]
        ys += [*corners[:, 1].tolist(), None]
    return go.Scatter(
        x=xs,
        y=ys,
        mode="lines",
        fill="toself",
        fillcolor=_INK[MIDDLE],
        line={"color": _INK[MIDDLE], "width": 0.5},
        name="head",
        hoverinfo="skip",
        showlegend=False,
    )


def _ground_grid(figures: StickFigures, view: View) -> go.Scatter:
    """Draw squares on the ground around one pose; seen from its level they are a line."""
    cell, reach = figures.body_height / 4, 3
    ticks = cell * np.arange(-reach, reach + 1)
    ends = cell * np.array([-reach, reach])
    # Lines along the picture and towards the viewer, whichever way the world's axes go.
    across = [[[end, tick] for end in ends] for tick in ticks]
    away = [[[tick, end] for end in ends] for tick in ticks]
    corners = np.array(across + away)
    corners[..., 1] *= np.sin(np.radians(view.elevation))
    return _lines(corners + figures.roots[0], Stroke(GROUND, 1.0), "ground")
