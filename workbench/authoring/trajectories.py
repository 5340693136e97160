"""Trajectories: curves on the plane of an embedding, with a time at each point.

A motion that is projected is such a curve, and a curve that is drawn or changed is a new
motion. Nothing is changed in place: each edit gives another trajectory, so that undoing it
is going back to the one before.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.authoring.checking import above_zero
from workbench.errors import WorkbenchError
from workbench.validation import as_embedding, as_numbers, finite, whole_number

#: What distances along a trajectory are measured by.
MEASURES = ("length", "time")


@dataclass(frozen=True, eq=False)
class Trajectory:
    """Points in the order of time; between two of them the way is straight and even.

    Parameters
    ----------
    points : array-like of shape (n_points, 2) or (n_points, 3)
        Positions in the embedding, at least two.
    times : array-like of shape (n_points,)
        Seconds, growing from point to point.

    Raises
    ------
    WorkbenchError
        If a value is not finite, there are fewer than two points, not one time for each, or
        times do not grow.

    Examples
    --------
    >>> path = Trajectory([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]], [0.0, 1.0, 2.0])
    >>> path.dragged(1, [1.0, 1.0], radius=0.5).points.tolist()
    [[0.0, 0.0], [1.0, 1.0], [2.0, 0.0]]
    """

    points: NDArray[np.float64]
    times: NDArray[np.float64]

    def __post_init__(self) -> None:
        points = as_embedding(self.points, "points").copy()
        times = finite(as_numbers("times", self.times), "times").copy()
        if len(points) < 2 or times.shape != (len(points),):
            raise WorkbenchError(
                f"times: got shape {times.shape} for {len(points)} points, "
                "want one for each of at least two"
            )
        if np.any(np.diff(times) <= 0):
            place = int(np.argmax(np.diff(times) <= 0))
            raise WorkbenchError(
                f"times: got {times[place]} before {times[place + 1]}, want growing seconds"
            )
        # Who kept a trajectory to undo an edit must find it as it was.
        points.flags.writeable = times.flags.writeable = False
        object.__setattr__(self, "points", points)
        object.__setattr__(self, "times", times)

    @classmethod
    def of_frames(cls, points: ArrayLike, frame_time: float) -> Trajectory:
        """Make the trajectory of a motion that was projected, from its first frame at 0 s.

        Parameters
        ----------
        points : array-like of shape (n_frames, 2) or (n_frames, 3)
            The embedding.
        frame_time : float
            Seconds between frames.

        Raises
        ------
        WorkbenchError
            If positions are not valid or the time is not above 0.
        """
        embedding = as_embedding(points, "points")
        step = above_zero("frame_time", frame_time)
        return cls(embedding, step * np.arange(len(embedding), dtype=np.float64))

    def __len__(self) -> int:
        return len(self.points)

    @property
    def duration(self) -> float:
        """Seconds from the first point to the last."""
        return float(self.times[-1] - self.times[0])

    @property
    def lengths(self) -> NDArray[np.float64]:
        """Way along the curve from the first point to each: (n_points,)."""
        steps = np.linalg.norm(np.diff(self.points, axis=0), axis=1)
        return np.concatenate([[0.0], np.cumsum(steps)])

    def at(self, times: ArrayLike) -> NDArray[np.float64]:
        """Find where the trajectory is at some times; outside its time it waits at its ends.

        Parameters
        ----------
        times : array-like of shape (n_times,)
            Seconds.

        Returns
        -------
        ndarray of shape (n_times, n_dimensions)

        Raises
        ------
        WorkbenchError
            If a time is not finite.
        """
        seconds = finite(np.atleast_1d(as_numbers("times", times)), "times")
        return np.stack([np.interp(seconds, self.times, axis) for axis in self.points.T], axis=-1)

    def dragged(
        self,
        index: int,
        to: ArrayLike,
        radius: float,
        *,
        measure: str = "length",
        fixed_ends: bool = False,
    ) -> Trajectory:
        """Drag one point to another place and its neighbourhood with it.

        A point at distance d along the curve follows by (1 − (d/radius)²)² of the way, and
        not at all from the radius on, so that the curve stays smooth; its times stay too.

        Parameters
        ----------
        index : int
            The point that is dragged.
        to : array-like of shape (n_dimensions,)
            Where it goes.
        radius : float
            How far along the curve the drag is felt, in the units of ``measure``.
        measure : {"length", "time"}
            Whether distance along the curve is a length or seconds. Where a motion hardly
            moves, points are apart in time and not in length.
        fixed_ends : bool
            Whether the first and the last point stay; on the way to them the drag is felt
            less than it were.

        Returns
        -------
        Trajectory

        Raises
        ------
        WorkbenchError
            If the point is not one of the trajectory's or is an end that is fixed, the place
            is not a position, or the radius or the measure is not valid.
        """
        last = len(self) - 1
        index = whole_number("index", index, 0)
        if index > last or (fixed_ends and index in (0, last)):
            raise WorkbenchError(
                f"index: got {index}, want a point from {int(fixed_ends)} to "
                f"{last - int(fixed_ends)}"
            )
        goal = finite(as_numbers("to", to, self.points.shape[1]), "to")
        if goal.ndim != 1:
            raise WorkbenchError(f"to: got shape {goal.shape}, want one position")
        if measure not in MEASURES:
            raise WorkbenchError(f"measure: got {measure!r}, want one of {', '.join(MEASURES)}")
        along = self.lengths if measure == "length" else self.times
        apart = np.abs(along - along[index]) / above_zero("radius", radius)
        weights = (1.0 - np.minimum(apart, 1.0) ** 2) ** 2
        if fixed_ends:
            weights *= _ramp(along, index)
        points = self.points + weights[:, None] * (goal - self.points[index])
        points[index] = goal
        return replace(self, points=points)

    def retimed(self, times: ArrayLike) -> Trajectory:
        """Give the same points other times.

        Parameters
        ----------
        times : array-like of shape (n_points,)
            Seconds, growing from point to point.

        Returns
        -------
        Trajectory

        Raises
        ------
        WorkbenchError
            If there is not one for each point or they do not grow.
        """
        return replace(self, times=np.asarray(times))

    def stretched(self, start: float, stop: float, factor: float) -> Trajectory:
        """Play a span slower, or faster for a factor below 1; what comes later moves in time.

        Parameters
        ----------
        start, stop : float
            The span, in seconds; the curve gets points there if it has none.
        factor : float
            How much longer it takes.

        Returns
        -------
        Trajectory

        Raises
        ------
        WorkbenchError
            If the span is not within the trajectory's time or the factor is not above 0.

        Examples
        --------
        >>> path = Trajectory([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]], [0.0, 1.0, 2.0])
        >>> path.stretched(0.0, 1.0, 3.0).times.tolist()
        [0.0, 3.0, 4.0]
        """
        factor = above_zero("factor", factor)
        if not self.times[0] <= start < stop <= self.times[-1]:
            raise WorkbenchError(
                f"start and stop: got {start} and {stop}, want a span within "
                f"{self.times[0]} and {self.times[-1]} s"
            )
        # A point that is there but for rounding is not doubled.
        apart = 1e-9 * self.duration
        new = [t for t in (start, stop) if np.abs(self.times - t).min() > apart]
        path = self.resampled(np.union1d(self.times, new))
        within = np.clip(path.times, start, stop) - start
        return replace(path, times=path.times + (factor - 1.0) * within)

    def resampled(self, times: ArrayLike) -> Trajectory:
        """Take the points at other times.

        At times that include those of all points, the curve stays what it was.

        Parameters
        ----------
        times : array-like of shape (n_times,)
            Seconds, growing, within the trajectory's time.

        Returns
        -------
        Trajectory

        Raises
        ------
        WorkbenchError
            If times do not grow or lie outside.
        """
        seconds = finite(as_numbers("times", times), "times")
        if seconds.ndim != 1 or len(seconds) == 0:
            raise WorkbenchError(f"times: got shape {seconds.shape}, want a list of seconds")
        if seconds.min() < self.times[0] or seconds.max() > self.times[-1]:
            raise WorkbenchError(
                f"times: got {seconds.min()}…{seconds.max()}, want them within "
                f"{self.times[0]} and {self.times[-1]} s"
            )
        return Trajectory(self.at(seconds), seconds)

    def frames(self, frame_time: float) -> Trajectory:
        """Take a point each frame, the first one included and the last if its time comes.

        Parameters
        ----------
        frame_time : float
            Seconds between frames.

        Returns
        -------
        Trajectory

        Raises
        ------
        WorkbenchError
            If the time is not above 0, or longer than the trajectory.
        """
        step = above_zero("frame_time", frame_time)
        # A duration of n frames is a little less than n in binary as often as not.
        n_steps = int(np.floor(self.duration / step + 1e-6))
        if n_steps < 1:
            raise WorkbenchError(
                f"frame_time: got {step} s, want at most the {self.duration} s of the trajectory"
            )
        seconds = self.times[0] + step * np.arange(n_steps + 1)
        return self.resampled(np.minimum(seconds, self.times[-1]))


def _ramp(along: NDArray[np.float64], index: int) -> NDArray[np.float64]:
    """Rise smoothly from 0 at both ends to 1 at a point between them."""
    left, right = along[index] - along[0], along[-1] - along[index]
    before = (along[: index + 1] - along[0]) / left if left > 0 else np.zeros(index + 1)
    n_after = len(along) - index - 1
    after = (along[-1] - along[index + 1 :]) / right if right > 0 else np.zeros(n_after)
    rise = np.concatenate([before, after])
    smooth = rise**2 * (3.0 - 2.0 * rise)
    smooth[0] = smooth[-1] = 0.0
    return smooth
