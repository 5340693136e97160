"""The ledger of claims."""

from __future__ import annotations

from pathlib import Path

import pandas as pd
import pytest

from workbench.errors import WorkbenchError
from workbench.experiments.bootstrap import Estimate
from workbench.reproduction.claims import Evidence, all_claims
from workbench.reproduction.ledger import count_verdicts, write_ledger
from workbench.reproduction.outputs import Outputs, read_evidence

CLAIM = "costa2018:tsne-below-slerp"
NOTEBOOK = "costa2018_table_5_1"


def test_evidence_comes_back_as_it_was_saved(tmp_path: Path):
    """What a notebook saves is what the ledger reads."""
    evidence = Evidence(Estimate(0.86, 0.8, 0.91, 29, 3), "clips", "CMU clips.")
    Outputs(tmp_path).claim(CLAIM, evidence)
    assert read_evidence(tmp_path, CLAIM) == evidence
    Outputs(tmp_path).claim(CLAIM, Evidence(None, note="No data."))
    assert read_evidence(tmp_path, CLAIM) == Evidence(None, note="No data.")


def test_evidence_for_no_claim_is_refused(tmp_path: Path):
    """An id that no claim has is named, with those that exist."""
    with pytest.raises(WorkbenchError, match="claim: got 'costa2018:nonsense', want one of"):
        Outputs(tmp_path).claim("costa2018:nonsense", Evidence(None))
    assert not list(tmp_path.iterdir())


def test_the_ledger_judges_and_says_what_it_rests_on(tmp_path: Path):
    """A row has the effect, the interval, the data and the verdict, a claim without one too."""
    Outputs(tmp_path).claim(CLAIM, Evidence(Estimate(0.86, 0.8, 0.914, 29, 3), "clips", "CMU."))
    rows = {row["claim"].id: row for row in write_ledger(tmp_path, [NOTEBOOK])}
    assert set(rows) == {c.id for c in all_claims().values() if c.notebook == NOTEBOOK}
    row = rows.pop(CLAIM)
    assert (row["effect"], row["interval"]) == ("0.86", "0.8 to 0.914")
    assert (row["data"], row["verdict"], row["note"]) == ("29 clips, 3 seeds", "reproduced", "CMU.")
    assert {other["verdict"] for other in rows.values()} == {"not decidable"}
    assert count_verdicts([row]) == {"reproduced": 1, "not reproduced": 0, "not decidable": 0}


def test_few_clips_decide_nothing_and_the_note_says_so(tmp_path: Path):
    """With five clips the verdict is open, however narrow the interval."""
    Outputs(tmp_path).claim(CLAIM, Evidence(Estimate(0.86, 0.86, 0.86, 1), "clips", "Short."))
    (row,) = (r for r in write_ledger(tmp_path, [NOTEBOOK]) if r["claim"].id == CLAIM)
    assert row["data"] == "1 clip"
    Outputs(tmp_path).claim(CLAIM, Evidence(Estimate(0.86, 0.85, 0.87, 5), "clips", "Short."))
    (row,) = (r for r in write_ledger(tmp_path, [NOTEBOOK]) if r["claim"].id == CLAIM)
    assert row["verdict"] == "not decidable"
    assert row["note"] == "Short. Too few clips to decide: 5, want 6 or more."


def test_the_ledger_is_a_table_too(tmp_path: Path):
    """CSV, Markdown and LaTeX lie with the other tables, one row for each claim."""
    Outputs(tmp_path).claim(CLAIM, Evidence(Estimate(0.86, 0.8, 0.91, 29)))
    rows = write_ledger(tmp_path, [NOTEBOOK])
    table = pd.read_csv(tmp_path / "tables" / "claims.csv", index_col="id")
    assert len(table) == len(rows)
    assert table.loc[CLAIM, "verdict"] == "reproduced"
    assert "| reproduced |" in (tmp_path / "tables" / "claims.md").read_text()
    assert r"\begin{tabular}{lrrrrr}" in (tmp_path / "tables" / "claims.tex").read_text()
