"""The comparison of optimizers from results that are known, and from real ones."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pandas as pd
import pytest

from workbench.errors import WorkbenchError
from workbench.experiments import bootstrap
from workbench.experiments.grid import run_grid
from workbench.experiments.runs.schemes import scheme_name
from workbench.reproduction.beyond.optimizer_comparison import (
    compare_markers,
    compare_optimizers,
    evidence,
    higher_runs,
    marker_table,
    medians_in_words,
    optimizer_table,
    ratio_boxes,
)
from workbench.reproduction.beyond.optimizer_runs import (
    MARKER_SEARCHES,
    PROJECTORS,
    marker_clips,
    marker_projectors,
    marker_runs,
    optimizer_runs,
    planned_runs,
    scheme_of,
    shortest,
)
from workbench.reproduction.claims import all_claims
from workbench.reproduction.costa2018 import keyframe_errors


@pytest.fixture(autouse=True)
def few_resamples(monkeypatch):
    """Keep the bootstrap short: no test looks at the ends of an interval."""
    monkeypatch.setattr(bootstrap, "N_RESAMPLES", 20)


def _row(clip: str, optimizer: str | None, error: float, markers=None, **values) -> dict:
    """Make the row of a run by PCA on 100 frames with 3 keyframes."""
    row = {
        "status": "done",
        "dataset": f"cmu/{clip}",
        "scheme": scheme_name(scheme_of("pca", optimizer, markers)),
        "n_samples": 100,
        "n_control_points": 3,
        "error": error,
        "evaluations": 97,
        "jacobians": 0,
        "distances": 0,
        "seconds_optimize": 1.0,
        "seconds_markers": None,
        "stress_ratio": 1.0,
        "scale_normalized_stress_ratio": 1.0,
        "trustworthiness": 0.9,
        "projected_trustworthiness": 0.9,
        "neighborhood_preservation": 0.5,
        "projected_neighborhood_preservation": 0.5,
    }
    return {**row, **values}


def _alg12(clip: str, error: float) -> dict:
    return _row(clip, "alg12", error, evaluations=97 + 1000, distances=1000, seconds_optimize=4.0)


TABLE = pd.DataFrame(
    [
        _alg12("a", 0.5),
        _row(
            "a",
            "local",
            0.6,
            evaluations=97 + 50,
            jacobians=50,
            distances=50,
            seconds_optimize=1.0,
            stress_ratio=0.7,
            trustworthiness=0.95,
        ),
        _row("a", "global", 0.4, evaluations=97 + 100, distances=300, seconds_optimize=2.0),
        _alg12("b", 0.8),
        _row("b", "local", 0.72, evaluations=97 + 100, jacobians=100, distances=100),
        _row("b", "global", 0.8, evaluations=97 + 100, distances=300, seconds_optimize=2.0),
        # Not compared: global has not finished here.
        _alg12("c", 0.1),
        _row("c", "local", 0.9),
        {**_row("c", "global", 0.9), "status": "failed"},
        _row("a", "global", 0.3, "move", evaluations=97 + 300, distances=500, seconds_markers=8.0),
        _row("a", "global", 0.2, "exchange", evaluations=97 + 700, distances=900),
    ]
)


def test_errors_and_costs_are_relative_to_alg12():
    """Local: 0.6 / 0.5 and 0.72 / 0.8; effort counts each derivative as two back-projections."""
    row = optimizer_table(compare_optimizers(TABLE)).loc["PCA, local"]
    assert row["error / Alg. 12", "median"] == pytest.approx((1.2 + 0.9) / 2)
    assert row["error / Alg. 12", "largest"] == pytest.approx(1.2)
    assert row["error / Alg. 12", "runs above 1"] == "1 of 2"
    assert row["cost / Alg. 12", "effort, mean"] == pytest.approx((200 + 400) / 2 / 2000)
    assert row["cost / Alg. 12", "seconds, median"] == pytest.approx(0.25)
    assert row["stress, after / before, median", "Eq. 4.1"] == pytest.approx(0.85)
    assert row["change, median", "trustworthiness"] == pytest.approx(0.025)


def test_alg12_is_its_own_measure():
    """Its rows are 1 throughout, so that what it does to stress stands beside ours."""
    row = optimizer_table(compare_optimizers(TABLE)).loc["all, alg12"]
    assert row["error / Alg. 12", "largest"] == 1
    assert row["error / Alg. 12", "runs above 1"] == "0 of 2"
    assert row["cost / Alg. 12", "effort, mean"] == 1


def test_runs_that_end_higher_are_named():
    """Local on clip a; an error that is equal is not higher."""
    listed = higher_runs(compare_optimizers(TABLE))
    assert listed.index.tolist() == ["a, PCA, local"]
    assert listed.iloc[0].tolist() == pytest.approx([0.5, 0.6, 1.2])


def test_boxes_are_over_clips():
    """One box for each of our optimizers and projector, none for Alg. 12."""
    boxes = ratio_boxes(compare_optimizers(TABLE))
    assert {method: list(found) for method, found in boxes.items()} == {
        "local": ["PCA"],
        "global": ["PCA"],
    }
    assert boxes["global"]["PCA"].median == pytest.approx((0.8 + 1.0) / 2)


def test_markers_are_compared_with_the_global_optimizer():
    """On clip a: 0.3 and 0.2 beside 0.4, at 2 and 4 times the effort, 5 times the time."""
    table = marker_table(compare_markers(TABLE))
    assert table.index.tolist() == ["PCA, move", "PCA, exchange", "all, move", "all, exchange"]
    moved, exchanged = table.loc["PCA, move"], table.loc["PCA, exchange"]
    assert moved["error / global alone", "median"] == pytest.approx(0.75)
    assert exchanged["error / global alone", "median"] == pytest.approx(0.5)
    assert moved["cost / global alone", "effort, mean"] == pytest.approx(2)
    assert exchanged["cost / global alone", "effort, mean"] == pytest.approx(4)
    assert moved["cost / global alone", "seconds, median"] == pytest.approx((1 + 8) / 2)


def test_alg12_and_raw_runs_are_those_of_table_5_1():
    """A reproduction computes them once for both."""
    of_table = set(keyframe_errors.table_5_1_runs(["cmu/a"], seed=2))
    shared = [run for run in optimizer_runs(["cmu/a"], seed=2) if run in of_table]
    assert len(shared) == 2 * len(PROJECTORS)


def test_markers_are_searched_on_the_shortest_clips():
    """One clip of the quick profile and six of the full one, whose own runs are there too."""
    clips = ["cmu/05_10", "cmu/02_01", "my/own.bvh", "cmu/09_06"]
    assert marker_clips(clips, "quick") == ["cmu/09_06"]
    assert marker_clips(clips, "full") == clips
    assert shortest(clips, 3) == ["cmu/05_10", "cmu/02_01", "cmu/09_06"]
    excerpts = ["cmu/01_01-three-jumps", "cmu/01_01-jump", "cmu/01_03-hang"]
    assert shortest(excerpts, 1) == ["cmu/01_01-jump"]
    assert set(marker_projectors("quick")) < set(marker_projectors("full")) == set(PROJECTORS)
    runs = marker_runs(["cmu/a"], projectors=["PCA"])
    assert [run.scheme.markers for run in runs] == list(MARKER_SEARCHES)


def test_planned_runs_have_what_each_search_is_compared_with():
    """For each run that searches for markers there is that of the global optimizer alone."""
    runs = planned_runs("quick", 2)
    assert len(set(runs)) == len(runs) < 90
    assert len({run.dataset for run in runs}) >= 6
    searched = [run for run in runs if run.scheme.markers]
    assert len(searched) == 2
    for run in searched:
        assert replace(run, scheme=replace(run.scheme, markers=None)) in runs
    assert planned_runs("quick", 2, clips=["cmu/01_01-jump"], projectors=["t-SNE"]) == [
        *optimizer_runs(["cmu/01_01-jump"], seed=2, projectors=["t-SNE"]),
        *marker_runs(["cmu/01_01-jump"], seed=2, projectors=["t-SNE"]),
    ]


def test_every_claim_of_the_notebook_has_its_evidence():
    """Clip a: 0.8, b: 1.0 by the global optimizer; moved 0.75, exchanged 0.5, of one clip."""
    found = evidence(TABLE)
    assert set(found) == {
        name for name, claim in all_claims().items() if claim.notebook == "optimizers"
    }
    better = found["ours:better-optimizer"]
    assert (better.estimate.value, better.estimate.n_units) == (pytest.approx(0.9), 2)
    assert "effort is 0.20 of that of Alg. 12" in better.note
    assert found["ours:moving-markers-helps"].estimate.value == pytest.approx(0.75)
    assert found["ours:exchanging-markers-helps"].estimate.value == pytest.approx(0.5)


def test_without_searches_there_is_no_evidence_on_them():
    """A claim whose runs are missing is not decidable, and the rest is judged."""
    found = evidence(TABLE[~TABLE["scheme"].str.contains("markers")])
    assert found["ours:moving-markers-helps"].estimate is None
    assert found["ours:better-optimizer"].estimate.n_units == 2


def test_medians_are_said_in_words():
    """The alternative text holds the numbers of the boxes."""
    text = medians_in_words(compare_optimizers(TABLE))
    assert text == "Medians, local: PCA 1.050. Medians, global: PCA 0.900."


def test_an_unknown_projector_is_refused():
    """A misspelt projector is an error that lists the right ones."""
    with pytest.raises(WorkbenchError, match="projectors: got 'pca', want some of PCA, MDS"):
        optimizer_runs(["cmu/a"], projectors=["pca"])


def test_a_real_clip_bears_it_out(tmp_path: Path):
    """On a jump, ours end no higher than Alg. 12, with less than half the effort."""
    compared = compare_optimizers(
        run_grid(optimizer_runs(["cmu/01_01-jump"], projectors=["PCA", "Isomap"]), tmp_path)
    )
    assert len(compared) == 2 * 3
    ours = compared[compared["method"] != "alg12"]
    assert (ours["error_ratio"] < 1.002).all()
    assert (ours["effort_ratio"] < 0.5).all()
    assert (ours["effort_ratio"] > 0).all()
