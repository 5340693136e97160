"""Filmstrips: poses of a motion side by side, in the manner of Costa 2018, Figure 4.2."""

from __future__ import annotations

import numpy as np
import plotly.graph_objects as go
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.figures.stick_drawing import GROUND, body_traces, hide_axes
from workbench.figures.stick_figures import StickFigures, stick_figures
from workbench.figures.stick_look import limb_width
from workbench.figures.style import BLACK, GREY, TEMPLATE
from workbench.figures.views import View
from workbench.mocap.motion import Motion
from workbench.validation import whole_number

#: Pixels of a picture's width that poses are laid out for, and of a line of text.
_WIDTH, _TEXT = 970, 19

#: Pixels of the largest body.
_LARGEST = 190

#: Poses that share a row, where the caller does not say.
_MOST_IN_A_ROW = 8

#: Space around each pose and above each row, as shares of the body's height.
_GAP, _HEADROOM = 0.12, 0.08


def filmstrip(
    motion: Motion,
    frames: ArrayLike,
    *,
    view: View | None = None,
    travelling: bool = False,
    n_columns: int | None = None,
    letters: bool = False,
) -> go.Figure:
    """Draw poses side by side, all on one scale and on common ground.

    Under each pose stand its frame and its time.

    Parameters
    ----------
    motion : Motion
        The clip.
    frames : array-like of shape (n_poses,)
        Frames to draw, sorted.
    view : View, optional
        Where to look from; by default where the poses spread most.
    travelling : bool
        Whether a gap between two poses grows with the way between them. Otherwise they stand
        at equal distances.
    n_columns : int, optional
        Poses in a row; by default at most 8, with rows as equal as can be.
    letters : bool
        Whether poses are called a, b, c … as in the panels of Halit 2010, Figure 4.3.

    Returns
    -------
    plotly.graph_objects.Figure

    Raises
    ------
    WorkbenchError
        If a frame is not one of the clip's, they are not sorted, or a row is to hold none.
    """
    figures = stick_figures(motion, frames, view, in_place=not travelling)
    chosen = np.asarray(frames)
    if letters and len(chosen) > 26:
        raise WorkbenchError(f"letters: got {len(chosen)} poses, want at most 26")
    columns = _columns(len(chosen), n_columns)
    rows = np.split(np.arange(len(chosen)), range(columns, len(chosen), columns))
    figures, widths = _in_rows(figures, rows, travelling=travelling)
    bounds = figures.bounds()
    left, right = -_GAP * figures.body_height, max(widths)
    # A few poses do not fill the width: they would be larger than the picture needs.
    per_pixel = max((right - left) / _WIDTH, figures.body_height / _LARGEST)
    # Rows are stacked: each as high as its tallest pose, with two lines of text below.
    shifts, levels, top = np.zeros((len(chosen), 2)), [], 0.0
    for row in rows:
        above = bounds[row, 1, 1].max() + _HEADROOM * figures.body_height
        below = bounds[row, 0, 1].min()
        shifts[row, 1] = top - above
        levels.append(top - above)
        top += below - above - 2.6 * _TEXT * per_pixel
    figures, bounds = figures.moved(shifts), bounds + shifts[:, None]

    figure = go.Figure(layout={"template": TEMPLATE})
    for level in levels:
        figure.add_trace(_ground(left, right, level))
    for trace in body_traces(figures, width=limb_width(figures.body_height / per_pixel)):
        figure.add_trace(trace)
    for row in rows:
        foot = bounds[row, 0, 1].min()
        for pose in row:
            seconds = chosen[pose] * motion.frame_time
            name = f"({'abcdefghijklmnopqrstuvwxyz'[pose]}) " if letters else ""
            figure.add_annotation(
                x=bounds[pose, :, 0].mean(),
                y=foot,
                yanchor="top",
                text=f"<b>{name}{chosen[pose]}</b><br>"
                f"<span style='color:{GREY};font-size:11px'>{seconds:.2f} s</span>",
                showarrow=False,
                font={"size": 12, "color": BLACK},
            )
    hide_axes(figure)
    margin = max(0.0, (per_pixel * _WIDTH - (right - left)) / 2)
    figure.update_xaxes(range=[left - margin, right + margin], constrain="domain")
    figure.update_yaxes(range=[top, 0.0])
    height = -top / per_pixel
    return figure.update_layout(
        height=round(height + 16), margin={"l": 15, "r": 15, "t": 8, "b": 8}
    )


def _columns(n_poses: int, n_columns: int | None) -> int:
    if n_columns is not None:
        return min(whole_number("n_columns", n_columns), n_poses)
    n_rows = -(-n_poses // _MOST_IN_A_ROW)
    return -(-n_poses // n_rows)


def _in_rows(
    figures: StickFigures, rows: list[NDArray[np.intp]], *, travelling: bool
) -> tuple[StickFigures, list[float]]:
    """Place the poses of each row from left to right, with the ground at height 0."""
    gap = _GAP * figures.body_height
    boxes = figures.bounds()[..., 0] - figures.roots[:, :1]
    shifts = -figures.roots
    cell = (boxes[:, 1] - boxes[:, 0]).max() + gap
    widths = []
    for row in rows:
        x = 0.0
        for place, pose in enumerate(row):
            if travelling and place > 0:
                before = row[place - 1]
                way = abs(figures.roots[pose, 0] - figures.roots[before, 0])
                # Poses never overlap: what they cover comes before the way between them.
                x += max(boxes[before, 1] - boxes[pose, 0] + gap, way)
            elif travelling:
                x = -boxes[pose, 0]
            else:
                x = place * cell + cell / 2 - gap - boxes[pose].mean()
            shifts[pose, 0] += x
        last = x + boxes[row[-1], 1] + gap
        widths.append(float(last if travelling else len(row) * cell))
    return figures.moved(shifts), widths


def _ground(left: float, right: float, level: float) -> go.Scatter:
    return go.Scatter(
        x=[left, right],
        y=[level, level],
        mode="lines",
        line={"color": GROUND, "width": 1},
        hoverinfo="skip",
        showlegend=False,
    )
