"""The one style of all figures: colours that colour-blind readers can tell apart, on white.

Colours are those of Okabe & Ito (2008), ordered so that the first three match the blue,
green and red in which the theses draw classes.
"""

from __future__ import annotations

import plotly.graph_objects as go

BLUE = "#0072B2"
GREEN = "#009E73"
VERMILLION = "#D55E00"
PURPLE = "#CC79A7"
SKY = "#56B4E9"
ORANGE = "#E69F00"
GREY = "#6E7781"
BLACK = "#1B1F24"

#: Colours of classes, in order; more classes repeat them with the next of :data:`SYMBOLS`.
PALETTE = (BLUE, GREEN, VERMILLION, PURPLE, SKY, ORANGE, BLACK)

#: Marker symbols; each is told from the others in black and white too.
SYMBOLS = ("circle", "diamond", "triangle-up", "square")

#: Our values, and those printed in a thesis.
OURS = BLUE
PUBLISHED = ORANGE

FONT = "Inter, 'Segoe UI', 'Helvetica Neue', Helvetica, Arial, sans-serif"

_AXIS = {
    "gridcolor": "#E6E9ED",
    "linecolor": "#AEB6BF",
    "zerolinecolor": "#E6E9ED",
    "ticks": "outside",
    "tickcolor": "#AEB6BF",
    "ticklen": 4,
    "automargin": True,
    "title": {"standoff": 8},
}

TEMPLATE = go.layout.Template(
    layout={
        "font": {"family": FONT, "size": 13, "color": BLACK},
        "paper_bgcolor": "white",
        "plot_bgcolor": "white",
        "colorway": PALETTE,
        "xaxis": _AXIS,
        "yaxis": _AXIS,
        "margin": {"l": 56, "r": 16, "t": 40, "b": 48},
        "legend": {
            "orientation": "h",
            "yanchor": "bottom",
            "y": 1.02,
            "x": 0,
            "title": {"text": ""},
        },
        "hoverlabel": {"font": {"family": FONT}},
    }
)


def class_style(index: int) -> tuple[str, str]:
    """Choose the colour and symbol of a class.

    Parameters
    ----------
    index : int
        Number of the class, from 0.

    Returns
    -------
    colour, symbol : str

    Examples
    --------
    >>> class_style(0), class_style(7)
    (('#0072B2', 'circle'), ('#0072B2', 'diamond'))
    """
    return (
        PALETTE[index % len(PALETTE)],
        SYMBOLS[index // len(PALETTE) % len(SYMBOLS)],
    )


def offer_no_upload() -> None:
    """Take from figures that notebooks show the button that uploads them.

    plotly.js has it unless it is told not to; what is shown here stays on this machine.
    """
    # Imported here: it takes seconds, by way of nbformat, and only who shows a figure needs it.
    import plotly.io

    for name in plotly.io.renderers:
        config = getattr(plotly.io.renderers[name], "config", None)
        if isinstance(config, dict):
            config["showSendToCloud"] = False
