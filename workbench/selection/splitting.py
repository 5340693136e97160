"""Split a curve at its worst frame, again and again."""

from __future__ import annotations

import heapq
from collections.abc import Callable
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray


def split_at_worst(
    worst_between: Callable[[int, int], tuple[float, int]],
    keys: NDArray[np.intp],
    count: int,
) -> NDArray[np.intp]:
    """Add the frame with the largest error to the keys until there are enough.

    An error depends on the two neighbouring keys, so a new key changes only those of the
    segment that it splits: each segment's worst frame waits in a heap. Balanced splits make
    that n · log2(count) errors altogether, instead of n · count.

    Parameters
    ----------
    worst_between : callable
        ``worst_between(first, last)`` gives the largest error of the frames between two
        neighbouring keys, and the first frame that has it.
    keys : ndarray of shape (n_keys,)
        Sorted keys to start from, the first and the last frame among them.
    count : int
        How many keys are wanted, at most as many as there are frames.

    Returns
    -------
    ndarray of shape (count,)
        Keys in the order in which they were chosen, those of the start first. Of equal
        errors, that of the earlier frame counts.

    Examples
    --------
    >>> values = np.array([0.0, 0.0, 3.0, 0.0, 1.0, 0.0])
    >>> split_at_worst(lambda a, b: worst_of(values[a + 1 : b], a + 1), np.array([0, 5]), 4)
    array([0, 5, 2, 4])
    """
    chosen = keys.tolist()
    waiting: list[tuple[float, int, int, int]] = []

    def wait(first: int, last: int) -> None:
        if last - first > 1:
            error, frame = worst_between(first, last)
            heapq.heappush(waiting, (-error, frame, first, last))

    for first, last in pairwise(chosen):
        wait(first, last)
    while len(chosen) < count:
        _, frame, first, last = heapq.heappop(waiting)
        chosen.append(frame)
        wait(first, frame)
        wait(frame, last)
    return np.array(chosen, dtype=np.intp)


def worst_of(errors: NDArray[np.float64], begin: int) -> tuple[float, int]:
    """Find the largest error and the first frame that has it.

    Parameters
    ----------
    errors : ndarray of shape (n_errors,)
        Errors of successive frames, at least one.
    begin : int
        The frame that the first is of.

    Returns
    -------
    error : float
    frame : int
    """
    worst = int(np.argmax(errors))
    return float(errors[worst]), begin + worst
