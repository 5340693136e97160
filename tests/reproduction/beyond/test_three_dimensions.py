"""Two dimensions beside three, from known results and from a small grid."""

from __future__ import annotations

from dataclasses import replace

import pandas as pd
import pytest

from workbench.experiments.grid import run_grid
from workbench.experiments.runs.before_after import BeforeAfterRun
from workbench.experiments.runs.compaction import CompactionRun
from workbench.experiments.runs.equal_size import EqualSizeRun
from workbench.experiments.runs.schemes import scheme_name
from workbench.reproduction.beyond import three_dimensions as dims
from workbench.reproduction.claims import claim_by_id, verdict

CLIPS = [f"cmu/{index:02d}" for index in range(8)]


def _results(solid: float, equal: float) -> pd.DataFrame:
    """Errors 1 in the plane, ``solid`` in space, ``equal`` in the plane at equal bytes."""
    rows = []
    for index, clip in enumerate(CLIPS):
        noise = 1 + 0.001 * index
        common = {"status": "done", "message": "", "dataset": clip, "standardize": False}
        for name in ("t-SNE", "PCA"):
            for scheme, error, size in (
                (dims.FLAT[name], 1.0, 1000),
                (dims.SOLID[name], solid, 1100),
            ):
                rows.append(
                    {
                        **common,
                        "kind": "spatial",
                        "scheme": scheme_name(scheme),
                        "ratio": 0.03,
                        "n_control_points": 10,
                        "file_error": error * noise,
                        "bytes": size,
                    }
                )
            rows.append(
                {
                    **common,
                    "kind": "equal size",
                    "scheme": scheme_name(dims.FLAT[name]),
                    "reference": scheme_name(dims.SOLID[name]),
                    "ratio": 0.03,
                    "n_control_points": 12,
                    "file_error": equal,
                    "bytes": 1095,
                }
            )
    return pd.DataFrame(rows)


def test_clips_are_compared_at_equal_keyframes_and_at_equal_bytes():
    """Ratios are those of the errors; the third coordinate's bytes are worth keyframes."""
    compared = dims.compare_dimensions(_results(0.9, 0.8))
    assert len(compared) == 16
    row = compared.iloc[0]
    assert row[dims.EQUAL_KEYFRAMES] == pytest.approx(0.9)
    assert row[dims.EQUAL_BYTES] == pytest.approx(0.9 / 0.8)
    assert row["size"] == pytest.approx(1.1)
    table = dims.dimension_table(compared)
    assert table.loc["t-SNE", ("bytes", "more keyframes in 2-D, %")] == pytest.approx(20)
    assert table.loc["PCA", ("3-D / 2-D, equal keyframes", "lower on")] == "8 of 8"
    assert table.loc["PCA", ("3-D / 2-D, equal bytes", "lower on")] == "0 of 8"
    boxes = dims.dimension_boxes(compared)
    assert boxes[dims.EQUAL_KEYFRAMES]["PCA"].median == pytest.approx(0.9)


def test_evidence_decides_the_claims():
    """Lower at equal keyframes and higher at equal bytes: one claim holds, the other does not."""
    compared = dims.compare_dimensions(_results(0.9, 0.8))
    for claim, kind, expected in (
        ("ours:third-dimension-lowers-error", dims.EQUAL_KEYFRAMES, "reproduced"),
        ("ours:third-dimension-pays", dims.EQUAL_BYTES, "not reproduced"),
    ):
        evidence = dims.dimension_evidence(compared, kind)
        assert evidence.estimate.n_units == 8
        assert verdict(claim_by_id(claim), evidence) == expected


def test_clips_without_all_runs_are_left_out():
    """A failed run takes its clip and projector out of the comparison; nothing is left of all."""
    results = _results(0.9, 0.8)
    results.loc[0, "status"] = "failed"
    assert len(dims.compare_dimensions(results)) == 15
    compared = dims.compare_dimensions(results.assign(status="failed"))
    assert compared.empty
    assert dims.dimension_table(compared).empty
    assert dims.dimension_evidence(compared, dims.EQUAL_BYTES).estimate is None


def test_a_real_grid_of_tables(tmp_path):
    """On Iris PCA leaves less in three dimensions than in two, before and after optimization."""
    runs = [
        run
        for run in dims.dimension_runs([], ["uci/iris"], "quick")
        if run.scheme.projector == "pca"
    ]
    errors = dims.table_errors(run_grid(runs, tmp_path))
    assert errors.index.tolist() == ["iris, PCA"]
    assert (errors.xs("3-D / 2-D", axis=1, level=1) < 1).all(axis=None)
    assert (errors["optimized"]["3-D"] <= errors["before"]["3-D"]).all()


def test_planned_runs_ask_for_the_same_methods_in_both():
    """Each scheme in space has its twin in the plane, and a run of equal size."""
    runs = dims.planned_runs("quick", 0)
    compactions = {run for run in runs if isinstance(run, CompactionRun)}
    for run in compactions:
        assert {replace(run, scheme=replace(run.scheme, dimensions=d)) for d in (None, 3)} <= (
            compactions
        )
    assert sum(isinstance(run, EqualSizeRun) for run in runs) == len(compactions) / 2
    assert any(isinstance(run, BeforeAfterRun) for run in runs)
