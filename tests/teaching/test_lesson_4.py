"""Exercises of lesson 4: right answers found in another way, and the mistakes that are made."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from workbench import SpatialScheme, load_space
from workbench.backprojection.knn import KNN
from workbench.backprojection.rbf import RBF
from workbench.errors import WorkbenchError
from workbench.optimization import optimizers
from workbench.optimization.landscape import PlaneGrid, error_landscape, rebuild_grid
from workbench.optimization.recording import trace_optimization
from workbench.optimization.trace import Trace
from workbench.teaching import Lesson
from workbench.teaching.held_out import HeldOut
from workbench.teaching.lesson_4 import alg12_step, nearest_control_point, step_cases


@pytest.fixture(scope="module")
def result() -> Any:
    iris = load_space("uci/iris", standardize=True)
    return SpatialScheme("pca").run(iris, ratio=0.1, random_state=0)


@pytest.fixture(scope="module")
def trace(result: Any) -> Trace:
    return trace_optimization(
        optimizers.build("alg12", None),
        result.space,
        result.back_projector,
        result.projected,
        result.control_points,
        int(np.argmax(result.errors)),
    )


def check(key: str, answer: Any, **given: Any) -> Any:
    return Lesson(4).check(key, answer, **given).verdict


def test_the_error_is_that_of_the_scheme(result: Any) -> None:
    """Exercise 1 asks for what results call their error; its relatives get their hints."""
    given = {"samples": result.space.samples, "rebuilt": result.reconstruction}
    assert check("reconstruction-error", result.error, **given).state == "solved"
    without = result.errors[result.errors > 0].mean()
    assert "control points" in check("reconstruction-error", without, **given).text
    squared = (result.errors**2).mean()
    assert "squared" in check("reconstruction-error", squared, **given).text


def test_the_nearest_control_point_is_one_nearest_neighbor(result: Any) -> None:
    """Exercise 2 is the method k-NN with k = 1; an index or the mean is told apart."""
    control = result.control_points
    places, samples = result.projected, result.space.samples
    given = {
        "places": places,
        "control_places": places[control],
        "control_samples": samples[control],
    }
    expected = KNN(1).fit(places[control], samples[control]).predict(places)
    np.testing.assert_allclose(nearest_control_point(**given), expected)

    def by_regressor(asked: Any, at: Any, known: Any) -> Any:
        return KNN(1).fit(at, known).predict(asked)

    assert check("nearest-control-point", by_regressor, **given).state == "solved"
    index = check("nearest-control-point", lambda a, b, _: [0] * len(a), **given)
    assert index.state == "wrong"
    mean = check("nearest-control-point", lambda a, _, c: [c.mean(axis=0)] * len(a), **given)
    assert "mean of all" in mean.text


def test_held_out_error_takes_the_mean_of_the_training_samples() -> None:
    """Exercise 3 agrees with the lesson's own measure, and notices who looked at the test."""
    parts = HeldOut.of(load_space("uci/wine"), "pca", random_state=0)
    rebuilt = RBF().fit(parts.training_places, parts.training.samples).predict(parts.test_places)
    given = {
        "test": parts.test.samples,
        "rebuilt": rebuilt,
        "training": parts.training.samples,
    }
    assert check("held-out-error", parts.error(RBF()), **given).state == "solved"
    assert "inverse" in check("held-out-error", 1 / parts.error(RBF()), **given).text
    errors = np.linalg.norm(parts.test.samples - rebuilt, axis=1)
    own = np.linalg.norm(parts.test.samples - parts.test.samples.mean(axis=0), axis=1)
    assert "training" in check("held-out-error", errors.mean() / own.mean(), **given).text


def test_held_out_samples_do_not_change_the_training(result: Any) -> None:
    """The two parts share no row, and only the training samples are standardised to mean 0."""
    parts = HeldOut.of(load_space("uci/wine"), "pca", random_state=0)
    assert len(parts.training) + len(parts.test) == 178
    np.testing.assert_allclose(parts.training.samples.mean(axis=0), 0, atol=1e-12)
    assert abs(parts.test.samples.mean(axis=0)).max() > 0.01
    with pytest.raises(WorkbenchError, match="cannot place new samples"):
        HeldOut.of(load_space("uci/wine"), "mds")


