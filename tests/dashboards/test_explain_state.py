"""What is asked for, and in which order."""

from __future__ import annotations

import numpy as np
import pytest

from workbench.dashboards.explanation.jobs import Job, Method, Plane, Setup
from workbench.dashboards.explanation.state import ExplainState
from workbench.dashboards.shared.sources import Source

METHODS = {name: Method(name, None, 1) for name in ("first", "second")}
SETUP = Setup(Source("data"), METHODS["first"], METHODS["second"], 0.1, 0)


def plane(*, radial: object = "weights", n: int = 6) -> Plane:
    return Plane(
        name="data",
        embedding=np.random.default_rng(0).random((n, 2)),
        control_points=np.array([0, 1, 2]),
        errors=np.array([0.0, 0.0, 0.0, 0.2, 0.9, 0.4])[:n],
        radial=radial,  # type: ignore[arg-type]  # only whether there is one counts
        columns=[],
        low=np.empty(0),
        high=np.empty(0),
        body=None,
        mean_prediction_error=1.0,
        notes=(),
    )


@pytest.fixture
def state() -> ExplainState:
    made = ExplainState(-1, METHODS)
    made.take(SETUP, plane())
    return made


def methods(state: ExplainState) -> list[str]:
    return [job.method for job in state.missing()]


def test_nothing_is_asked_before_there_is_a_plane() -> None:
    """Without data there is no sample to explain."""
    assert ExplainState(-1, METHODS).missing() == []


def test_what_is_seen_first_is_computed_first(state: ExplainState) -> None:
    """The row, a coarse map and the chosen way come before the fine map and the other ways."""
    assert state.sample == 4
    assert methods(state) == ["original", "landscape", "trace", "landscape", "trace"]
    sides = [job.rest[1].side for job in state.missing() if job.method == "landscape"]
    assert sides == [24, 96]
    state.active = "second"
    names = [job.rest[1].name for job in state.missing() if job.method == "trace"]
    assert names == ["second", "first"]


def test_a_coarse_map_is_not_asked_for_where_a_fine_one_is_there(state: ExplainState) -> None:
    """A sample that was shown before is shown at once."""
    fine = next(j for j in state.missing() if j.method == "landscape" and j.rest[1].side == 96)
    state.remember(fine, "map")
    assert methods(state) == ["original", "trace", "trace"]
    assert state.best_map == "map"


def test_control_points_have_no_way(state: ExplainState) -> None:
    """Nothing is traced for them, and that is said."""
    state.sample = 1
    assert "trace" not in methods(state)
    assert set(state.told) == set(METHODS)
    assert all("control point" in str(words) for words in state.told.values())


def test_python_rebuilds_only_what_the_browser_cannot(state: ExplainState) -> None:
    """Without weights for the browser, the clicked place is asked for, or else the start."""
    assert "rebuild" not in methods(state)
    state.take(SETUP, plane(radial=None))
    place = tuple(state.plane.embedding[4])
    assert Job("rebuild", SETUP, (place,)) in state.missing()
    state.place = (0.5, 0.25)
    assert Job("rebuild", SETUP, ((0.5, 0.25),)) in state.missing()


def test_the_sample_stays_under_another_method(state: ExplainState) -> None:
    """It changes with the data only, or where it does not exist any more."""
    state.sample = 3
    other = Setup(SETUP.source, METHODS["second"], METHODS["first"], 0.1, 0)
    state.take(other, plane())
    assert state.sample == 3
    state.take(Setup(Source("more"), METHODS["first"], METHODS["first"], 0.1, 0), plane())
    assert state.sample == 4


def test_failures_are_told_once_and_ways_tell_their_own(state: ExplainState) -> None:
    """A failed map is a fault of the plane; a failed way is said in its place."""
    for job in state.missing():
        state.failures[job] = "no memory"
    assert state.faults() == ["no memory"]
    assert state.missing() == []
    assert state.told == dict.fromkeys(METHODS, "no memory")


def test_only_so_many_results_are_remembered(state: ExplainState) -> None:
    """The oldest are forgotten first."""
    for number in range(250):
        state.remember(Job("original", SETUP, (number,)), number)
    assert len(state.results) == 200
    assert state.answer_of("original", 249) == 249
    assert state.answer_of("original", 49) is None
