"""Authoring in pictures: a curve in the plane, and the poses at some of its points."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import plotly.graph_objects as go
from numpy.typing import ArrayLike, NDArray
from plotly.subplots import make_subplots

from workbench.errors import WorkbenchError
from workbench.figures.embeddings import Panel
from workbench.figures.stick_drawing import body_traces
from workbench.figures.stick_figures import StickFigures
from workbench.figures.stick_look import limb_width
from workbench.figures.style import BLACK, GREY, TEMPLATE
from workbench.figures.trajectories import add_key, trajectory_traces
from workbench.validation import as_numbers

_LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"

#: Pixels of a body in a row, about.
_BODY_TALL = 110

#: Space between poses, and above and below a row, as shares of the body's height.
_GAP, _AROUND = 0.1, 0.12


def plane_with_poses(
    panel: Panel,
    probes: ArrayLike,
    poses: Mapping[str, StickFigures],
    *,
    before: NDArray[np.float64] | None = None,
    seconds: float | None = None,
) -> go.Figure:
    """Draw a curve in the plane beside the poses at some points (Costa 2018, Figure 6.1).

    Points and their poses have the same letters.

    Parameters
    ----------
    panel : Panel
        The curve; its control points, of which there may be none, are the markers.
    probes : array-like of shape (n_probes, 2)
        Points at which poses are looked at, at most 26.
    poses : mapping of str to StickFigures
        Rows of poses by what they show, one pose for each probe.
    before : ndarray of shape (n_frames, 2), optional
        The curve as it was before it was changed, in grey.
    seconds : float, optional
        How long the motion lasts.

    Returns
    -------
    plotly.graph_objects.Figure

    Raises
    ------
    WorkbenchError
        If there is no row, or a row has not one pose for each probe.
    """
    at = as_numbers("probes", probes, 2)
    if not poses or not 0 < len(at) <= len(_LETTERS):
        raise WorkbenchError(
            f"poses: got {len(poses)} rows for {len(at)} probes, want at least one row "
            f"and 1 to {len(_LETTERS)} probes"
        )
    for name, figures in poses.items():
        if len(figures) != len(at):
            raise WorkbenchError(f"poses {name!r}: got {len(figures)}, want {len(at)}")
    figure = make_subplots(
        rows=len(poses),
        cols=2,
        column_widths=[0.42, 0.58],
        horizontal_spacing=0.03,
        vertical_spacing=0.03,
        specs=[[{"rowspan": len(poses)} if row == 0 else None, {}] for row in range(len(poses))],
    )
    _draw_plane(figure, panel, at, before)
    for row, (name, figures) in enumerate(poses.items(), 1):
        _draw_poses(figure, name, figures, row)
    figure.update_layout(template=TEMPLATE, height=310 + 130 * len(poses))
    add_key(figure, seconds)
    return figure.update_layout(
        coloraxis_colorbar={"x": 0.0, "xanchor": "left", "len": 0.4},
        legend={"x": 0.0, "xanchor": "left"},
    )


def _draw_plane(
    figure: go.Figure, panel: Panel, at: NDArray[np.float64], before: NDArray[np.float64] | None
) -> None:
    if before is not None:
        figure.add_trace(
            go.Scatter(
                x=before[:, 0],
                y=before[:, 1],
                mode="lines",
                line={"color": GREY, "width": 1.4, "dash": "dot"},
                hoverinfo="skip",
                showlegend=False,
            ),
            row=1,
            col=1,
        )
    keys = np.asarray(panel.control_points, dtype=np.intp)
    for trace in trajectory_traces(panel.points, keys):
        figure.add_trace(trace, row=1, col=1)
    figure.add_trace(
        go.Scatter(
            x=at[:, 0],
            y=at[:, 1],
            mode="markers+text",
            marker={"symbol": "cross-thin", "size": 11, "line": {"color": BLACK, "width": 1.6}},
            text=[f"<b>{letter}</b>" for letter in _LETTERS[: len(at)]],
            textposition="top right",
            textfont={"size": 13, "color": BLACK},
            hoverinfo="skip",
            showlegend=False,
        ),
        row=1,
        col=1,
    )
    frame = {"showticklabels": False, "ticks": "", "showgrid": False, "zeroline": False}
    figure.update_xaxes(**frame, mirror=True, showline=True, row=1, col=1)
    figure.update_yaxes(**frame, mirror=True, showline=True, scaleanchor="x", row=1, col=1)


def _draw_poses(figure: go.Figure, name: str, figures: StickFigures, row: int) -> None:
    """Draw a row of poses at equal distances, their letters below and its name above."""
    axis = figure.get_subplot(row, 2)
    boxes = figures.bounds()[..., 0] - figures.roots[:, :1]
    cell = (boxes[:, 1] - boxes[:, 0]).max() + _GAP * figures.body_height
    shifts = np.arange(len(figures))[:, None] * [cell, 0.0] - figures.roots
    shifts[:, 0] -= boxes.mean(axis=1)
    placed = figures.moved(shifts)
    for trace in body_traces(placed, width=limb_width(_BODY_TALL)):
        figure.add_trace(trace, row=row, col=2)
    low, high = placed.bounds()[:, 0].min(axis=0), placed.bounds()[:, 1].max(axis=0)
    margin = _AROUND * figures.body_height
    for place, letter in enumerate(_LETTERS[: len(figures)]):
        figure.add_annotation(
            x=place * cell,
            y=low[1] - 0.3 * margin,
            yanchor="top",
            text=f"<b>{letter}</b>",
            showarrow=False,
            font={"size": 12, "color": BLACK},
            row=row,
            col=2,
        )
    figure.add_annotation(
        x=low[0],
        y=high[1] + margin,
        xanchor="left",
        yanchor="middle",
        text=name,
        showarrow=False,
        font={"size": 12, "color": GREY},
        row=row,
        col=2,
    )
    figure.update_xaxes(
        visible=False, range=[low[0] - margin, high[0] + margin], constrain="domain", row=row, col=2
    )
    figure.update_yaxes(
        visible=False,
        range=[low[1] - 1.6 * margin, high[1] + 1.6 * margin],
        scaleanchor=axis.yaxis.anchor,
        row=row,
        col=2,
    )
