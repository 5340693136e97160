"""Figure 5.2: selectors with temporal and spatial schemes."""

from __future__ import annotations

import pytest

from tests.reproduction.costa2018.synthetic import results_of
from workbench.experiments.runs.schemes import SchemeRun
from workbench.reproduction.costa2018 import keyframe_errors, selectors

#: Errors of a made-up clip: by selector, and how much better optimized schemes are.
BY_SELECTOR = {"uniform": 1.0, "scs": 0.9, "pb": 1.2, "rols": 1.5}


def _runs(clips=("cmu/a", "cmu/b")):
    planned = selectors.planned_runs("quick", 0)
    first = [run for run in planned if run.dataset == planned[0].dataset]
    return [SchemeRun(clip, run.scheme, ratio=run.ratio) for clip in clips for run in first]


def _values(run):
    if run["dataset"] == "cmu/failing" and run["scheme"] == "lle, uniform":
        return "no neighbours"
    error = BY_SELECTOR[run["selector"]]
    if run["kind"] == "spatial":
        error *= 0.5 if run["optimizer"] else 2.0
    return {"error": 2 * error if run["dataset"] == "cmu/b" else error}


ERRORS = selectors.errors(results_of(_runs(), _values))


def test_every_scheme_is_run_with_every_selector():
    """Three temporal schemes and six projectors, raw and optimized, with four selectors."""
    planned = selectors.planned_runs("quick", 5)
    assert len(planned) == len(set(planned)) == 2 * (3 + 2 * 6) * 4
    assert {run.seed for run in planned} == {5}


def test_runs_with_uniform_keyframes_are_those_of_table_5_1():
    """What both notebooks want is computed once."""
    of_table = set(keyframe_errors.planned_runs("quick", 0))
    uniform = [run for run in selectors.planned_runs("quick", 0) if "uniform" in str(run)]
    assert len(uniform) == 2 * 15
    assert set(uniform) <= of_table


def test_bars_are_means_over_clips():
    """Errors of 1 and 2 have the mean 1.5; raw spatial ones are twice, optimized half of it."""
    bars = selectors.bars(ERRORS)
    assert bars[selectors.TEMPORAL]["US"]["Slerp"] == pytest.approx(1.5)
    assert bars[selectors.TEMPORAL]["SCS"]["Linear"] == pytest.approx(1.35)
    assert bars[selectors.RAW]["ROLS"]["PCA"] == pytest.approx(4.5)
    assert bars[selectors.OPTIMIZED]["US"]["t-SNE"] == pytest.approx(0.75)


def test_a_clip_with_a_failed_run_is_left_out_of_all_means():
    """Means that are compared are of the same clips."""
    table = results_of(_runs(("cmu/a", "cmu/failing")), _values)
    assert selectors.errors(table).index.tolist() == ["cmu/a"]


def test_the_published_means_stand_beside_ours():
    """The text prints two: 0.618 and 0.826, each for one selector."""
    means = selectors.mean_errors(ERRORS)
    printed = means["published"].dropna().to_dict()
    assert printed == {"Slerp": "0.826 (SCS)", "t-SNE, optimized": "0.618 (US)"}
    text = selectors.describe_means(means)
    assert "Slerp 1.50" in text
    assert "with SCS, 0.68" in text


def test_selectors_are_compared_with_uniform_sampling():
    """In every panel SCS has 0.9 of the error and ROLS 1.5, on all clips alike."""
    table = selectors.against_uniform(ERRORS)
    assert len(table) == 9
    for name, row in table.iterrows():
        ratio = BY_SELECTOR[str(name).rpartition(", ")[2].lower()]
        assert row.tolist() == pytest.approx([ratio] * 3)


def test_evidence_measures_what_the_claims_say():
    """Effects follow from the made-up errors."""
    effects = {claim: found.estimate.value for claim, found in selectors.evidence(ERRORS).items()}
    assert effects == pytest.approx(
        {
            "costa2018:temporal-alike": 1.0,
            "costa2018:uniform-not-beaten": 0.9,
            "costa2018:spatial-needs-optimization": 0.5,
            "costa2018:raw-spatial-is-worse": 2.0,
            "costa2018:best-means": 0.5 / 0.9,
        }
    )
