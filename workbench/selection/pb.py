"""Position-based selection, also called frame decimation."""

from __future__ import annotations

import heapq
from collections.abc import Iterable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.kernels import compiled
from workbench.selection.base import Selector, fixed_samples
from workbench.selection.track_errors import frame_errors
from workbench.selection.tracks import (
    Track,
    check_interpolator,
    pose_track,
    value_track,
    with_ends,
)
from workbench.spaces import Space
from workbench.validation import control_point_count


class PositionBased(Selector):
    """Start from all frames and drop, one after the other, the one that is missed least.

    Dropping a frame costs D_q(frame, the frame interpolated between its neighbouring keys);
    frames dropped before do not count. The first, the last and the fixed frames stay.
    (Costa 2018, Alg. 2, "PB"; Halit's "frame decimation", Halit 2010, section 4.1. The
    "reconstructed frame set" is read as slerp between the keys.) Of equal costs, that of the
    earlier frame counts.

    Dropping a frame changes the costs of its two neighbours only, so n frames need fewer
    than 3 · n errors and a heap.

    Only for motions, because the rows of a table have no order in time; for curves of
    numbers see :func:`decimated_keyframes`.

    Parameters
    ----------
    interpolator : {"slerp", "linear"}
        How poses between keys are rebuilt: joint rotations by slerp, or unwrapped Euler
        angles linearly, as the interpolators of these names do.

    Raises
    ------
    WorkbenchError
        If the interpolator is another; when selecting, if the space is a table, or ``count``
        leaves no room for the first and the last frame.

    Examples
    --------
    >>> from workbench import load_space
    >>> keys = PositionBased().select(load_space("cmu/01_01-jump"), 6)
    >>> len(keys), int(keys[0])
    (6, 0)
    """

    def __init__(self, interpolator: str = "slerp") -> None:
        check_interpolator(interpolator)
        self.interpolator = interpolator

    def _select(self, space: Space, count: int, fixed: NDArray[np.intp]) -> NDArray[np.intp]:
        keys = with_ends(fixed, len(space), count)
        return _decimated(pose_track(space, self.interpolator, "pb"), keys, count)


def decimated_keyframes(
    values: ArrayLike, count: int, fixed: Iterable[int] = ()
) -> NDArray[np.intp]:
    """Drop the frames of curves that linear interpolation misses least.

    :class:`PositionBased` for curves of numbers, such as the joint angles of a motion without
    a skeleton: the cost of a frame is its Euclidean distance from the interpolated one.

    Parameters
    ----------
    values : array-like of shape (n_frames, n_values)
        One row per frame, in the order of time; unwrap angles first.
    count : int
        How many frames to keep, the first and the last included.
    fixed : iterable of int
        Frames that must be among them.

    Returns
    -------
    ndarray of shape (count,)
        Sorted.

    Raises
    ------
    WorkbenchError
        If an argument is not valid.

    Examples
    --------
    >>> decimated_keyframes([[0], [1], [2], [1], [0]], 3)
    array([0, 2, 4])
    """
    track = value_track(values)
    count = control_point_count(track.n_frames, count=count)
    kept = fixed_samples(fixed, track.n_frames, count)
    return _decimated(track, with_ends(kept, track.n_frames, count), count)


def _decimated(track: Track, keys: NDArray[np.intp], count: int) -> NDArray[np.intp]:
    """Drop frames, but for the given keys, until ``count`` are left."""
    stays = np.zeros(track.n_frames, dtype=np.bool_)
    stays[keys] = True
    return np.flatnonzero(_decimate(track, stays, count))


@compiled
def _decimate(track, stays, count):  # type: ignore[no-untyped-def]  # compiled
    """Tell which frames are left, as an array of shape (n_frames,)."""
    n_frames = stays.shape[0]
    before, after = np.arange(n_frames) - 1, np.arange(n_frames) + 1
    left = np.ones(n_frames, dtype=np.bool_)
    costs = np.full(n_frames, np.inf)
    waiting = [(np.inf, n_frames)]
    for frame in range(n_frames):
        if not stays[frame]:
            frame_errors(track, frame - 1, frame + 1, frame, costs[frame : frame + 1])
            waiting.append((costs[frame], frame))
    heapq.heapify(waiting)
    for _ in range(n_frames - count):
        cost, frame = heapq.heappop(waiting)
        # An entry whose cost is another by now was replaced by a later one.
        while not left[frame] or cost != costs[frame]:
            cost, frame = heapq.heappop(waiting)
        left[frame] = False
        a, b = before[frame], after[frame]
        after[a], before[b] = b, a
        for neighbor in (a, b):
            if not stays[neighbor]:
                first, last = before[neighbor], after[neighbor]
                frame_errors(track, first, last, neighbor, costs[neighbor : neighbor + 1])
                heapq.heappush(waiting, (costs[neighbor], neighbor))
    return left
