"""Line drawings as SVG: figures without axes, of lines, filled shapes and words."""

from __future__ import annotations

import re
from xml.sax.saxutils import escape, quoteattr

import plotly.graph_objects as go

from workbench.errors import WorkbenchError
from workbench.figures.style import GREY

_TAG = re.compile(r"<[^>]*>")
_FONT = "system-ui, sans-serif"
#: Pixels from one line of words to the next.
_LINE = 15


def line_svg(figure: go.Figure, *, title: str, description: str, width: int = 970) -> str:
    """Write a drawing of lines as the text of an SVG file.

    Making a file of a plotly figure takes a browser; stick figures are lines on one scale,
    which can be written without one and stay a few kilobytes.

    Parameters
    ----------
    figure : plotly.graph_objects.Figure
        Scatter traces of lines or filled shapes, with a height and the ranges of both axes,
        as :func:`~workbench.figures.filmstrips.filmstrip` makes it. Annotations are written
        below their places, the first line of each in bold.
    title, description : str
        What it shows, for readers who cannot see it.
    width : int
        In pixels.

    Returns
    -------
    str
        Stands on its own.

    Raises
    ------
    WorkbenchError
        If the figure has no height, or an axis no range.

    Examples
    --------
    >>> from workbench.datasets import load_space
    >>> from workbench.figures.filmstrips import filmstrip
    >>> strip = filmstrip(load_space("cmu/01_01-jump").motion, [0, 150])
    >>> svg = line_svg(strip, title="a jump", description="two poses")
    >>> svg.startswith("<svg"), "150" in svg
    (True, True)
    """
    layout = figure.layout
    if layout.height is None or layout.xaxis.range is None or layout.yaxis.range is None:
        raise WorkbenchError("figure: got one without a height or a range, want a line drawing")
    (left, right), (bottom, top) = layout.xaxis.range, layout.yaxis.range
    height = layout.height
    scale = min(width / (right - left), height / (top - bottom))
    across = (width - scale * (right - left)) / 2
    down = (height - scale * (top - bottom)) / 2

    def place(x: float, y: float) -> tuple[float, float]:
        return across + (x - left) * scale, down + (top - y) * scale

    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" role="img" width="{width}" height="{height}" '
        f'viewBox="0 0 {width} {height}">',
        f"<title>{escape(title)}</title>",
        f"<desc>{escape(description)}</desc>",
        '<rect width="100%" height="100%" fill="white"/>',
        '<g stroke-linecap="round" stroke-linejoin="round">',
    ]
    for trace in figure.data:
        ends = zip(trace.x, trace.y, strict=True)
        path = _path([None if x is None else place(x, y) for x, y in ends])
        dash = f'stroke-dasharray="{trace.line.dash}" ' if trace.line.dash else ""
        fill = trace.fillcolor if trace.fill == "toself" else "none"
        parts.append(
            f"<path fill={quoteattr(fill)} stroke={quoteattr(trace.line.color)} {dash}"
            f'stroke-width="{trace.line.width:.2f}" d="{path}"/>'
        )
    parts.append("</g>")
    for annotation in layout.annotations:
        parts += _words(annotation.text, *place(annotation.x, annotation.y))
    return "\n".join([*parts, "</svg>", ""])


def _path(ends: list[tuple[float, float] | None]) -> str:
    """Join points to lines that are interrupted where there is none."""
    text, starts = [], True
    for end in ends:
        if end is not None:
            text.append(f"{'M' if starts else 'L'}{end[0]:.1f} {end[1]:.1f}")
        starts = end is None
    return "".join(text)


def _words(text: str, x: float, y: float) -> list[str]:
    """Write lines of words in the middle below a place."""
    lines = []
    for row, line in enumerate(text.split("<br>")):
        look = f'font-size="11" fill="{GREY}"' if row else 'font-size="12" font-weight="600"'
        lines.append(
            f'<text x="{x:.1f}" y="{y + (row + 1) * _LINE:.1f}" text-anchor="middle" '
            f'font-family="{_FONT}" {look}>{_TAG.sub("", line)}</text>'
        )
    return lines
