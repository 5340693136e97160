"""Tests of workbench.optimization."""

from __future__ import annotations

import numpy as np
import pytest

from workbench.backprojection.rbf import RBF
from workbench.errors import WorkbenchError
from workbench.optimization.gradient_descent import GradientDescent
from workbench.optimization.objective import Objective
from workbench.spaces import VectorSpace


@pytest.fixture
def problem():
    """Give samples of a curved sheet in 3-D, a start beside the truth, and an objective."""
    rng = np.random.default_rng(0)
    plane = rng.random((60, 2))
    space = VectorSpace(np.column_stack([plane, np.sin(3 * plane[:, 0])]))
    start = plane.copy()
    free = np.arange(20, 60)
    start[free] += rng.normal(scale=0.05, size=(40, 2))
    back_projector = RBF().fit(plane[:20], space.samples[:20])
    return space, start, free, lambda: Objective(back_projector, space.errors)


def literal_sweep(objective, points, free, neighbors, alpha=0.5, delta=0.5):
    """Follow Alg. 12 of Costa 2018 line by line, one sample at a time, for one sweep."""
    moved = points.copy()
    for i in free:
        q = points[i]
        r = np.mean([np.linalg.norm(q - points[j]) for j in neighbors[i]])

        def error(at, sample=i):
            return objective(np.asarray(at)[None], [sample])[0]

        e_o = error(q)
        e_xp, e_xn = error(q + np.array([delta * r, 0])), error(q - np.array([delta * r, 0]))
        e_yp, e_yn = error(q + np.array([0, delta * r])), error(q - np.array([0, delta * r]))
        h = np.zeros(2)
        if e_o > e_xp or e_o > e_xn:
            h += np.array([1, 0]) * (e_xn - e_xp)
        if e_o > e_yp or e_o > e_yn:
            h += np.array([0, 1]) * (e_yn - e_yp)
        if np.linalg.norm(h) > 0:
            moved[i] = q + alpha * r * h / np.linalg.norm(h)
    return moved


def test_sweeps_follow_the_printed_algorithm(problem):
    """Three sweeps move every sample as a line-by-line reading of Alg. 12 does."""
    space, points, free, objective = problem
    seen = []
    GradientDescent(max_sweeps=3, tol=0).optimize(
        objective(),
        points,
        free,
        space.neighbors,
        callback=lambda sweep, error, embedding: seen.append(embedding.copy()),
    )
    expected = points
    for embedding in seen:
        expected = literal_sweep(objective(), expected, free, space.neighbors)
        assert np.allclose(embedding, expected, atol=1e-12)
    assert len(seen) == 3


def test_the_error_falls_and_control_points_stay(problem):
    """The total error falls by more than half; no control point moves by a digit."""
    space, start, free, objective = problem
    result = GradientDescent().optimize(objective(), start, free, space.neighbors)
    assert result.errors.mean() < 0.5 * result.history[0]
    control = np.setdiff1d(np.arange(60), free)
    assert np.array_equal(result.embedding[control], start[control])


def test_the_reported_errors_are_those_of_the_embedding(problem):
    """Recomputing the error at the returned positions gives the returned errors."""
    space, start, free, objective = problem
    result = GradientDescent().optimize(objective(), start, free, space.neighbors)
    again = objective()(result.embedding[free], free)
    assert np.array_equal(again, result.errors)
    assert result.errors.mean() == pytest.approx(result.history.min())


def test_evaluations_are_counted(problem):
    """Each sweep back-projects four probes and one new position for each free sample."""
    space, start, free, objective = problem
    result = GradientDescent(max_sweeps=5, tol=0).optimize(
        objective(), start, free, space.neighbors
    )
    assert result.evaluations == len(free) * (1 + 5 * result.iterations)


def test_the_callback_stops_the_search(problem):
    """A true result ends it after that sweep."""
    space, start, free, objective = problem
    result = GradientDescent().optimize(
        objective(), start, free, space.neighbors, callback=lambda sweep, *_: sweep == 2
    )
    assert result.iterations == 2
    assert result.reason == "stopped by the callback"


def test_the_start_is_not_changed(problem):
    """Optimizing works on a copy."""
    space, start, free, objective = problem
    before = start.copy()
    GradientDescent(max_sweeps=2).optimize(objective(), start, free, space.neighbors)
    assert np.array_equal(start, before)


