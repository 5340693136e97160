"""Figures 5.12 to 5.17 from a real, small grid."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from workbench.datasets import load_space
from workbench.experiments.grid import run_grid
from workbench.experiments.store import ResultStore
from workbench.projection import scale_to_unit_square
from workbench.reproduction.costa2018.uci_projections import (
    TABLE_5_3,
    planned_runs,
    uci_alt,
    uci_caption,
    uci_panels,
    uci_quality,
    uci_ratios,
    uci_runs,
)
from workbench.reproduction.costa2018.uci_tables import UCI_TABLES

WINE = next(table for table in UCI_TABLES if table.dataset == "uci/wine")
YEAST = next(table for table in UCI_TABLES if table.dataset == "uci/yeast")


@pytest.fixture(scope="module")
def store(tmp_path_factory: pytest.TempPathFactory) -> ResultStore:
    """Give a place for results."""
    return ResultStore(tmp_path_factory.mktemp("results"))


@pytest.fixture(scope="module")
def results(store: ResultStore) -> pd.DataFrame:
    """Run the grid of one figure."""
    return run_grid(uci_runs([WINE], "quick", seed=2, items=[WINE.item]), store.folder)


def test_schemes_take_two_steps():
    """Every run is RBFP from a seed projector with control points by ROLS, and Alg. 12."""
    for run in uci_runs(UCI_TABLES, "full"):
        assert (run.scheme.two_step, run.scheme.selector) == ("rbfp", "rols")
        assert run.scheme.optimizer == "alg12"
        assert run.ratio == 0.03


@pytest.mark.parametrize(
    ("tables", "profile", "items", "count"),
    [
        ([WINE], "quick", None, 12),
        ([WINE], "full", None, 36),
        ([WINE], "full", [TABLE_5_3], 36),
        ([WINE], "full", [WINE.item], 2),
        ([YEAST], "quick", None, 1),
        ([YEAST], "quick", [YEAST.item], 1),
    ],
    ids=["quick", "full", "the table", "one figure", "large", "figure of a large one"],
)
def test_profiles_choose_how_much(tables, profile, items, count):
    """Projectors x scalings x seeds; a figure alone, and large tables in quick, need few."""
    assert len(uci_runs(tables, profile, items=items)) == count


def test_planned_runs_are_those_of_the_tables_that_are_here():
    """Iris and Wine are bundled, and no run is planned without its data."""
    planned = {run.dataset for run in planned_runs("quick", 0)}
    assert {"uci/iris", "uci/wine"} <= planned
    assert all(len(load_space(name)) >= 150 for name in planned)


def test_panels_are_raw_beside_optimized(results: pd.DataFrame, store: ResultStore):
    """Four panels; optimization moves no control point, standardisation changes the data."""
    raw, optimized, raw_standard, optimized_standard = uci_panels(results, WINE, store)
    assert [panel.title for panel in (raw, optimized)] == [
        "2-step ROLS, data as they are",
        "optimized",
    ]
    for before, after in ((raw, optimized), (raw_standard, optimized_standard)):
        fixed = before.control_points
        assert np.array_equal(before.points[fixed], after.points[fixed])
        assert not np.array_equal(before.points, after.points)
        assert np.allclose(scale_to_unit_square(before.points), before.points)
    assert not np.allclose(raw.points, raw_standard.points)


def test_quality_is_told_before_and_after(results: pd.DataFrame):
    """The optimizer lowers the error, on both scalings; the ratios are those of the stresses."""
    quality = uci_quality(results, WINE)
    assert quality.index.tolist() == ["data as they are", "standardised data"]
    assert (quality["error", "after"] < quality["error", "before"]).all()
    stress = quality["stress, Eq. 4.1"]
    assert uci_ratios(results, WINE) == pytest.approx(
        (stress["after"] / stress["before"]).to_dict()
    )


def test_the_caption_hides_nothing(results: pd.DataFrame):
    """Rows, control points, the projector, both ratios, the published one and the method."""
    caption = uci_caption(results, WINE)
    for words in (
        "178 rows, 5 control points (crosses), seed projector Force",
        "by Eq. 4.1 (scale-normalised): data as they are ",
        "Published: 0.72, scaling of the data not stated",
        "ROLS chooses 3 %",
    ):
        assert words in caption
    assert "the mean error falls from" in uci_alt(results, WINE)


def test_failed_runs_are_in_the_caption_and_not_in_the_figure(store: ResultStore, results):
    """Without a finished run there is no panel and no row, but a reason."""
    failed = results.assign(status="failed", message="uci/wine: broken")
    assert uci_panels(failed, WINE, store) == []
    assert len(uci_quality(failed, WINE)) == 0
    assert "2 of 2 runs failed; the first: uci/wine: broken" in uci_caption(failed, WINE)


def test_a_projection_without_stress_has_no_ratio(results: pd.DataFrame):
    """A missing ratio is left out of the values and named in the caption."""
    without = results.assign(stress_ratio=results["stress_ratio"].mask(~results["standardize"]))
    assert list(uci_ratios(without, WINE)) == ["standardised data"]
    assert "data as they are none (" in uci_caption(without, WINE)


@pytest.mark.parametrize("table", UCI_TABLES, ids=lambda table: table.title)
def test_styles_name_all_classes(table):
    """The classes of the captions are those of the data, each with a look of its own."""
    assert len(set(table.styles.values())) == len(table.styles)
    try:
        labels = load_space(table.dataset).labels
    except Exception as error:  # whatever keeps the table from being here
        pytest.skip(f"{table.dataset} is not on this machine: {error}")
    assert set(table.styles) == (set() if labels is None else set(labels.tolist()))
