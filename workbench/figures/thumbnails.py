"""Thumbnails: a whole motion in one small picture, as in Halit 2010, Figure 4.3 (m).

The same composition is drawn as a plotly figure and as a file of a few kilobytes (SVG) that
any browser or file manager shows.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from xml.sax.saxutils import escape

import numpy as np
import plotly.graph_objects as go
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.figures.stick_drawing import (
    SHADOW,
    circle_points,
    hide_axes,
    segment_path,
    stroke_trace,
)
from workbench.figures.stick_figures import StickFigures, stick_figures
from workbench.figures.stick_look import PAPER, Stroke, limb_strokes, limb_width
from workbench.figures.style import BLUE, TEMPLATE
from workbench.figures.views import View, best_view
from workbench.files import write_atomically
from workbench.mocap.motion import Motion
from workbench.mocap.sides import MIDDLE, RIGHT
from workbench.validation import whole_number

#: Grey of the second pose, which must still be seen on white, and of the last; the others
#: fade between them.
_EARLY, _LATE = 145, 20

#: Least way from one pose to the next, as a share of the body's height; a motion that
#: stays where it is would else be one heap of limbs.
_STEP = 0.3

_MARGIN = 0.08


@dataclass(frozen=True, eq=False)
class Composite:
    """Key poses in one picture, from the first to the last.

    Attributes
    ----------
    figures : StickFigures
        Where the poses stand.
    frames : tuple of int, of length n_poses
        Which frames they are.
    colors : tuple of str, of length n_poses
        The first is blue, the others go from light grey to black with time.
    box : tuple of float
        Left, bottom, right and top of the picture.
    """

    figures: StickFigures
    frames: tuple[int, ...]
    colors: tuple[str, ...]
    box: tuple[float, float, float, float]


def compose(motion: Motion, keyframes: ArrayLike, view: View | None = None) -> Composite:
    """Put the key poses of a motion into one picture.

    Poses stand where the motion passes, in the order of time from left to right as far as
    it goes that way. Where it hardly moves on, each pose stands a step beside the one before,
    so that it can be seen.

    Parameters
    ----------
    motion : Motion
        The clip.
    keyframes : array-like of shape (n_poses,)
        Frames to draw, sorted.
    view : View, optional
        Where to look from; by default where the poses spread most.

    Returns
    -------
    Composite

    Raises
    ------
    WorkbenchError
        If a frame is not one of the clip's, or they are not sorted.
    """
    view = view or best_view(motion, keyframes)
    figures = stick_figures(motion, keyframes, view)
    step = _STEP * figures.body_height
    path = figures.roots[:, 0]
    if abs(path[-1] - path[0]) < 0.6 * step * (len(path) - 1):
        figures = stick_figures(motion, keyframes, view, in_place=True)
        figures = figures.moved(np.arange(len(path))[:, None] * [step, 0.0])
    bounds = figures.bounds()
    low, high = bounds[:, 0].min(axis=0), bounds[:, 1].max(axis=0)
    margin = _MARGIN * figures.body_height
    left, bottom = (low - margin).tolist()
    right, top = (high + margin).tolist()
    frames = tuple(np.asarray(keyframes).tolist())
    return Composite(figures, frames, _tones(len(figures)), (left, bottom, right, top))


def thumbnail(motion: Motion, keyframes: ArrayLike, *, view: View | None = None) -> go.Figure:
    """Draw a motion as one picture of its key poses.

    Parameters
    ----------
    motion, keyframes, view
        As :func:`compose` takes them.

    Returns
    -------
    plotly.graph_objects.Figure

    Raises
    ------
    WorkbenchError
        As :func:`compose` does.
    """
    composite = compose(motion, keyframes, view)
    left, bottom, right, top = composite.box
    height = max(150, min(420, round(970 * (top - bottom) / (right - left))))
    width = limb_width(composite.figures.body_height * height / (top - bottom))
    figure = go.Figure(layout={"template": TEMPLATE})
    figure.add_trace(
        stroke_trace(
            segment_path(composite.figures.shadows), Stroke(SHADOW, 1.2 * width), hoverinfo="skip"
        )
    )
    for pose, (color, frame) in enumerate(zip(composite.colors, composite.frames, strict=True)):
        for bones, stroke, named in _strokes(composite.figures.sides, color, width):
            path = segment_path(composite.figures.segments[pose, bones])
            name = (
                {"name": f"frame {frame}", "hoverinfo": "name"} if named else {"hoverinfo": "skip"}
            )
            figure.add_trace(stroke_trace(path, stroke, **name))
        for center in composite.figures.heads[pose]:
            figure.add_trace(_head(center, composite.figures.head_radius, color))
    hide_axes(figure)
    figure.update_xaxes(range=[left, right], constrain="domain")
    figure.update_yaxes(range=[bottom, top])
    return figure.update_layout(height=height, margin={"l": 8, "r": 8, "t": 8, "b": 8})


def thumbnail_svg(
    motion: Motion,
    keyframes: ArrayLike,
    *,
    view: View | None = None,
    height: int = 120,
) -> str:
    """Draw a motion as one picture of its key poses, as the text of an SVG file.

    Parameters
    ----------
    motion, keyframes, view
        As :func:`compose` takes them.
    height : int
        Height at which the picture is shown, in pixels; the width follows.

    Returns
    -------
    str
        Stands on its own, and has a title and a description for readers who cannot see it.

    Raises
    ------
    WorkbenchError
        As :func:`compose` does, or if the height is no whole number above 0.

    Examples
    --------
    >>> from workbench.datasets import load_space
    >>> svg = thumbnail_svg(load_space("cmu/01_01-jump").motion, [0, 150, 299])
    >>> svg.startswith("<svg"), svg.count("<circle")
    (True, 3)
    """
    height = whole_number("height", height)
    composite = compose(motion, keyframes, view)
    figures = composite.figures
    left, bottom, right, top = composite.box
    scale = height / (top - bottom)
    corner = np.array([left, top])
    width = limb_width(figures.body_height * scale)
    picture_width = round(scale * (right - left), 1)
    name = escape(motion.name or "motion")
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" role="img" width="{picture_width:g}" '
        f'height="{height}" viewBox="0 0 {picture_width:g} {height}">',
        f"<title>{name}</title>",
        f"<desc>{len(figures)} poses of {name}, frames {composite.frames[0]} to "
        f"{composite.frames[-1]}; the first is blue, later ones are darker, "
        "right limbs are open or dashed.</desc>",
        '<rect width="100%" height="100%" fill="white"/>',
        '<g fill="none" stroke-linecap="round">',
        f'<path stroke="{SHADOW}" stroke-width="{1.2 * width:.2f}" '
        f'd="{_svg_path((figures.shadows - corner) * [scale, -scale])}"/>',
    ]
    for pose, (color, frame) in enumerate(zip(composite.colors, composite.frames, strict=True)):
        limbs = (figures.segments[pose] - corner) * [scale, -scale]
        parts.append(f"<g><title>frame {frame}</title>")
        parts += [
            f'<path stroke="{stroke.color}" stroke-width="{stroke.width:.2f}" '
            + f'stroke-dasharray="{stroke.dash}" ' * bool(stroke.dash)
            + f'd="{_svg_path(limbs[bones])}"/>'
            for bones, stroke, _ in _strokes(figures.sides, color, width)
        ]
        for x, y in (figures.heads[pose] - corner) * [scale, -scale]:
            parts.append(
                f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{figures.head_radius * scale:.1f}" '
                f'fill="{color}" stroke="white"/>'
            )
        parts.append("</g>")
    return "\n".join([*parts, "</g>", "</svg>", ""])


def write_thumbnail(
    path: str | Path,
    motion: Motion,
    keyframes: ArrayLike,
    *,
    view: View | None = None,
    height: int = 120,
) -> None:
    """Write a motion's thumbnail as an SVG file.

    Parameters
    ----------
    path : str or Path
        The file; its folder is made if it is missing.
    motion, keyframes, view, height
        As :func:`thumbnail_svg` takes them.

    Raises
    ------
    WorkbenchError
        As :func:`thumbnail_svg` does, or if the name does not end in ``.svg``.
    """
    target = Path(path)
    if target.suffix.lower() != ".svg":
        raise WorkbenchError(f"path: got {str(path)!r}, want a name that ends in .svg")
    svg = thumbnail_svg(motion, keyframes, view=view, height=height)
    write_atomically(target, svg.encode())


def _tones(n_poses: int) -> tuple[str, ...]:
    """Give the first pose blue, and the others greys that darken evenly."""
    greys = np.linspace(_EARLY, _LATE, n_poses - 1).round().astype(int)
    return (BLUE, *(f"#{grey:02x}{grey:02x}{grey:02x}" for grey in greys.tolist()))


def _strokes(
    sides: tuple[str, ...], color: str, width: float
) -> list[tuple[NDArray[np.bool_], Stroke, bool]]:
    """List the strokes of a pose: the bones, how they are drawn, whether they stand for it."""
    right = np.array(sides) == RIGHT
    # A white seam keeps each pose apart from those behind it.
    seam = (np.ones(len(sides), dtype=bool), Stroke(PAPER, 2.2 * width), False)
    solid = [(~right, stroke, True) for stroke in limb_strokes(MIDDLE, color, width)]
    return [seam, *solid, *((right, s, False) for s in limb_strokes(RIGHT, color, width))]


def _head(center: NDArray[np.float64], radius: float, color: str) -> go.Scatter:
    corners = circle_points(center, radius).round(4)
    return go.Scatter(
        x=corners[:, 0].tolist(),
        y=corners[:, 1].tolist(),
        mode="lines",
        fill="toself",
        fillcolor=color,
        line={"color": PAPER, "width": 1},
        hoverinfo="skip",
        showlegend=False,
    )


def _svg_path(segments: NDArray[np.float64]) -> str:
    return "".join(
        f"M{x0:.1f} {y0:.1f}L{x1:.1f} {y1:.1f}"
        for (x0, y0), (x1, y1) in segments.reshape(-1, 2, 2).tolist()
    )
