"""Lesson 2, why "stress" needs its formula: its exercises and their solutions.

d_ij is the distance in the data, δ_ij that on the map; sums run over pairs i < j, of which a
full matrix holds each twice: that cancels in quotients.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.quality.stress import scale_normalized_stress, stress
from workbench.teaching.answers import Choice, Number
from workbench.teaching.exercises import (
    Exercise,
    FunctionExercise,
    Mistake,
    OpenExercise,
    Question,
)

FloatArray = NDArray[np.float64]

VERDICTS = ("Eq. 4.1", "scale-normalised", "both", "neither")


def raw_stress(distances: FloatArray, plane_distances: FloatArray) -> float:
    """Sum up the squared differences of distances, each pair once."""
    i, j = np.triu_indices(len(distances), k=1)
    return float(((plane_distances[i, j] - distances[i, j]) ** 2).sum())


def _absolute(distances: FloatArray, plane_distances: FloatArray) -> float:
    return float(np.abs(plane_distances - distances).sum() / 2)


def _of_each_pair(distances: FloatArray, plane_distances: FloatArray) -> float:
    n = len(distances)
    return raw_stress(distances, plane_distances) / (n * (n - 1) / 2)


def factor_of_raw_stress(unit: float) -> float:
    """Give the factor of raw stress when all distances are multiplied by ``unit``."""
    return unit**2


def winning_factor(distances: FloatArray, embedding: FloatArray, rival: float) -> float:
    """Find the factor at which Eq. 4.1 is lowest for a map."""
    del rival  # the lowest there is; whether it suffices is for the check to see
    i, j = np.triu_indices(len(distances), k=1)
    plane = np.linalg.norm(embedding[i] - embedding[j], axis=1)
    return float((distances[i, j] ** 2).sum() / (distances[i, j] * plane).sum())


def _not_winning(
    factor: float, distances: FloatArray, embedding: FloatArray, rival: float
) -> str | None:
    if factor <= 0:
        return "A map that is multiplied by 0 or less is gone or mirrored. Take a factor above 0."
    value = stress(distances, factor * embedding)
    if value < rival:
        return None
    best = winning_factor(distances, embedding, rival)
    where = "larger" if factor < best else "smaller"
    return f"Stress is {value:.3g} now, and {rival:.3g} is to be beaten. Try a {where} factor."


def best_factor(distances: FloatArray, plane_distances: FloatArray) -> float:
    """Find the factor of the map that brings its distances closest to the data's."""
    return float((distances * plane_distances).sum() / (plane_distances**2).sum())


def normalized_at_best_scale(distances: FloatArray, plane_distances: FloatArray) -> float:
    """Compute normalised stress of the map at its best scale."""
    factor = (distances * plane_distances).sum() / (plane_distances**2).sum()
    return float(((factor * plane_distances - distances) ** 2).sum() / (distances**2).sum())


def _as_it_is(distances: FloatArray, plane_distances: FloatArray) -> float:
    return float(((plane_distances - distances) ** 2).sum() / (distances**2).sum())


def _over_the_map(distances: FloatArray, plane_distances: FloatArray) -> float:
    return float(((plane_distances - distances) ** 2).sum() / (plane_distances**2).sum())


def _over_the_scaled_map(distances: FloatArray, plane_distances: FloatArray) -> float:
    return _over_the_map(distances, best_factor(distances, plane_distances) * plane_distances)


def _rooted(distances: FloatArray, plane_distances: FloatArray) -> float:
    return float(np.sqrt(normalized_at_best_scale(distances, plane_distances)))


def _not_divided(distances: FloatArray, plane_distances: FloatArray) -> float:
    return raw_stress(distances, best_factor(distances, plane_distances) * plane_distances)


def _scaled_maps(distances: FloatArray, plane_distances: FloatArray) -> Sequence[tuple[Any, ...]]:
    return tuple((distances, scale * plane_distances) for scale in (1.0, 0.01, 30.0))


def who_sees_it_better(distances: FloatArray, before: FloatArray, after: FloatArray) -> str:
    """Tell which of two formulas is lower after than before."""
    measures: dict[str, Callable[..., float]] = {
        "Eq. 4.1": stress,
        "scale-normalised": scale_normalized_stress,
    }
    lower = [
        name
        for name, measure in measures.items()
        if measure(distances, after) < measure(distances, before)
    ]
    return {0: "neither", 1: lower[0] if lower else "", 2: "both"}[len(lower)]


