"""Figures 5.1 to 5.9 of Halit 2010: the answers, or what was published of them."""

from __future__ import annotations

import math

import plotly.graph_objects as go

from workbench.figures.ratings import difference_figure, rating_figure
from workbench.reproduction.halit2010.user_study import N_PARTICIPANTS, Result
from workbench.reproduction.published import published
from workbench.study.comparisons import PairedComparison


def figures(result: Result) -> dict[str, go.Figure]:
    """Draw the answers, if there are any, and the mean differences.

    Returns
    -------
    dict of str to Figure
        The figure of the item under ``""``; the differences under "differences" where the
        answers take that place.
    """
    theirs = {f"published, interval implied by p and n = {N_PARTICIPANTS}": result.theirs}
    if result.ratings is None:
        return {"": difference_figure(theirs)}
    drawn = {"": rating_figure(result.ratings)}
    if result.ours:
        drawn["differences"] = difference_figure({"ours": result.ours, **theirs})
    return drawn


def figure_caption(result: Result, name: str = "") -> str:
    """Say what a figure of :func:`figures` shows."""
    about = f"Comparison of {result.rated.title} (in the thesis: {result.rated.setting})."
    place = published(result.rated.table_id).place
    implied = (
        f"the mean differences printed in {place} with the 95 % intervals that their p values "
        f"imply for {N_PARTICIPANTS} participants"
    )
    if any(math.isnan(comparison.low) for comparison in result.theirs):
        implied += " (open marker: equal means, no interval)"
    if result.ratings is None:
        return f"{about} {result.missing} Shown are {implied}."
    if name:
        return f"{about} Our mean differences with 95 % intervals, and {implied}."
    n = len(result.ratings)
    return (
        f"{about} Ratings of {n} participants of the study file, and below the mean of each "
        "stimulus with its 95 % interval. The thesis draws the ratings of 20 others, which were "
        "not published."
    )


def figure_alt(result: Result, name: str = "") -> str:
    """Tell what a figure of :func:`figures` shows to a reader who does not see it."""
    if result.ratings is not None and not name:
        means = ", ".join(f"{name} {mean:.2f}" for name, mean in result.ratings.mean().items())
        return f"Ratings of {len(result.ratings)} participants. Means: {means}."
    sources = {"ours": result.ours, "published": result.theirs}
    listed = [
        f"{source}: " + "; ".join(_described(c) for c in found)
        for source, found in sources.items()
        if found
    ]
    return f"Mean differences of ratings. {'. '.join(listed)}."


def _described(comparison: PairedComparison) -> str:
    known = math.isfinite(comparison.high - comparison.low)
    low, high = _number(comparison.low), _number(comparison.high)
    interval = f"{low} to {high}" if known else "no interval"
    return f"{comparison.label}: {_number(comparison.mean_difference)} ({interval})"


def _number(value: float) -> str:
    return f"{value:.2f}".replace("-", "\N{MINUS SIGN}")
