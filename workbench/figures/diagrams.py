"""Diagrams: boxes and arrows on a grid."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import plotly.graph_objects as go
from numpy.typing import NDArray

from workbench.errors import WorkbenchError
from workbench.figures.style import BLACK, BLUE, GREEN, GREY, TEMPLATE

#: Line and fill of each kind of box.
KINDS = {
    "data": (GREY, "#F3F5F7"),
    "step": (BLUE, "#E3F0F8"),
    "kept": (GREEN, "#E2F4EE"),
}

#: Size of a cell and of a box in it, in pixels.
CELL_WIDTH, CELL_HEIGHT = 154, 104
BOX_WIDTH, BOX_HEIGHT = 124, 62

#: Space around all boxes, and above those of a group for its title.
_MARGIN, _TITLE = 12, 20


@dataclass(frozen=True)
class Box:
    """One box of a diagram.

    Attributes
    ----------
    key : str
        What arrows call it.
    text : str
        What it says; ``<b>`` and ``<br>`` are understood.
    kind : {"data", "step", "kept"}
        What flows, what is done to it, and what is stored in the end.
    column, row : float
        Where its middle is; row 0 is the top.
    """

    key: str
    text: str
    kind: str
    column: float
    row: float


@dataclass(frozen=True)
class Arrow:
    """What leads from one box to another.

    Attributes
    ----------
    start, end : str
        Keys of the boxes.
    text : str
        What flows.
    around : float
        Row through which it goes around the boxes between, where it is not straight.
    is_needed_only : bool
        Whether the box at its end, which is lower, needs it but does not pass it on; then it
        is dotted.
    """

    start: str
    end: str
    text: str = ""
    around: float | None = None
    is_needed_only: bool = False


@dataclass(frozen=True)
class Diagram:
    """Boxes, arrows and what is grouped.

    Attributes
    ----------
    boxes : tuple of Box
    arrows : tuple of Arrow
    groups : tuple of (str, tuple of str)
        A title and the keys of the boxes that it stands above.

    Raises
    ------
    WorkbenchError
        If two boxes have one key, an arrow or a group names no box, or a kind is unknown.
    """

    boxes: tuple[Box, ...]
    arrows: tuple[Arrow, ...]
    groups: tuple[tuple[str, tuple[str, ...]], ...] = ()

    def __post_init__(self) -> None:
        keys = [box.key for box in self.boxes]
        if not keys or len(set(keys)) < len(keys):
            raise WorkbenchError(f"boxes: got keys {keys}, want at least one and each once")
        named = [key for arrow in self.arrows for key in (arrow.start, arrow.end)]
        named += [key for _, members in self.groups for key in members]
        if not set(named) <= set(keys):
            raise WorkbenchError(f"arrows and groups: got {named}, want keys among {keys}")
        if not {box.kind for box in self.boxes} <= set(KINDS):
            raise WorkbenchError(f"boxes: want each kind one of {', '.join(KINDS)}")

    def box(self, key: str) -> Box:
        """Find a box by its key."""
        return next(box for box in self.boxes if box.key == key)

    def sources(self, key: str) -> list[str]:
        """List the boxes from which arrows lead to a box."""
        return [arrow.start for arrow in self.arrows if arrow.end == key]


def draw_diagram(diagram: Diagram) -> go.Figure:
    """Draw a diagram.

    Parameters
    ----------
    diagram : Diagram
        What to draw.

    Returns
    -------
    plotly.graph_objects.Figure
        Of a width of its own, at most 1000 pixels, so that texts fit their boxes.
    """
    reach = np.array([BOX_WIDTH / 2 + _MARGIN, BOX_HEIGHT / 2 + _MARGIN])
    corners = [[_center(box) - reach, _center(box) + reach] for box in diagram.boxes]
    (left, top), (right, bottom) = np.min(corners, axis=(0, 1)), np.max(corners, axis=(0, 1))
    if diagram.groups:
        top, bottom = top - _TITLE, bottom + _MARGIN
    around = [arrow.around for arrow in diagram.arrows if arrow.around is not None]
    top = min(top, *(CELL_HEIGHT * row - _MARGIN for row in around)) if around else top
    bottom = max(bottom, *(CELL_HEIGHT * row + _MARGIN for row in around)) if around else bottom
    # A page of 1000 pixels shows wide diagrams smaller, texts too.
    scale = min(1.0, 980 / (right - left))
    figure = go.Figure(layout={"template": TEMPLATE})
    for title, members in diagram.groups:
        _draw_group(figure, title, [diagram.box(key) for key in members], scale)
    for arrow in diagram.arrows:
        _draw_arrow(figure, diagram.box(arrow.start), diagram.box(arrow.end), arrow, scale)
    for box in diagram.boxes:
        _draw_box(figure, box, scale)
    figure.update_xaxes(visible=False, range=[left, right], constrain="domain")
    figure.update_yaxes(visible=False, range=[bottom, top], scaleanchor="x")
    return figure.update_layout(
        # Texts do not shrink with a window, so the diagram does not either: pages scroll it.
        width=round((right - left) * scale) + 16,
        height=round((bottom - top) * scale) + 16,
        margin={"l": 8, "r": 8, "t": 8, "b": 8},
    )


def _center(box: Box) -> NDArray[np.float64]:
    return np.array([box.column * CELL_WIDTH, box.row * CELL_HEIGHT])


def _draw_box(figure: go.Figure, box: Box, scale: float) -> None:
    line, fill = KINDS[box.kind]
    x, y = _center(box)
    figure.add_shape(
        type="rect",
        x0=x - BOX_WIDTH / 2,
        x1=x + BOX_WIDTH / 2,
        y0=y - BOX_HEIGHT / 2,
        y1=y + BOX_HEIGHT / 2,
        line={"color": line, "width": 1.5},
        fillcolor=fill,
        layer="below",
    )
    figure.add_annotation(
        x=x, y=y, text=box.text, showarrow=False, font={"size": 12.5 * scale, "color": BLACK}
    )


def _draw_group(figure: go.Figure, title: str, boxes: list[Box], scale: float) -> None:
    centers = np.array([_center(box) for box in boxes])
    reach = np.array([BOX_WIDTH / 2 + 10, BOX_HEIGHT / 2 + 10])
    (x0, y0), (x1, y1) = centers.min(axis=0) - reach, centers.max(axis=0) + reach
    figure.add_shape(
        type="rect",
        x0=x0,
        x1=x1,
        y0=y0 - _TITLE,
        y1=y1,
        line={"color": GREEN, "width": 1, "dash": "dash"},
        layer="below",
    )
    figure.add_annotation(
        x=(x0 + x1) / 2,
        y=y0 - 6,
        text=f"<i>{title}</i>",
        showarrow=False,
        font={"size": 11.5 * scale, "color": GREEN},
    )


def _draw_arrow(figure: go.Figure, start: Box, end: Box, arrow: Arrow, scale: float) -> None:
    points = _route(start, end, arrow)
    dash = "dot" if arrow.is_needed_only else "solid"
    figure.add_trace(
        go.Scatter(
            x=[x for x, _ in points],
            y=[y for _, y in points],
            mode="lines",
            line={"color": GREY, "width": 1.5, "dash": dash},
            hoverinfo="skip",
            showlegend=False,
        )
    )
    (x0, y0), (x1, y1) = points[-2:]
    length = max(float(np.hypot(x1 - x0, y1 - y0)), 1e-9)
    figure.add_annotation(
        x=x1,
        y=y1,
        ax=x1 - 12 * (x1 - x0) / length,
        ay=y1 - 12 * (y1 - y0) / length,
        axref="x",
        ayref="y",
        text="",
        showarrow=True,
        arrowhead=2,
        arrowsize=1.3,
        arrowwidth=1.5,
        arrowcolor=GREY,
    )
    if arrow.text:
        (x0, y0), (x1, y1) = max(
            pairwise(points),
            key=lambda ends: abs(ends[0][0] - ends[1][0]) + 0.5 * abs(ends[0][1] - ends[1][1]),
        )
        figure.add_annotation(
            x=(x0 + x1) / 2,
            y=(y0 + y1) / 2,
            yanchor="middle",
            text=arrow.text,
            showarrow=False,
            bgcolor="white",
            borderpad=1,
            font={"size": 11.5 * scale, "color": GREY},
        )


def _route(start: Box, end: Box, arrow: Arrow) -> list[tuple[float, float]]:
    """Lead from side to side, down from above, within a column, or around by another row."""
    (x0, y0), (x1, y1) = _center(start), _center(end)
    if arrow.around is not None:
        by = arrow.around * CELL_HEIGHT
        out0 = y0 + np.sign(by - y0) * BOX_HEIGHT / 2
        out1 = y1 + np.sign(by - y1) * BOX_HEIGHT / 2
        return [(x0, out0), (x0, by), (x1, by), (x1, out1)]
    if abs(x1 - x0) < BOX_WIDTH:
        down = np.sign(y1 - y0)
        return [(x0, y0 + down * BOX_HEIGHT / 2), (x1, y1 - down * BOX_HEIGHT / 2)]
    right = np.sign(x1 - x0)
    if arrow.is_needed_only:
        return [(x0 + right * BOX_WIDTH / 2, y0), (x1, y0), (x1, y1 - BOX_HEIGHT / 2)]
    exit_x, entry_x = x0 + right * BOX_WIDTH / 2, x1 - right * BOX_WIDTH / 2
    if y0 == y1:
        return [(exit_x, y0), (entry_x, y1)]
    # The bend is in the gap before the last box, where nothing stands in the way.
    bend = x1 - right * CELL_WIDTH / 2
    return [(exit_x, y0), (bend, y0), (bend, y1), (entry_x, y1)]
