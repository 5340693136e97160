"""Grouped bars, in the manner of Costa 2018, Figures 5.2 and 5.4."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import plotly.graph_objects as go
from plotly.subplots import make_subplots

from workbench.errors import WorkbenchError
from workbench.figures.style import BLACK, PALETTE, TEMPLATE

#: Pixels of a panel, above and below all of them, and of a title.
_PANEL_HEIGHT, _TOP, _BOTTOM, _TITLE = 260, 76, 44, 26


@dataclass(frozen=True)
class Reference:
    """A value that all bars are compared with, drawn as a line across the panels.

    Attributes
    ----------
    value : float
        Where it is.
    name : str
        What it is, for the legend.
    """

    value: float
    name: str


def bar_panels(
    panels: Mapping[str, Mapping[str, Mapping[str, float]]],
    *,
    y_title: str,
    colors: Mapping[str, str] | None = None,
    reference: Reference | None = None,
) -> go.Figure:
    """Draw groups of bars, one panel below the other on one scale.

    Parameters
    ----------
    panels : mapping of str to mapping of str to mapping of str to float
        For each panel, by its title (which may be empty), the series; for each series, which
        has one colour in all panels, its value in each group.
    y_title : str
        What the values are. Bars start at 0.
    colors : mapping of str to str, optional
        Colours of series; by default those of the palette in their order.
    reference : Reference, optional
        A line across all panels.

    Returns
    -------
    plotly.graph_objects.Figure

    Raises
    ------
    WorkbenchError
        If there is no bar.
    """
    names = list(dict.fromkeys(name for series in panels.values() for name in series))
    values = [
        value for series in panels.values() for bars in series.values() for value in bars.values()
    ]
    if not values:
        raise WorkbenchError("panels: got no bar to draw")
    chosen = {name: PALETTE[index % len(PALETTE)] for index, name in enumerate(names)}
    chosen.update(colors or {})
    top = _TOP if any(panels) else _TOP - _TITLE
    height = top + _BOTTOM + _PANEL_HEIGHT * len(panels)
    figure = make_subplots(
        rows=len(panels),
        cols=1,
        subplot_titles=list(panels) if any(panels) else None,
        vertical_spacing=64 / (height - top - _BOTTOM) if len(panels) > 1 else 0.0,
    )
    shown: set[str] = set()
    for row, series in enumerate(panels.values(), 1):
        for name, bars in series.items():
            figure.add_trace(
                go.Bar(
                    name=name,
                    x=list(bars),
                    y=list(bars.values()),
                    marker={"color": chosen[name], "line": {"width": 0}},
                    legendgroup=name,
                    showlegend=name not in shown,
                    hovertemplate="%{x}: %{y:.3f}<extra>" + name + "</extra>",
                ),
                row=row,
                col=1,
            )
            shown.add(name)
    if reference is not None:
        _draw_reference(figure, reference, len(panels))
    figure.update_annotations(font={"size": 13, "color": BLACK}, x=0, xanchor="left")
    figure.update_xaxes(showgrid=False, ticks="")
    highest = max([*values, *([reference.value] if reference else [])])
    figure.update_yaxes(title_text=y_title, range=[0, 1.06 * highest], nticks=6)
    return figure.update_layout(
        template=TEMPLATE,
        height=height,
        bargap=0.22,
        bargroupgap=0.06,
        legend={"y": 1 + (top - 42) / (height - top - _BOTTOM), "traceorder": "normal"},
        margin={"t": top, "b": _BOTTOM},
    )


def _draw_reference(figure: go.Figure, reference: Reference, n_rows: int) -> None:
    line = {"color": BLACK, "width": 1.2, "dash": "dash"}
    for row in range(1, n_rows + 1):
        figure.add_hline(reference.value, line=line, row=row, col=1)
    # A shape has no entry in the legend.
    figure.add_trace(
        go.Scatter(name=reference.name, x=[None], y=[None], mode="lines", line=line), row=1, col=1
    )
