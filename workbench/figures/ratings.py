"""Answers of a user study, and the differences of ratings that they add up to."""

from __future__ import annotations

import html
import math
from collections.abc import Iterable, Mapping, Sequence
from textwrap import wrap
from typing import TYPE_CHECKING

import numpy as np
import plotly.graph_objects as go
from plotly.subplots import make_subplots
from scipy import stats

from workbench.errors import WorkbenchError
from workbench.figures.style import GREY, OURS, PALETTE, PUBLISHED, SYMBOLS, TEMPLATE
from workbench.study.answers import HIGHEST_RATING, LOWEST_RATING
from workbench.study.comparisons import PairedComparison

if TYPE_CHECKING:
    import pandas as pd

#: Pixels for each participant, for each row of means or differences, and for the rest.
_PARTICIPANT, _ROW, _FRAME = 26, 34, 130
#: Differences that every axis shows, so that the figures of one study have about one scale.
_AT_LEAST = (-1.0, 3.0)
_BAND = "#F4F6F8"
_LINE = "#D5DAE0"
_MINUS = "\N{MINUS SIGN}"


def rating_figure(ratings: pd.DataFrame) -> go.Figure:
    """Draw each participant's rating of each stimulus, and the mean of each stimulus below.

    A row for each participant, in the manner of Cleveland's dot plots: equal ratings do not
    hide each other, and a stimulus is known by its colour, its symbol and its place in the cell.
    The means have 95 % intervals by Student's t.

    Parameters
    ----------
    ratings : DataFrame of shape (n_participants, n_stimuli)
        As from :func:`workbench.study.answers.ratings_of`; NaN where there is no answer.

    Returns
    -------
    plotly.graph_objects.Figure

    Raises
    ------
    WorkbenchError
        If there is no rating.
    """
    if not np.isfinite(ratings.to_numpy(dtype=float)).any():
        raise WorkbenchError("ratings: got none to draw")
    n_participants, n_stimuli = ratings.shape
    above, below = n_participants * _PARTICIPANT, n_stimuli * _ROW
    figure = make_subplots(
        rows=2,
        shared_xaxes=True,
        row_heights=[above, below],
        vertical_spacing=36 / (above + below + 36),
    )
    for index, name in enumerate(ratings.columns):
        _add_stimulus(figure, index, n_stimuli, str(name), ratings[name])
    for row in range(0, n_participants, 2):
        band = {"y0": row - 0.5, "y1": row + 0.5, "fillcolor": _BAND, "line_width": 0}
        figure.add_hrect(**band, layer="below", row=1, col=1)
    figure.update_yaxes(
        title_text="participant",
        tickvals=list(range(n_participants)),
        ticktext=_as_text(ratings.index),
        range=[n_participants - 0.5, -0.5],
        showgrid=False,
        zeroline=False,
        row=1,
        col=1,
    )
    figure.update_yaxes(
        title_text="mean",
        tickvals=list(range(n_stimuli)),
        # In short lines, so that the labels leave room on a phone.
        ticktext=["<br>".join(map(_plain, wrap(str(name), 14))) for name in ratings.columns],
        range=[n_stimuli - 0.5, -0.5],
        showgrid=False,
        zeroline=False,
        row=2,
        col=1,
    )
    figure.update_xaxes(
        range=[LOWEST_RATING - 0.5, HIGHEST_RATING + 0.5],
        tickvals=list(range(LOWEST_RATING, HIGHEST_RATING + 1)),
        zeroline=False,
    )
    # Lines between the ratings, as in a table: inside of a cell the place means the stimulus.
    between = [rating + 0.5 for rating in range(LOWEST_RATING - 1, HIGHEST_RATING + 1)]
    figure.update_xaxes(
        showgrid=False,
        showticklabels=True,
        minor={"tickvals": between, "showgrid": True, "gridcolor": _LINE, "ticks": ""},
        row=1,
        col=1,
    )
    figure.update_xaxes(title_text=f"rating ({HIGHEST_RATING} is best)", row=2, col=1)
    return figure.update_layout(template=TEMPLATE, height=above + below + 36 + _FRAME)


