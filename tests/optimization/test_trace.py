"""Tests of what is recorded of an optimization."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from sklearn.neighbors import KNeighborsRegressor

from tests.optimization.problems import sheet
from workbench.datasets import load_space
from workbench.errors import WorkbenchError
from workbench.optimization.global_search import GlobalSearch
from workbench.optimization.gradient_descent import GradientDescent
from workbench.optimization.local_search import LocalSearch
from workbench.optimization.objective import Objective, OptimizationResult
from workbench.optimization.recording import record_optimization, trace_optimization
from workbench.optimization.trace import Trace
from workbench.schemes import SpatialScheme

OPTIMIZERS = pytest.mark.parametrize(
    "optimizer", [GradientDescent, LocalSearch, GlobalSearch], ids=["alg12", "local", "global"]
)
BACK_PROJECTORS = pytest.mark.parametrize("derivatives", [True, False], ids=["rbf", "knn"])


def problem(*, derivatives: bool):
    made = sheet(noise=0.2)
    if not derivatives:
        made.back_projector = KNeighborsRegressor(3, weights="distance").fit(
            made.start[:20], made.space.samples[:20]
        )
    return made


def traced(made, optimizer, sample: int = 33, callback=None) -> Trace:
    return trace_optimization(
        optimizer, made.space, made.back_projector, made.start, np.arange(20), sample, callback
    )


@OPTIMIZERS
@BACK_PROJECTORS
@pytest.mark.parametrize("sample", [20, 33, 59])
def test_a_trace_ends_where_the_unwatched_optimizer_puts_the_sample(optimizer, derivatives, sample):
    """The last position is the result's, exactly, and so are the mean error and the reason."""
    made = problem(derivatives=derivatives)
    result = optimizer().optimize(made.objective(), made.start, made.free, made.space.neighbors)
    trace = traced(made, optimizer(), sample)
    assert np.array_equal(trace.positions[-1], result.embedding[sample])
    assert trace.mean_error == result.errors.mean()
    assert (trace.iterations, trace.reason) == (result.iterations, result.reason)
    assert np.array_equal(trace.positions[0], made.start[sample])


@OPTIMIZERS
@BACK_PROJECTORS
def test_recorded_errors_are_those_of_the_positions(optimizer, derivatives):
    """Each error, also of what was only tried, equals an error computed independently."""
    made = problem(derivatives=derivatives)
    trace = traced(made, optimizer())
    tries = [tried for step in trace.steps for tried in step.tries]
    assert len(tries) > 2
    positions = np.concatenate([trace.positions, [tried.position for tried in tries]])
    recorded = np.concatenate([trace.errors, [tried.error for tried in tries]])
    rebuilt = made.back_projector.predict(positions)
    expected = np.linalg.norm(rebuilt - made.space.samples[33], axis=1)
    np.testing.assert_allclose(recorded, expected, rtol=0, atol=1e-12)


def test_probes_of_alg_12_lie_around_the_point_and_lead_the_way():
    """Each sweep probes at ±δr along the axes and goes αr against the differences."""
    made = problem(derivatives=True)
    trace = traced(made, GradientDescent(step=0.3, probe=0.6))
    pair = made.start[made.space.neighbors[33]]
    radius = np.linalg.norm(pair - made.start[33], axis=1).mean()
    step = trace.steps[1]
    assert [tried.stage for tried in step.tries] == ["probe"] * 4 + ["step"]
    offsets = np.array([tried.position for tried in step.tries[:4]]) - made.start[33]
    expected = 0.6 * radius * np.array([[1, 0], [0, 1], [-1, 0], [0, -1]])
    np.testing.assert_allclose(offsets, expected, atol=1e-12)
    errors = np.array([tried.error for tried in step.tries[:4]])
    start = trace.errors[0]
    slope = np.where(np.minimum(errors[:2], errors[2:]) < start, errors[2:] - errors[:2], 0)
    direction = slope / np.linalg.norm(slope)
    moved = trace.positions[1] - trace.positions[0]
    np.testing.assert_allclose(moved, 0.3 * radius * direction, atol=1e-12)


def test_alg_12_goes_back_to_its_best_sweep():
    """Where the last sweep is not the best, a last step says to which one it returns."""
    made = problem(derivatives=True)
    result = made.run(GradientDescent(step=2.0))
    best = int(result.history.argmin())
    assert best < result.iterations
    endings = []
    made.run(GradientDescent(step=2.0), callback=lambda *state: endings.append(state[2].copy()))
    moved = np.abs(endings[-1] - result.embedding).max(axis=1)
    last = traced(made, GradientDescent(step=2.0), int(moved.argmax())).steps[-1]
    assert last.returned
    assert last.iteration == best
    assert last.tries == ()


