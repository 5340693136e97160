"""Paired comparisons agree with scipy and with what can be worked out by hand."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from workbench.errors import DegenerateDataWarning, WorkbenchError
from workbench.study.comparisons import (
    compare_pair,
    compare_stimuli,
    corrected_for_pairs,
    holm,
)


def ratings(seed, n=20, stimuli=2):
    return np.random.default_rng(seed).integers(1, 11, size=(n, stimuli)).astype(float)


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("confidence", [0.9, 0.95])
def test_t_p_and_interval_are_scipys(seed, confidence):
    """The test and the interval are those of scipy.stats.ttest_rel."""
    first, second = ratings(seed).T
    ours = compare_pair(first, second, confidence=confidence)
    theirs = stats.ttest_rel(first, second)
    interval = theirs.confidence_interval(confidence)
    assert ours.t == pytest.approx(theirs.statistic)
    assert ours.p_two_sided == pytest.approx(theirs.pvalue)
    assert (ours.low, ours.high) == pytest.approx((interval.low, interval.high))
    alternative = "greater" if ours.mean_difference > 0 else "less"
    one_sided = stats.ttest_rel(first, second, alternative=alternative).pvalue
    assert ours.p_one_sided == pytest.approx(one_sided)


def test_effect_sizes_by_hand():
    """d_z of the differences 1, 2, 3 is 2; Hedges' factor for 2 degrees of freedom is 1/√π."""
    result = compare_pair([2, 4, 6], [1, 2, 3])
    assert result.effect_size == pytest.approx(2.0)
    assert result.corrected_effect_size == pytest.approx(2.0 / math.sqrt(math.pi))


def test_the_corrected_effect_size_has_no_bias():
    """Over many samples of 5 from a known effect, g_z is right on average and d_z too large."""
    differences = np.random.default_rng(0).normal(1.0, 1.0, size=(20_000, 5))
    d = differences.mean(axis=1) / differences.std(axis=1, ddof=1)
    one = compare_pair([1.0, 2.0, 4.0, 3.0, 5.0], [0.0] * 5)
    factor = one.corrected_effect_size / one.effect_size
    assert (factor * d).mean() == pytest.approx(1.0, abs=0.02)
    assert d.mean() > 1.15


@given(st.integers(0, 1000), st.integers(2, 30))
def test_the_order_of_a_pair_only_turns_signs(seed, n):
    """The test of a − b is that of b − a."""
    first, second = ratings(seed, n).T
    second[0] = first[0] + 1 if np.ptp(first - second) == 0 else second[0]
    there, back = compare_pair(first, second), compare_pair(second, first)
    assert there.t == -back.t
    assert (there.low, there.high) == (-back.high, -back.low)
    assert there.p_two_sided == back.p_two_sided


def test_who_lacks_one_rating_is_left_out():
    """A participant who did not rate both is no pair."""
    first, second = ratings(3).T
    second[4] = np.nan
    kept = np.arange(20) != 4
    assert compare_pair(first, second) == compare_pair(first[kept], second[kept])
    assert compare_pair(first, second).n == 19


def test_equal_ratings_are_no_difference_and_no_test():
    """Identical answers, as the thesis reports for walking, have p = 0.5 and no t."""
    with pytest.warns(DegenerateDataWarning, match="the same difference, 0"):
        result = compare_pair([7.0] * 20, [7.0] * 20)
    assert (result.mean_difference, result.p_one_sided, result.p_two_sided) == (0.0, 0.5, 1.0)
    assert math.isnan(result.t)
    assert math.isnan(result.effect_size)
    assert (result.low, result.high) == (0.0, 0.0)
    assert "undefined" in result.note


@pytest.mark.parametrize("shift", [-2.0, 0.1], ids=["below", "above, not exact in binary"])
def test_one_constant_difference_has_no_spread(shift):
    """An equal difference of all is said to leave t without a denominator."""
    first = np.arange(1.0, 9.0)
    with pytest.warns(DegenerateDataWarning, match="all 8 participants"):
        result = compare_pair(np.full(8, shift), np.zeros(8))
    assert result.t == math.copysign(math.inf, shift)
    assert result.p_two_sided == 0.0
    assert result.low == result.high == pytest.approx(shift)
    assert compare_pair(first, first[::-1]).note == ""


