"""Claims of the theses and ours, and the verdicts on them.

A claim names an effect, a number that can be measured, and where it has to lie for the claim
to hold. Evidence is that number with an interval; the verdict follows from the two alone.
"""

from __future__ import annotations

import math
import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from workbench.errors import WorkbenchError
from workbench.experiments.bootstrap import Estimate

REPRODUCED = "reproduced"
NOT_REPRODUCED = "not reproduced"
NOT_DECIDABLE = "not decidable"

#: With fewer clips or tables no interval is to be believed: six that all point one way are the
#: fewest that a two-sided sign test takes for more than chance, at 5 %.
MIN_UNITS = 6


@dataclass(frozen=True)
class Claim:
    """A claim in one sentence, and how it is tested.

    Attributes
    ----------
    id : str
        Such as ``"costa2018:selectors-alike"``.
    sentence : str
        What is claimed.
    place : str
        Where: "Costa 2018, section 5, page 22"; or "ours".
    notebook : str
        The notebook that gives the evidence.
    test : str
        What is measured, and on what.
    effect : str
        Name of the number, such as "median of optimized t-SNE / median of slerp".
    above, below : float, optional
        The claim holds where the effect is above the one and below the other.
    published : str
        The published number or numbers, as text; empty if there is none.
    """

    id: str
    sentence: str
    place: str
    notebook: str
    test: str
    effect: str
    above: float = -math.inf
    below: float = math.inf
    published: str = ""

    @property
    def holds_where(self) -> str:
        """Say where the effect has to lie: "below 1"."""
        parts = [f"above {self.above:g}"] if math.isfinite(self.above) else []
        parts += [f"below {self.below:g}"] if math.isfinite(self.below) else []
        return " and ".join(parts)


@dataclass(frozen=True)
class Evidence:
    """What was found about a claim.

    Attributes
    ----------
    estimate : Estimate or None
        The effect with its interval; None if the data for it are not there.
    units : str
        What was counted: "clips", "tables", "clip-projector pairs".
    note : str
        What a reader should know: the data used, why it cannot be decided.
    """

    estimate: Estimate | None
    units: str = "clips"
    note: str = ""


def verdict(claim: Claim, evidence: Evidence) -> str:
    """Judge a claim by its evidence.

    Parameters
    ----------
    claim : Claim
        The claim.
    evidence : Evidence
        What was found.

    Returns
    -------
    {"reproduced", "not reproduced", "not decidable"}
        Reproduced if the whole interval lies where the claim holds, not reproduced if none
        of it does; not decidable if it lies on both sides, if there is no number, or if it
        rests on fewer than :data:`MIN_UNITS` units. A number that follows from a formula
        rests on none and is judged alone.

    Examples
    --------
    >>> claim = Claim("a:b", "It falls.", "page 1", "n", "t", "after / before", below=1.0)
    >>> verdict(claim, Evidence(Estimate(0.9, 0.85, 0.95, n_units=20)))
    'reproduced'
    >>> verdict(claim, Evidence(Estimate(0.9, 0.85, 1.05, n_units=20)))
    'not decidable'
    >>> verdict(claim, Evidence(Estimate(0.9, 0.85, 0.95, n_units=3)))
    'not decidable'
    """
    found = evidence.estimate
    if found is None or 0 < found.n_units < MIN_UNITS:
        return NOT_DECIDABLE
    if claim.above < found.low and found.high < claim.below:
        return REPRODUCED
    if found.high <= claim.above or claim.below <= found.low:
        return NOT_REPRODUCED
    return NOT_DECIDABLE


@cache
def all_claims() -> dict[str, Claim]:
    """Give all claims by their ids, in the order of the ledger."""
    path = Path(__file__).with_name("claims.toml")
    content: dict[str, dict[str, Any]] = tomllib.loads(path.read_text(encoding="utf-8"))
    return {claim_id: Claim(claim_id, **fields) for claim_id, fields in content.items()}


def claim_by_id(claim_id: str) -> Claim:
    """Look up a claim.

    Raises
    ------
    WorkbenchError
        If there is none of this id.
    """
    if claim_id not in all_claims():
        raise WorkbenchError(f"claim: got {claim_id!r}, want one of {', '.join(all_claims())}")
    return all_claims()[claim_id]
