"""Runs of schemes, as a grid stores them."""

from __future__ import annotations

import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from tests.experiments.small_grids import OPTIMIZED, PAIR, RAW
from workbench.datasets import load_space
from workbench.experiments.grid import run_grid
from workbench.experiments.runs.schemes import SchemeRun
from workbench.experiments.store import ResultStore
from workbench.optimization import optimizers
from workbench.optimization.local_search import LocalSearch
from workbench.schemes import SpatialScheme

KINDS = {
    "one step": {},
    "two steps": {"two_step": "rbfp"},
    "two other steps": {"two_step": "lamp"},
    "three dimensions": {"dimensions": 3},
    "own inverse": {"back_projector": "inverse"},
    "markers": {"markers": "move"},
}


def test_a_row_holds_what_the_scheme_gives(tmp_path: Path):
    """Error and stress of a row are those of the scheme run by hand."""
    row = run_grid(PAIR, tmp_path).iloc[1]
    result = OPTIMIZED.run(load_space("uci/iris"), ratio=0.05, random_state=0)
    assert row["status"] == "done"
    assert row["error"] == result.error
    assert row["relative_error"] == result.relative_error
    assert row["stress"] == result.quality.stress
    assert row["projected_stress"] == result.projected_quality.stress
    assert row["stress_ratio"] == result.quality.stress / result.projected_quality.stress
    assert row["evaluations"] == result.evaluations
    assert (row["n_samples"], row["n_control_points"]) == (150, 7)
    assert row["seconds_optimize"] > 0


@pytest.mark.parametrize("columns", [2, 3])
def test_a_perfect_embedding_has_no_stress_ratio(tmp_path: Path, columns: int):
    """A plane, in two columns or tilted in three, leaves nothing but rounding to divide by."""
    plane = np.random.default_rng(0).normal(size=(60, 2)) @ [[3.0, 0.5, 1.0], [0.2, 2.0, 1.0]]
    file = tmp_path / "plane.csv"
    frame = pd.DataFrame(plane[:, :columns], columns=list("xyz")[:columns])
    frame.to_csv(file, index=False)
    runs = [SchemeRun(str(file), scheme, ratio=0.1) for scheme in (RAW, OPTIMIZED)]
    table = run_grid(runs, tmp_path / "results")
    assert table["message"].tolist() == ["", ""]
    assert table["projected_scale_normalized_stress"].max() < 1e-14
    assert table["scale_normalized_stress_ratio"].isna().all()
    assert table["stress_ratio"].notna().all()


def test_embeddings_are_kept_with_the_result(tmp_path: Path):
    """The arrays of a run are the embeddings of the scheme."""
    row = run_grid(PAIR, tmp_path).iloc[1]
    result = OPTIMIZED.run(load_space("uci/iris"), ratio=0.05, random_state=0)
    arrays = ResultStore(tmp_path).arrays(row["key"])
    assert np.array_equal(arrays["projected"], result.projected)
    assert np.array_equal(arrays["embedding"], result.embedding)
    assert np.array_equal(arrays["control_points"], result.control_points)
    assert np.array_equal(arrays["errors"], result.errors)


def test_raw_and_optimized_share_one_projection(tmp_path: Path, counted: list[int]):
    """Two schemes of one projector project once."""
    schemes = [
        SpatialScheme("counted", selector="random", optimizer=optimizer)
        for optimizer in (None, "alg12")
    ]
    table = run_grid([SchemeRun("uci/iris", scheme, ratio=0.05) for scheme in schemes], tmp_path)
    assert table["status"].tolist() == ["done", "done"]
    assert counted == [150]


@pytest.mark.parametrize("count", [7, 12])
def test_every_kind_of_scheme_is_stored_as_run_by_hand(tmp_path: Path, count: int):
    """Runs side by side share nothing that is not theirs, and are found again afterwards."""
    schemes = [SpatialScheme("pca", selector="random", **kind) for kind in KINDS.values()]
    runs = [SchemeRun("uci/iris", scheme, count=count) for scheme in schemes]
    table = run_grid(runs, tmp_path)
    for scheme, (_, row) in zip(schemes, table.iterrows(), strict=True):
        result = scheme.run(load_space("uci/iris"), count=count, random_state=0)
        arrays = ResultStore(tmp_path).arrays(row["key"])
        assert row["error"] == result.error
        assert row["stress"] == result.quality.stress
        assert row["projected_stress"] == result.projected_quality.stress
        assert np.array_equal(arrays["projected"], result.projected)
        assert np.array_equal(arrays["embedding"], result.embedding)
    assert table["scheme"].is_unique
    assert table["two_step"].dropna().tolist() == ["rbfp", "lamp"]
    assert table["dimensions"].dropna().tolist() == [3]
    assert table["markers"].dropna().tolist() == ["move"]
    pd.testing.assert_frame_equal(run_grid(runs, tmp_path), table)


def test_only_one_step_projections_are_shared(tmp_path: Path, counted: list[int]):
    """Raw and optimized share one for each number of dimensions; two steps see half the data."""
    schemes = [
        SpatialScheme("counted", selector="random", optimizer=optimizer, **kind)
        for kind in ({}, {"dimensions": 3}, {"two_step": "rbfp"})
        for optimizer in (None, "local")
    ]
    table = run_grid([SchemeRun("uci/iris", scheme, ratio=0.05) for scheme in schemes], tmp_path)
    assert table["message"].tolist() == [""] * 6
    assert sorted(counted)[2:] == [150, 150]
    assert len(counted) == 4
    assert sorted(counted)[1] < 150


def test_a_row_counts_the_effort_of_all_searches(tmp_path: Path):
    """Derivatives and distances of the optimizer and of the search for markers, added up."""
    scheme = SpatialScheme("pca", selector="random", optimizer="local", markers="move")
    row = run_grid([PAIR[0], SchemeRun("uci/iris", scheme, ratio=0.05)], tmp_path)
    result = scheme.run(load_space("uci/iris"), ratio=0.05, random_state=0)
    effort = result.optimization.effort + result.marker_result.effort
    assert row["jacobians"].tolist() == [0, effort.jacobians]
    assert row["distances"].tolist() == [0, effort.distances]
    assert row["evaluations"].tolist() == [143, effort.evaluations + 143]


def test_the_effort_of_a_reticent_optimizer_is_unknown(tmp_path: Path, monkeypatch):
    """An optimizer of a user's own need not count; its run is stored all the same."""

    class Reticent(LocalSearch):
        def optimize(self, *arguments, **options):
            return replace(super().optimize(*arguments, **options), effort=None)

    monkeypatch.setitem(optimizers._entries, "reticent", Reticent)
    scheme = SpatialScheme("pca", selector="random", optimizer="reticent")
    row = run_grid([SchemeRun("uci/iris", scheme, ratio=0.05)], tmp_path).iloc[0]
    assert row["status"] == "done"
    assert row["jacobians"] is None
    assert row["distances"] is None


def test_warnings_are_kept_with_the_result(tmp_path: Path):
    """What the methods warn of is in the rows of all runs that share the projection."""
    runs = [
        SchemeRun("uci/iris", SpatialScheme("isomap", optimizer=o), ratio=0.05)
        for o in (None, "alg12")
    ]
    with warnings.catch_warnings(record=True) as printed:
        table = run_grid(runs, tmp_path)
    assert printed == []
    assert all("falls into 2 parts" in text for text in table["warnings"])