@pytest.mark.parametrize(
    ("first", "second", "difference"),
    [([26 / 3, 22 / 3], [23 / 3, 19 / 3], 1.0), ([0.1 + 0.2, 0.3], [0.3, 0.3], 0.0)],
    ids=["all 1", "all 0"],
)
def test_means_that_differ_equally_but_for_rounding_have_no_spread(first, second, difference):
    """As means of three ratings do, whose differences differ in the last digit."""
    assert np.ptp(np.subtract(first, second)) > 0
    with pytest.warns(DegenerateDataWarning, match="all 2 participants"):
        result = compare_pair(first, second)
    assert result.standard_deviation == 0.0
    assert result.mean_difference == pytest.approx(difference)
    assert math.isinf(result.t) if difference else math.isnan(result.t)


@pytest.mark.parametrize(
    ("first", "second", "message"),
    [
        ([1, 2, 3], [1, 2], "second_ratings: got 2 for 3"),
        ([1, np.nan], [np.nan, 2], "got 0 participants who rated both, want at least 2"),
        ([1], [2], "got 1 participants"),
        (["a", "b"], [1, 2], "first_ratings: got what is no array"),
        ([1, 2], [1, np.inf], "second_ratings: want a list of finite ratings"),
        ([[1, 2]], [1, 2], "first_ratings: want a list"),
    ],
)
def test_what_is_no_pairing_is_refused(first, second, message):
    """No message of numpy reaches the reader."""
    with pytest.raises(WorkbenchError, match=message):
        compare_pair(first, second)


@pytest.mark.parametrize("confidence", [0.0, 1.0, 95, float("nan")])
def test_a_level_beyond_0_and_1_is_refused(confidence):
    """95 is not taken for 95 %."""
    with pytest.raises(WorkbenchError, match="confidence: got"):
        compare_pair([1, 2], [2, 4], confidence=confidence)


def test_a_table_compares_each_pair_once():
    """Pairs stand as in the thesis, earlier stimuli against later ones, corrected together."""
    names = ["original", "saliency", "decimation", "simplification"]
    table = pd.DataFrame(ratings(1, stimuli=4), columns=names)
    results = compare_stimuli(table)
    assert [(r.first, r.second) for r in results] == [
        (names[i], names[j]) for i in range(4) for j in range(i + 1, 4)
    ]
    assert [r.p_holm for r in results] == holm([r.p_two_sided for r in results]).tolist()
    assert results[1].mean_difference == pytest.approx(
        table["original"].mean() - table["decimation"].mean()
    )
    with pytest.raises(WorkbenchError, match="got 1 stimuli, want at least 2"):
        compare_stimuli(table[["original"]])
    assert corrected_for_pairs([]) == []


def naive_holm(p):
    """Correct each value by the definition: the largest factor that stands before it."""
    return [min(1.0, max((len(p) - sum(q < b for q in p)) * b for b in p if b <= a)) for a in p]


@given(st.lists(st.integers(0, 100).map(lambda i: i / 100), min_size=1, max_size=8))
def test_holm_follows_its_definition(p):
    """Each value is the largest corrected one among those not above it; order does not count."""
    assert holm(p) == pytest.approx(naive_holm(p))


def test_holm_keeps_the_chance_of_a_false_finding():
    """With six true hypotheses, at most one study in twenty rejects any."""
    p = np.random.default_rng(0).random((4000, 6))
    share = np.mean([holm(row).min() <= 0.05 for row in p])
    assert 0.035 < share < 0.06


@pytest.mark.parametrize("p", [[], [1.1], [-0.1], [float("nan")], [[0.1]]])
def test_what_is_no_p_value_is_refused(p):
    """Only numbers from 0 to 1 are corrected."""
    with pytest.raises(WorkbenchError, match="p_values: want"):
        holm(p)
