"""Recording: trajectories as a hand drew them, with its timing."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.authoring.checking import above_zero
from workbench.authoring.trajectories import Trajectory
from workbench.errors import WorkbenchError
from workbench.validation import as_numbers, finite

#: Seconds without an event after which the hand has rested: moving pointers send more often.
_REST = 0.1
#: Seconds between events of a moving pointer, about.
_EVENT = 1 / 60


def recorded(
    points: ArrayLike, times: ArrayLike, frame_time: float, *, smoothing: float = 0.03
) -> Trajectory:
    """Make a trajectory of the positions of a pointer.

    Of events at one moment the last counts. A pointer that rests sends nothing, so where
    0.1 s or more are between two events it stays and only then moves on. The curve is taken at
    each frame and freed from the hand's tremor by a Gaussian mean over time, which leaves both
    ends and straight, even strokes as they are.

    Parameters
    ----------
    points : array-like of shape (n_events, 2)
        Positions on the plane.
    times : array-like of shape (n_events,)
        Seconds of any clock, never falling.
    frame_time : float
        Seconds between the trajectory's points.
    smoothing : float
        Standard deviation of the Gaussian, in seconds; 0 for none.

    Returns
    -------
    Trajectory
        From 0 s, a point at each frame and at the end.

    Raises
    ------
    WorkbenchError
        If positions or times are not finite, there is not one time for each position, times
        fall, or the drawing takes less than a frame.

    Examples
    --------
    >>> path = recorded([[0.0, 0.0], [0.5, 0.0], [1.0, 0.0]], [7.0, 7.05, 7.1], 0.05)
    >>> path.points.round(9).tolist(), path.times.round(9).tolist()
    ([[0.0, 0.0], [0.5, 0.0], [1.0, 0.0]], [0.0, 0.05, 0.1])
    """
    step = above_zero("frame_time", frame_time)
    places = finite(as_numbers("points", points, 2), "points")
    seconds = finite(as_numbers("times", times), "times")
    if places.ndim != 2 or seconds.shape != (len(places),):
        raise WorkbenchError(
            f"times: got shape {seconds.shape} for points of shape {places.shape}, "
            "want one time for each of (n_events, 2)"
        )
    if np.any(np.diff(seconds) < 0):
        raise WorkbenchError("times: got times that fall, want them as they came")
    if not smoothing >= 0:
        raise WorkbenchError(f"smoothing: got {smoothing!r}, want 0 or a number above")
    seconds = seconds - seconds[0] if len(seconds) else seconds
    last = np.append(np.diff(seconds) > 0, True)[: len(seconds)]
    places, seconds = places[last], seconds[last]
    if len(seconds) == 0 or seconds[-1] < step:
        raise WorkbenchError(
            f"drawing: took {seconds[-1] if len(seconds) else 0:.3g} s, "
            f"want at least a frame, {step:.3g} s: draw slower or longer"
        )
    hand = Trajectory(*_with_rests(places, seconds))
    clock = hand.frames(step).times
    if hand.duration - clock[-1] > 1e-6 * step:
        clock = np.append(clock, hand.times[-1])
    curve = hand.at(clock)
    curve[-1] = places[-1]  # even if it came a rounding error after the last frame
    return Trajectory(_smoothed(curve, smoothing / step), clock)


def _with_rests(
    places: NDArray[np.float64], seconds: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Insert where the pointer still was just before it moved on."""
    after = 1 + np.flatnonzero(np.diff(seconds) >= _REST)
    return (
        np.insert(places, after, places[after - 1], axis=0),
        np.insert(seconds, after, seconds[after] - _EVENT),
    )


def _smoothed(points: NDArray[np.float64], width: float) -> NDArray[np.float64]:
    """Average by a Gaussian, narrower towards the ends so that they stay.

    At frame i the window reaches as far as the nearer end, to both sides alike, so that points
    on an even line are their own means.
    """
    reach, last = int(np.ceil(3.0 * width)), len(points) - 1
    smooth = points.copy()
    for half in range(1, min(reach, last // 2 + 1)):
        weights = _gaussian(half, width)
        smooth[half] = weights @ points[: 2 * half + 1]
        smooth[last - half] = weights @ points[last - 2 * half :]
    if 0 < 2 * reach <= last:
        weights = _gaussian(reach, width)
        inside = [np.convolve(axis, weights, mode="valid") for axis in points.T]
        smooth[reach : last - reach + 1] = np.stack(inside, axis=1)
    return smooth


def _gaussian(half: int, width: float) -> NDArray[np.float64]:
    """Give weights from −half to half that add up to 1."""
    weights = np.exp(-0.5 * (np.arange(-half, half + 1) / width) ** 2)
    normalized: NDArray[np.float64] = weights / weights.sum()
    return normalized
