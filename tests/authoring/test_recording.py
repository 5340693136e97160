"""Drawings become trajectories with the timing of the hand."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from workbench.authoring.recording import recorded
from workbench.errors import WorkbenchError

STEP = 1 / 120


def _events(seconds, rate=60):
    return np.arange(0.0, seconds, 1 / rate)


def test_an_even_straight_stroke_stays_as_it_is():
    """A line at even speed is neither smoothed nor delayed."""
    times = _events(1.0)
    path = recorded(np.stack([times, 2 * times], axis=1), 5.0 + times, STEP)
    assert_allclose(path.points, np.stack([path.times, 2 * path.times], axis=1), atol=1e-9)
    assert path.times[0] == 0.0
    assert path.duration == pytest.approx(times[-1])


def test_speed_is_kept():
    """A hand that speeds up gives a trajectory that speeds up."""
    times = _events(1.0)
    path = recorded(np.stack([times**2, 0 * times], axis=1), times, STEP)
    assert_allclose(path.points[:, 0], path.times**2, atol=2e-3)


def test_a_rest_stays_a_rest():
    """A pointer that rests sends nothing; it must not creep to where it goes next."""
    times = np.array([0.0, 0.05, 0.10, 1.10, 1.15, 1.20])
    points = np.stack([[0.0, 0.5, 1.0, 1.5, 2.0, 2.5], np.zeros(6)], axis=1)
    path = recorded(points, times, STEP, smoothing=0.0)
    resting = path.at(np.linspace(0.1, 1.08, 20))
    assert_allclose(resting[:, 0], 1.0, atol=1e-12)
    assert path.at([1.10])[0, 0] == pytest.approx(1.5, abs=1e-6)


def test_of_events_at_one_moment_the_last_counts():
    """Events that were gathered have one time; the trajectory has growing times."""
    path = recorded([[0, 0], [9, 9], [1, 0], [2, 0]], [0.0, 0.1, 0.1, 0.2], 0.1, smoothing=0.0)
    assert path.points.round(9).tolist() == [[0, 0], [1, 0], [2, 0]]


def test_tremor_is_smoothed_away():
    """Noise about a stroke shrinks to less than a half, and its ends stay."""
    rng = np.random.default_rng(0)
    times = _events(2.0, rate=120)
    stroke = np.stack([np.cos(times), np.sin(times)], axis=1)
    shaken = stroke + rng.normal(scale=0.01, size=stroke.shape)
    path = recorded(shaken, times, STEP)
    truth = np.stack([np.cos(path.times), np.sin(path.times)], axis=1)
    assert (path.points - truth).std() < 0.5 * 0.01
    assert_allclose(path.points[[0, -1]], shaken[[0, -1]], atol=1e-12)


@pytest.mark.parametrize("n_frames", [2, 3, 4, 7, 8, 9, 30])
def test_smoothing_is_a_mean_over_the_window_that_fits(n_frames):
    """Each frame is the Gaussian mean of a window that reaches as far as the nearer end."""
    width = 1.1
    times = STEP * np.arange(n_frames)
    points = np.random.default_rng(2).random((n_frames, 2))
    path = recorded(points, times, STEP, smoothing=width * STEP)
    for i in range(n_frames):
        half = min(4, i, n_frames - 1 - i)
        weights = np.exp(-0.5 * (np.arange(-half, half + 1) / width) ** 2)
        expected = np.average(points[i - half : i + half + 1], axis=0, weights=weights)
        assert_allclose(path.points[i], expected, atol=1e-6)


@settings(deadline=None)
@given(st.lists(st.floats(0.0, 0.5), min_size=2, max_size=40), st.floats(0.002, 0.2))
def test_any_events_give_a_trajectory(gaps, step):
    """Whatever the gaps between events, points are finite, times grow and the ends are kept."""
    times = np.cumsum(gaps)
    points = np.stack([np.sin(7 * times), np.arange(len(times))], axis=1)
    if times[-1] - times[0] < step:
        with pytest.raises(WorkbenchError, match="draw slower"):
            recorded(points, times, step)
        return
    path = recorded(points, times, step)
    assert np.isfinite(path.points).all()
    assert np.all(np.diff(path.times) > 0)
    assert path.duration == pytest.approx(times[-1] - times[0], rel=1e-5)
    first = np.flatnonzero(times == times[0])[-1]
    assert np.array_equal(path.points[[0, -1]], points[[first, -1]])


@pytest.mark.parametrize(
    ("points", "times", "message"),
    [
        ([[0, 0], [1, np.nan]], [0, 1], "points"),
        ([[0, 0, 0]], [0], "points"),
        ([[0, 0], [1, 1]], [0], "times"),
        ([[0, 0], [1, 1]], [0, np.inf], "times"),
        ([[0, 0], [1, 1]], [1, 0], "fall"),
        (np.zeros((0, 2)), [], "draw slower"),
        ([[0, 0]], [3.0], "draw slower"),
    ],
    ids=["no number", "space", "too few times", "infinite", "backwards", "nothing", "a click"],
)
def test_what_is_no_drawing_is_refused(points, times, message):
    """Each wrong input is named."""
    with pytest.raises(WorkbenchError, match=message):
        recorded(points, times, STEP)
