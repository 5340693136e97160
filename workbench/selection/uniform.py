"""Uniform sampling in time."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from workbench.spaces import Space
from workbench.validation import control_point_count


class Uniform:
    """Select samples at regular intervals, the first and the last included.

    For tables, whose rows have no order in time, prefer a random sample: Iris, for
    instance, is sorted by class. (Costa 2018, chapter 5, "US".)

    Examples
    --------
    >>> from workbench.spaces import VectorSpace
    >>> Uniform().select(VectorSpace([[0], [1], [2], [3], [4]]), 3)
    array([0, 2, 4])
    """

    def select(self, space: Space, count: int) -> NDArray[np.intp]:
        """Pick ``count`` evenly spaced samples.

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
        return np.round(np.linspace(0, len(space) - 1, count)).astype(np.intp)
