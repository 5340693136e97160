"""Table 5.3 from known results."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from workbench.experiments.runs.schemes import scheme_name
from workbench.reproduction.claims import claim_by_id, verdict
from workbench.reproduction.costa2018 import uci_stress
from workbench.reproduction.costa2018.results import PROJECTORS
from workbench.reproduction.costa2018.uci_projections import scheme_of
from workbench.reproduction.costa2018.uci_tables import UCI_TABLES
from workbench.reproduction.published import published

SEEDS = (0, 1, 2)


def _results(tables=UCI_TABLES, factor: float = 0.5) -> pd.DataFrame:
    """Ratios of ``factor`` x (1, 1.1, 1.2) for the three seeds, twice that when standardised."""
    return pd.DataFrame(
        [
            {
                "key": "",
                "status": "done",
                "message": "",
                "dataset": table.dataset,
                "scheme": scheme_name(scheme_of(method)),
                "standardize": standardize,
                "seed": seed,
                "n_samples": 100,
                "stress_ratio": factor * (1 + standardize) * (1 + 0.1 * seed),
                "scale_normalized_stress_ratio": 3.0,
                "error": 1.0,
                "projected_error": 4.0,
            }
            for table in tables
            for method in PROJECTORS
            for standardize in (False, True)
            for seed in SEEDS
        ]
    )


def test_the_table_has_ours_published_and_their_difference():
    """Medians and ranges over seeds of one scaling, beside the value that the thesis prints."""
    table = uci_stress.table_5_3(_results(), standardize=False)
    assert len(table) == 42
    row = table.loc["Yeast, MDS"]
    assert row["Eq. 4.1", "published"] == 2.023
    assert row["Eq. 4.1", "ours"] == pytest.approx(0.55)
    assert row["Eq. 4.1", "difference"] == pytest.approx(0.55 - 2.023)
    assert (row["Eq. 4.1", "lowest"], row["Eq. 4.1", "highest"]) == pytest.approx((0.5, 0.6))
    assert row["scale-normalised", "ours"] == 3.0
    assert row["error", "after / before"] == 0.25
    assert row["seeds", ""] == 3


def test_panels_are_arranged_as_printed():
    """The published panel is the printed table; ours have its rows and columns."""
    panels = uci_stress.ratio_panels(_results())
    assert list(panels) == [
        "published, Eq. 4.1",
        "ours, data as they are, Eq. 4.1",
        "ours, standardised data, Eq. 4.1",
        "ours, data as they are, scale-normalised",
        "ours, standardised data, scale-normalised",
    ]
    printed = published("costa2018:tab5.3").table().drop(columns="Attributes")
    assert panels["published, Eq. 4.1"].equals(printed)
    ours = panels["ours, standardised data, Eq. 4.1"]
    assert ours.index.tolist() == printed.index.tolist()
    assert np.allclose(ours, 1.1)
    assert "Ours, data as they are, Eq. 4.1: median 0.55, 42 of 42 below 1." in (
        uci_stress.ratio_alt(_results())
    )


@pytest.mark.parametrize(
    ("factor", "expected"),
    [(0.5, "reproduced"), (2.0, "not reproduced")],
    ids=["falls", "rises"],
)
def test_evidence_decides_the_claim(factor, expected):
    """Seven tables on which stress falls, or rises, everywhere leave no doubt."""
    claim, column, standardize = uci_stress.CLAIMS[0]
    evidence = uci_stress.stress_evidence(_results(factor=factor), column, standardize=standardize)
    assert evidence.units == "tables"
    assert evidence.estimate.n_units == 7
    assert evidence.estimate.value == pytest.approx(factor * np.cbrt(1.1 * 1.2))
    assert verdict(claim_by_id(claim), evidence) == expected


def test_too_few_tables_decide_nothing():
    """A table that lacks a projector does not count, and without any there is no number."""
    few = _results(UCI_TABLES[:3])
    lacking = few[few["scheme"] != scheme_name(scheme_of("LLE"))]
    claim, column, standardize = uci_stress.CLAIMS[0]
    assert (
        verdict(
            claim_by_id(claim), uci_stress.stress_evidence(few, column, standardize=standardize)
        )
        == "not decidable"
    )
    empty = uci_stress.stress_evidence(lacking, column, standardize=standardize)
    assert empty.estimate is None


def test_what_was_used_is_said():
    """Tables with their rows and seeds, those that are not here, and failures."""
    few = _results(UCI_TABLES[:2])
    few.loc[0, ["status", "message"]] = ["failed", "broken"]
    text = uci_stress.describe_tables(few)
    assert "2 of 7 tables: Ionosphere (100 rows, 3 seeds), Iris (100 rows, 3 seeds)." in text
    assert "Not here: Seeds, Wine, Page blocks, Yeast, Cloud." in text
    assert "1 of 72 runs failed; the first: broken" in text
