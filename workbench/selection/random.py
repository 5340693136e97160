"""Random sampling."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from sklearn.utils import check_random_state

from workbench.spaces import Space
from workbench.validation import control_point_count


class Random:
    """Select samples at random, all equally likely.

    Parameters
    ----------
    random_state : int, RandomState instance or None
        Seed; the same seed selects the same samples.
    """

    def __init__(self, random_state: int | np.random.RandomState | None = None) -> None:
        self.random_state = random_state

    def select(self, space: Space, count: int) -> NDArray[np.intp]:
        """Pick ``count`` samples without repetition.

        Returns
        -------
        ndarray of shape (count,)
            Sorted indices.

        Raises
        ------
        WorkbenchError
            If the count is not within 2 and n_samples − 1.
        """
        count = control_point_count(len(space), count=count)
        chosen = check_random_state(self.random_state).choice(len(space), count, replace=False)
        return np.sort(chosen).astype(np.intp)
