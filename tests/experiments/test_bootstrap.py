"""Bootstrap intervals against scipy's, and against what is known of simulated data."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import stats

from workbench.errors import WorkbenchError
from workbench.experiments import bootstrap as module
from workbench.experiments.bootstrap import Estimate, bootstrap


def _mean(values):
    return float(values.mean())


def test_interval_is_that_of_scipy():
    """Both percentile intervals of a skewed sample's mean agree, up to the resampling."""
    values = np.random.default_rng(0).exponential(size=40)
    found = bootstrap(values, _mean)
    theirs = stats.bootstrap(
        (values,), np.mean, n_resamples=4000, method="percentile", random_state=0
    )
    interval = theirs.confidence_interval
    tolerance = 0.05 * (interval.high - interval.low)
    assert found.value == pytest.approx(values.mean())
    assert found.low == pytest.approx(interval.low, abs=tolerance)
    assert found.high == pytest.approx(interval.high, abs=tolerance)
    assert (found.n_units, found.n_seeds) == (40, 1)


def test_nine_of_ten_intervals_cover_the_truth(monkeypatch):
    """Of 90 % intervals for the mean of 40 normal numbers, about nine tenths hold it."""
    monkeypatch.setattr(module, "N_RESAMPLES", 200)
    rng = np.random.default_rng(1)
    covered = 0
    for trial in range(150):
        found = bootstrap(rng.normal(3.0, 2.0, 40), _mean, level=0.9, random_state=trial)
        covered += found.low <= 3.0 <= found.high
    # Percentile intervals are a little short; 150 trials scatter by 2.4 %.
    assert 0.81 < covered / 150 < 0.96


def test_seeds_that_differ_widen_the_interval(monkeypatch):
    """Drawing seeds too tells more doubt than taking each clip's mean over seeds as known."""
    monkeypatch.setattr(module, "N_RESAMPLES", 1000)
    rng = np.random.default_rng(2)
    values = rng.normal(size=(12, 1)) * 0.1 + rng.normal(size=(12, 3))
    hierarchical = bootstrap(values, _mean, seeds=True)
    flat = bootstrap(values.mean(axis=1), _mean)
    assert hierarchical.value == pytest.approx(flat.value)
    assert hierarchical.high - hierarchical.low > 1.1 * (flat.high - flat.low)
    assert (hierarchical.n_units, hierarchical.n_seeds) == (12, 3)


def test_equal_seeds_are_no_more_data(monkeypatch):
    """Seeds that all give the same value leave the interval as it is with one of them."""
    monkeypatch.setattr(module, "N_RESAMPLES", 1000)
    values = np.random.default_rng(3).normal(size=10)
    once = bootstrap(values, _mean)
    repeated = bootstrap(np.repeat(values[:, None], 4, axis=1), _mean, seeds=True)
    assert repeated.high - repeated.low == pytest.approx(once.high - once.low, rel=0.15)


def test_columns_are_drawn_together():
    """A ratio that is the same on every clip has no doubt, however the clips differ."""
    clips = np.random.default_rng(4).exponential(size=(8, 1))
    found = bootstrap(np.hstack([clips, 2 * clips]), lambda v: float((v[:, 0] / v[:, 1]).mean()))
    assert (found.low, found.high) == pytest.approx((0.5, 0.5))


def test_a_formula_has_no_interval():
    """A value that follows from no data rests on no unit."""
    assert Estimate.exact(2.0) == Estimate(2.0, 2.0, 2.0, 0, 0)


@pytest.mark.parametrize(
    ("values", "seeds"),
    [([], False), (np.empty((3, 0)), True), ([1.0, np.nan], False), ([1.0, 2.0], True)],
    ids=["no unit", "no seed", "not finite", "no axis of seeds"],
)
def test_what_cannot_be_drawn_is_refused(values, seeds):
    """Wrong input is told in a sentence."""
    with pytest.raises(WorkbenchError, match="values"):
        bootstrap(values, _mean, seeds=seeds)
