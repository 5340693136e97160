"""Lesson 3, control points: its exercises and their solutions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.quality.stress import scale_normalized_stress
from workbench.teaching.answers import Array, Choice, Number
from workbench.teaching.exercises import Exercise, FunctionExercise, Mistake, Question

FloatArray = NDArray[np.float64]


def second_step_distances(n_samples: int, n_control_points: int) -> int:
    """Count the pairs of a control point and a sample that is none."""
    return n_control_points * (n_samples - n_control_points)


def rbf_weights(control_samples: FloatArray, positions: FloatArray) -> FloatArray:
    """Solve for the weights with which each control point gets its position."""
    difference = control_samples[:, None, :] - control_samples[None, :, :]
    distances = np.sqrt((difference**2).sum(axis=2))
    weights: FloatArray = np.linalg.solve(np.sqrt(1.0 + distances**2), positions)
    return weights


def _squares_between(control_samples: FloatArray) -> FloatArray:
    squares: FloatArray = ((control_samples[:, None] - control_samples[None]) ** 2).sum(axis=2)
    return squares


def _rbf_cases(control_samples: FloatArray, positions: FloatArray) -> Sequence[tuple[Any, ...]]:
    return ((control_samples, positions), (control_samples[:4], positions[:4]))


def lamp_weights(sample: FloatArray, control_samples: FloatArray) -> FloatArray:
    """Weigh each control point by one over its squared distance; the sum is 1."""
    weights = 1.0 / ((control_samples - sample) ** 2).sum(axis=1)
    normalized: FloatArray = weights / weights.sum()
    return normalized


def _over_the_distance(sample: FloatArray, control_samples: FloatArray) -> FloatArray:
    weights = 1.0 / np.linalg.norm(control_samples - sample, axis=1)
    normalized: FloatArray = weights / weights.sum()
    return normalized


def _far_is_heavy(sample: FloatArray, control_samples: FloatArray) -> FloatArray:
    weights = ((control_samples - sample) ** 2).sum(axis=1)
    normalized: FloatArray = weights / weights.sum()
    return normalized


def _lamp_cases(sample: FloatArray, control_samples: FloatArray) -> Sequence[tuple[Any, ...]]:
    return ((sample, control_samples), (sample, control_samples[:3]))


def closest_method(truth: FloatArray, placed: Mapping[str, FloatArray]) -> str:
    """Tell which method places the samples closest to where they belong."""
    errors = {name: np.abs(places - truth).max() for name, places in placed.items()}
    return min(errors, key=lambda name: errors[name])


def error_ratios(columns: FloatArray, outputs: FloatArray, regularization: float) -> FloatArray:
    """Compute for each column which share of the outputs it explains."""
    explained = (columns.T @ outputs) ** 2 / (outputs**2).sum(axis=0)
    ratios: FloatArray = explained.sum(axis=1) / ((columns**2).sum(axis=0) + regularization)
    return ratios


def _not_squared(columns: FloatArray, outputs: FloatArray, regularization: float) -> FloatArray:
    explained = (columns.T @ outputs) / (outputs**2).sum(axis=0)
    ratios: FloatArray = explained.sum(axis=1) / ((columns**2).sum(axis=0) + regularization)
    return ratios


def _as_printed(columns: FloatArray, outputs: FloatArray, regularization: float) -> FloatArray:
    products = (columns.T @ outputs) ** 2 + regularization
    explained = (products / (outputs**2).sum(axis=0)).sum(axis=1)
    ratios: FloatArray = explained / (columns**2).sum(axis=0)
    return ratios


def _without_outputs(columns: FloatArray, outputs: FloatArray, regularization: float) -> FloatArray:
    explained = ((columns.T @ outputs) ** 2).sum(axis=1)
    ratios: FloatArray = explained / ((columns**2).sum(axis=0) + regularization)
    return ratios


def _without_columns(columns: FloatArray, outputs: FloatArray, regularization: float) -> FloatArray:
    del regularization  # it stands in what was forgotten
    explained: FloatArray = ((columns.T @ outputs) ** 2 / (outputs**2).sum(axis=0)).sum(axis=1)
    return explained


def _ratio_cases(columns: FloatArray, outputs: FloatArray) -> Sequence[tuple[Any, ...]]:
    # A second r, so large that its place in the formula is seen.
    return ((columns, outputs, 1e-5), (columns[:, :20], outputs, 1000.0))


def fewest(departures: Mapping[str, Mapping[int, float]], curve: str, limit: float) -> int:
    """Find the smallest number of control points with which a curve is below a limit."""
    return min(count for count, value in departures[curve].items() if value < limit)


def _fewest_of_another(
    departures: Mapping[str, Mapping[int, float]], curve: str, limit: float
) -> int:
    return fewest(departures, curve.replace("ROLS", "random"), limit)


def least_stress(distances: FloatArray, maps: Mapping[str, FloatArray]) -> str:
    """Tell which map has the least scale-normalised stress."""
    return min(maps, key=lambda name: scale_normalized_stress(distances, maps[name]))


EXERCISES: Sequence[Question] = (
    Exercise(
        key="second-step",
        task="Say how many distances the second step looks at.",
        solution=second_step_distances,
        praise="Yes. It grows with n, not with n². This is why a million samples can be placed.",
        hint="Each sample that is no control point looks at each control point, once.",
        kind=Number(tolerance=1e-9),
        mistakes=(
            Mistake(
                lambda n_samples, n_control_points: n_samples * n_control_points,
                "Nearly. The control points have their places already.",
            ),
            Mistake(
                lambda n_samples, **_: n_samples * (n_samples - 1) / 2,
                "This is the number of all pairs. Samples that are no control points do not look "
                "at each other.",
            ),
            Mistake(
                lambda n_samples, n_control_points: n_samples - n_control_points,
                "This is the number of samples to place. How many distances does each look at?",
            ),
        ),
    ),
    FunctionExercise(
        key="rbf-weights",
        task="Replace the `...` in `rbf_weights` so that it returns the weights, one row for each "
        "control point.",
        solution=rbf_weights,
        praise="Yes. One linear system, as large as there are control points, and the whole map "
        "is known.",
        hint="Make the matrix of φ(‖c_i − c_j‖) between all control points, and solve the linear "
        "system with `positions` on the right (`np.linalg.solve`).",
        kind=Array(tolerance=1e-5),
        cases=_rbf_cases,
        mistakes=(
            Mistake(
                lambda c, y: np.linalg.solve(1.0 + _squares_between(c), y),
                "The root of φ(r) = √(1 + r²) is missing.",
            ),
            Mistake(
                lambda c, y: np.linalg.solve(np.sqrt(1.0 + np.sqrt(_squares_between(c))), y),
                "In φ(r) = √(1 + r²), the distance is squared.",
            ),
            Mistake(
                lambda c, y: np.linalg.solve(np.sqrt(_squares_between(c)), y),
                "This is the kernel φ(r) = r. Here φ(r) = √(1 + r²).",
            ),
            Mistake(
                lambda c, y: np.sqrt(1.0 + _squares_between(c)) @ y,
                "You multiplied by the matrix. The weights are what it must be multiplied with to "
                "give the positions: solve the system.",
            ),
            Mistake(
                lambda c, *_: np.sqrt(1.0 + _squares_between(c)),
                "This is the matrix. Now solve the linear system with it.",
            ),
        ),
    ),
    FunctionExercise(
        key="lamp-weights",
        task="Replace the `...` in `lamp_weights` so that it returns one weight for each control "
        "point.",
        solution=lamp_weights,
        praise="Yes. Near control points decide, far ones hardly count. (A sample that is a "
        "control point would divide by 0; it just gets that point's place.)",
        hint="Squared distances from the sample to each control point, one over each, divided "
        "by their sum.",
        kind=Array(),
        cases=_lamp_cases,
        mistakes=(
            Mistake(_over_the_distance, "You took one over the distance. Square it."),
            Mistake(
                lambda x, c: 1.0 / ((c - x) ** 2).sum(axis=1),
                "The weights must sum up to 1: divide them by their sum.",
            ),
            Mistake(_far_is_heavy, "Your far control points weigh most. Take one over it."),
            Mistake(
                lambda x, c: 1.0 / np.linalg.norm(c - x, axis=1),
                "You took one over the distance. Square it, and divide by the sum.",
            ),
        ),
    ),
    Exercise(
        key="flat-sheet",
        task='Assign "LAMP" or "RBFP" to `answer`.',
        solution=closest_method,
        praise="Yes. On a flat sheet each of its local maps is the right one, to rounding. Radial "
        "functions bend the sheet between the control points.",
        hint="Compute the largest difference from `sheet_places` for each.",
        kind=Choice(("LAMP", "RBFP")),
    ),
    FunctionExercise(
        key="error-ratios",
        task="Replace the `...` in `error_ratios` so that it returns one ratio for each column.",
        solution=error_ratios,
        praise="Yes. The first control point is the one with the largest ratio. Then ROLS takes "
        "from all columns what that one explains, and asks again.",
        hint="`columns.T @ outputs` holds all products of a column and an output. Square, divide "
        "by both sums of squares, sum up over the outputs.",
        kind=Array(),
        cases=_ratio_cases,
        mistakes=(
            Mistake(_not_squared, "The product of a column and an output must be squared."),
            Mistake(
                lambda a, q, *_: error_ratios(a, q, 0.0),
                "The r is missing. It is added to the sum of squares of the column.",
            ),
            Mistake(
                _as_printed,
                "You added r above the line. There it regularises nothing; it belongs below, to "
                "the sum of squares of the column.",
            ),
            Mistake(_without_outputs, "Divide by the sum of squares of each output, too."),
            Mistake(_without_columns, "Divide by the sum of squares of each column (plus r)."),
        ),
    ),
    Exercise(
        key="how-many",
        task="Read from the figure the smallest number of control points that suffices.",
        solution=fewest,
        praise="Yes. With well-chosen control points a small part of the samples carries the map.",
        hint="Find the curve in the legend, and the first of its points below the limit. The "
        "answer is the number of control points under it.",
        kind=Number(tolerance=1e-9),
        mistakes=(
            Mistake(
                _fewest_of_another,
                "This is where the curve of random control points gets below the limit.",
            ),
            Mistake(
                lambda departures, curve, limit: departures[curve][
                    fewest(departures, curve, limit)
                ],
                "This is the departure. Give the number of control points.",
            ),
        ),
    ),
    Exercise(
        key="least-stress",
        task='Assign the name of one of the three maps to `answer`: "t-SNE", "RBFP" or "LAMP".',
        solution=least_stress,
        praise="Yes. A map around a few points of another one need not be the worse copy of it. "
        "The table below has all values.",
        hint="Compute `embedding_quality(wine.distances, places).scale_normalized_stress` for each "
        "of the three.",
        kind=Choice(("t-SNE", "RBFP", "LAMP")),
    ),
)
