"""Paired comparisons of ratings, as in Halit 2010, chapter 5, and what its tables leave out.

The thesis prints, for each pair of stimuli, the mean difference of the ratings and the p value
of a paired t test. Its p values are one-sided, in the direction of the difference found: equal
means are printed as "0/0.5", where a two-sided test gives 1. A direction that is chosen after
looking doubles the chance of a false finding, so the two-sided p stands beside it, corrected
(Holm) for the number of pairs in a table.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import special, stats

from workbench.errors import DegenerateDataWarning, WorkbenchError
from workbench.validation import as_numbers

if TYPE_CHECKING:
    import pandas as pd


#: Differences of ratings, or of means of ratings, that lie closer together differ by rounding.
_ROUNDING = 1e-9


@dataclass(frozen=True)
class PairedComparison:
    """How the ratings of two stimuli by the same participants differ.

    Attributes
    ----------
    first, second : str
        The stimuli; differences are first − second.
    n : int
        Participants who rated both.
    mean_difference, standard_deviation : float
        Of the n differences (the latter with n − 1 in the denominator), in rating points.
    low, high : float
        Confidence interval of the mean difference by Student's t.
    t : float
        mean_difference / (standard_deviation / √n), with n − 1 degrees of freedom.
    p_one_sided : float
        P(T ≥ |t|), as in the thesis.
    p_two_sided : float
        P(|T| ≥ |t|).
    p_holm : float
        The two-sided p, corrected for the pairs that were compared together.
    effect_size : float
        Cohen's d_z = mean_difference / standard_deviation.
    corrected_effect_size : float
        Hedges' g_z, which takes away the bias of d_z in small samples.
    note : str
        What leaves a value undetermined; empty otherwise.
    """

    first: str
    second: str
    n: int
    mean_difference: float
    standard_deviation: float
    low: float
    high: float
    t: float
    p_one_sided: float
    p_two_sided: float
    p_holm: float
    effect_size: float
    corrected_effect_size: float
    note: str = ""

    @property
    def label(self) -> str:
        """What was subtracted from what."""
        return difference_label(self.first, self.second)


def difference_label(first: str, second: str) -> str:
    """Name a difference with a minus sign, which names with hyphens are not mistaken for.

    Examples
    --------
    >>> difference_label("saliency", "t-SNE").isascii()
    False
    """
    return f"{first} \N{MINUS SIGN} {second}"


def compare_pair(
    first_ratings: ArrayLike,
    second_ratings: ArrayLike,
    *,
    names: tuple[str, str] = ("first", "second"),
    confidence: float = 0.95,
) -> PairedComparison:
    """Compare two stimuli by a paired t test, with an interval and an effect size.

    Where all participants give the same difference, t has no denominator: a difference of 0
    gets p = 1 and no t nor effect size, any other an infinite t and p = 0, and both an
    interval of no width; the note says so.

    Parameters
    ----------
    first_ratings, second_ratings : array-like of shape (n_participants,)
        Ratings in the same order of participants; one who lacks either (NaN) is left out.
    names : tuple of str
        What was rated.
    confidence : float
        Level of the interval, between 0 and 1.

    Returns
    -------
    PairedComparison
        With ``p_holm`` equal to ``p_two_sided``: a single test needs no correction.

    Raises
    ------
    WorkbenchError
        If the ratings are no numbers, of two lengths, or fewer than two are paired, or the
        confidence is not between 0 and 1.

    Warns
    -----
    DegenerateDataWarning
        If all differences are equal.

    Examples
    --------
    >>> result = compare_pair([9, 8, 7, 10], [7, 7, 6, 6])
    >>> result.mean_difference, round(result.t, 3), round(result.p_two_sided, 4)
    (2.0, 2.828, 0.0663)
    """
    first = _ratings(first_ratings, "first_ratings")
    second = _ratings(second_ratings, "second_ratings")
    if len(first) != len(second):
        raise WorkbenchError(
            f"second_ratings: got {len(second)} for {len(first)} of the first, "
            "want one from each participant"
        )
    differences = first - second
    differences = differences[~np.isnan(differences)]
    n = len(differences)
    if n < 2:
        raise WorkbenchError(
            f"{names[0]} and {names[1]}: got {n} participants who rated both, want at least 2"
        )
    mean = float(differences.mean())
    # The spread of equal numbers is exactly 0, which means of several ratings do not give.
    equal = bool(np.ptp(differences) <= _ROUNDING)
    deviation = 0.0 if equal else float(differences.std(ddof=1))
    if equal and abs(mean) <= _ROUNDING:
        mean = 0.0
    note = ""
    if equal:
        note = f"all {n} participants gave the same difference, {mean:g}: the t test is undefined"
        warnings.warn(f"{difference_label(*names)}: {note}", DegenerateDataWarning, stacklevel=2)
    return summarize_differences(mean, deviation, n, names=names, confidence=confidence, note=note)


def summarize_differences(
    mean: float,
    standard_deviation: float,
    n: int,
    *,
    names: tuple[str, str],
    confidence: float = 0.95,
    note: str = "",
) -> PairedComparison:
    """Compute a paired t test from the mean and the spread of n differences.

    Parameters
    ----------
    mean, standard_deviation : float
        Of the differences.
    n : int
        How many, at least 2.
    names : tuple of str
        What was rated.
    confidence : float
        Level of the interval, between 0 and 1.
    note : str
        What should be known of the numbers.

    Raises
    ------
    WorkbenchError
        If the confidence is not between 0 and 1.
    """
    if not 0.0 < confidence < 1.0:
        raise WorkbenchError(f"confidence: got {confidence!r}, want a number between 0 and 1")
    freedom = n - 1
    if standard_deviation > 0.0:
        effect = mean / standard_deviation
    else:
        effect = math.copysign(math.inf, mean) if mean else math.nan
    t = effect * math.sqrt(n)
    p = 0.5 if math.isnan(t) else float(stats.t.sf(abs(t), freedom))
    reach = float(stats.t.ppf((1 + confidence) / 2, freedom)) * standard_deviation / math.sqrt(n)
    return PairedComparison(
        first=names[0],
        second=names[1],
        n=n,
        mean_difference=mean,
        standard_deviation=standard_deviation,
        low=mean - reach,
        high=mean + reach,
        t=t,
        p_one_sided=p,
        p_two_sided=2 * p,
        p_holm=2 * p,
        effect_size=effect,
        corrected_effect_size=effect * _hedges_factor(freedom),
        note=note,
    )


def compare_stimuli(ratings: pd.DataFrame, *, confidence: float = 0.95) -> list[PairedComparison]:
    """Compare each pair of stimuli, as one table of the thesis does.

    Parameters
    ----------
    ratings : DataFrame of shape (n_participants, n_stimuli)
        As from :func:`workbench.study.answers.ratings_of`; NaN where there is no answer.
    confidence : float
        Level of each interval, between 0 and 1; intervals are not widened for the number of
        pairs.

    Returns
    -------
    list of PairedComparison
        Earlier columns against later ones, with ``p_holm`` over all of them.

    Raises
    ------
    WorkbenchError
        If there are fewer than two stimuli, or two of them were rated by fewer than two
        participants.

    Warns
    -----
    DegenerateDataWarning
        If all differences of a pair are equal.
    """
    if ratings.shape[1] < 2:
        raise WorkbenchError(f"ratings: got {ratings.shape[1]} stimuli, want at least 2")
    results = [
        compare_pair(
            ratings[first].to_numpy(),
            ratings[second].to_numpy(),
            names=(str(first), str(second)),
            confidence=confidence,
        )
        for first, second in combinations(ratings.columns, 2)
    ]
    return corrected_for_pairs(results)


def corrected_for_pairs(comparisons: Sequence[PairedComparison]) -> list[PairedComparison]:
    """Correct the two-sided p values of comparisons that are made together (Holm)."""
    if not comparisons:
        return []
    corrected = holm([comparison.p_two_sided for comparison in comparisons])
    return [
        replace(comparison, p_holm=float(p))
        for comparison, p in zip(comparisons, corrected, strict=True)
    ]


def holm(p_values: ArrayLike) -> NDArray[np.float64]:
    """Correct p values for multiple tests (Holm 1979, step-down Bonferroni).

    The i-th smallest of m values is multiplied by m − i + 1; none falls below the one before.
    Rejecting where the result is at most α keeps the chance of any false rejection at α,
    however the tests depend on each other.

    Parameters
    ----------
    p_values : array-like of shape (n_tests,)
        Between 0 and 1.

    Returns
    -------
    ndarray of shape (n_tests,)
        Corrected values, at most 1, in the same order.

    Raises
    ------
    WorkbenchError
        If there is none, or one is not between 0 and 1.

    Examples
    --------
    >>> holm([0.01, 0.04, 0.03]).round(3).tolist()
    [0.03, 0.06, 0.06]
    """
    p = as_numbers("p_values", p_values)
    if p.ndim != 1 or len(p) == 0 or not np.all((p >= 0) & (p <= 1)):
        raise WorkbenchError("p_values: want a list of numbers from 0 to 1")
    order = np.argsort(p, kind="stable")
    factors = np.arange(len(p), 0, -1)
    corrected = np.empty_like(p)
    corrected[order] = np.minimum(np.maximum.accumulate(p[order] * factors), 1.0)
    return corrected


def _ratings(values: ArrayLike, name: str) -> NDArray[np.float64]:
    ratings = as_numbers(name, values)
    if ratings.ndim != 1 or np.isinf(ratings).any():
        raise WorkbenchError(f"{name}: want a list of finite ratings, one per participant")
    return ratings


def _hedges_factor(freedom: int) -> float:
    """Compute Γ(m/2) / (√(m/2) Γ((m − 1)/2)) (Hedges 1981), which is 0 for m = 1."""
    if freedom < 2:
        return 0.0
    gammas = special.gammaln(freedom / 2) - special.gammaln((freedom - 1) / 2)
    return float(math.exp(gammas) / math.sqrt(freedom / 2))
