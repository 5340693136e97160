"""Box plots in the manner of Costa 2018, Figure 5.3."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import plotly.graph_objects as go

from workbench.errors import WorkbenchError
from workbench.figures.style import BLACK, OURS, PUBLISHED, TEMPLATE


@dataclass(frozen=True)
class Box:
    """The values that one box shows.

    Attributes
    ----------
    whisker_bottom, q1, median, q3, whisker_top : float
        Ends of the whiskers and quartiles.
    n_outliers : int
        How many values lie beyond the whiskers.
    outliers : tuple of float
        Those values, where they are known.
    """

    whisker_bottom: float
    q1: float
    median: float
    q3: float
    whisker_top: float
    n_outliers: int = 0
    outliers: tuple[float, ...] = ()


def box_plot(
    groups: Mapping[str, Mapping[str, Box]],
    *,
    y_title: str,
    order: tuple[str, ...] | None = None,
    reference: float | None = None,
) -> go.Figure:
    """Draw boxes side by side for one or two sources of the same values.

    The quartiles and whiskers are drawn as given: plotly would compute its own by another
    rule.

    Parameters
    ----------
    groups : mapping of str to mapping of str to Box
        For each source, such as "ours" and "published", the box of each category.
    y_title : str
        What the values are.
    order : tuple of str, optional
        Categories from left to right; by default in the order of their first appearance.
    reference : float, optional
        A value that all are compared with: it gets a line, and the axis the range of the
        values. Without it the axis starts at 0.

    Returns
    -------
    plotly.graph_objects.Figure

    Raises
    ------
    WorkbenchError
        If there is no box.
    """
    categories = list(order or dict.fromkeys(name for boxes in groups.values() for name in boxes))
    if not categories:
        raise WorkbenchError("groups: got no box to draw")
    figure = go.Figure(layout={"template": TEMPLATE, "boxmode": "group", "scattermode": "group"})
    for (source, boxes), color in zip(groups.items(), (OURS, PUBLISHED), strict=False):
        names = [name for name in categories if name in boxes]
        shown = [boxes[name] for name in names]
        figure.add_trace(
            go.Box(
                name=source,
                x=names,
                q1=[box.q1 for box in shown],
                median=[box.median for box in shown],
                q3=[box.q3 for box in shown],
                lowerfence=[box.whisker_bottom for box in shown],
                upperfence=[box.whisker_top for box in shown],
                boxpoints=False,
                line={"color": color, "width": 1.6},
                fillcolor=_faded(color),
                offsetgroup=source,
                legendgroup=source,
            )
        )
        outliers = [(name, value) for name in names for value in boxes[name].outliers]
        if outliers:
            figure.add_trace(
                go.Scatter(
                    name=f"{source}, outliers",
                    x=[name for name, _ in outliers],
                    y=[value for _, value in outliers],
                    mode="markers",
                    marker={"symbol": "circle-open", "size": 7, "color": color},
                    offsetgroup=source,
                    legendgroup=source,
                    showlegend=False,
                    hovertemplate="%{x}: %{y:.3f}<extra>outlier</extra>",
                )
            )
    figure.update_xaxes(categoryorder="array", categoryarray=categories, showgrid=False)
    if reference is None:
        figure.update_yaxes(title_text=y_title, rangemode="tozero", tickformat=".1f")
    else:
        figure.update_yaxes(
            title_text=y_title, tickformat=".2f", range=_range_of(groups, reference)
        )
        figure.add_hline(reference, line={"color": BLACK, "width": 1, "dash": "dot"})
    return figure.update_layout(height=460)


def _range_of(groups: Mapping[str, Mapping[str, Box]], reference: float) -> list[float]:
    """Find the range that shows all values; plotly's own includes 0 where quartiles are given."""
    boxes = [box for source in groups.values() for box in source.values()]
    ends = [(box.whisker_bottom, box.whisker_top, *box.outliers) for box in boxes]
    values = [reference, *(value for end in ends for value in end)]
    low, high = min(values), max(values)
    margin = 0.05 * (high - low) or 0.05
    return [low - margin, high + margin]


def _faded(color: str) -> str:
    red, green, blue = (int(color[i : i + 2], 16) for i in (1, 3, 5))
    return f"rgba({red},{green},{blue},0.18)"
