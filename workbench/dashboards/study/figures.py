"""Figures of a user study's answers, without colours: the page gives them."""

from __future__ import annotations

import math
from html import escape
from typing import TYPE_CHECKING

from scipy import stats

from workbench.study.answers import HIGHEST_RATING, LOWEST_RATING

if TYPE_CHECKING:
    import pandas as pd
    import plotly.graph_objects as go

#: Up to so many participants each gets bars of their own.
_MOST_PARTICIPANTS = 24
_MEAN = "mean"


def rating_bars(ratings: pd.DataFrame, title: str) -> go.Figure:
    """Draw bars of the ratings: the mean of each stimulus, then each participant's.

    The thesis draws each participant's ratings (Figures 5.1 to 5.9). The mean stands before
    them, with its 95 % interval by Student's t; with more than 24 participants it stands alone.

    Parameters
    ----------
    ratings : DataFrame of shape (n_participants, n_stimuli)
        NaN where there is no answer.
    title : str
        What was rated.

    Returns
    -------
    plotly Figure
    """
    import plotly.graph_objects as go

    people = [str(name) for name in ratings.index]
    if len(people) > _MOST_PARTICIPANTS:
        people = []
    figure = go.Figure(layout={"template": "none"})
    for name in ratings.columns:
        known = ratings[name].dropna()
        mean = float(known.mean()) if len(known) else None
        values = [None if math.isnan(value) else float(value) for value in ratings[name]]
        figure.add_bar(
            name=escape(str(name)),
            x=[_MEAN, *people],
            y=[mean, *(values if people else [])],
            error_y={
                "array": [_half_width(known), *([None] * len(people))],
                "color": "rgba(128, 128, 128, 1)",
                "thickness": 1.5,
                "width": 4,
            },
            hovertemplate=f"{escape(str(name))}, %{{x}}: %{{y:.3g}}<extra></extra>",
        )
    figure.update_layout(
        title={"text": escape(title), "font": {"size": 14}, "x": 0, "xref": "paper"},
        xaxis={"type": "category", "title": {"text": "participant"}},
        yaxis={
            "title": {"text": f"rating, {HIGHEST_RATING} is best"},
            "range": [0, HIGHEST_RATING + 0.2],
            "tickvals": [LOWEST_RATING, *range(2, HIGHEST_RATING + 1, 2)],
        },
        barmode="group",
        bargap=0.25,
        height=300,
        margin={"l": 50, "r": 10, "t": 40, "b": 45},
        legend={"orientation": "h", "y": 1.02, "yanchor": "bottom", "x": 1, "xanchor": "right"},
    )
    return figure


def _half_width(values: pd.Series) -> float:
    """Half the width of the 95 % interval of a mean; 0 where one value has none."""
    if len(values) < 2:
        return 0.0
    reach = stats.t.ppf(0.975, len(values) - 1) * values.std(ddof=1) / math.sqrt(len(values))
    return float(reach)
