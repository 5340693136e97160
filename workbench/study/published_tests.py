"""What printed mean differences and p values imply, and where they contradict each other."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from decimal import Decimal
from itertools import combinations

from scipy import stats

from workbench.errors import WorkbenchError
from workbench.study.comparisons import (
    PairedComparison,
    corrected_for_pairs,
    difference_label,
    summarize_differences,
)

#: For each pair of stimuli, the mean difference and the one-sided p value.
PrintedTable = Mapping[tuple[str, str], tuple[float, float]]


def implied_comparison(
    mean_difference: float, p: float, n: int, *, names: tuple[str, str] = ("first", "second")
) -> PairedComparison:
    """Recover a paired t test from its mean difference and one-sided p value.

    t = T⁻¹(1 − p; n − 1), so the standard deviation of the differences is √n · |mean| / t and
    all else follows. A mean of 0 has p = 0.5 at any spread: then there is no interval.

    Parameters
    ----------
    mean_difference : float
        As printed, with its sign.
    p : float
        As printed: one-sided, in the direction of the difference, so at most 0.5.
    n : int
        Number of participants, at least 2.
    names : tuple of str
        What was rated.

    Returns
    -------
    PairedComparison

    Raises
    ------
    WorkbenchError
        If no t test gives these two numbers.

    Examples
    --------
    >>> result = implied_comparison(1.2, 0.004, 20)
    >>> round(result.t, 2), round(result.low, 2), round(result.high, 2)
    (2.96, 0.35, 2.05)
    """
    if n < 2:
        raise WorkbenchError(f"n: got {n}, want at least 2 participants")
    if not 0.0 < p <= 0.5 or (mean_difference == 0.0) != (p == 0.5):
        raise WorkbenchError(
            f"{difference_label(*names)}: got {mean_difference:g} and p = {p:g}, "
            "want p = 0.5 for equal means and 0 < p < 0.5 for others"
        )
    if mean_difference == 0.0:
        at_any_spread = summarize_differences(0.0, 1.0, n, names=names)
        return replace(
            at_any_spread,
            standard_deviation=math.nan,
            low=math.nan,
            high=math.nan,
            note="equal means tell nothing of the spread: no interval",
        )
    deviation = _implied_deviation(mean_difference, p, n)
    return summarize_differences(mean_difference, deviation, n, names=names)


def implied_comparisons(table: PrintedTable, n: int) -> list[PairedComparison]:
    """Recover all tests of a printed table, corrected for their number (Holm).

    Raises
    ------
    WorkbenchError
        If no t test gives a pair's numbers.
    """
    return corrected_for_pairs(
        [implied_comparison(mean, p, n, names=pair) for pair, (mean, p) in table.items()]
    )


def contradictions(table: PrintedTable, n: int) -> list[str]:
    """Find numbers in a printed table that cannot all be right.

    Three things must hold for ratings in whole numbers by the same n participants:

    - a mean difference is a multiple of 1/n (Brown & Heathers 2017);
    - mean differences add up: (a − b) + (b − c) = (a − c);
    - so do the differences of each participant, which makes their standard deviations the
      sides of a triangle: s(a − c) ≤ s(a − b) + s(b − c).

    Parameters
    ----------
    table : mapping of pairs to (mean difference, one-sided p)
        Each pair of stimuli once. All numbers count as rounded to the digits they have.
    n : int
        Number of participants.

    Returns
    -------
    list of str
        One sentence for each contradiction that rounding does not explain.

    Examples
    --------
    >>> table = {("a", "b"): (1.1, 0.04), ("b", "c"): (1.2, 0.03), ("a", "c"): (1.5, 0.01)}
    >>> contradictions(table, 20)
    ['a − b = 1.1 and b − c = 1.2 do not add up to a − c = 1.5']
    """
    found = [
        f"{difference_label(a, b)} = {mean:g} is no mean of {n} whole numbers"
        for (a, b), (mean, _) in table.items()
        if abs(mean * n - round(mean * n)) / n > _half_a_digit(mean)
    ]
    stimuli = list(dict.fromkeys(name for pair in table for name in pair))
    for a, b, c in combinations(stimuli, 3):
        found += _wrong_sum(table, a, b, c)
        for first, between, last in ((a, b, c), (a, c, b), (b, a, c)):
            found += _too_long_side(table, first, between, last, n)
    return found


def _wrong_sum(table: PrintedTable, a: str, b: str, c: str) -> list[str]:
    sides = _sides(table, a, b, c)
    if sides is None:
        return []
    (ab, _), (bc, _), (ac, _) = sides
    rounding = sum(_half_a_digit(mean) for mean, _ in sides)
    if abs(ab + bc - ac) <= rounding + 1e-9:
        return []
    first, second, whole = (difference_label(*pair) for pair in ((a, b), (b, c), (a, c)))
    return [f"{first} = {ab:g} and {second} = {bc:g} do not add up to {whole} = {ac:g}"]


def _too_long_side(table: PrintedTable, a: str, b: str, c: str, n: int) -> list[str]:
    sides = _sides(table, a, b, c)
    if sides is None or any(mean == 0.0 for mean, _ in sides):
        return []
    ab, bc, ac = (_deviation_range(mean, p, n) for mean, p in sides)
    if ac[0] <= ab[1] + bc[1]:
        return []
    return [
        f"p = {sides[2][1]:g} implies that {difference_label(a, c)} has a standard deviation of at "
        f"least {ac[0]:.2f}, but by their p values those of {difference_label(a, b)} and "
        f"{difference_label(b, c)} are at most {ab[1]:.2f} and {bc[1]:.2f}, "
        "whose sum it cannot exceed"
    ]


def _sides(table: PrintedTable, a: str, b: str, c: str) -> list[tuple[float, float]] | None:
    sides = [_directed(table, *pair) for pair in ((a, b), (b, c), (a, c))]
    known = [side for side in sides if side is not None]
    return known if len(known) == 3 else None


def _directed(table: PrintedTable, first: str, second: str) -> tuple[float, float] | None:
    if (first, second) in table:
        return table[first, second]
    if (second, first) in table:
        mean, p = table[second, first]
        return -mean, p
    return None


def _implied_deviation(mean: float, p: float, n: int) -> float:
    return abs(mean) * math.sqrt(n) / float(stats.t.isf(p, n - 1))


def _deviation_range(mean: float, p: float, n: int) -> tuple[float, float]:
    """Find the spreads that round to the printed numbers, as lowest and highest."""
    low = max(abs(mean) - _half_a_digit(mean), 0.0), max(p - _half_a_digit(p), 0.0)
    high = abs(mean) + _half_a_digit(mean), min(p + _half_a_digit(p), 0.5)
    # t is infinite at p = 0 and 0 at p = 0.5.
    lowest = _implied_deviation(low[0], low[1], n) if low[1] > 0 else 0.0
    highest = _implied_deviation(high[0], high[1], n) if high[1] < 0.5 else math.inf
    return lowest, highest


def _half_a_digit(value: float) -> float:
    """Give half a unit of the last digit with which a number is written."""
    exponent = Decimal(repr(float(value))).normalize().as_tuple().exponent
    assert isinstance(exponent, int)  # printed numbers are finite
    return 0.5 * 10.0 ** min(exponent, 0)
