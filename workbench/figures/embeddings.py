"""Scatter panels of embeddings, in the manner of Costa 2018, Figures 5.12 to 5.17."""

from __future__ import annotations

import html
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import plotly.graph_objects as go
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.figures.panels import panel_grid
from workbench.figures.style import BLACK, BLUE, class_style

#: Marker of a control point, and what draws nothing but an entry of the legend.
CROSS = {"symbol": "x", "size": 9, "color": "white", "line": {"color": BLACK, "width": 1}}
LEGEND_ONLY = {"x": [None], "y": [None], "mode": "markers"}

#: Points of a panel above which drawing them as vectors makes a page slow.
_MANY = 3000
#: Control points of a panel above which their crosses are drawn smaller, to hide less.
_CROWDED = 100


@dataclass(frozen=True, eq=False)
class Panel:
    """One embedding and what to call it.

    Attributes
    ----------
    title : str
        Shown above.
    points : ndarray of shape (n_samples, 2)
        Positions.
    control_points : ndarray of shape (n_control_points,)
        Indices of the samples that are drawn as crosses.
    """

    title: str
    points: NDArray[np.float64]
    control_points: NDArray[np.intp]


def embedding_panels(
    panels: Sequence[Panel],
    *,
    labels: ArrayLike | None = None,
    styles: Mapping[str, tuple[str, str]] | None = None,
    n_columns: int = 2,
) -> go.Figure:
    """Draw embeddings of the same samples side by side.

    Samples are dots in the colour of their class, control points crosses. Both axes have
    one scale, since distances in the plane mean something; each panel has its own.

    Parameters
    ----------
    panels : sequence of Panel
        The embeddings, row by row.
    labels : array-like of shape (n_samples,), optional
        Class of each sample. Classes take their colours in the order of their first sample.
    styles : mapping of str to (colour, symbol), optional
        What classes look like, in the order of the legend, in place of those colours; the
        last are drawn above the others. Classes that are not named follow.
    n_columns : int
        Panels in a row.

    Returns
    -------
    plotly.graph_objects.Figure

    Raises
    ------
    WorkbenchError
        If there is no panel, or labels or positions are not one for each sample.
    """
    if not panels:
        raise WorkbenchError("panels: got none, want at least one embedding")
    n_samples = len(panels[0].points)
    classes = np.full(n_samples, "sample") if labels is None else np.asarray(labels).astype(str)
    for panel in panels:
        if panel.points.shape != (n_samples, 2) or len(classes) != n_samples:
            raise WorkbenchError(
                f"panel {panel.title!r}: got points of shape {panel.points.shape} and "
                f"{len(classes)} labels, want ({n_samples}, 2) and {n_samples}"
            )
    shown_as = _styles_of(classes, styles or {})
    figure, places = panel_grid([panel.title for panel in panels], n_columns)
    for index, (panel, (row, column)) in enumerate(zip(panels, places, strict=True)):
        for trace in _panel_traces(panel, classes, shown_as, first=index == 0):
            figure.add_trace(trace, row=row, col=column)
    return figure


def _styles_of(
    classes: NDArray[np.str_], given: Mapping[str, tuple[str, str]]
) -> dict[str, tuple[str, str]]:
    """Find colour and symbol of each class that has a sample."""
    names = list(dict.fromkeys(classes.tolist()))
    if len(names) == 1 and not given:
        return {names[0]: (BLUE, "circle")}
    found = {name: style for name, style in given.items() if name in names}
    others = [name for name in names if name not in found]
    return found | {name: class_style(len(found) + i) for i, name in enumerate(others)}


def _panel_traces(
    panel: Panel, classes: NDArray[np.str_], styles: Mapping[str, tuple[str, str]], *, first: bool
) -> list[go.Scatter | go.Scattergl]:
    """Draw dots class by class, and above them the control points as crosses."""
    scatter = go.Scattergl if len(classes) > _MANY else go.Scatter
    is_control = np.zeros(len(classes), dtype=bool)
    is_control[panel.control_points] = True
    cross_size = CROSS["size"] if len(panel.control_points) <= _CROWDED else 6
    dots: list[go.Scatter | go.Scattergl] = []
    crosses: list[go.Scatter | go.Scattergl] = []
    for name, (color, symbol) in styles.items():
        shown = _as_text(name)
        for control in (False, True):
            chosen = np.flatnonzero((classes == name) & (is_control == control))
            if len(chosen) == 0 and control:
                continue
            trace = scatter(
                name=shown,
                x=panel.points[chosen, 0],
                y=panel.points[chosen, 1],
                customdata=chosen,
                mode="markers",
                legendgroup=name,
                showlegend=first and not control,
                marker=(
                    {**CROSS, "color": color, "size": cross_size}
                    if control
                    else {"symbol": symbol, "size": 5, "color": color, "opacity": 0.75}
                ),
                hovertemplate=f"{shown}, sample %{{customdata}}"
                + (" (control point)" if control else "")
                + "<extra></extra>",
            )
            (crosses if control else dots).append(trace)
    if first:
        crosses.append(go.Scatter(name="control point", marker=CROSS, **LEGEND_ONLY))
    return dots + crosses


def _as_text(name: str) -> str:
    """Keep plotly from reading tags, entities or the fields of a template in a name."""
    return html.escape(name, quote=False).replace("{", "&#123;")
