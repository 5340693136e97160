"""Figure 5.4 and Table 5.2: one and two steps, and stress."""

from __future__ import annotations

import pytest

from tests.reproduction.costa2018.synthetic import results_of
from workbench.reproduction.costa2018 import selectors, two_step
from workbench.reproduction.published import published

CLIPS = selectors.clips_of("quick")
RUNS = two_step.planned_runs("quick", 0)


def _values(run):
    error = {None: 1.0, "rbfp": 4.0, "lamp": 2.0}[run["two_step"]]
    if run["optimizer"]:
        error = 0.5 if run["two_step"] is None else 0.6
    stress = 0.5 if run["two_step"] else 1.1
    return {"error": error, "stress_ratio": stress, "scale_normalized_stress_ratio": 2 * stress}


TABLE = results_of(RUNS, _values)


def test_runs_in_one_step_are_those_of_figure_5_2():
    """Only what is projected in two steps is computed for this notebook alone."""
    of_selectors = set(selectors.planned_runs("quick", 0))
    own = [run for run in RUNS if run not in of_selectors]
    assert own
    assert all(run.scheme.two_step for run in own)
    assert len(RUNS) == len(set(RUNS))


def test_bars_are_mean_errors_and_lamp_is_in_the_table_alone():
    """Six projectors in four kinds of bars."""
    means = two_step.mean_errors(two_step.errors(TABLE, CLIPS))
    assert means.loc["PCA"].tolist() == [1.0, 0.5, 4.0, 0.6, 2.0]
    bars = two_step.bars(two_step.errors(TABLE, CLIPS))
    assert list(bars) == list(two_step.COLORS)
    assert bars[two_step.RBFP] == dict.fromkeys(
        ["Force", "Isomap", "LLE", "MDS", "PCA", "t-SNE"], 4.0
    )
    assert "PCA: 1.00, 0.50, 4.00, 0.60" in two_step.describe_means(means)


def test_means_are_over_the_clips_of_the_profile():
    """Clips that only single figures show do not enter the means."""
    assert set(TABLE["dataset"]) > set(CLIPS)
    assert sorted(two_step.errors(TABLE, CLIPS).index) == sorted(CLIPS)


def test_table_5_2_sets_ours_beside_the_published():
    """Each selector has ours, the published values as printed and their difference."""
    table = two_step.table_5_2(two_step.stress_ratios(TABLE, CLIPS, "Eq. 4.1"))
    printed = published("costa2018:tab5.2").table()
    for name, row in printed.iterrows():
        ours = 0.5 if "RBFP" in str(name) else 1.1
        assert table.loc[f"{name}: ours"].tolist() == pytest.approx([ours] * 6)
        assert table.loc[f"{name}: published"].tolist() == row.tolist()
        assert table.loc[f"{name}: difference"].tolist() == pytest.approx((ours - row).tolist())
    normalized = two_step.mean_ratios(two_step.stress_ratios(TABLE, CLIPS, "scale-normalised"))
    assert normalized.loc["US", "MDS"] == pytest.approx(2.2)


def test_the_published_table_supports_its_text():
    """RBFP gains with every projector but Isomap; the means are those in the ledger."""
    printed = published("costa2018:tab5.2").table()
    assert printed.loc["RBFP, ROLS"].drop("Isomap").max() < 0.6
    assert printed.loc["RBFP, ROLS"].mean() == pytest.approx(0.59, abs=0.005)
    assert printed.drop("RBFP, ROLS").to_numpy().mean() == pytest.approx(1.08, abs=0.005)


def test_evidence_measures_what_the_claims_say():
    """Effects follow from the made-up values."""
    effects = {c: found.estimate.value for c, found in two_step.evidence(TABLE, CLIPS).items()}
    assert effects == pytest.approx(
        {
            "costa2018:rbfp-needs-optimization": 4.0,
            "costa2018:rbfp-optimized-recovers": 1.2,
            "costa2018:lamp-is-poor": 2.0,
            "costa2018:stress-falls-for-rbfp": 0.5,
            "costa2018:stress-falls-for-rbfp-normalized": 1.0,
            "costa2018:stress-stays-for-one-step": 1.1,
            "costa2018:stress-stays-for-one-step-normalized": 2.2,
        }
    )