EXERCISES: Sequence[Question] = (
    FunctionExercise(
        key="raw-stress",
        task="Replace the `...` in `raw_stress` so that it returns the sum over all pairs.",
        solution=raw_stress,
        praise="Yes. All other forms of stress start from this sum.",
        hint="Take the difference of both matrices, square it entry by entry, and sum up, each "
        "pair once.",
        kind=Number(tolerance=1e-6),
        cases=_scaled_maps,
        mistakes=(
            Mistake(
                lambda d, delta: 2 * raw_stress(d, delta),
                "Nearly: a matrix of distances holds each pair twice, as (i, j) and as (j, i).",
            ),
            Mistake(_absolute, "You summed absolute differences. Square them."),
            Mistake(
                lambda d, delta: 2 * _absolute(d, delta),
                "You summed absolute differences, and "
                "each pair twice. Square them, and count each pair once.",
            ),
            Mistake(
                lambda d, delta: np.sqrt(raw_stress(d, delta)), "You took a root. Leave it out."
            ),
            Mistake(
                lambda d, delta: ((delta - d) ** 2).mean(),
                "You took the mean over the matrix, with its diagonal. Here, the sum is wanted.",
            ),
            Mistake(_of_each_pair, "You took the mean over pairs. Here, the sum is wanted."),
            Mistake(
                lambda d, delta: abs((delta - d).sum() / 2),
                "Differences of opposite sign cancel. Square each before you sum up.",
            ),
        ),
    ),
    Exercise(
        key="units",
        task="Say by which factor raw stress grows if both distances grow by the factor `unit`.",
        solution=factor_of_raw_stress,
        praise="Yes. The same map of the same data, and another number: raw stress means nothing "
        "without the unit. So it is divided by something.",
        hint="Put unit · δ and unit · d into the sum, and take `unit` out of it.",
        kind=Number(),
        mistakes=(
            Mistake(lambda unit: unit, "The differences grow by this factor. They are squared."),
            Mistake(lambda **_: 1.0, "The sum is not divided by anything yet. It does change."),
            Mistake(
                lambda unit: unit**-2, "The distances become larger numbers, not smaller ones."
            ),
        ),
    ),
    OpenExercise(
        key="fool-eq-4.1",
        task="Find a factor for the worse map with which Eq. 4.1 gives it less stress than the "
        "other has.",
        solution=winning_factor,
        praise="Yes. No point has moved relative to another, the picture is the same, and it has "
        "overtaken the other. A number that can be had so cheaply tells nothing about the picture.",
        hint="Try some factors.",
        kind=Number(),
        fault=_not_winning,
    ),
    Exercise(
        key="best-factor",
        task="Compute the factor α that brings the distances on the map closest to those in the "
        "data.",
        solution=best_factor,
        praise="Yes. This is a regression line through the origin, of d on δ.",
        hint="Set the derivative by α of Σ (α δ − d)² to 0 and solve for α.",
        kind=Number(),
        mistakes=(
            Mistake(
                lambda distances, plane_distances: (
                    (distances**2).sum() / (distances * plane_distances).sum()
                ),
                "This factor minimises Eq. 4.1, whose denominator grows with α. Minimise the "
                "numerator alone.",
            ),
            Mistake(
                lambda distances, plane_distances: (
                    (distances * plane_distances).sum() / (distances**2).sum()
                ),
                "You divided by Σ d². Which of the two is multiplied by α?",
            ),
            Mistake(
                lambda distances, plane_distances: (
                    (plane_distances**2).sum() / (distances * plane_distances).sum()
                ),
                "This is 1 / α.",
            ),
            Mistake(
                lambda distances, plane_distances: distances.sum() / plane_distances.sum(),
                "This makes the mean distances equal. Least squares is something else.",
            ),
            Mistake(
                lambda distances, plane_distances: np.sqrt(
                    (distances**2).sum() / (plane_distances**2).sum()
                ),
                "This makes the mean squared distances equal. Least squares is something else.",
            ),
        ),
    ),
    FunctionExercise(
        key="scale-normalized",
        task="Replace the `...` in `scale_normalized` so that it returns normalised stress at the "
        "best scale.",
        solution=normalized_at_best_scale,
        praise="Yes. It was tried on the map at three scales and gave one value: to this formula, "
        "a larger picture is the same picture.",
        hint="Compute α as before, multiply the distances on the map by it, and put them into "
        "the formula of normalised stress.",
        kind=Number(tolerance=1e-6),
        cases=_scaled_maps,
        mistakes=(
            Mistake(_as_it_is, "The map must be multiplied by α first."),
            Mistake(
                _over_the_map,
                "This is Eq. 4.1. Multiply the map by α, and divide by Σ d².",
            ),
            Mistake(
                _over_the_scaled_map,
                "Multiplied by α, yes; now divide by Σ d² of the data, not by that of the map.",
            ),
            Mistake(_rooted, "You took a root. Some packages do; leave it out here."),
            Mistake(_not_divided, "Multiplied by α, yes; now divide by Σ d²."),
        ),
    ),
    Exercise(
        key="two-verdicts",
        task="Say which formula finds the map better after the optimization.",
        solution=who_sees_it_better,
        praise="Yes. So a claim about stress is a claim about one formula. Name it.",
        hint="Compute `stress` and `scale_normalized_stress` before and after, and compare.",
        kind=Choice(VERDICTS),
    ),
)
