"""Tables 5.1 to 5.9 of Halit 2010: as printed, and what they leave out."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from decimal import Decimal
from typing import Any

import pandas as pd

from workbench.reproduction.halit2010.user_study import N_PARTICIPANTS, Result, printed_table
from workbench.reproduction.published import published
from workbench.study.comparisons import PairedComparison
from workbench.study.published_tests import contradictions

_SIGNIFICANT = 0.05


def differences_table(result: Result) -> pd.DataFrame:
    """Set our mean differences and one-sided p values beside the printed ones.

    Parameters
    ----------
    result : Result
        From :func:`results`.

    Returns
    -------
    DataFrame
        One row per pair. The columns of ours are there only if there are answers.
    """
    mine = {c.label: c for c in result.ours}
    printed = {c.label: c for c in result.theirs}
    rows: dict[str, dict[tuple[str, str], Any]] = {}
    for label in dict.fromkeys([*printed, *mine]):
        our, their = mine.get(label), printed.get(label)
        mean: Any = None if our is None else our.mean_difference
        printed_mean: Any = None if their is None else their.mean_difference
        row = rows[label] = {}
        if mine:
            row["mean difference", "ours"] = mean
        row["mean difference", "published"] = printed_mean
        if mine:
            known = mean is not None and printed_mean is not None
            row["mean difference", "difference"] = mean - printed_mean if known else None
            row["p, one-sided", "ours"] = None if our is None else p_text(our.p_one_sided)
        row["p, one-sided", "published"] = None if their is None else p_text(their.p_one_sided)
    return _frame(rows)


def comparisons_table(comparisons: Sequence[PairedComparison]) -> pd.DataFrame:
    """List what the thesis's tables leave out: intervals, effect sizes, corrected p values.

    Parameters
    ----------
    comparisons : sequence of PairedComparison
        Ours, or those that the printed numbers imply.

    Returns
    -------
    DataFrame
        One row per pair.
    """
    return _frame(
        {
            c.label: {
                "mean difference": c.mean_difference,
                "95 %, low": _known(c.low),
                "95 %, high": _known(c.high),
                "t": _known(c.t),
                "p, two-sided": p_text(c.p_two_sided),
                "p, Holm": p_text(c.p_holm),
                "Cohen's d_z": _known(c.effect_size),
                "Hedges' g_z": _known(c.corrected_effect_size),
                "participants": c.n,
            }
            for c in comparisons
        }
    )


def overview(found: Sequence[Result]) -> pd.DataFrame:
    """Count how many differences of each table hold, as printed and when corrected.

    Returns
    -------
    DataFrame
        One row per table; ours are counted where there are answers.
    """
    rows: dict[str, dict[str, object]] = {}
    for result in found:
        row = rows[f"Table 5.{result.rated.number}, {result.rated.title}"] = {
            "pairs": len(result.theirs),
            "p < 0.05, as printed": _n_significant(result.theirs, "p_one_sided"),
            "two-sided": _n_significant(result.theirs, "p_two_sided"),
            "two-sided, Holm": _n_significant(result.theirs, "p_holm"),
        }
        if any(other.ours for other in found):
            row["ours, two-sided, Holm"] = (
                _n_significant(result.ours, "p_holm") if result.ours else None
            )
        row["contradictions"] = len(contradictions(printed_table(result.rated), N_PARTICIPANTS))
    frame = _frame(rows)
    frame.index.name = "table"
    return frame.astype("Int64")


def differences_caption(result: Result) -> str:
    """Say what :func:`differences_table` shows, and where the printed numbers disagree."""
    wrong = contradictions(printed_table(result.rated), N_PARTICIPANTS)
    means = "The printed mean differences add up and are means of 20 whole numbers" + (
        "." if wrong else ", and their p values do not contradict each other."
    )
    disagree = [f"The printed p values contradict each other: {wrong[0]}."] if wrong else []
    parts = [
        f"Mean differences of ratings (1 to 10), comparison of {result.rated.title} "
        f"(in the thesis: {result.rated.setting}), and p values of paired t tests, one-sided "
        "in the direction of each difference.",
        result.missing or f"Ours: {_participants(result.ours)} of the study file.",
        means,
        *disagree,
        published(result.rated.table_id).note,
    ]
    return " ".join(part for part in parts if part)


def comparisons_caption(result: Result) -> str:
    """Say what :func:`comparisons_table` shows, of our comparisons or of the printed ones."""
    shown = result.ours or result.theirs
    source = (
        f"from the answers of {_participants(result.ours)}"
        if result.ours
        else f"recovered from the printed mean differences and p values, n = {N_PARTICIPANTS}"
    )
    alone, together = _n_significant(shown, "p_one_sided"), _n_significant(shown, "p_holm")
    notes = dict.fromkeys(f"{c.label}: {c.note}" for c in result.ours if c.note)
    return (
        f"Paired t tests of {result.rated.title}, {source}. Below 0.05 are {alone} of "
        f"{len(shown)} one-sided p values, and {together} once they are two-sided and corrected "
        f"for {len(shown)} pairs (Holm). {' '.join(f'{note}.' for note in notes)}"
    ).strip()


def p_text(p: float) -> str:
    """Write a p value with two significant digits, without an exponent.

    Examples
    --------
    >>> p_text(0.000001), p_text(0.0441), p_text(0.5)
    ('0.000001', '0.044', '0.5')
    """
    if p < 1e-6:
        return "< 0.000001"
    return format(Decimal(f"{p:.2g}").normalize(), "f")


def _n_significant(comparisons: Sequence[PairedComparison], p: str) -> int:
    return sum(getattr(comparison, p) < _SIGNIFICANT for comparison in comparisons)


def _participants(comparisons: Sequence[PairedComparison]) -> str:
    counts = sorted({comparison.n for comparison in comparisons})
    span = str(counts[0]) if len(counts) == 1 else f"{counts[0]} to {counts[-1]}"
    return f"{span} participants"


def _known(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _frame(rows: Mapping[str, Mapping[Any, Any]]) -> pd.DataFrame:
    frame = pd.DataFrame(list(rows.values()), index=list(rows))
    first = next(iter(rows.values()))
    if isinstance(next(iter(first)), tuple):
        frame.columns = pd.MultiIndex.from_tuples(list(first))
    frame.index.name = "pair"
    return frame
