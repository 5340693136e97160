"""The comparison of held-out errors from results that are known, and from real ones."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from workbench.errors import WorkbenchError
from workbench.experiments import bootstrap
from workbench.experiments.grid import run_grid
from workbench.experiments.runs.held_out import HeldOutRun
from workbench.reproduction.beyond import held_out, held_out_comparison, held_out_evidence
from workbench.reproduction.claims import all_claims


@pytest.fixture(autouse=True)
def few_resamples(monkeypatch):
    """Keep the bootstrap short: no test looks at the ends of an interval."""
    monkeypatch.setattr(bootstrap, "N_RESAMPLES", 20)


def _row(dataset: str, projector: str = "pca", *, standardize=False, split="random", **errors):
    """Make the row of a run whose errors are 1 where nothing else is said."""
    columns = [
        *(f"error_{p}_{m}" for p in ("raw", "alg12", "local") for m in ("mean", "nearest", "rbf")),
        *(f"error_{n}" for n in ("mean_sample", "data_nearest", "plane_nearest", "plane_mean")),
        *("error_plane_control", "error_self_placed"),
        *(f"{n}_{p}" for n in ("training_error", "unexplained") for p in ("raw", "alg12")),
    ]
    return {
        "status": "done",
        "message": "",
        "dataset": dataset,
        "projector": projector,
        "split": split,
        "standardize": standardize,
        "ratio": 0.03,
        "error_raw_own": None,
        "error_inverse": None,
        **dict.fromkeys(columns, 1.0),
        **errors,
    }


TABLE = pd.DataFrame(
    [
        _row("uci/iris", "pca", error_alg12_mean=0.4, error_inverse=0.2, error_plane_control=0.8),
        _row("uci/iris", "mds", error_alg12_mean=0.9, error_plane_control=0.8),
        _row("uci/iris", "pca", standardize=True, error_alg12_mean=0.6, error_inverse=0.6),
        _row("uci/iris", "mds", standardize=True, error_alg12_mean=0.6),
        _row("cmu/a", split="blocks", error_alg12_mean=0.9, training_error_alg12=0.5),
        _row("cmu/a", split="random", error_alg12_mean=0.1),
        {**_row("cmu/b", split="blocks", error_alg12_mean=9.0), "status": "failed"},
    ]
)


def test_settings_tell_tables_and_splits_apart():
    """Tables raw and standardised, clips by what was held out; failed runs are left out."""
    rows = held_out_comparison.finished(TABLE)
    assert rows["setting"].tolist() == [
        *["Tables, raw"] * 2,
        *["Tables, standardised"] * 2,
        "Clips, stretches held out",
        "Clips, frames held out",
    ]
    assert set(rows["method"]) == {"PCA", "MDS"}


def test_ratios_are_geometric_means_per_data_set():
    """Of 0.4 and 0.9 it is 0.6, and so it is with the standardised ones."""
    rows = held_out_comparison.finished(TABLE)
    tables = rows[rows["dataset"] == "uci/iris"]
    values = held_out_comparison.ratios(tables, "error_alg12_mean", "error_raw_mean")
    assert values == pytest.approx([0.6])


def test_missing_errors_are_left_out():
    """Only PCA has an inverse; where no run has the error there is no estimate."""
    rows = held_out_comparison.finished(TABLE)
    raw = rows[rows["setting"] == "Tables, raw"]
    assert held_out_comparison.ratios(raw, "error_alg12_mean", "error_inverse") == pytest.approx(
        [2.0]
    )
    assert held_out_comparison.estimate(raw, "error_alg12_mean", "error_raw_own") is None


def test_gains_are_those_of_training_and_held_out_samples():
    """Each projector, and all of them where there are several, with its interval."""
    gains = held_out_comparison.gains(held_out_comparison.finished(TABLE))
    held = gains["Tables, raw"]["held-out samples"]
    assert {name: e.value for name, e in held.items()} == pytest.approx(
        {"PCA": 0.4, "MDS": 0.9, "all": 0.6}
    )
    clips = gains["Clips, stretches held out"]
    assert clips["training samples"]["PCA"].value == pytest.approx(0.5)
    assert clips["held-out samples"]["PCA"].value == pytest.approx(0.9)


def test_tables_hold_the_same_numbers():
    """Gains by projector and map, and errors by method, are medians over data sets."""
    rows = held_out_comparison.finished(TABLE)
    gains = held_out_comparison.gain_table(rows)
    raw = gains.loc["Tables, raw: all"]
    assert raw["held out, Alg. 12 / raw", "placed by five nearest"] == pytest.approx(0.6)
    assert raw["held out, Alg. 12 / raw", "placed by RBFP"] == 1
    assert np.isnan(raw["held out", "Alg. 12 / raw, own transform"])
    errors = held_out_comparison.method_table(rows)
    assert errors.loc["Alg. 12", "Tables, raw"] == pytest.approx(0.6)
    assert errors.loc["nearest control point", "Tables, raw"] == pytest.approx(0.8)
    assert errors.loc["PCA's own inverse", "Tables, standardised"] == pytest.approx(0.6)


def test_claims_rest_on_stretches_of_clips():
    """Frames beside known ones count in the note only; every claim of the notebook is judged."""
    evidence = held_out_evidence.evidence(TABLE)
    wanted = {name for name, claim in all_claims().items() if claim.notebook == "held_out"}
    assert set(evidence) == wanted
    found = evidence["ours:helps-on-held-out"]
    assert found.estimate.n_units == 2
    assert found.estimate.value == pytest.approx((0.6 + 0.9) / 2)
    assert "Clips, frames held out: 0.10" in found.note


def test_the_explanation_correlates_over_runs():
    """Where a run with rougher positions gains less, the rank correlation is 1."""
    rough = pd.DataFrame(
        [
            _row(f"uci/{n}", error_alg12_mean=0.5 + 0.1 * n, unexplained_alg12=1.0 + n)
            for n in range(4)
        ]
    )
    row = held_out_evidence.explanation_table(held_out_comparison.finished(rough)).iloc[0]
    correlations = row["rank correlation of the held-out ratio with"]
    assert correlations["what is left open"] == pytest.approx(1)
    assert row["positions that neighbours leave open", "optimized / raw"] == pytest.approx(6**0.5)


def test_alternative_texts_say_the_numbers():
    """Of projectors that of all is said, of methods each."""
    rows = held_out_comparison.finished(TABLE)
    gains = held_out_evidence.in_words(held_out_comparison.gains(rows))
    assert "Tables, raw: training samples 1.00, held-out samples 0.60." in gains
    methods = held_out_evidence.in_words(held_out_comparison.method_errors(rows))
    assert "Alg. 12 0.60" in methods


def test_captions_say_what_was_used_and_what_failed():
    """Data sets by kind, and the failed run's message."""
    text = held_out_evidence.describe_data(TABLE)
    assert text.startswith("1 CMU clip (a) and 1 UCI table (iris); 70 % of the samples")
    assert "1 of 7 runs failed" in text
    with pytest.raises(WorkbenchError, match="all runs failed"):
        held_out_comparison.finished(TABLE[TABLE["status"] == "failed"])


