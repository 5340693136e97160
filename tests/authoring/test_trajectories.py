"""Trajectories are edited without changing what they were."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from workbench.authoring import Trajectory
from workbench.errors import WorkbenchError

LINE = Trajectory(np.stack([np.arange(11.0), np.zeros(11)], axis=1), np.arange(11) / 10)
CURVE = Trajectory(np.random.default_rng(0).random((30, 2)), np.arange(30) * 0.25)


def test_dragging_a_point_to_where_it_is_changes_nothing():
    """The identity drag leaves every point exactly."""
    assert np.array_equal(CURVE.dragged(7, CURVE.points[7], 0.8).points, CURVE.points)


@pytest.mark.parametrize("measure", ["length", "time"])
def test_a_drag_follows_the_falloff(measure):
    """Each point moves by (1 − u²)² of the way, nothing from the radius on."""
    radius = 3.0 if measure == "length" else 0.3
    dragged = LINE.dragged(5, [5.0, 2.0], radius, measure=measure)
    expected = [0, 0, 0, 2 * (1 - 4 / 9) ** 2, 2 * (1 - 1 / 9) ** 2, 2]
    expected = [*expected, *expected[-2::-1]]
    assert np.allclose(dragged.points[:, 1], expected, rtol=1e-12)
    assert np.array_equal(dragged.points[[0, 1, 2, 8, 9, 10]], LINE.points[[0, 1, 2, 8, 9, 10]])
    assert np.array_equal(dragged.points[:, 0], LINE.points[:, 0])
    assert np.array_equal(dragged.times, LINE.times)


def test_time_tells_points_apart_that_length_does_not():
    """Where the curve rests, a drag by length takes all along and one by time does not."""
    resting = Trajectory(np.zeros((5, 2)), np.arange(5.0))
    assert np.allclose(resting.dragged(2, [1, 0], 0.5).points[:, 0], 1)
    assert np.allclose(
        resting.dragged(2, [1, 0], 0.5, measure="time").points[:, 0], [0, 0, 1, 0, 0]
    )


@given(st.integers(1, 28), st.floats(0.1, 50.0))
def test_fixed_ends_stay(index, radius):
    """However far a drag is felt, the ends stay and the dragged point arrives."""
    dragged = CURVE.dragged(index, [3.0, -2.0], radius, fixed_ends=True)
    assert np.array_equal(dragged.points[[0, -1]], CURVE.points[[0, -1]])
    assert np.array_equal(dragged.points[index], [3.0, -2.0])


def test_edits_leave_what_was():
    """Going back to an earlier trajectory undoes an edit: its arrays cannot be written."""
    before = LINE.points.copy()
    LINE.dragged(5, [0.0, 9.0], 4.0).retimed(LINE.times**2)
    assert np.array_equal(LINE.points, before)
    with pytest.raises(ValueError, match="read-only"):
        LINE.points[0] = 1.0


def test_the_callers_array_is_not_taken():
    """Changing the array that a trajectory was made of does not change it."""
    points = np.zeros((3, 2))
    path = Trajectory(points, [0, 1, 2])
    points[:] = 5.0
    assert not path.points.any()


@given(st.lists(st.floats(0.0, 7.25), max_size=20))
def test_resampling_keeps_the_points(extra):
    """At times that include all points, the points are among the result, bit for bit."""
    times = np.union1d(CURVE.times, extra)
    more = CURVE.resampled(times)
    assert np.array_equal(more.points[np.searchsorted(times, CURVE.times)], CURVE.points)
    assert np.isclose(more.lengths[-1], CURVE.lengths[-1])


def test_frames_have_the_clocks_of_the_motion():
    """A trajectory of frames gives back its frames, and halves them at twice the time."""
    path = Trajectory.of_frames(CURVE.points, 0.0083333)
    assert np.allclose(path.frames(0.0083333).points, CURVE.points, atol=1e-12)
    assert np.allclose(path.frames(2 * 0.0083333).points, CURVE.points[:-1:2], atol=1e-12)


def test_stretching_a_span_moves_what_comes_later():
    """A span takes factor times as long, and positions follow the new clock."""
    slow = LINE.stretched(0.25, 0.55, 2.0)
    assert slow.duration == pytest.approx(1.3)
    assert np.allclose(slow.at([0.1, 0.25, 0.35, 0.85, 1.3])[:, 0], [1, 2.5, 3, 5.5, 10])
    assert slow.stretched(0.25, 0.85, 0.5).duration == pytest.approx(1.0)


def test_the_ends_hold_outside_the_time():
    """Before the first and after the last point the trajectory waits."""
    assert LINE.at([-1.0, 2.0]).tolist() == [[0.0, 0.0], [10.0, 0.0]]


def test_a_curve_may_have_three_dimensions():
    """An embedding in space has trajectories too."""
    path = Trajectory(np.eye(3), [0, 1, 2]).dragged(1, [0, 0, 0], 0.1)
    assert path.points.tolist() == [[1, 0, 0], [0, 0, 0], [0, 0, 1]]


@pytest.mark.parametrize(
    ("edit", "message"),
    [
        (lambda: Trajectory([[0, 0]], [0]), "times"),
        (lambda: Trajectory([[0, 0], [1, np.nan]], [0, 1]), "points"),
        (lambda: Trajectory([[0, 0], [1, 1]], [1, 1]), "growing"),
        (lambda: Trajectory.of_frames(np.zeros((3, 2)), 0.0), "frame_time"),
        (lambda: LINE.dragged(11, [0, 0], 1.0), "index"),
        (lambda: LINE.dragged(0, [0, 0], 1.0, fixed_ends=True), "index"),
        (lambda: LINE.dragged(1, [0, 0, 0], 1.0), "to"),
        (lambda: LINE.dragged(1, [0, 0], -1.0), "radius"),
        (lambda: LINE.dragged(1, [0, 0], 1.0, measure="frames"), "measure"),
        (lambda: LINE.retimed([0, 1]), "times"),
        (lambda: LINE.stretched(0.5, 0.2, 2.0), "start and stop"),
        (lambda: LINE.stretched(0.2, 0.5, 0.0), "factor"),
        (lambda: LINE.resampled([0.5, 2.0]), "times"),
        (lambda: LINE.frames(3.0), "frame_time"),
    ],
    ids=[
        "one point",
        "nan",
        "equal times",
        "no frame time",
        "no such point",
        "fixed end",
        "another dimension",
        "negative radius",
        "unknown measure",
        "too few times",
        "reversed span",
        "no factor",
        "outside",
        "longer than all",
    ],
)
def test_what_is_no_edit_is_refused(edit, message):
    """The message names the argument."""
    with pytest.raises(WorkbenchError, match=message):
        edit()
