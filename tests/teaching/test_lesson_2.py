"""Lesson 2: right answers computed another way, and the hints for wrong ones."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from workbench.quality.stress import scale_normalized_stress, stress
from workbench.teaching import Lesson


def _pairs(*matrices):
    upper = np.triu_indices(len(matrices[0]), k=1)
    return [matrix[upper] for matrix in matrices]


def _raw(distances, plane_distances):
    d, delta = _pairs(distances, plane_distances)
    return ((d - delta) ** 2).sum()


def _factor(distances, plane_distances):
    """Find the best scale by a search, not by the formula."""
    found = minimize_scalar(
        lambda factor: _raw(distances, factor * plane_distances), bracket=(0.0, 1.0)
    )
    return found.x


def _normalized(distances, plane_distances):
    factor = _factor(distances, plane_distances)
    return _raw(distances, factor * plane_distances) / _raw(distances, 0 * distances)


def _seen_better(distances, before, after):
    better = [
        name
        for name, measure in (("Eq. 4.1", stress), ("scale-normalised", scale_normalized_stress))
        if measure(distances, after) < measure(distances, before)
    ]
    return better[0] if len(better) == 1 else ("both" if better else "neither")


RIGHT = {
    "raw-stress": lambda **_: _raw,
    "units": lambda unit: unit * unit,
    "fool-eq-4.1": lambda **_: 10.0,
    "best-factor": _factor,
    "scale-normalized": lambda **_: _normalized,
    "two-verdicts": _seen_better,
}

WRONG = {
    "each pair twice": ("raw-stress", lambda **_: lambda d, p: ((d - p) ** 2).sum(), "twice"),
    "absolute": ("raw-stress", lambda **_: lambda d, p: abs(d - p).sum() / 2, "absolute"),
    "a root": ("raw-stress", lambda **_: lambda d, p: _raw(d, p) ** 0.5, "root"),
    "a mean": ("raw-stress", lambda **_: lambda d, p: ((d - p) ** 2).mean(), "mean"),
    "not squared": (
        "raw-stress",
        lambda **_: lambda d, p: abs(np.subtract(*_pairs(d, p)).sum()),
        "cancel",
    ),
    "the unit itself": ("units", lambda unit: unit, "squared"),
    "no change": ("units", lambda **_: 1, "does change"),
    "no change of the map": ("fool-eq-4.1", lambda **_: 1.0, "Try a larger factor"),
    "far too large": (
        "fool-eq-4.1",
        # So large that the stress of a map of all but equal places is exceeded: never.
        lambda **_: 0.0,
        "above 0",
    ),
    "a smaller map": ("fool-eq-4.1", lambda **_: 0.5, "Try a larger factor"),
    "the factor of Eq. 4.1": (
        "best-factor",
        lambda distances, plane_distances: (
            (distances**2).sum() / (distances * plane_distances).sum()
        ),
        "minimises Eq. 4.1",
    ),
    "one over the factor": (
        "best-factor",
        lambda distances, plane_distances: 1 / _factor(distances, plane_distances),
        "1 / α",
    ),
    "equal means": (
        "best-factor",
        lambda distances, plane_distances: distances.mean() / plane_distances.mean(),
        "mean distances equal",
    ),
    "not scaled": (
        "scale-normalized",
        lambda **_: lambda d, p: _raw(d, p) / _raw(d, 0 * d),
        "multiplied by α first",
    ),
    "Eq. 4.1": (
        "scale-normalized",
        lambda **_: lambda d, p: _raw(d, p) / _raw(p, 0 * p),
        "This is Eq. 4.1",
    ),
    "over the scaled map": (
        "scale-normalized",
        lambda **_: lambda d, p: _raw(d, _factor(d, p) * p) / _raw(_factor(d, p) * p, 0 * p),
        "divide by Σ d² of the data",
    ),
    "stress-1": ("scale-normalized", lambda **_: lambda d, p: _normalized(d, p) ** 0.5, "root"),
    "the wrong verdict": ("two-verdicts", lambda **_: "both", "before and after"),
    "no verdict": ("two-verdicts", lambda **_: "neither", "before and after"),
}


@pytest.mark.parametrize("key", RIGHT)
def test_right_answers_are_accepted(key, given):
    """What another implementation gives is right."""
    arguments = given(2)[key]
    assert Lesson(2).check(key, RIGHT[key](**arguments), **arguments).state == "solved"


@pytest.mark.parametrize(("key", "answer", "told"), WRONG.values(), ids=WRONG)
def test_wrong_answers_get_their_hint(key, answer, told, given):
    """Each typical mistake is told from the others."""
    arguments = given(2)[key]
    feedback = Lesson(2).check(key, answer(**arguments), **arguments)
    assert feedback.state == "wrong"
    assert told in feedback.verdict.text


def test_the_two_formulas_disagree_as_the_text_says(given):
    """Eq. 4.1 finds the optimized map better, scale-normalised stress finds it worse."""
    assert _seen_better(**given(2)["two-verdicts"]) == "Eq. 4.1"
