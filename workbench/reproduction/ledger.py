"""The ledger of claims: each with its evidence and the verdict, for the report and as tables."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from workbench.files import write_atomically
from workbench.reproduction.claims import (
    MIN_UNITS,
    NOT_DECIDABLE,
    NOT_REPRODUCED,
    REPRODUCED,
    Claim,
    Evidence,
    all_claims,
    verdict,
)
from workbench.reproduction.outputs import read_evidence, slug
from workbench.reproduction.tables import as_latex, as_markdown

_CAPTION = (
    "Claims, our evidence with a 95 % bootstrap interval over clips and seeds, and the verdict: "
    "reproduced if the whole interval lies where the claim holds, not reproduced if none of it "
    "does."
)


def write_ledger(out: Path, notebooks: Sequence[str]) -> list[dict[str, Any]]:
    """Judge the claims that some notebooks give evidence for, and save the verdicts as tables.

    Parameters
    ----------
    out : Path
        The output folder of a reproduction.
    notebooks : sequence of str
        The notebooks whose claims are wanted.

    Returns
    -------
    list of dict
        One for each claim, in the order of the ledger: the claim and, as texts, its effect,
        interval, data, verdict and note.
    """
    rows = [
        _row(claim, read_evidence(out, claim.id))
        for claim in all_claims().values()
        if claim.notebook in notebooks
    ]
    if rows:
        _write_tables(out, rows)
    return rows


def count_verdicts(rows: Sequence[dict[str, Any]]) -> dict[str, int]:
    """Count the verdicts of a ledger, in a fixed order."""
    counts = Counter(row["verdict"] for row in rows)
    return {name: counts[name] for name in (REPRODUCED, NOT_REPRODUCED, NOT_DECIDABLE)}


def _row(claim: Claim, evidence: Evidence | None) -> dict[str, Any]:
    found = evidence or Evidence(None, note="Its notebook has not given evidence.")
    estimate = found.estimate
    note = found.note
    if estimate is not None and 0 < estimate.n_units < MIN_UNITS:
        few = f"Too few {found.units} to decide: {estimate.n_units}, want {MIN_UNITS} or more."
        note = f"{note} {few}".strip()
    return {
        "claim": claim,
        "anchor": f"claim-{slug(claim.id)}",
        "verdict": verdict(claim, found),
        "effect": "" if estimate is None else _number(estimate.value),
        "interval": (
            ""
            if estimate is None or estimate.n_units == 0
            else f"{_number(estimate.low)} to {_number(estimate.high)}"
        ),
        "data": _data(found),
        "note": note,
    }


def _data(evidence: Evidence) -> str:
    """Say how much data an estimate rests on: "29 clips, 3 seeds"."""
    estimate = evidence.estimate
    if estimate is None:
        return ""
    if estimate.n_units == 0:
        return "by formula"
    seeds = f", {estimate.n_seeds} seeds" if estimate.n_seeds > 1 else ""
    units = evidence.units.removesuffix("s") if estimate.n_units == 1 else evidence.units
    return f"{estimate.n_units} {units}{seeds}"


def _number(value: float) -> str:
    return f"{value:.3g}".replace("-", "\N{MINUS SIGN}")


def _write_tables(out: Path, rows: Sequence[dict[str, Any]]) -> None:
    # Imported here because a report of nothing, as of a first listing, needs no table.
    import pandas as pd

    table = pd.DataFrame(
        [
            {
                "claim": row["claim"].sentence,
                "source": row["claim"].place,
                "effect": row["claim"].effect,
                "holds where": row["claim"].holds_where,
                "published": row["claim"].published,
                "ours": row["effect"],
                "interval": row["interval"],
                "data": row["data"],
                "verdict": row["verdict"],
                "note": row["note"],
            }
            for row in rows
        ],
        index=pd.Index([row["claim"].id for row in rows], name="id"),
    )
    path = out / "tables" / "claims.csv"
    write_atomically(path, table.to_csv(lineterminator="\n").encode())
    write_atomically(path.with_suffix(".md"), as_markdown(table, _CAPTION).encode())
    short = table[["claim", "ours", "interval", "data", "verdict"]]
    write_atomically(path.with_suffix(".tex"), as_latex(short, _CAPTION, "claims").encode())
