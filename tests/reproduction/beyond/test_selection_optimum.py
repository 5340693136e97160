"""Distance from the optimum, from errors that are known."""

from __future__ import annotations

import pandas as pd
import pytest

from workbench.experiments.grid import run_grid
from workbench.experiments.runs.schemes import scheme_name
from workbench.reproduction.beyond import selection_optimum


def results(errors):
    """Make a result table: for each selector its errors on clips a, b, c."""
    return pd.DataFrame(
        {
            "status": "done",
            "dataset": f"cmu/{clip}",
            "scheme": scheme_name(selection_optimum.SCHEMES[name]),
            "seed": 0,
            "error": error,
        }
        for name, values in errors.items()
        for clip, error in zip("abc", values, strict=False)
    )


TABLE = results(
    {
        "Uniform": [1.4, 1.2, 2.0],
        "SCS": [1.1, 1.5, 2.2],
        "PB": [1.3, 1.3, 2.1],
        "Chord": [1.6, 1.6, 1.0],
        "Saliency": [1.5, 1.5, 3.0],
        "Exact": [1.0, 1.0],
    }
)


def test_errors_are_relative_to_the_exact_selection():
    """Clips without it are left out."""
    ratios = selection_optimum.ratios_to_optimum(TABLE)
    assert list(ratios.index) == ["cmu/a", "cmu/b"]
    assert ratios.loc["cmu/a", "SCS"] == pytest.approx(1.1)
    assert "Exact" not in ratios


def test_the_best_greedy_selector_may_differ_from_clip_to_clip():
    """SCS on the first, uniform on the second: the median is over the best of each."""
    ratios = selection_optimum.ratios_to_optimum(TABLE)
    found = selection_optimum.greedy_gap(ratios).estimate
    assert (found.value, found.n_units) == (pytest.approx(1.15), 2)
    rows = selection_optimum.optimum_table(ratios)
    assert rows.loc["Best of uniform, SCS, PB", "median"] == pytest.approx(1.15)
    assert rows.loc["SCS", "best on"] == "1 of 2"
    assert rows.loc["PB", "mean"] == pytest.approx(1.3)
    assert selection_optimum.medians(ratios)["PB"].value == pytest.approx(1.3)


def test_nothing_is_below_the_optimum(tmp_path):
    """On a bundled excerpt every selector has at least the error of the exact selection."""
    table = run_grid(selection_optimum.planned_runs("quick", clips=["cmu/01_01-jump"]), tmp_path)
    assert set(table["status"]) == {"done"}
    ratios = selection_optimum.ratios_to_optimum(table)
    assert ratios.shape == (1, 5)
    assert ratios.to_numpy().min() >= 1 - 1e-9
