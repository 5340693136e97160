"""Uniform sampling in time."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from workbench.selection.base import Selector
from workbench.spaces import Space


class Uniform(Selector):
    """Select samples at regular intervals, the first and the last included.

    Where samples are fixed, the others are spread over the gaps between them so that the
    longest interval is as short as can be. For tables, whose rows have no order in time,
    prefer a random sample: Iris, for instance, is sorted by class. (Costa 2018, chapter 5,
    "US".)

    Examples
    --------
    >>> from workbench.spaces import VectorSpace
    >>> space = VectorSpace([[0], [1], [2], [3], [4]])
    >>> Uniform().select(space, 3)
    array([0, 2, 4])
    >>> Uniform().select(space, 4, fixed=[1])
    array([0, 1, 2, 4])
    """

    def _select(self, space: Space, count: int, fixed: NDArray[np.intp]) -> NDArray[np.intp]:
        last = len(space) - 1
        if not len(fixed):
            return np.round(np.linspace(0, last, count)).astype(np.intp)
        ends = np.setdiff1d([0, last], fixed)[: count - len(fixed)]
        stops = np.union1d(fixed, ends)
        lengths = np.diff(stops)
        parts = np.ones(len(lengths), dtype=int)
        for _ in range(count - len(stops)):
            # A gap cannot be cut into more parts than it has frames.
            longest = np.argmax(np.where(parts < lengths, lengths / parts, 0.0))
            parts[longest] += 1
        inner = [
            np.round(np.linspace(start, start + length, n + 1)[:-1])
            for start, length, n in zip(stops, lengths, parts, strict=False)
        ]
        return np.concatenate([*inner, stops[-1:]]).astype(np.intp)
