"""Figures 5.12 to 5.17 from a real, small grid."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from workbench.experiments.grid import run_grid
from workbench.experiments.store import ResultStore
from workbench.reproduction.costa2018.uci_projections import (
    UCI_FIGURES,
    uci_caption,
    uci_panels,
    uci_ratios,
    uci_runs,
    uci_table,
)

WINE = next(figure for figure in UCI_FIGURES if figure.dataset == "uci/wine")


@pytest.fixture(scope="module")
def store(tmp_path_factory: pytest.TempPathFactory) -> ResultStore:
    """Give a place for results."""
    return ResultStore(tmp_path_factory.mktemp("results"))


@pytest.fixture(scope="module")
def table(store: ResultStore) -> pd.DataFrame:
    """Run the grid of one figure."""
    return run_grid(uci_runs([WINE], seed=2), store.folder)


def test_panels_are_raw_beside_optimized(table: pd.DataFrame, store: ResultStore):
    """Four panels; optimization moves no control point, standardisation changes the data."""
    raw, optimized, raw_standard, optimized_standard = uci_panels(table, WINE, store)
    assert [panel.title for panel in (raw, optimized)] == [
        "Force, data as they are",
        "optimized, data as they are",
    ]
    for before, after in ((raw, optimized), (raw_standard, optimized_standard)):
        fixed = before.control_points
        assert np.array_equal(before.points[fixed], after.points[fixed])
        assert not np.array_equal(before.points, after.points)
    assert not np.allclose(raw.points, raw_standard.points)


def test_the_table_compares_before_and_after(table: pd.DataFrame):
    """Errors before are those of the raw scheme; the optimizer lowers them."""
    compared = uci_table(table, [WINE])
    raw = table[table["scheme"] == "force, random"].set_index("standardize")["error"]
    assert compared["error", "before"].tolist() == [raw[False], raw[True]]
    assert (compared["error", "after"] < compared["error", "before"]).all()
    assert compared["stress, after / before", "published"].tolist() == [0.72, 0.72]
    assert uci_ratios(table, WINE) == {
        "one step, data as they are": compared["stress, after / before", "Eq. 4.1"].iloc[0],
        "one step, standardised data": compared["stress, after / before", "Eq. 4.1"].iloc[1],
    }


def test_the_caption_hides_nothing(table: pd.DataFrame):
    """Rows, control points, the projector and the one-step projection are named."""
    caption = uci_caption(table, WINE)
    for words in (
        "178 rows, 5 control points",
        "One-step projection, not the two-step",
        "by Force",
    ):
        assert words in caption


def test_failed_runs_are_in_the_caption_and_not_in_the_figure(store: ResultStore, table):
    """Without a finished run there is no panel and no row, but a reason."""
    failed = table.assign(status="failed", message="uci/wine: broken")
    assert uci_panels(failed, WINE, store) == []
    assert len(uci_table(failed, [WINE])) == 0
    assert "4 of 4 runs failed; the first: uci/wine: broken" in uci_caption(failed, WINE)


def test_a_projection_without_stress_has_no_ratio(table: pd.DataFrame):
    """A missing ratio is left out of the values and named in the caption."""
    without = table.assign(stress_ratio=table["stress_ratio"].mask(~table["standardize"]))
    assert list(uci_ratios(without, WINE)) == ["one step, standardised data"]
    assert "optimization: none on data as they are, " in uci_caption(without, WINE)
