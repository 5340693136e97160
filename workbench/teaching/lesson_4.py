"""Lesson 4, back-projection and its optimization: its exercises and their solutions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.optimization.trace import Trace
from workbench.teaching.answers import Array, Number, Samples
from workbench.teaching.exercises import Exercise, FunctionExercise, Mistake, Question

FloatArray = NDArray[np.float64]


def reconstruction_error(samples: FloatArray, rebuilt: FloatArray) -> float:
    """Give the mean Euclidean distance of samples and what they were rebuilt as."""
    return float(np.sqrt(((samples - rebuilt) ** 2).sum(axis=1)).mean())


def _of_rebuilt_only(samples: FloatArray, rebuilt: FloatArray) -> float:
    errors = np.linalg.norm(samples - rebuilt, axis=1)
    return float(errors[errors > 0].mean())


def nearest_control_point(
    places: FloatArray, control_places: FloatArray, control_samples: FloatArray
) -> FloatArray:
    """Rebuild each sample as that of the control point which is nearest in the plane."""
    distances = np.linalg.norm(places[:, None] - control_places, axis=2)
    return control_samples[distances.argmin(axis=1)]


def _farthest(places: FloatArray, control_places: FloatArray, control_samples: FloatArray) -> Any:
    distances = np.linalg.norm(places[:, None] - control_places, axis=2)
    return control_samples[distances.argmax(axis=1)]


def _mean_control(places: FloatArray, _: FloatArray, control_samples: FloatArray) -> Any:
    return np.repeat(control_samples.mean(axis=0)[None], len(places), axis=0)


def _index_only(places: FloatArray, control_places: FloatArray, _: FloatArray) -> Any:
    return np.linalg.norm(places[:, None] - control_places, axis=2).argmin(axis=1)


def _places_of_control(
    places: FloatArray, control_places: FloatArray, control_samples: FloatArray
) -> Any:
    return control_places[_index_only(places, control_places, control_samples)]


def _cases(
    places: FloatArray, control_places: FloatArray, control_samples: FloatArray
) -> Sequence[tuple[Any, ...]]:
    return (
        (places, control_places, control_samples),
        (places[:7] + 0.05, control_places[::-1], control_samples[::-1]),
    )


def relative_error(test: FloatArray, rebuilt: FloatArray, training: FloatArray) -> float:
    """Give the error of held-out samples relative to answering with the training mean."""
    mean = training.mean(axis=0)
    return reconstruction_error(test, rebuilt) / reconstruction_error(test, mean)


def lowest_place(errors: FloatArray, x: FloatArray, y: FloatArray) -> FloatArray:
    """Find the place of the lowest error of a landscape."""
    row, column = np.unravel_index(errors.argmin(), errors.shape)
    return np.array([x[column], y[row]])


def _highest_place(errors: FloatArray, x: FloatArray, y: FloatArray) -> FloatArray:
    return lowest_place(-errors, x, y)


def alg12_step(
    position: FloatArray,
    radius: float,
    here: float,
    right: float,
    left: float,
    up: float,
    down: float,
) -> FloatArray:
    """Take one step of Alg. 12, from the errors at a position and at its four probes."""
    slope = np.zeros(2)
    if right < here or left < here:
        slope[0] = left - right
    if up < here or down < here:
        slope[1] = down - up
    length = np.linalg.norm(slope)
    if length == 0.0:
        return position
    return position + 0.5 * radius * slope / length


def _uphill(position: FloatArray, *others: Any) -> FloatArray:
    return 2 * position - alg12_step(position, *others)


def _whole_radius(position: FloatArray, *others: Any) -> FloatArray:
    return position + 2 * (alg12_step(position, *others) - position)


# Whole again, because the solution above is shown to students as it stands.
def _without_length(
    position: FloatArray,
    radius: float,
    here: float,
    right: float,
    left: float,
    up: float,
    down: float,
) -> FloatArray:
    slope = np.zeros(2)
    if right < here or left < here:
        slope[0] = left - right
    if up < here or down < here:
        slope[1] = down - up
    return position + 0.5 * radius * slope


def _whatever_is_here(
    position: FloatArray,
    radius: float,
    here: float,  # noqa: ARG001 - the mistake is not to look at it
    right: float,
    left: float,
    up: float,
    down: float,
) -> FloatArray:
    return alg12_step(position, radius, np.inf, right, left, up, down)


def _to_the_best_probe(
    position: FloatArray,
    radius: float,
    here: float,
    right: float,
    left: float,
    up: float,
    down: float,
) -> FloatArray:
    ways = np.array([[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]])
    return position + 0.5 * radius * ways[np.argmin([here, right, left, up, down])]


def step_cases(trace: Trace) -> Sequence[tuple[Any, ...]]:
    """Make cases of the steps that Alg. 12 took with a sample, and two that it seldom meets.

    Parameters
    ----------
    trace : Trace
        Of Alg. 12 with its usual parameters: four probes in each step, at half a radius.

    Returns
    -------
    sequence of tuple
        Arguments of :func:`alg12_step`.
    """
    cases: list[tuple[Any, ...]] = []
    for before, step in zip(trace.steps, trace.steps[1:], strict=False):
        probes = [tried for tried in step.tries if tried.stage == "probe"]
        if len(probes) == 4:
            right, up, left, down = (probe.error for probe in probes)
            radius = 2 * float(np.linalg.norm(probes[0].position - before.position))
            cases.append((before.position, radius, before.error, right, left, up, down))
    here = np.array([0.5, 0.5])
    cases.append((here, 0.2, 1.0, 1.2, 1.1, 0.7, 1.3))  # one axis has no better probe
    cases.append((here, 0.2, 1.0, 1.2, 1.1, 1.5, 1.3))  # neither has one
    return cases


def stuck_sample(local_errors: FloatArray, global_errors: FloatArray) -> int:
    """Find the sample that ends highest above what the global search finds for it."""
    return int((local_errors - global_errors).argmax())


def relative_gain(before: float, after: float) -> float:
    """Give the share by which an error has fallen."""
    return 1 - after / before


EXERCISES: Sequence[Question] = (
    Exercise(
        key="reconstruction-error",
        task="Compute the mean Euclidean distance of the rows of `samples` and `rebuilt`.",
        solution=reconstruction_error,
        praise="Yes. Control points are rebuilt exactly and count with an error of 0.",
        hint="Take the difference of the arrays, the length of each of its rows "
        "(`np.linalg.norm` with `axis=1`), and the mean of these lengths.",
        kind=Number(),
        mistakes=(
            Mistake(
                lambda samples, rebuilt: ((samples - rebuilt) ** 2).sum(axis=1).mean(),
                "These are squared distances. Take the root of each before the mean.",
            ),
            Mistake(
                lambda samples, rebuilt: ((samples - rebuilt) ** 2).mean(),
                "This is the mean squared difference of single values. Sum over the columns "
                "first, and take the root.",
            ),
            Mistake(
                lambda samples, rebuilt: np.sqrt(((samples - rebuilt) ** 2).sum(axis=1).mean()),
                "You took the root of the mean. Take the mean of the roots: it is the mean "
                "distance that is asked for.",
            ),
            Mistake(
                lambda samples, rebuilt: np.linalg.norm(samples - rebuilt),
                "This is the length of the whole array. Use `axis=1` for that of each row.",
            ),
            Mistake(
                lambda samples, rebuilt: np.abs(samples - rebuilt).mean(),
                "This is the mean difference of single values. Take the distance of each row.",
            ),
            Mistake(
                _of_rebuilt_only,
                "You left the control points out. Their error is 0, and here they count.",
            ),
        ),
    ),
    FunctionExercise(
        key="nearest-control-point",
        task="Replace the `...` so that each place gets the sample of the nearest control point.",
        solution=nearest_control_point,
        praise="Yes. The plane falls into cells, one around each control point, and all places "
        "in a cell give the same sample.",
        hint="Compute the distances of all places to all control points, shape (n_places, "
        "n_control_points); `argmin(axis=1)` says which is nearest; index the samples with it.",
        kind=Array(),
        cases=_cases,
        mistakes=(
            Mistake(_farthest, "This is the farthest control point. Take the nearest."),
            Mistake(_index_only, "This says which control point is nearest. Give its sample."),
            Mistake(
                _places_of_control,
                "This is the nearest control point's place in the plane. Give its sample.",
            ),
            Mistake(_mean_control, "This is the mean of all control points' samples."),
        ),
    ),
    Exercise(
        key="held-out-error",
        task="Divide the error of the rebuilt test samples by that of the training mean.",
        solution=relative_error,
        praise="Yes. Below 1 it is better than knowing nothing of the place in the plane.",
        hint="Both errors are mean Euclidean distances to the rows of `test`; the second one "
        "rebuilds every row by `training.mean(axis=0)`.",
        kind=Number(),
        mistakes=(
            Mistake(
                lambda test, rebuilt, **_: relative_error(test, rebuilt, test),
                "You took the mean of the test samples. It is not known before they are seen; "
                "take that of the training samples.",
            ),
            Mistake(
                lambda test, rebuilt, training: 1 / relative_error(test, rebuilt, training),
                "This is the inverse. Divide by the error of the mean.",
            ),
            Mistake(
                lambda test, rebuilt, **_: reconstruction_error(test, rebuilt),
                "This is the error itself. Divide it by that of the training mean.",
            ),
            Mistake(
                lambda test, rebuilt, training: (
                    ((test - rebuilt) ** 2).sum() / ((test - training.mean(axis=0)) ** 2).sum()
                ),
                "You summed squares. Take the mean of distances, as in exercise 1.",
            ),
        ),
    ),
    Exercise(
        key="lowest-place",
        task="Find the x and y of the lowest error in `errors`, whose rows are y and columns x.",
        solution=lowest_place,
        praise="Yes. No place of this grid rebuilds the sample better.",
        hint="`np.unravel_index(errors.argmin(), errors.shape)` gives the row and the column of "
        "the lowest error. The row belongs to `y`, the column to `x`.",
        kind=Array(tolerance=1e-6),
        mistakes=(
            Mistake(
                lambda **given: lowest_place(**given)[::-1],
                "Nearly: x and y are exchanged. Rows belong to y, columns to x.",
            ),
            Mistake(
                lambda errors, x, y: lowest_place(errors.T, x, y),
                "Rows belong to y, columns to x: you took them the other way round.",
            ),
            Mistake(
                lambda errors, **_: np.unravel_index(errors.argmin(), errors.shape),
                "These are the row and the column. Look up `y` at the row and `x` at the column.",
            ),
            Mistake(_highest_place, "This is the highest error. Look for the lowest."),
        ),
    ),
    FunctionExercise(
        key="alg12-step",
        task="Replace the `...` in `alg12_step` so that it returns the next position.",
        solution=alg12_step,
        praise="Yes. This is one step of Alg. 12, for one sample. Note what it does not do: look "
        "whether the new position is better.",
        hint="Make a vector of two differences, left − right and down − up; set one to 0 if "
        "neither of its probes is better than `here`. Bring it to length 1 (unless both are 0) "
        "and move by half a radius along it.",
        kind=Array(tolerance=1e-9),
        cases=step_cases,
        mistakes=(
            Mistake(_uphill, "This goes uphill: towards the probe with the larger error."),
            Mistake(
                _without_length,
                "The direction must have length 1. Divide the differences by their length.",
            ),
            Mistake(_whole_radius, "The step is too long: it is α = 0.5 times the radius."),
            Mistake(
                _whatever_is_here,
                "Right in most places. But an axis counts only if one of its two probes is "
                "better than `here`; in a valley, both may be worse.",
            ),
            Mistake(
                _to_the_best_probe,
                "You go to the best of the four probes. The step goes along both axes at once, "
                "in the ratio of the differences.",
            ),
        ),
    ),
    Exercise(
        key="stuck-sample",
        task="Find the sample whose error after the local search is highest above that after "
        "the global one.",
        solution=stuck_sample,
        praise="Yes. Let us look at its landscape.",
        hint="Subtract the errors after the global search from those after the local one, and "
        "find where the difference is largest (`argmax`).",
        kind=Samples(),
        mistakes=(
            Mistake(
                lambda local_errors, **_: int(local_errors.argmax()),
                "This one has the highest error after the local search. Perhaps it cannot be "
                "rebuilt better at all. Look at the difference of the two.",
            ),
            Mistake(
                lambda local_errors, global_errors: stuck_sample(global_errors, local_errors),
                "Here the local search ends lower or equal. Exchange the two.",
            ),
        ),
    ),
    Exercise(
        key="held-out-gain",
        task="By which share does the error of the held-out samples fall?",
        solution=relative_gain,
        praise="Yes. Compare it with the fall on the training samples in the table above.",
        hint="1 − after / before, where both are errors of held-out samples.",
        kind=Number(tolerance=0.005),
        mistakes=(
            Mistake(
                lambda before, after: after / before,
                "This is what remains. By how much has it fallen?",
            ),
            Mistake(
                lambda before, after: 100 * relative_gain(before, after),
                "This is a percentage. Give the share, between 0 and 1.",
            ),
            Mistake(
                lambda before, after: before - after,
                "This is the difference. Divide it by the error before.",
            ),
            Mistake(
                lambda before, after: (before - after) / after,
                "Divide by the error before, not by that after.",
            ),
        ),
    ),
)
