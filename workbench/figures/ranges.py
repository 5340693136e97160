"""Medians and ranges on a logarithmic axis, for times as in Costa 2018, Figure 5.5."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import plotly.graph_objects as go
from numpy.typing import NDArray

from workbench.errors import WorkbenchError
from workbench.figures.style import PALETTE, TEMPLATE
from workbench.validation import as_numbers, finite

_SYMBOLS = ("circle", "diamond", "square", "triangle-up")

#: Pixels of a category, and above and below all of them.
_ROW_HEIGHT, _AROUND = 58, 130
#: How far apart the series of one category lie, in rows.
_STEP = 0.24


def range_chart(groups: Mapping[str, Mapping[str, Sequence[float]]], *, x_title: str) -> go.Figure:
    """Draw, for each category and series, the median, the quartiles and the range.

    Times differ by orders of magnitude, where bars on a linear axis hide the small ones and
    bars on a logarithmic one have no zero to start from: a dot is the median, a thick line
    leads from quartile to quartile, a thin one from the smallest to the largest value.

    Parameters
    ----------
    groups : mapping of str to mapping of str to sequence of float
        For each series the values of each category, all above 0.
    x_title : str
        What the values are.

    Returns
    -------
    plotly.graph_objects.Figure

    Raises
    ------
    WorkbenchError
        If there is no value, or one that is not above 0.
    """
    categories = list(dict.fromkeys(name for values in groups.values() for name in values))
    if not categories:
        raise WorkbenchError("groups: got no values to draw")
    figure = go.Figure(layout={"template": TEMPLATE})
    for index, (name, by_category) in enumerate(groups.items()):
        shift = _STEP * (index - (len(groups) - 1) / 2)
        rows = [categories.index(category) + shift for category in by_category]
        summaries = [_summary(category, values) for category, values in by_category.items()]
        color = PALETTE[index % len(PALETTE)]
        for low, high, width in ((0, 4, 1.4), (1, 3, 5)):
            figure.add_trace(_segments(summaries, rows, low, high, color, width, name))
        figure.add_trace(
            go.Scatter(
                name=name,
                x=[summary[2] for summary in summaries],
                y=rows,
                mode="markers",
                marker={
                    "symbol": _SYMBOLS[index % len(_SYMBOLS)],
                    "size": 11,
                    "color": "white",
                    "line": {"color": color, "width": 2.4},
                },
                legendgroup=name,
                customdata=list(by_category),
                hovertemplate="%{customdata}: median %{x:.3g}<extra>" + name + "</extra>",
            )
        )
    figure.update_xaxes(
        title_text=x_title,
        type="log",
        range=_range_of(groups),
        dtick="D2",
        exponentformat="power",
    )
    figure.update_yaxes(
        tickvals=list(range(len(categories))),
        ticktext=categories,
        range=[len(categories) - 0.5, -0.5],
        showgrid=False,
        zeroline=False,
        ticks="",
    )
    height = _AROUND + _ROW_HEIGHT * len(categories)
    return figure.update_layout(height=height, margin={"t": 56, "b": 60})


def _range_of(groups: Mapping[str, Mapping[str, Sequence[float]]]) -> list[float]:
    """Find the range of the axis, in powers of ten, with a margin for the dots."""
    every = [v for by_category in groups.values() for vs in by_category.values() for v in vs]
    low, high = np.log10(min(every)), np.log10(max(every))
    margin = 0.05 * (high - low) or 0.5
    return [float(low - margin), float(high + margin)]


def _summary(category: str, values: Sequence[float]) -> NDArray[np.float64]:
    numbers = finite(as_numbers(category, values), category)
    if numbers.size == 0 or (numbers <= 0).any():
        raise WorkbenchError(f"{category}: got {values!r}, want numbers above 0")
    quartiles: NDArray[np.float64] = np.quantile(numbers, [0.0, 0.25, 0.5, 0.75, 1.0])
    return quartiles


def _segments(
    summaries: Sequence[NDArray[np.float64]],
    rows: Sequence[float],
    low: int,
    high: int,
    color: str,
    width: float,
    name: str,
) -> go.Scatter:
    """Draw one line per category, as one trace with gaps."""
    xs = [x for summary in summaries for x in (summary[low], summary[high], None)]
    ys = [y for row in rows for y in (row, row, None)]
    return go.Scatter(
        x=xs,
        y=ys,
        mode="lines",
        line={"color": color, "width": width},
        opacity=0.55,
        hoverinfo="skip",
        legendgroup=name,
        showlegend=False,
    )
