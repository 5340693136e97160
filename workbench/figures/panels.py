"""Panels: embeddings side by side, each framed and in one scale."""

from __future__ import annotations

from collections.abc import Sequence

import plotly.graph_objects as go
from plotly.subplots import make_subplots

from workbench.figures.style import TEMPLATE


def panel_grid(titles: Sequence[str], n_columns: int) -> tuple[go.Figure, list[tuple[int, int]]]:
    """Make empty panels, row by row.

    Both axes of a panel have one scale, since distances in the plane mean something; each
    panel has its own. Axes carry no numbers, since positions mean nothing.

    Parameters
    ----------
    titles : sequence of str
        One for each panel.
    n_columns : int
        Panels in a row.

    Returns
    -------
    figure : plotly.graph_objects.Figure
    places : list of (row, column)
        Where each panel is, as ``add_trace`` takes it.
    """
    n_rows = -(-len(titles) // n_columns)
    figure = make_subplots(
        rows=n_rows,
        cols=n_columns,
        subplot_titles=list(titles),
        horizontal_spacing=0.04 if n_columns < 3 else 0.025,
        vertical_spacing=0.14 / n_rows if n_rows > 1 else 0.0,
    )
    places = [(index // n_columns + 1, index % n_columns + 1) for index in range(len(titles))]
    for row, column in places:
        axis = figure.get_subplot(row, column)
        axis.yaxis.scaleanchor = axis.xaxis.anchor.replace("y", "x")
    frame = {"showticklabels": False, "ticks": "", "showgrid": False, "zeroline": False}
    figure.update_xaxes(**frame, mirror=True, showline=True)
    figure.update_yaxes(**frame, mirror=True, showline=True)
    for row, column in [
        (index // n_columns + 1, index % n_columns + 1)
        for index in range(len(titles), n_rows * n_columns)
    ]:
        figure.update_xaxes(visible=False, row=row, col=column)
        figure.update_yaxes(visible=False, row=row, col=column)
    figure.update_annotations(font_size=13)
    height = {1: 520, 2: 380}.get(n_columns, 300)
    figure.update_layout(
        template=TEMPLATE,
        height=90 + height * n_rows,
        margin={"l": 12, "r": 12, "t": 40, "b": 60},
        legend={"yanchor": "top", "y": -0.03, "itemsizing": "constant"},
    )
    return figure, places