def test_smoothing_helps_held_out_wines_and_harms_the_training() -> None:
    """What section 3 of the lesson says of interpolation holds for its data."""
    parts = HeldOut.of(load_space("uci/wine"), "pca", random_state=0)
    exact, smooth = RBF(), RBF(smoothing=1.0)
    assert parts.training_error(exact) < 1e-9 < parts.training_error(smooth)
    assert parts.error(smooth) < 0.95 * parts.error(exact)
    assert parts.error(KNN(20)) < parts.error(exact) < parts.error(KNN(1))


def test_the_lowest_place_is_that_of_the_landscape(result: Any) -> None:
    """Exercise 4 agrees with the landscape's minimum; exchanged axes get their hint."""
    grid = PlaneGrid.around(result.projected, side=21)
    rebuilt = rebuild_grid(result.back_projector, grid)
    landscape = error_landscape(result.space, 3, grid, rebuilt)
    given = {"errors": landscape.errors, "x": grid.x, "y": grid.y}
    place, _ = landscape.minimum
    assert check("lowest-place", place, **given).state == "solved"
    assert "exchanged" in check("lowest-place", place[::-1], **given).text
    row, column = np.unravel_index(landscape.errors.argmin(), landscape.errors.shape)
    assert "row and the column" in check("lowest-place", (row, column), **given).text


def test_the_step_is_that_of_the_optimizer(trace: Trace) -> None:
    """Exercise 5 repeats every step that Alg. 12 took with a sample."""
    cases = step_cases(trace)
    steps = [step for step in trace.steps[1:] if len(step.tries) == 5]
    assert len(cases) == len(steps) + 2 > 3
    for case, step in zip(cases, steps, strict=False):
        np.testing.assert_allclose(alg12_step(*case), step.tries[-1].position, atol=1e-12)


@pytest.mark.parametrize(
    ("mistake", "hint"),
    [
        (lambda p, *others: 2 * p - alg12_step(p, *others), "uphill"),
        (lambda p, r, h, e, w, n, s: p + 0.5 * r * _unit(w - e, s - n), "only if one"),
        (lambda p, *_: p, "half a radius"),
        (lambda p, r: p, "must take 7 arguments"),
        (lambda p, *_: p[5], "stops"),
        (lambda p, *_: None, "None"),
    ],
    ids=["uphill", "both-axes", "stays", "too-few-arguments", "raises", "no-return"],
)
def test_wrong_steps_get_a_hint(trace: Trace, mistake: Any, hint: str) -> None:
    """A typical wrong step is named, and a function that fails is told in words."""
    verdict = check("alg12-step", mistake, trace=trace)
    assert verdict.state in ("wrong", "unreadable")
    assert hint in verdict.text


def _unit(x: float, y: float) -> np.ndarray:
    return np.array([x, y]) / np.hypot(x, y)


def test_the_stuck_sample_is_where_the_searches_differ_most() -> None:
    """Exercise 6 wants the largest difference, not the largest error."""
    local, best = np.array([1.0, 5.0, 4.0, 2.0]), np.array([1.0, 4.9, 2.0, 2.0])
    given = {"local_errors": local, "global_errors": best}
    assert check("stuck-sample", 2, **given).state == "solved"
    assert "highest error" in check("stuck-sample", 1, **given).text
    assert check("stuck-sample", 1.5, **given).state == "unreadable"


def test_the_gain_is_relative_to_what_was_before() -> None:
    """Exercise 7 wants a share of the error before."""
    given = {"before": 4.0, "after": 3.0}
    assert check("held-out-gain", 0.25, **given).state == "solved"
    assert "remains" in check("held-out-gain", 0.75, **given).text
    assert "percentage" in check("held-out-gain", 25.0, **given).text
    assert "before" in check("held-out-gain", 1 / 3, **given).text
