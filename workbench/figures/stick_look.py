"""How stick figures look, wherever they are drawn.

The browser's ``stick_figure.js`` has the same numbers; a test compares them.
"""

from __future__ import annotations

from dataclasses import dataclass

from workbench.figures.style import BLACK, BLUE, VERMILLION
from workbench.mocap.sides import LEFT, MIDDLE, RIGHT

#: Radius of a head as a share of the body's height: about that of a grown-up.
HEAD_RADIUS = 0.062

#: Width of a limb as a share of the body's height, and of the trunk as a multiple of that.
LIMB_WIDTH, TRUNK = 0.024, 1.15

#: Pixels of the thinnest limb: less would fade into the ground where lines are smoothed.
LEAST_WIDTH = 1.6

#: Right limbs are open, so that colour is not all that tells them from left ones: the share of
#: their width that is left open, and the pixels from which on they are wide enough for that.
OPEN_SHARE, OPEN_FROM = 0.34, 3.6

#: Thinner ones are dashed: a dash and a gap, in widths of the line.
DASH = (2.0, 1.7)

#: Still pictures are drawn on white, whatever the theme of the page around them.
PAPER = "white"

#: Colours of limbs, of the trunk (middle), of the ground's lines and of shadows on it, by theme.
COLORS = {
    "light": {
        LEFT: BLUE,
        RIGHT: VERMILLION,
        MIDDLE: BLACK,
        "ground": "#BFC6CE",
        "shadow": "#DDE1E6",
    },
    "dark": {
        LEFT: "#4DA6E0",
        RIGHT: "#FF8540",
        MIDDLE: "#F2F2F2",
        "ground": "#50565D",
        "shadow": "#33383D",
    },
}


@dataclass(frozen=True)
class Stroke:
    """How a line is drawn.

    Attributes
    ----------
    color : str
        As CSS has it.
    width : float
        In pixels.
    dash : str
        Lengths of dashes and gaps, as plotly and SVG have them; empty for a solid line.
    """

    color: str
    width: float
    dash: str = ""


def limb_strokes(side: str, color: str, width: float) -> list[Stroke]:
    """Choose the strokes that draw the bones of one side, each over the one before.

    Parameters
    ----------
    side : {"left", "right", "middle"}
        Of the body.
    color : str
        Of the bones.
    width : float
        In pixels.

    Returns
    -------
    list of Stroke

    Examples
    --------
    >>> [stroke.color for stroke in limb_strokes("right", "#000000", 4.0)]
    ['#000000', 'white']
    """
    if side != RIGHT:
        return [Stroke(color, width)]
    if width < OPEN_FROM:
        return [Stroke(color, width, ",".join(f"{part * width:.1f}px" for part in DASH))]
    return [Stroke(color, width), Stroke(PAPER, OPEN_SHARE * width)]


def limb_width(body_height: float) -> float:
    """Choose the width of limbs.

    Parameters
    ----------
    body_height : float
        Height of the body in the picture, in pixels.

    Returns
    -------
    float
        In pixels.

    Examples
    --------
    >>> limb_width(250), limb_width(44)
    (6.0, 1.6)
    """
    return max(LEAST_WIDTH, LIMB_WIDTH * body_height)
