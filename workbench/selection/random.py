"""Random sampling."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from workbench.selection.base import Selector, random_generator
from workbench.spaces import Space


class Random(Selector):
    """Select samples at random, all equally likely.

    Parameters
    ----------
    random_state : int, RandomState instance or None
        Seed; the same seed selects the same samples.

    Raises
    ------
    WorkbenchError
        When selecting, if the seed is anything else.

    Examples
    --------
    >>> from workbench.spaces import VectorSpace
    >>> space = VectorSpace([[0], [1], [2], [3], [4]])
    >>> len(Random(random_state=0).select(space, 3, fixed=[4]))
    3
    """

    def __init__(self, random_state: int | np.random.RandomState | None = None) -> None:
        self.random_state = random_state

    def _select(self, space: Space, count: int, fixed: NDArray[np.intp]) -> NDArray[np.intp]:
        others = np.setdiff1d(np.arange(len(space)), fixed)
        chosen = random_generator(self.random_state).choice(
            others, count - len(fixed), replace=False
        )
        return np.sort(np.concatenate([fixed, chosen])).astype(np.intp)
