"""Figure 5.5: how long projectors and the optimizer take."""

from __future__ import annotations

import pytest

from tests.reproduction.costa2018.synthetic import results_of
from workbench.reproduction.costa2018 import keyframe_errors, running_time

RUNS = running_time.planned_runs("quick", 0)
#: Seconds that projectors take in the order of the thesis, without the distance matrix.
SECONDS = {"pca": 1.0, "force": 2.0, "mds": 2.5, "isomap": 3.0, "lle": 8.0, "tsne": 9.0}


def _values(run):
    if run["kind"] == "temporal":
        return {"error": 1.0}
    project = SECONDS[run["projector"]]
    return {
        "seconds_select": 0.001,
        "seconds_project": project,
        "seconds_distances": 0.5,
        "seconds_optimize": 0.1 * project,
        "seconds_back_project": 0.002,
    }


TABLE = results_of(RUNS, _values)


def test_runs_are_those_of_table_5_1():
    """Nothing is run for this notebook alone."""
    assert set(RUNS) <= set(keyframe_errors.planned_runs("quick", 0))


def test_distances_count_for_projectors_that_need_them():
    """PCA and LLE see the poses; the others wait for the distance matrix."""
    seconds = running_time.step_seconds(TABLE, "seconds_project").iloc[0]
    assert seconds["PCA"] == 1.0
    assert seconds["LLE"] == 8.0
    assert seconds["Force"] == 2.5
    assert seconds["t-SNE"] == 9.5


def test_times_are_per_frame_from_the_fastest_to_the_slowest():
    """All clips of the made-up table have 300 frames."""
    project, optimize = running_time.seconds_per_frame(TABLE).values()
    assert list(project) == ["PCA", "Force", "MDS", "Isomap", "LLE", "t-SNE"]
    assert list(optimize) == list(project)
    assert project["PCA"] == pytest.approx([1 / 300] * 6)
    assert optimize["LLE"] == pytest.approx([0.8 / 300] * 6)


def test_the_table_sets_ratios_beside_those_of_the_text():
    """Force takes 2.5 of 9.5 s of t-SNE; the text says a quarter, and nothing of Isomap."""
    times = running_time.times(TABLE)
    row = times.loc["Force"]
    assert row["projection / t-SNE, ours"] == pytest.approx(2.5 / 9.5)
    assert row["projection / t-SNE, published"] == 0.25
    assert times["projection / t-SNE, published"].isna()["Isomap"]
    assert running_time.describe_times(times).startswith("Dots and lines")
    steps = running_time.steps(TABLE)
    assert steps.loc["PCA"].tolist() == pytest.approx([1.0, 1000.0, 100.0, 2.0])


def test_evidence_measures_what_the_claims_say():
    """Optimization takes 10 % of PCA's projection; the order is as published up to ties."""
    found = running_time.evidence(TABLE)
    share = found["costa2018:projection-dominates-time"].estimate
    agreement = found["costa2018:order-of-projectors"].estimate
    assert 0.08 < share.value < 0.1
    # Two pairs of five are tied in the published order: 8 of 10 pairs agree.
    assert agreement.value == pytest.approx(8 / (8 * 10) ** 0.5)
