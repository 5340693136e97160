"""The share of control points, from known results and from a small grid."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from workbench import load_space
from workbench.experiments.grid import run_grid
from workbench.experiments.runs.schemes import scheme_name
from workbench.reproduction.beyond import control_point_share as shares
from workbench.reproduction.claims import claim_by_id, verdict

CLAIM = "ours:best-share-of-control-points"


def _results(after: dict[float, float], n_tables: int = 6) -> pd.DataFrame:
    """Give errors after optimization by share, from 1 before; a bit different for each table."""
    return pd.DataFrame(
        [
            {
                "status": "done",
                "message": "",
                "dataset": dataset,
                "scheme": scheme_name(shares.scheme_of(projector)),
                "ratio": share,
                "n_samples": 200,
                "n_control_points": 200 * share,
                "projected_error": 1.0,
                "error": error * (1 + 0.001 * index),
                "relative_error": error * (1 + 0.001 * index) / 4.0,
                "stress_ratio": 0.9,
                "scale_normalized_stress_ratio": 1.1,
            }
            for index, dataset in enumerate(list(shares.TABLES)[:n_tables])
            for projector in ("PCA", "MDS")
            for share, error in after.items()
        ]
    )


@pytest.mark.parametrize(
    ("after", "best", "expected"),
    [
        ({0.03: 0.8, 0.1: 0.5, 0.3: 0.7}, "10 %", "reproduced"),
        ({0.03: 0.5, 0.1: 0.6, 0.3: 0.7}, "3 %", "not reproduced"),
    ],
    ids=["another share", "the published share"],
)
def test_the_best_share_is_found(after, best, expected):
    """The claim holds where another share gains clearly more than 3 % does."""
    found = shares.gains(_results(after))
    evidence = shares.best_share_evidence(found)
    assert f"Largest median gain at {best}." in evidence.note
    assert (evidence.units, evidence.estimate.n_units) == ("tables", 6)
    assert verdict(claim_by_id(CLAIM), evidence) == expected
    assert shares.share_table(found).loc[best, ("gain", "largest on")] == "12 of 12"


def test_noise_alone_does_not_make_a_share_better():
    """Where tables differ at random in their best share, the claim is not reproduced."""
    results = _results(dict.fromkeys(shares.SHARES, 0.6))
    noise = np.random.default_rng(0).uniform(0.95, 1.05, len(results))
    found = shares.gains(results.assign(error=results["error"] * noise))
    assert (shares.best_shares(found)["ratio"] >= 1).all()
    assert verdict(claim_by_id(CLAIM), shares.best_share_evidence(found)) != "reproduced"


def test_errors_are_those_of_rows_that_are_no_control_points():
    """A mean over all rows would fall with the share though no row is rebuilt better."""
    row = shares.gains(_results({0.5: 0.6})).iloc[0]
    assert row["gain"] == pytest.approx(0.4)
    assert row["error"] == pytest.approx(0.6 / 4.0 / 0.5)
    assert row["before"] == pytest.approx(1.0 / 4.0 / 0.5)


def test_curves_and_tables_are_those_of_the_gains():
    """Each table has a curve over all its shares, medians over projectors."""
    found = shares.gains(_results({0.03: 0.8, 0.1: 0.5}, n_tables=2))
    iris, _ = shares.share_curves(found, "gain")
    assert (iris.name, list(iris.x), list(iris.y)) == (
        "Iris",
        [3.0, 10.0],
        pytest.approx([0.2, 0.5]),
    )
    best = shares.best_shares(found).loc["Iris"]
    assert best.tolist() == pytest.approx([10.0, 0.5, 0.2, 2.5])


def test_without_results_there_is_nothing_to_show():
    """Failed runs leave no curve, no table and no evidence, but a sentence."""
    failed = _results({0.03: 0.8}).assign(status="failed", message="broken")
    found = shares.gains(failed)
    assert shares.share_curves(found, "gain") == []
    assert shares.share_table(found).empty
    assert shares.best_shares(found).empty
    assert shares.best_share_evidence(found).estimate is None
    assert "the first: broken" in shares.describe_tables(failed)


def test_a_real_grid(tmp_path):
    """On Iris the optimizer gains at every share, and the mean row's error is that of numpy."""
    runs = [run for run in shares.share_runs(["uci/iris"], "quick") if run.ratio in (0.03, 0.3)]
    results = run_grid(runs, tmp_path)
    found = shares.gains(results)
    assert len(found) == 6
    assert (found["gain"] > 0).all()
    values = load_space("uci/iris", standardize=True).features
    mean_row = np.linalg.norm(values - values.mean(axis=0), axis=1).mean()
    row, run = found.iloc[0], results.iloc[0]
    free = run["n_samples"] - run["n_control_points"]
    assert row["error"] == pytest.approx(run["error"] * run["n_samples"] / free / mean_row)


def test_profiles():
    """Quick runs the bundled tables only; full compares eight shares."""
    quick = shares.planned_runs("quick", 4)
    assert {run.dataset for run in quick} == {"uci/iris", "uci/wine"}
    assert {run.seed for run in quick} == {4}
    assert len(shares.share_runs(["uci/iris"], "full")) == 6 * 8
    assert all(run.standardize for run in quick)
