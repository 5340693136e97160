"""Tests of workbench.selection.optimal and best_paths."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from hypothesis import given, settings

from tests.selection.conftest import random_motion, selections, still_motion, wave
from workbench.errors import WorkbenchError
from workbench.interpolation import interpolators
from workbench.mocap.rotations import rotations_from_vectors
from workbench.selection import best_paths
from workbench.selection.optimal import Optimal
from workbench.selection.pb import PositionBased
from workbench.selection.scs import SimpleCurveSimplification
from workbench.selection.tracks import pose_track
from workbench.spaces import PoseSpace, VectorSpace

OBJECTIVES = {"sum": np.sum, "maximum": np.max}


def objective_of(space, keys, interpolator, objective):
    """Rebuild all frames from keys and measure them."""
    rebuilt = interpolators.build(interpolator).interpolate(space.motion, sorted(keys))
    return float(OBJECTIVES[objective](space.errors(np.arange(len(space)), rebuilt)))


def brute_force(space, count, fixed, interpolator, objective):
    """Try all sets of keys."""
    stops = {0, len(space) - 1, *fixed}
    others = sorted(set(range(len(space))) - stops)
    return min(
        objective_of(space, [*stops, *more], interpolator, objective)
        for more in combinations(others, count - len(stops))
    )


@pytest.mark.parametrize("objective", list(OBJECTIVES))
@settings(deadline=None, max_examples=10)
@given(drawn=selections(max_frames=8))
def test_no_other_keys_are_better(objective, drawn):
    """The optimum is that of all sets of keys, for any count and fixed frames."""
    space, count, fixed = drawn
    keys = Optimal(objective=objective).select(space, count, fixed=fixed)
    assert {0, len(space) - 1, *fixed} <= set(keys.tolist())
    assert len(set(keys.tolist())) == count
    assert np.all(np.diff(keys) > 0)
    found = objective_of(space, keys, "slerp", objective)
    assert found == pytest.approx(brute_force(space, count, fixed, "slerp", objective))


@pytest.mark.parametrize("objective", list(OBJECTIVES))
@pytest.mark.parametrize("interpolator", ["slerp", "linear"])
def test_a_path_gives_the_optimum_for_every_count(interpolator, objective):
    """Each count's keys reach the value that is given with them, which none beats."""
    space = random_motion(10, 11)
    path = Optimal(interpolator, objective).path(space, 7, fixed=[4])
    assert path.counts.tolist() == [3, 4, 5, 6, 7]
    for count, keys, value in zip(path.counts, path.keyframes, path.objectives, strict=True):
        assert len(keys) == count
        assert value == pytest.approx(objective_of(space, keys, interpolator, objective))
        assert value == pytest.approx(brute_force(space, count, [4], interpolator, objective))


def unpruned(space, max_count, objective):
    """Fill the whole table of legs, without any bound; give the optimum for each count."""
    n = len(space)
    method = interpolators.build("slerp")
    combine = np.add if objective == "sum" else np.maximum
    legs = np.full((n, n), np.inf)
    for u in range(n):
        for v in range(u + 1, n):
            inner = np.arange(u + 1, v)
            rebuilt = method.interpolate(space.motion, [u, v])[inner]
            errors = space.errors(inner, rebuilt)
            legs[u, v] = errors.sum() if objective == "sum" else errors.max(initial=0.0)
    reached = np.full(n, np.inf)
    reached[0] = 0.0
    optimum = []
    for _ in range(max_count - 1):
        reached = combine(reached[:, None], legs).min(axis=0)
        optimum.append(reached[-1])
    return optimum


@pytest.mark.parametrize("objective", list(OBJECTIVES))
@pytest.mark.parametrize("smooth", [False, True], ids=["rough", "smooth"])
def test_bounds_lose_nothing_on_longer_motions(smooth, objective):
    """With coarse stages and legs left out, the optimum is that of the whole table."""
    space = wave(72) if smooth else random_motion(72, 2)
    wanted = unpruned(space, 5, objective)
    path = Optimal(objective=objective).path(space, 5)
    assert np.allclose(path.objectives, wanted, rtol=1e-9)
    for count in (4, 5):
        keys = Optimal(objective=objective).select(space, count)
        found = objective_of(space, keys, "slerp", objective)
        assert found == pytest.approx(wanted[count - 2], rel=1e-9)


def test_greedy_selectors_do_not_beat_it(wandering):
    """Neither SCS nor PB has a lower sum of errors."""
    best = objective_of(wandering, Optimal().select(wandering, 9), "slerp", "sum")
    for greedy in (SimpleCurveSimplification(), PositionBased()):
        assert best <= objective_of(wandering, greedy.select(wandering, 9), "slerp", "sum")


@pytest.mark.parametrize("objective", list(OBJECTIVES))
def test_bounds_of_rounding_errors_cut_no_path_off(objective):
    """At constant speed the best cost is 0; a bound of exactly 0 leaves a path to every count."""
    turns = np.arange(40)[:, None, None] * np.array([[0.01, 0.02, 0.03]])
    base = rotations_from_vectors(np.random.default_rng(5).normal(size=(3, 3)))
    motion = replace(random_motion(40, 0).motion, rotations=base @ rotations_from_vectors(turns))
    track = pose_track(PoseSpace(motion), "slerp", "optimal")
    frames, stops = np.arange(40), np.array([0, 39])
    costs, _ = best_paths._solve(track, frames, stops, np.zeros(6), objective == "maximum")
    assert np.all(costs[1:, -1] < 1e-12)


def test_a_still_motion_costs_nothing():
    """Any keys do, and the count is right."""
    path = Optimal().path(still_motion(12), 5)
    assert np.array_equal(path.objectives, np.zeros(4))
    assert [len(keys) for keys in path.keyframes] == [2, 3, 4, 5]


def test_what_cannot_be_is_refused(wandering):
    """No room for the ends, a table, an unknown option: each is said."""
    with pytest.raises(WorkbenchError, match="count: got 3 keyframes, want at least 4"):
        Optimal().select(wandering, 3, fixed=[4, 5])
    with pytest.raises(WorkbenchError, match="got the table"):
        Optimal().path(VectorSpace(np.eye(5)), 3)
    with pytest.raises(WorkbenchError, match="count: got 40"):
        Optimal().path(wandering, 40)
    with pytest.raises(WorkbenchError, match="fixed: got 40"):
        Optimal().path(wandering, 5, fixed=[40])
    with pytest.raises(WorkbenchError, match="objective: got 'mean'"):
        Optimal(objective="mean")