def test_the_quick_profile_is_small_and_decides():
    """At least the six data sets that a verdict needs, and few runs."""
    runs = held_out.planned_runs("quick", 3)
    assert len(runs) == len(set(runs)) < 40
    assert len({run.dataset for run in runs}) >= 6
    assert {run.seed for run in runs} == {3}
    assert {run.split for run in runs if run.dataset.startswith("cmu/")} == {"random", "blocks"}
    assert not any(run.split == "blocks" for run in runs if run.dataset.startswith("uci/"))


def test_parameters_replace_those_of_the_profile():
    """A user's data sets and projectors are taken; an unknown projector is refused."""
    runs = held_out.planned_runs("full", 0, clips=[], tables=["uci/wine"], projectors=["LLE"])
    assert set(runs) == {
        HeldOutRun("uci/wine", "lle", ratio=ratio, standardized=standardized)
        for ratio in (0.03, 0.1)
        for standardized in (False, True)
    }
    with pytest.raises(WorkbenchError, match="projectors: got 'lle', want some of PCA"):
        held_out.planned_runs("full", 0, clips=[], tables=[], projectors=["lle"])


def test_real_tables_bear_it_out(tmp_path: Path):
    """On Iris and Wine, optimized positions of training samples help held-out ones."""
    runs = held_out.planned_runs(
        "full", 0, clips=[], tables=["uci/iris", "uci/wine"], projectors=["Isomap"]
    )
    table = run_grid(runs, tmp_path)
    assert held_out.other_ratios(table) == [0.1]
    for setting, some in held_out_comparison.by_setting(held_out_comparison.finished(table)):
        ratio = held_out_comparison.median_ratio(some, "error_alg12_mean", "error_raw_mean")
        assert ratio < 0.9, setting
