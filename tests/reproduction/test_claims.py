"""The ledger of claims and the rules of its verdicts."""

from __future__ import annotations

import math
import re

import pytest

from workbench.errors import WorkbenchError
from workbench.experiments.bootstrap import Estimate
from workbench.reproduction.claims import (
    MIN_UNITS,
    NOT_DECIDABLE,
    NOT_REPRODUCED,
    REPRODUCED,
    Claim,
    Evidence,
    all_claims,
    claim_by_id,
    verdict,
)
from workbench.reproduction.items import NOTEBOOKS

BELOW = Claim("a:b", "It falls.", "page 1", "n", "t", "after / before", below=1.0)
BETWEEN = Claim("a:c", "It is near.", "page 1", "n", "t", "ours / theirs", above=0.9, below=1.1)


@pytest.mark.parametrize(
    ("claim", "interval", "expected"),
    [
        (BELOW, (0.8, 0.9), REPRODUCED),
        (BELOW, (0.8, 1.1), NOT_DECIDABLE),
        (BELOW, (1.1, 1.2), NOT_REPRODUCED),
        (BELOW, (1.0, 1.2), NOT_REPRODUCED),
        (BELOW, (0.9, 1.0), NOT_DECIDABLE),
        (BETWEEN, (0.95, 1.05), REPRODUCED),
        (BETWEEN, (0.5, 0.8), NOT_REPRODUCED),
        (BETWEEN, (1.2, 1.3), NOT_REPRODUCED),
        (BETWEEN, (0.8, 1.2), NOT_DECIDABLE),
        (BETWEEN, (0.8, 1.0), NOT_DECIDABLE),
    ],
)
def test_the_whole_interval_decides(claim: Claim, interval: tuple[float, float], expected: str):
    """Inside, outside, or on both sides of where the claim holds."""
    low, high = interval
    found = Estimate((low + high) / 2, low, high, n_units=MIN_UNITS)
    assert verdict(claim, Evidence(found)) == expected


def test_few_units_decide_nothing():
    """One fewer than the least number is too few, whichever way they point."""
    for low, high in ((0.1, 0.2), (2.0, 3.0)):
        found = Estimate(low, low, high, n_units=MIN_UNITS - 1)
        assert verdict(BELOW, Evidence(found)) == NOT_DECIDABLE


def test_no_number_decides_nothing_and_a_formula_alone():
    """Missing data are not decidable; what follows from a formula needs no units."""
    assert verdict(BELOW, Evidence(None, note="no answers")) == NOT_DECIDABLE
    assert verdict(BELOW, Evidence(Estimate.exact(0.5))) == REPRODUCED
    assert verdict(BELOW, Evidence(Estimate.exact(1.5))) == NOT_REPRODUCED


def test_where_a_claim_holds_is_said_in_words():
    """Only the bounds that there are."""
    assert BELOW.holds_where == "below 1"
    assert BETWEEN.holds_where == "above 0.9 and below 1.1"


@pytest.mark.parametrize("claim", all_claims().values(), ids=all_claims().keys())
def test_each_claim_is_complete(claim: Claim):
    """Its id, sentence, place, notebook, test and bounds are what the ledger needs."""
    assert re.fullmatch(r"(costa2018|halit2010|ours):[a-z0-9]+(-[a-z0-9]+)*", claim.id)
    assert re.fullmatch(r"[A-ZÀ-Þ0-9].*\.", claim.sentence)
    assert claim.test.endswith(".")
    assert claim.effect
    assert claim.notebook in {notebook.name for notebook in NOTEBOOKS}
    assert claim.place.startswith("ours" if claim.id.startswith("ours:") else ("Costa", "Halit"))
    assert claim.above < claim.below
    assert math.isfinite(claim.above) or math.isfinite(claim.below)


def test_an_unknown_claim_is_refused():
    """A misspelt id is an error that lists the right ones."""
    with pytest.raises(WorkbenchError, match="claim: got 'ours:none', want one of costa2018:"):
        claim_by_id("ours:none")
