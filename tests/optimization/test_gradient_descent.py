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


@pytest.mark.parametrize("parameter", ["step", "probe", "max_sweeps"])
def test_useless_parameters_are_refused(parameter):
    """Steps, probes and sweeps are positive."""
    with pytest.raises(WorkbenchError, match=f"{parameter}: got 0"):
        GradientDescent(**{parameter: 0})
