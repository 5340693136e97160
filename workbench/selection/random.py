"""Random sampling."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from sklearn.utils import check_random_state

from workbench.selection.base import Selector
from workbench.spaces import Space


class Random(Selector):
    """Select samples at random, all equally likely.

    Parameters
    ----------
    random_state : int, RandomState instance or None
        Seed; the same seed selects the same samples.
    """

    def __init__(self, random_state: int | np.random.RandomState | None = None) -> None:
        self.random_state = random_state

    def _select(self, space: Space, count: int, fixed: NDArray[np.intp]) -> NDArray[np.intp]:
        others = np.setdiff1d(np.arange(len(space)), fixed)
        chosen = check_random_state(self.random_state).choice(
            others, count - len(fixed), replace=False
        )
        return np.sort(np.concatenate([fixed, chosen])).astype(np.intp)
