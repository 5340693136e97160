"""Section 5.1 from a real, small grid, and from known results."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from workbench.experiments.grid import run_grid
from workbench.experiments.runs.compaction import CompactionRun
from workbench.reproduction.claims import claim_by_id, verdict
from workbench.reproduction.costa2018 import compression

CLIP = "cmu/01_01-jump"


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> pd.DataFrame:
    """Run the quick grid on one clip."""
    runs = compression.compression_runs([CLIP], "quick")
    return run_grid(runs, tmp_path_factory.mktemp("results"))


def test_bytes_counted_and_written_stand_side_by_side(results: pd.DataFrame):
    """300 frames, 9 keyframes: the equations by hand, and the files of the runs."""
    row = compression.bytes_table(results).loc[CLIP]
    assert row["motion", "Eq. 5.1"] == 4 * 300 * 96
    assert row["Slerp", "equation"] == 4 * (9 * 94 + 300 * 3)
    assert row["t-SNE, optimized", "equation"] == 4 * (9 * 94 + 300 * 5)
    slerp = results[(results["scheme"] == "slerp, uniform") & (results["ratio"] == 0.03)].iloc[0]
    assert row["Slerp", "file"] == slerp["bytes"]
    assert row["Slerp", "of whole, %"] == pytest.approx(100 * slerp["bytes"] / 115200)
    assert row["Slerp", "file"] < row["t-SNE, optimized", "file"] < row["motion", "gzip"]


def test_files_are_equally_large_at_equal_size(results: pd.DataFrame):
    """Slerp's file is at most as large, and within one keyframe of it."""
    row = compression.equal_size_table(results).loc[CLIP]
    slerp, tsne = row["slerp, as large", "bytes"], row["t-SNE, optimized", "bytes"]
    assert slerp <= tsne < slerp * 1.1
    assert row["slerp, as large", "keyframes"] > row["t-SNE, optimized", "keyframes"]
    ratio = row["slerp, as large", "error"] / row["t-SNE, optimized", "error"]
    assert compression.equal_size_evidence(results).estimate.value == pytest.approx(ratio)
    plane = compression.plane_evidence(results).estimate
    assert plane.value == pytest.approx(row["t-SNE, keyframes only", "error / stored"])


def test_curves_fall_as_files_grow(results: pd.DataFrame):
    """More keyframes make larger files with lower errors, for every scheme of the profile."""
    curves = compression.trade_off_curves(results)
    assert [curve.name for curve in curves] == ["Slerp", "t-SNE, optimized", "Hermitian"]
    for curve in curves:
        assert np.all(np.diff(curve.x) > 0)
        assert np.all(np.diff(curve.y) < 0)
        assert list(curve.text) == ["2 % keyframes", "3 % keyframes", "6 % keyframes"]
    assert "Slerp: error" in compression.trade_off_alt(curves)


def test_counted_sizes_are_those_of_the_equations(results: pd.DataFrame):
    """By formula, slerp with 9 of 300 keyframes takes 6.06 % and t-SNE 8.15 % of the motion."""
    slerp, tsne, _ = compression.trade_off_curves(results, by_formula=True)
    assert slerp.x[1] == pytest.approx(6.0625)
    assert tsne.x[1] == pytest.approx(8.1458, abs=1e-4)


@pytest.mark.parametrize("claim", compression.LIMIT_CLAIMS)
def test_limits_follow_from_the_formulas(claim):
    """The three published limits are reproduced without any data."""
    assert verdict(claim_by_id(claim), compression.limit_evidence(claim)) == "reproduced"


def test_limits_stand_beside_the_published_ones():
    """They agree to the published digits."""
    assert (compression.limits_table()["difference"].abs() < 0.005).all()


def test_failed_runs_leave_no_rows(results: pd.DataFrame):
    """Without a finished run the tables are empty and the claims have no number."""
    failed = results.assign(status="failed", message="broken")
    assert compression.bytes_table(failed).empty
    assert compression.equal_size_table(failed).empty
    assert compression.trade_off_curves(failed) == []
    assert compression.equal_size_evidence(failed).estimate is None
    assert compression.plane_evidence(failed).estimate is None


def test_clips_with_a_failed_run_are_not_averaged(results: pd.DataFrame):
    """Points of a curve are means over the same clips."""
    other = results.assign(dataset="other", file_error=100.0)
    other = other.drop(other[other["scheme"] == "slerp, uniform"].index[0])
    together = compression.trade_off_curves(pd.concat([results, other], ignore_index=True))
    assert together == compression.trade_off_curves(results)


def test_profiles_spread_over_the_clips():
    """The quick profile takes two excerpts and fewer schemes."""
    runs = compression.planned_runs("quick", 5)
    assert len({run.dataset for run in runs}) == 2
    compactions = [run for run in runs if isinstance(run, CompactionRun)]
    assert len(compactions) == 2 * 3 * 3
    assert {run.seed for run in compactions} == {5}