def test_coinciding_points_still_find_a_way(problem):
    """A free point on top of both its neighbours gets the median radius and moves."""
    space, start, free, objective = problem
    first, second = space.neighbors[free[0]]
    start[[first, second]] = start[free[0]]
    result = GradientDescent(max_sweeps=5).optimize(objective(), start, free, space.neighbors)
    assert np.isfinite(result.embedding).all()
    assert not np.array_equal(result.embedding[free[0]], start[free[0]])


def test_three_dimensions(problem):
    """An embedding with a third coordinate is optimized along it too."""
    space, start, free, _ = problem
    cube = np.column_stack([start, np.random.default_rng(1).random(60)])
    objective = Objective(RBF().fit(cube[:20], space.samples[:20]), space.errors)
    result = GradientDescent(max_sweeps=5, tol=0).optimize(objective, cube, free, space.neighbors)
    assert result.errors.mean() < result.history[0]
    assert result.evaluations == len(free) * (1 + 7 * result.iterations)


def test_the_search_ends_when_nothing_changes(problem):
    """Once the relative change of the total is below tol, the next sweep is the last."""
    space, start, free, objective = problem
    result = GradientDescent(tol=1e-2).optimize(objective(), start, free, space.neighbors)
    changes = np.abs(np.diff(result.history)) / result.history[:-1]
    assert result.reason == "the total error stopped changing"
    assert changes[-1] <= 1e-2
    assert np.all(changes[:-1] > 1e-2)


def test_the_search_ends_without_a_new_minimum(problem):
    """A search that cycles ends after ``patience`` sweeps without a new minimum."""
    space, start, free, objective = problem
    search = GradientDescent(step=1.5, tol=0, patience=4)
    result = search.optimize(objective(), start, free, space.neighbors)
    assert result.reason == "no new minimum for 4 sweeps"
    assert result.history.argmin() == result.iterations - 4
    assert result.errors.mean() == result.history.min()


def test_the_search_ends_after_the_last_sweep(problem):
    """The limit of sweeps holds, and is the reason given."""
    space, start, free, objective = problem
    search = GradientDescent(max_sweeps=3, tol=0)
    result = search.optimize(objective(), start, free, space.neighbors)
    assert (result.iterations, result.reason) == (3, "reached 3 sweeps")


def test_points_without_a_radius_take_the_median_one(problem):
    """Coinciding with both neighbours, a point is probed at the others' median distance."""
    space, start, free, objective = problem
    first, second = space.neighbors[free[0]]
    start[[first, second]] = start[free[0]]
    pairs = space.neighbors[free]
    radii = np.linalg.norm(start[pairs] - start[free, None], axis=2).mean(axis=1)
    expected = np.median(radii[radii > 0])
    result = GradientDescent(max_sweeps=1, step=1.0).optimize(
        objective(), start, free, space.neighbors
    )
    moved = np.linalg.norm(result.embedding[free[0]] - start[free[0]])
    assert moved in (pytest.approx(expected), 0.0)
    assert moved > 0


def test_the_readings_are_the_defaults():
    """α = δ = 0.5, 200 sweeps, 1e-6 and 20 sweeps without a new minimum."""
    search = GradientDescent()
    assert (search.step, search.probe, search.max_sweeps) == (0.5, 0.5, 200)
    assert (search.tol, search.patience) == (1e-6, 20)


@pytest.mark.parametrize("parameter", ["step", "probe", "max_sweeps", "patience"])
def test_useless_parameters_are_refused(parameter):
    """Steps, probes, sweeps and patience are positive."""
    with pytest.raises(WorkbenchError, match=f"{parameter}: got 0"):
        GradientDescent(**{parameter: 0})


@pytest.mark.parametrize(
    ("free", "rows", "message"),
    [
        ([], 60, "free: got"),
        ([True] * 60, 60, "free: got bool"),
        ([5, 99], 60, "want indices from 0 to 59"),
        ([5, 6], 59, r"neighbors: got shape \(59, 2\)"),
    ],
    ids=["none", "mask", "outside", "neighbours"],
)
def test_arrays_that_do_not_fit_are_refused(problem, free, rows, message):
    """The message names the argument."""
    space, start, _, objective = problem
    with pytest.raises(WorkbenchError, match=message):
        GradientDescent().optimize(objective(), start, free, space.neighbors[:rows])
