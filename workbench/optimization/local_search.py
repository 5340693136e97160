"""The local optimizer: every sample goes down to the minimum of its own basin."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from workbench.optimization.descent import Descent
from workbench.optimization.objective import Objective
from workbench.optimization.progress import Progress
from workbench.optimization.search import Search


class LocalSearch(Search):
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

    def _steps(
        self,
        objective: Objective,
        progress: Progress,
        bounds: tuple[NDArray[np.float64], NDArray[np.float64]],
    ) -> Iterator[None]:
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
        progress.reason = "every sample came to rest"
        every = np.arange(len(progress.free))
        for number, _ in enumerate(descent.run(), start=1):
            progress.place(every, descent.points, descent.errors)
            if number == self.max_iterations:
                progress.reason = f"reached {number} iterations"
            yield