def difference_figure(sources: Mapping[str, Sequence[PairedComparison]]) -> go.Figure:
    """Draw mean differences of ratings, in points, with their intervals, pair by pair.

    Parameters
    ----------
    sources : mapping of str to sequence of PairedComparison
        For each source, such as "ours" and "published", its comparisons. Pairs stand in the
        order of their first appearance; a difference whose interval is unknown is an open
        marker.

    Returns
    -------
    plotly.graph_objects.Figure

    Raises
    ------
    WorkbenchError
        If there is no comparison.
    """
    labels = list(dict.fromkeys(c.label for found in sources.values() for c in found))
    if not labels:
        raise WorkbenchError("sources: got no comparison to draw")
    figure = go.Figure(layout={"template": TEMPLATE})
    n_sources = len(sources)
    for index, (source, comparisons) in enumerate(sources.items()):
        # A single source is the published one where ours is missing; colours mean sources.
        color = PUBLISHED if source.startswith("published") else OURS
        shift = _shift(index, n_sources)
        known = [math.isfinite(c.high - c.low) for c in comparisons]
        reach = [
            (c.high - c.low) / 2 if k else None for c, k in zip(comparisons, known, strict=True)
        ]
        figure.add_trace(
            go.Scatter(
                name=_plain(source),
                x=[c.mean_difference for c in comparisons],
                y=[labels.index(c.label) + shift for c in comparisons],
                error_x={"array": reach, "color": color, "thickness": 2, "width": 5},
                mode="markers",
                marker={
                    "size": 10,
                    "color": [color if k else "white" for k in known],
                    "line": {"width": 2, "color": color},
                },
                customdata=[_described(c) for c in comparisons],
                hovertemplate="%{customdata}<extra></extra>",
                showlegend=True,
            )
        )
    figure.update_yaxes(
        tickvals=list(range(len(labels))),
        # In two lines, for the same reason.
        ticktext=[_plain(label).replace(f" {_MINUS} ", f" {_MINUS}<br>") for label in labels],
        range=[len(labels) - 0.5, -0.5],
        showgrid=False,
        zeroline=False,
    )
    ends = [end for found in sources.values() for c in found for end in (c.low, c.high)]
    low, high = np.nanmin([*ends, _AT_LEAST[0]]), np.nanmax([*ends, _AT_LEAST[1]])
    figure.update_xaxes(
        title_text="mean rating difference",
        range=[low - 0.1, high + 0.1],
        zerolinecolor=GREY,
        zerolinewidth=1.5,
    )
    return figure.update_layout(height=_FRAME + len(labels) * max(_ROW + 10, 26 * n_sources))


def _add_stimulus(
    figure: go.Figure, index: int, n_stimuli: int, name: str, ratings: pd.Series
) -> None:
    """Add the answers on one stimulus and their mean."""
    values = ratings.to_numpy(dtype=float)
    rated = np.flatnonzero(np.isfinite(values))
    marker = {
        "color": PALETTE[index % len(PALETTE)],
        "symbol": SYMBOLS[index % len(SYMBOLS)],
        "size": 8,
        "line": {"width": 0.5, "color": "white"},
    }
    participants = _as_text(ratings.index)
    answers = [(participants[row], f"{values[row]:g}") for row in rated]
    figure.add_trace(
        go.Scatter(
            name=_plain(name),
            x=values[rated] + _shift(index, n_stimuli),
            y=rated + _shift(index, n_stimuli),
            mode="markers",
            marker=marker,
            customdata=answers,
            hovertemplate=(
                f"participant %{{customdata[0]}}: %{{customdata[1]}}<extra>{_plain(name)}</extra>"
            ),
        ),
        row=1,
        col=1,
    )
    if not len(rated):
        return
    mean = float(values[rated].mean())
    figure.add_trace(
        go.Scatter(
            x=[mean],
            y=[index],
            error_x={"array": [_reach(values[rated])], "thickness": 2, "width": 5},
            mode="markers",
            marker={**marker, "size": 11},
            showlegend=False,
            hovertemplate=f"mean of {len(rated)}: %{{x:.2f}}<extra>{_plain(name)}</extra>",
        ),
        row=2,
        col=1,
    )


def _reach(values: np.ndarray) -> float:
    """Half the width of the 95 % interval of a mean; 0 where one value has none."""
    if len(values) < 2:
        return 0.0
    return float(stats.t.ppf(0.975, len(values) - 1) * values.std(ddof=1) / math.sqrt(len(values)))


def _shift(index: int, count: int) -> float:
    """Place one of several things side by side in a row of height 1."""
    return 0.7 * (index - (count - 1) / 2) / count


def _described(comparison: PairedComparison) -> str:
    known = math.isfinite(comparison.high - comparison.low)
    interval = f", {comparison.low:.2f} to {comparison.high:.2f}" if known else ", no interval"
    return (
        f"{_plain(comparison.label)}: {comparison.mean_difference:.2f}{interval}, "
        f"one-sided p {comparison.p_one_sided:.2g}"
    )


def _as_text(names: Iterable[object]) -> list[str]:
    return [_plain(str(name)) for name in names]


def _plain(text: str) -> str:
    """Keep plotly from reading markup or a field to fill in."""
    return html.escape(text, quote=False).replace("{", "&#123;")
