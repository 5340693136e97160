"""What an optimizer lowers, and what it returns."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.backprojection import BackProjector

#: Called with (iteration, mean error, embedding) after each iteration; a true result stops.
Callback = Callable[[int, float, NDArray[np.float64]], bool | None]

#: Error measure: (indices of samples, their reconstructions) to one error for each.
ErrorFunction = Callable[[NDArray[np.intp], NDArray[np.float64]], NDArray[np.float64]]


class Objective:
    """The back-projection error of samples at given positions.

    Parameters
    ----------
    back_projector : back-projector
        Fitted on the control points.
    errors : callable
        ``errors(indices, reconstructions)`` gives one error for each reconstruction, for
        instance :meth:`workbench.spaces.Space.errors`.

    Attributes
    ----------
    evaluations : int
        Points back-projected so far.
    """

    def __init__(self, back_projector: BackProjector, errors: ErrorFunction) -> None:
        self._back_projector = back_projector
        self._errors = errors
        self.evaluations = 0

    def __call__(self, points: NDArray[np.float64], indices: ArrayLike) -> NDArray[np.float64]:
        """Evaluate the errors of samples placed at points.

        Parameters
        ----------
        points : ndarray of shape (n_points, n_dimensions)
            Positions.
        indices : array-like of shape (n_points,)
            The sample that each position is tried for.

        Returns
        -------
        ndarray of shape (n_points,)
        """
        self.evaluations += len(points)
        return self._errors(np.asarray(indices), self._back_projector.predict(points))


@dataclass(frozen=True)
class OptimizationResult:
    """A better embedding and how it was found.

    Attributes
    ----------
    embedding : ndarray of shape (n_samples, n_dimensions)
        Positions; those of control points are as they were.
    errors : ndarray of shape (n_free,)
        Error of each free sample there.
    history : ndarray of shape (n_iterations + 1,)
        Mean error over the free samples, at the start and after each iteration.
    evaluations : int
        Points back-projected.
    reason : str
        Why the search ended.
    """

    embedding: NDArray[np.float64]
    errors: NDArray[np.float64]
    history: NDArray[np.float64]
    evaluations: int
    reason: str

    @property
    def iterations(self) -> int:
        """Number of iterations that were run."""
        return len(self.history) - 1
