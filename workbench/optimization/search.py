"""What the searches that never raise an error share."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.optimization.objective import Callback, Objective, OptimizationResult
from workbench.optimization.progress import Bounds, Progress, as_bounds
from workbench.validation import whole_number


class Search(ABC):
    """The base of searches that move a sample only to where its error is lower.

    A subclass implements ``_steps``.

    Parameters
    ----------
    tolerance : float
        Expected improvement, relative to a sample's error, below which it rests.
    max_iterations : int
        Upper limit of iterations.
    bounds : tuple of two array-likes of shape (n_dimensions,), optional
        Low and high corner of a box that no sample leaves.
    """

    def __init__(
        self,
        *,
        tolerance: float = 1e-3,
        max_iterations: int = 50,
        bounds: Bounds | None = None,
    ) -> None:
        if not tolerance >= 0:
            raise WorkbenchError(f"tolerance: got {tolerance}, want 0 or a number above")
        self.tolerance = tolerance
        self.max_iterations = whole_number("max_iterations", max_iterations)
        self.bounds = bounds

    def optimize(
        self,
        objective: Objective,
        embedding: ArrayLike,
        free: ArrayLike,
        neighbors: ArrayLike,
        callback: Callback | None = None,
    ) -> OptimizationResult:
        """Search for better positions of the free points.

        Parameters
        ----------
        objective : Objective
            Errors of samples at positions.
        embedding : array-like of shape (n_samples, n_dimensions)
            Start; points that are not free are never moved.
        free : array-like of shape (n_free,)
            Sorted indices of the samples to move.
        neighbors : array-like of shape (n_samples, 2)
            Two neighbours of each sample.
        callback : callable, optional
            ``callback(iteration, mean_error, embedding)``; a true result stops the search.

        Returns
        -------
        OptimizationResult

        Raises
        ------
        WorkbenchError
            If the arrays do not fit each other, the start is out of bounds, or the
            back-projector gives values that are not finite.
        """
        progress = Progress(objective, embedding, free, neighbors, callback)
        bounds = as_bounds(self.bounds, progress.embedding)
        for _ in self._steps(objective, progress, bounds):
            if not progress.record():
                break
        return progress.result()

    @abstractmethod
    def _steps(
        self,
        objective: Objective,
        progress: Progress,
        bounds: tuple[NDArray[np.float64], NDArray[np.float64]],
    ) -> Iterator[None]:
        """Begin the progress, improve it step by step, and note why it ends."""
