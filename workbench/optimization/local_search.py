"""The local optimizer: every sample goes down to the minimum of its own basin."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from workbench.errors import WorkbenchError
from workbench.optimization.descent import Descent
from workbench.optimization.objective import Callback, Objective, OptimizationResult
from workbench.optimization.progress import Bounds, Progress, as_bounds
from workbench.validation import whole_number


class LocalSearch:
    """Lower every sample's error from where it is, without ever raising one.

    The same problem as that of Costa 2018, Alg. 12, with checked steps. Where the
    back-projector gives its Jacobian, steps are Newton's within a trust region, with the
    curvature of Gauss and Newton; otherwise the neighbourhood is probed along the axes. The
    first step is at most as long as the mean distance to the sample's two neighbours, and
    steps grow only while the model predicts them well. So samples hardly ever leave the basin
    that they start in: on clip 05_10 under t-SNE, Isomap and PCA with 3 % keyframes, 99.9,
    100 and 97 % of them end within 1 % of the error to which a gradient flow of tiny steps
    leads. The search ends by itself, for each sample, when no improvement beyond
    ``tolerance`` is to be expected.

    Parameters
    ----------
    tolerance : float
        Expected improvement, relative to a sample's error, below which it rests.
    max_iterations : int
        Upper limit of iterations.
    bounds : tuple of two array-likes of shape (n_dimensions,), optional
        Low and high corner of a box that no sample leaves.

    Examples
    --------
    >>> from workbench.spaces import VectorSpace
    >>> from workbench.backprojection.rbf import RBF
    >>> plane = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.5]])
    >>> space = VectorSpace(plane)
    >>> start = plane.copy()
    >>> start[3] = [0.2, 0.9]
    >>> objective = Objective.of(space, RBF().fit(start[:3], plane[:3]))
    >>> result = LocalSearch().optimize(objective, start, [3], space.neighbors)
    >>> bool(np.allclose(result.embedding[3], [0.5, 0.5], atol=1e-3))
    True
    """

    def __init__(
        self,
        *,
        tolerance: float = 1e-3,
        max_iterations: int = 50,
        bounds: Bounds | None = None,
    ) -> None:
        check_limits(tolerance, max_iterations)
        self.tolerance = tolerance
        self.max_iterations = max_iterations
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
        descent = Descent(
            objective,
            progress.free,
            progress.points,
            progress.radii,
            bounds,
            self.tolerance,
            self.max_iterations,
        )
        progress.begin(descent.errors)
        every = np.arange(len(progress.free))
        iterations = 0
        for _ in descent.run():
            iterations += 1
            progress.place(every, descent.points, descent.errors)
            if not progress.record():
                break
        reached_limit = iterations == self.max_iterations
        return progress.result(
            f"reached {iterations} iterations" if reached_limit else "every sample came to rest"
        )


def check_limits(tolerance: float, max_iterations: int) -> None:
    """Refuse limits that no search could keep.

    Raises
    ------
    WorkbenchError
        If the tolerance is negative or there are no iterations.
    """
    if not tolerance >= 0:
        raise WorkbenchError(f"tolerance: got {tolerance}, want 0 or a number above")
    whole_number("max_iterations", max_iterations)
