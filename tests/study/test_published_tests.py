"""What printed means and p values imply is what the answers behind them would give."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from workbench.errors import WorkbenchError
from workbench.study.comparisons import compare_stimuli
from workbench.study.published_tests import (
    contradictions,
    implied_comparison,
    implied_comparisons,
)


def printed(seed, n=20, digits=4, stimuli=4):
    """Print a table of random answers as the thesis prints its own."""
    ratings = np.random.default_rng(seed).integers(1, 11, size=(n, stimuli))
    results = compare_stimuli(pd.DataFrame(ratings, columns=list("abcd")[:stimuli]))
    table = {
        (r.first, r.second): (round(r.mean_difference, 2), round(r.p_one_sided, digits))
        for r in results
    }
    return results, table


@given(st.integers(0, 300))
def test_the_test_is_recovered_from_what_is_printed(seed):
    """Mean and p give back t, spread, interval, effect size and corrected p."""
    results, table = printed(seed, digits=14)
    for result, implied in zip(results, implied_comparisons(table, 20), strict=True):
        assert implied.p_holm == pytest.approx(result.p_holm, rel=1e-6)
        if result.mean_difference:
            assert implied.t == pytest.approx(result.t, rel=1e-4)
            assert (implied.low, implied.high) == pytest.approx(
                (result.low, result.high), rel=1e-3, abs=1e-6
            )


def test_equal_means_imply_no_spread():
    """A p of 0.5 fits any spread, so no interval is invented."""
    result = implied_comparison(0.0, 0.5, 20)
    assert (result.t, result.p_two_sided, result.effect_size) == (0.0, 1.0, 0.0)
    assert math.isnan(result.low)
    assert math.isnan(result.standard_deviation)
    assert "no interval" in result.note


@pytest.mark.parametrize(
    ("mean", "p", "n"),
    [(1.0, 0.5, 20), (0.0, 0.4, 20), (1.0, 0.0, 20), (1.0, 0.7, 20), (1.0, 0.1, 1)],
)
def test_numbers_of_no_one_sided_test_are_refused(mean, p, n):
    """A p above 0.5 cannot be in the direction of the difference."""
    with pytest.raises(WorkbenchError, match="want"):
        implied_comparison(mean, p, n)


@given(st.integers(0, 1000))
def test_a_table_of_real_answers_has_no_contradiction(seed):
    """Whatever the answers, rounding as in print is never taken for an error."""
    _, table = printed(seed)
    whole = {pair: (mean, max(p, 0.0001)) for pair, (mean, p) in table.items()}
    assert contradictions(whole, 20) == []


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({("a", "b"): (1.07, 0.02)}, "= 1.07 is no mean of 20 whole numbers"),
        ({("a", "c"): (2.15, 0.001)}, "do not add up to"),
        ({("a", "b"): (0.95, 1e-9), ("b", "c"): (0.95, 1e-9)}, "has a standard deviation of at"),
    ],
    ids=["no mean", "no sum", "no triangle"],
)
def test_each_kind_of_contradiction_is_found(change, message):
    """A sound table with one number changed is no longer sound, and one sentence says why."""
    table = {("a", "b"): (0.95, 0.02), ("b", "c"): (0.95, 0.03), ("a", "c"): (1.9, 0.004)}
    assert contradictions(table, 20) == []
    found = contradictions(table | change, 20)
    assert len([sentence for sentence in found if message in sentence]) == 1


def test_a_pair_may_stand_the_other_way_round():
    """What is printed of b − a holds for a − b with the other sign."""
    table = {("b", "a"): (-0.95, 0.02), ("b", "c"): (0.95, 0.03), ("a", "c"): (1.9, 0.004)}
    assert contradictions(table, 20) == []
    assert "do not add up" in contradictions(table | {("b", "a"): (0.95, 0.02)}, 20)[0]
