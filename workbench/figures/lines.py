"""Line charts as small multiples, in the manner of Costa 2018, Figure 5.1."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

import plotly.graph_objects as go
from plotly.subplots import make_subplots

from workbench.errors import WorkbenchError
from workbench.figures.style import BLACK, PALETTE, TEMPLATE
from workbench.validation import whole_number

#: Each line is told from the others without its colour too.
_SYMBOLS = ("circle", "square", "diamond", "triangle-up", "triangle-down", "cross", "x")

_BAND = "#EEF1F4"

#: Pixels of a panel, and above and below all of them.
_PANEL_HEIGHT, _AROUND = 240, 140


@dataclass(frozen=True)
class LinePanel:
    """One chart.

    Attributes
    ----------
    title : str
        Shown above; ``<br>`` breaks a line, which keeps panels readable on a phone.
    lines : mapping of str to mapping of float to float
        For each line its values: y by x.
    """

    title: str
    lines: Mapping[str, Mapping[float, float]]


def line_panels(
    panels: Sequence[LinePanel],
    *,
    x_title: str,
    y_title: str,
    n_columns: int = 2,
    dashed: Collection[str] = (),
    band: tuple[float, float] | None = None,
) -> go.Figure:
    """Draw charts side by side; lines of one name look alike in all of them.

    Parameters
    ----------
    panels : sequence of LinePanel
        The charts, row by row. Each has its own y-axis, which starts at 0.
    x_title, y_title : str
        What the values are.
    n_columns : int
        Charts in a row.
    dashed : collection of str
        Names of the lines that are dashed, to tell two families apart.
    band : (float, float), optional
        Part of the x-axis that the reader should look at, shaded.

    Returns
    -------
    plotly.graph_objects.Figure

    Raises
    ------
    WorkbenchError
        If there is no line, or the number of columns is not at least 1.
    """
    columns = min(whole_number("n_columns", n_columns), len(panels))
    names = list(dict.fromkeys(name for panel in panels for name in panel.lines))
    if not names:
        raise WorkbenchError("panels: got none with a line, want at least one")
    n_rows = -(-len(panels) // columns)
    height = _AROUND + _PANEL_HEIGHT * n_rows
    figure = make_subplots(
        rows=n_rows,
        cols=columns,
        subplot_titles=[panel.title for panel in panels],
        horizontal_spacing=0.14 / columns,
        vertical_spacing=84 / (height - _AROUND) if n_rows > 1 else 0.0,
    )
    shown: set[str] = set()
    for index, panel in enumerate(panels):
        place = {"row": index // columns + 1, "col": index % columns + 1}
        for name, values in panel.lines.items():
            style = names.index(name)
            figure.add_trace(
                go.Scatter(
                    name=name,
                    x=list(values),
                    y=list(values.values()),
                    mode="lines+markers",
                    line={
                        "color": PALETTE[style % len(PALETTE)],
                        "width": 1.8,
                        "dash": "dot" if name in dashed else "solid",
                    },
                    marker={"symbol": _SYMBOLS[style % len(_SYMBOLS)], "size": 6},
                    legendgroup=name,
                    showlegend=name not in shown,
                    hovertemplate="%{x:g}: %{y:.3f}<extra>" + name + "</extra>",
                ),
                **place,
            )
            shown.add(name)
        if band is not None and panel.lines:
            figure.add_vrect(*band, fillcolor=_BAND, line_width=0, layer="below", **place)
    figure.update_annotations(font={"size": 13, "color": BLACK})
    figure.update_yaxes(rangemode="tozero", nticks=5)
    figure.update_yaxes(title_text=y_title, col=1)
    for column in range(1, columns + 1):
        lowest = (len(panels) - column) // columns + 1
        figure.update_xaxes(title_text=x_title, row=lowest, col=column)
    legend = {"y": 1 + 40 / (height - _AROUND), "itemwidth": 40}
    return figure.update_layout(
        template=TEMPLATE, height=height, legend=legend, margin={"t": 88, "b": 52}
    )
