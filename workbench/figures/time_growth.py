"""Running time against the size of the data, with a straight line, as in Halit 2010, Figure 4.2."""

from __future__ import annotations

import numpy as np
import pandas as pd
import plotly.graph_objects as go

from workbench.errors import WorkbenchError
from workbench.figures.style import BLACK, OURS, TEMPLATE


def time_growth(seconds: pd.DataFrame, *, x_title: str, note: str = "") -> go.Figure:
    """Draw the median time of each size with its range, and the line of least squares.

    Parameters
    ----------
    seconds : DataFrame of shape (n_repetitions, n_sizes)
        Times; the columns are the sizes.
    x_title : str
        What the sizes are.
    note : str
        Written into the figure, such as what was published.

    Returns
    -------
    plotly.graph_objects.Figure

    Raises
    ------
    WorkbenchError
        If there are fewer than 2 sizes.
    """
    if seconds.shape[1] < 2 or seconds.empty:
        raise WorkbenchError(f"seconds: got {seconds.shape[1]} sizes, want at least 2")
    sizes = seconds.columns.to_numpy(float)
    medians = seconds.median().to_numpy(float)
    slope, start = np.polyfit(sizes, medians, 1)
    ends = np.array([sizes.min(), sizes.max()])
    figure = go.Figure(layout={"template": TEMPLATE, "height": 440})
    figure.add_trace(
        go.Scatter(
            name=f"line of least squares: {1e6 * slope:.1f} µs per frame",
            x=ends,
            y=start + slope * ends,
            mode="lines",
            line={"color": BLACK, "width": 1.4, "dash": "dash"},
            hoverinfo="skip",
        )
    )
    figure.add_trace(
        go.Scatter(
            name="median, least and most of the repetitions",
            x=sizes,
            y=medians,
            mode="markers",
            marker={"color": OURS, "size": 9},
            error_y={
                "array": seconds.max().to_numpy(float) - medians,
                "arrayminus": medians - seconds.min().to_numpy(float),
                "color": OURS,
                "thickness": 1.4,
                "width": 4,
            },
            hovertemplate="%{x:,}: %{y:.3f} s<extra></extra>",
        )
    )
    if note:
        figure.add_annotation(
            text=note,
            xref="paper",
            yref="paper",
            x=0.02,
            y=0.97,
            showarrow=False,
            align="left",
            xanchor="left",
            yanchor="top",
            font={"size": 12},
        )
    figure.update_xaxes(title_text=x_title, rangemode="tozero", tickformat=",", showgrid=False)
    figure.update_yaxes(title_text="seconds", rangemode="tozero")
    return figure