def test_the_local_search_knows_what_it_expects_of_a_step():
    """Expected errors are below the last one and near those found once steps are short."""
    trace = traced(problem(derivatives=True), LocalSearch(tolerance=1e-9))
    tried = [(before.error, after.tries[0]) for before, after in pairwise(trace.steps)]
    assert all(t.predicted is not None and t.predicted < before for before, t in tried)
    assert tried[-1][1].predicted == pytest.approx(tried[-1][1].error, rel=1e-3)


@pytest.mark.parametrize("search", [LocalSearch, GlobalSearch], ids=["local", "global"])
@BACK_PROJECTORS
def test_searches_never_step_up_and_rest_where_they_tried(search, derivatives):
    """Errors of a search fall, and each new position is one of those tried."""
    trace = traced(problem(derivatives=derivatives), search())
    assert np.all(np.diff(trace.errors) <= 0)
    for step in trace.steps[1:]:
        if step.moved:
            assert any(np.array_equal(step.position, tried.position) for tried in step.tries)
    assert trace.steps[-1].tries or trace.steps[-1].moved


def test_the_global_search_shows_its_coarse_points():
    """A sample's share of coarse points is tried first; a scout measures all of them."""
    made = problem(derivatives=True)
    common = {t.stage for t in traced(made, GlobalSearch(scouts=40), 33).steps[1].tries}
    assert common == {"coarse"}
    scout = traced(made, GlobalSearch(scouts=1), 33).steps
    stages = [tried.stage for step in scout for tried in step.tries]
    assert stages.count("scout") > 196


def test_poses_are_traced_alike():
    """A frame's trace ends where the scheme's embedding has it."""
    space = load_space("cmu/01_01-jump")
    scheme = SpatialScheme("pca", optimizer="local")
    result = scheme.run(space, ratio=0.05)
    frame = 40 if 40 not in result.control_points else 41
    trace = trace_optimization(
        LocalSearch(), space, result.back_projector, result.projected, result.control_points, frame
    )
    assert np.array_equal(trace.positions[-1], result.embedding[frame])


def test_a_callback_still_stops_the_search():
    """Who watches may also stop; the trace is what there was until then."""
    made = problem(derivatives=True)
    trace = traced(made, LocalSearch(tolerance=1e-9), callback=lambda number, *_: number == 2)
    assert trace.iterations == 2
    assert trace.reason == "stopped by the callback"


class Jump:
    """Put all samples at the origin without a look."""

    def optimize(self, objective, embedding, free, neighbors, callback=None):
        points = embedding.copy()
        points[free] = 0.0
        errors = Objective.__call__(objective, points[free], free)
        return OptimizationResult(points, errors, errors[:1], 0, "done")


def test_an_optimizer_from_elsewhere_need_not_tell_anything():
    """A result that was neither measured nor announced is a step with its true error."""
    made = problem(derivatives=True)
    trace = traced(made, Jump())
    assert np.array_equal(trace.positions[-1], [0.0, 0.0])
    rebuilt = made.back_projector.predict(np.zeros((1, 2)))[0]
    expected = np.linalg.norm(rebuilt - made.space.samples[33])
    assert trace.errors[-1] == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("sample", [3, -1, 60], ids=["control point", "negative", "beyond"])
def test_only_samples_that_move_are_followed(sample):
    """Control points and what is no sample are refused in words."""
    with pytest.raises(WorkbenchError, match=r"sample: got .*control points"):
        traced(problem(derivatives=True), LocalSearch(), sample)


def test_one_recording_serves_all_samples():
    """Traces of one recording are those of runs that follow a single sample."""
    made = problem(derivatives=True)
    recording = record_optimization(
        GlobalSearch(), made.space, made.back_projector, made.start, np.arange(20)
    )
    for sample in (20, 47):
        once, alone = recording.trace(sample), traced(made, GlobalSearch(), sample)
        assert np.array_equal(once.positions, alone.positions)
        assert np.array_equal(once.errors, alone.errors)
        tries = [[t.error for s in trace.steps for t in s.tries] for trace in (once, alone)]
        assert tries[0] == tries[1]
    assert recording.size > 0
