"""Lesson 3: right answers computed another way, and the hints for wrong ones."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.interpolate import RBFInterpolator
from scipy.spatial.distance import cdist

from workbench.quality.stress import normalized_stress
from workbench.selection.rols import orthogonal_selection
from workbench.teaching import Lesson


def _kernel(samples):
    return np.hypot(1.0, cdist(samples, samples))


def _weights(control_samples, positions):
    # SciPy's multiquadric is −√(1 + r²).
    fitted = RBFInterpolator(
        control_samples, positions, kernel="multiquadric", epsilon=1, degree=-1
    )
    return -fitted._coeffs


def _shares(sample, control_samples, power=2):
    weights = cdist([sample], control_samples)[0] ** -power
    return weights / weights.sum()


def _ratios(columns, outputs, r, above=0.0):
    return np.array(
        [
            sum(((a @ q) ** 2 + above) / ((a @ a + r) * (q @ q)) for q in outputs.T)
            for a in columns.T
        ]
    )


def _first_below(departures, curve, limit):
    return next(count for count in sorted(departures[curve]) if departures[curve][count] < limit)


def _least(distances, maps):
    """Compare at each map's best scale, found among many."""
    scales = np.geomspace(0.1, 100, 3000)
    unit = {
        name: np.sqrt((distances**2).sum() / (cdist(p, p) ** 2).sum()) for name, p in maps.items()
    }
    return min(
        maps,
        key=lambda name: min(
            normalized_stress(distances, unit[name] * scale * maps[name])
            for scale in scales[np.abs(np.log(scales)) < 0.4]
        ),
    )


RIGHT = {
    "second-step": lambda n_samples, n_control_points: sum(
        n_samples - n_control_points for _ in range(n_control_points)
    ),
    "rbf-weights": lambda **_: _weights,
    "lamp-weights": lambda **_: _shares,
    "flat-sheet": lambda **_: "LAMP",
    "error-ratios": lambda **_: _ratios,
    "how-many": _first_below,
    "least-stress": _least,
}

WRONG = {
    "control points too": (
        "second-step",
        lambda n_samples, n_control_points: n_samples * n_control_points,
        "have their places already",
    ),
    "all pairs": (
        "second-step",
        lambda n_samples, n_control_points: n_samples * (n_samples - 1) // 2,
        "all pairs",
    ),
    "no root": (
        "rbf-weights",
        lambda **_: lambda c, y: np.linalg.solve(_kernel(c) ** 2, y),
        "root",
    ),
    "linear kernel": (
        "rbf-weights",
        lambda **_: lambda c, y: np.linalg.solve(cdist(c, c), y),
        "φ(r) = r",
    ),
    "multiplied": ("rbf-weights", lambda **_: lambda c, y: _kernel(c) @ y, "solve the system"),
    "the matrix": ("rbf-weights", lambda **_: lambda c, y: _kernel(c), "This is the matrix"),
    "the positions": ("rbf-weights", lambda **_: lambda c, y: y, "linear system"),
    "weights in columns": (
        "rbf-weights",
        lambda **_: lambda c, y: _weights(c, y).T,
        "returns has shape (2, 8). An array of shape (8, 2)",
    ),
    "over the distance": (
        "lamp-weights",
        lambda **_: lambda x, c: _shares(x, c, power=1),
        "Square it",
    ),
    "no sum of 1": (
        "lamp-weights",
        lambda **_: lambda x, c: cdist([x], c)[0] ** -2,
        "sum up to 1",
    ),
    "far is heavy": (
        "lamp-weights",
        lambda **_: lambda x, c: _shares(x, c, power=-2),
        "far control points weigh most",
    ),
    "the bent one": ("flat-sheet", lambda **_: "RBFP", "largest difference"),
    "r left out": (
        "error-ratios",
        lambda **_: lambda a, q, r: _ratios(a, q, 0.0),
        "The r is missing",
    ),
    "r above the line": (
        "error-ratios",
        lambda **_: lambda a, q, r: _ratios(a, q, 0.0, above=r),
        "above the line",
    ),
    "not over the columns": (
        "error-ratios",
        lambda **_: lambda a, q, r: ((a.T @ q) ** 2 / (q**2).sum(axis=0)).sum(axis=1),
        "each column (plus r)",
    ),
    "one output only": (
        "error-ratios",
        lambda **_: lambda a, q, r: _ratios(a, q[:, :1], r),
        "sum up over the outputs",
    ),
    "the other curve": (
        "how-many",
        lambda departures, curve, limit: _first_below(departures, "RBFP, random", limit),
        "curve of random",
    ),
    "the departure": (
        "how-many",
        lambda departures, curve, limit: departures[curve][_first_below(departures, curve, limit)],
        "This is the departure",
    ),
    "the whole map": ("least-stress", lambda **_: "t-SNE", "of the three"),
    "the other copy": ("least-stress", lambda **_: "RBFP", "of the three"),
}


@pytest.mark.parametrize("key", RIGHT)
def test_right_answers_are_accepted(key, given):
    """What another implementation gives is right."""
    arguments = given(3)[key]
    assert Lesson(3).check(key, RIGHT[key](**arguments), **arguments).state == "solved"


@pytest.mark.parametrize(("key", "answer", "told"), WRONG.values(), ids=WRONG)
def test_wrong_answers_get_their_hint(key, answer, told, given):
    """Each typical mistake is told from the others."""
    arguments = given(3)[key]
    feedback = Lesson(3).check(key, answer(**arguments), **arguments)
    assert feedback.state == "wrong"
    assert told in feedback.verdict.text


def test_the_largest_ratio_is_the_first_choice_of_rols(given):
    """What the student computes decides in the package which control point comes first."""
    columns, outputs = given(3)["error-ratios"].values()
    none = np.empty(0, dtype=np.intp)
    (first,) = orthogonal_selection(columns, outputs, 1, 1e-5, none)
    assert _ratios(columns, outputs, 1e-5).argmax() == first


def test_curves_are_as_the_text_says(given):
    """Departures fall with the number of control points; ROLS is ahead while they are few."""
    departures = given(3)["how-many"]["departures"]
    for method in ("RBFP", "LAMP"):
        chosen, drawn = departures[f"{method}, ROLS"], departures[f"{method}, random"]
        assert chosen[64] < chosen[4]
        assert drawn[64] < drawn[4]
        assert chosen[4] < 0.6 * drawn[4]
    assert departures["LAMP, ROLS"][4] < departures["RBFP, ROLS"][4]
    assert departures["LAMP, ROLS"][64] > departures["RBFP, ROLS"][64]
