"""A projection with the method that made it and the scale that it was brought to."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class Projection:
    """An embedding in the unit square, and how to get there and back.

    Attributes
    ----------
    embedding : ndarray of shape (n_samples, n_components)
        Positions, scaled to the unit square.
    projector : scikit-learn transformer
        The fitted method.
    low : ndarray of shape (n_components,)
        Where the unit square begins in the method's own coordinates.
    extent : float
        Length of its side there.
    """

    embedding: NDArray[np.float64]
    projector: Any
    low: NDArray[np.float64]
    extent: float

    def unscaled(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Express positions in the projector's own coordinates.

        Parameters
        ----------
        points : ndarray of shape (n_points, n_components)
            Positions on the scale of ``embedding``.

        Returns
        -------
        ndarray of shape (n_points, n_components)
        """
        return points * self.extent + self.low
