"""What the searches share: arguments, the state of the embedding, watching and stopping."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.optimization.objective import Callback, Objective, OptimizationResult
from workbench.validation import as_embedding, control_point_indices

#: Low and high corner of the box that free points may not leave.
Bounds = tuple[ArrayLike, ArrayLike]


class Progress:
    """The embedding while it is being optimized.

    Parameters
    ----------
    objective : Objective
        Errors of samples at positions.
    embedding : array-like of shape (n_samples, n_dimensions)
        Start.
    free : array-like of shape (n_free,)
        Sorted indices of the samples to move.
    neighbors : array-like of shape (n_samples, 2)
        Two neighbours of each sample.
    callback : callable or None
        ``callback(iteration, mean_error, embedding)``; a true result stops the search.

    Attributes
    ----------
    embedding : ndarray of shape (n_samples, n_dimensions)
        Current positions.
    free : ndarray of shape (n_free,)
        Indices of the samples that move.
    neighbors : ndarray of shape (n_free, 2)
        Neighbours of those.
    errors : ndarray of shape (n_free,)
        Their current errors, from :meth:`begin` on.
    stopped : bool
        Whether the callback has asked to stop.
    reason : str
        Why the search ends otherwise.

    Raises
    ------
    WorkbenchError
        If the arrays do not fit each other.
    """

    def __init__(
        self,
        objective: Objective,
        embedding: ArrayLike,
        free: ArrayLike,
        neighbors: ArrayLike,
        callback: Callback | None,
    ) -> None:
        self.embedding = as_embedding(embedding).copy()
        self.free = control_point_indices(free, len(self.embedding), name="free")
        self.neighbors = as_neighbors(neighbors, len(self.embedding))[self.free]
        self.stopped = False
        self.reason = ""
        self._objective = objective
        self._callback = callback
        self._started_at = objective.effort
        self._history: list[float] = []

    errors: NDArray[np.float64]

    @property
    def points(self) -> NDArray[np.float64]:
        """Current positions of the free points, a copy: (n_free, n_dimensions)."""
        return self.embedding[self.free]

    def begin(self, errors: NDArray[np.float64]) -> None:
        """Note the errors at the start: (n_free,)."""
        self.errors = errors.copy()
        self._history = [float(errors.mean())]

    @property
    def radii(self) -> NDArray[np.float64]:
        """Mean distance of each free point to its two neighbours: (n_free,).

        See :func:`neighbor_radii` for points that coincide with both.
        """
        return neighbor_radii(self.embedding, self.free, self.neighbors)

    def place(
        self, which: NDArray[np.intp], points: NDArray[np.float64], errors: NDArray[np.float64]
    ) -> bool:
        """Move free points where their error is lower than it is, and only there.

        Parameters
        ----------
        which : ndarray of shape (n_points,)
            Positions in ``free``; where one is repeated, its lowest error counts.
        points : ndarray of shape (n_points, n_dimensions)
            Where they might move.
        errors : ndarray of shape (n_points,)
            Their errors there.

        Returns
        -------
        bool
            Whether any was moved.
        """
        order = np.lexsort([errors, which])
        first = np.diff(which[order], prepend=-1) != 0
        best = order[first]
        best = best[errors[best] < self.errors[which[best]]]
        self.embedding[self.free[which[best]]] = points[best]
        self.errors[which[best]] = errors[best]
        return len(best) > 0

    def record(self) -> bool:
        """Note the mean error, call back, and tell whether to go on."""
        self._history.append(float(self.errors.mean()))
        if self._callback is not None and self._callback(
            len(self._history) - 1, self._history[-1], self.embedding
        ):
            self.stopped = True
        return not self.stopped

    def result(self) -> OptimizationResult:
        """Sum up the search."""
        effort = self._objective.effort - self._started_at
        return OptimizationResult(
            self.embedding,
            self.errors,
            np.array(self._history),
            effort.evaluations,
            "stopped by the callback" if self.stopped else self.reason,
            effort,
        )


def as_neighbors(neighbors: ArrayLike, n_samples: int) -> NDArray[np.intp]:
    """Check the two neighbours of each sample.

    Parameters
    ----------
    neighbors : array-like of shape (n_samples, 2)
        Indices of samples.
    n_samples : int
        Number of samples.

    Returns
    -------
    ndarray of shape (n_samples, 2)

    Raises
    ------
    WorkbenchError
        If the shape is another, or they are no indices of samples.
    """
    pairs = np.asarray(neighbors)
    if pairs.shape != (n_samples, 2) or not np.issubdtype(pairs.dtype, np.integer):
        raise WorkbenchError(
            f"neighbors: got shape {pairs.shape} of {pairs.dtype}, "
            f"want ({n_samples}, 2) sample indices"
        )
    if pairs.min() < 0 or pairs.max() >= n_samples:
        raise WorkbenchError(
            f"neighbors: got {pairs.min()}…{pairs.max()}, want indices from 0 to {n_samples - 1}"
        )
    return pairs.astype(np.intp)


def neighbor_radii(
    points: NDArray[np.float64], free: NDArray[np.intp], pairs: NDArray[np.intp]
) -> NDArray[np.float64]:
    """Average each free point's distances to its two neighbours.

    Points that coincide with both have no radius of their own and take the median one; if
    all do, the extent of the whole embedding, or 1 if that has none.

    Parameters
    ----------
    points : ndarray of shape (n_samples, n_dimensions)
        Positions.
    free : ndarray of shape (n_free,)
        Indices of the free points.
    pairs : ndarray of shape (n_free, 2)
        Indices of their neighbours.

    Returns
    -------
    ndarray of shape (n_free,)
    """
    radii = np.linalg.norm(points[pairs] - points[free, None], axis=2).mean(axis=1)
    positive = radii > 0
    if positive.any():
        radii[~positive] = np.median(radii[positive])
    else:
        radii[:] = np.ptp(points, axis=0).max() or 1.0
    return radii


def as_bounds(
    bounds: Bounds | None, embedding: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Check the box that free points may not leave.

    Parameters
    ----------
    bounds : tuple of two array-likes of shape (n_dimensions,), or None
        Low and high corner; None for no bounds.
    embedding : ndarray of shape (n_samples, n_dimensions)
        The start, which must lie inside: a point outside could be brought in only by
        raising its error.

    Returns
    -------
    low, high : ndarray of shape (n_dimensions,)

    Raises
    ------
    WorkbenchError
        If they are no such corners, or the start lies outside.
    """
    dimensions = embedding.shape[1]
    if bounds is None:
        return np.full(dimensions, -np.inf), np.full(dimensions, np.inf)
    try:
        low, high = (np.broadcast_to(np.asarray(c, dtype=np.float64), dimensions) for c in bounds)
    except (TypeError, ValueError):
        raise WorkbenchError(
            f"bounds: got {bounds!r}, want a low and a high corner of {dimensions} numbers each"
        ) from None
    if not np.all(low < high):
        raise WorkbenchError(f"bounds: got {low} and {high}, want the first below the second")
    if np.any(embedding < low) or np.any(embedding > high):
        raise WorkbenchError(
            f"embedding: got points from {embedding.min(axis=0)} to {embedding.max(axis=0)}, "
            f"want them within the bounds {low} and {high}"
        )
    return low, high
