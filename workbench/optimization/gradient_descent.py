"""Gradient descent on each sample's back-projection error (Costa 2018, Alg. 12)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.optimization.objective import Callback, Objective, OptimizationResult
from workbench.optimization.progress import as_neighbors, neighbor_radii
from workbench.validation import as_embedding, control_point_indices, whole_number


class GradientDescent:
    """Move every free point down its own error, all points at once, sweep by sweep.

    A point q is probed at q ± δ·r along each axis, where r is its mean distance to its two
    neighbours in the current embedding. Along each axis on which a probe is better than q,
    the difference of the two probes' errors counts; the point then moves by α·r in the
    direction of those differences (Costa 2018, Alg. 12).

    Read as in the author's program: sweeps are simultaneous, over all free points, at
    most 200 times. Printed literally, a point that moved would never move again. Steps
    are not checked, so a point's error may rise. The search often cycles; it ends when the
    relative change of the total error is below ``tol`` or the total found no new minimum
    for ``patience`` sweeps, and the positions of the smallest total are returned.

    Parameters
    ----------
    step : float
        α, the length of a step relative to r.
    probe : float
        δ, the distance of the probes relative to r.
    max_sweeps : int
        Upper limit of sweeps.
    tol : float
        Relative change of the total error that ends the search.
    patience : int
        Sweeps without a new minimum that end the search.

    Examples
    --------
    >>> from workbench.spaces import VectorSpace
    >>> from workbench.backprojection.rbf import RBF
    >>> plane = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.5]])
    >>> space = VectorSpace(plane)
    >>> start = plane.copy()
    >>> start[3] = [0.2, 0.9]
    >>> objective = Objective(RBF().fit(start[:3], plane[:3]), space.errors)
    >>> result = GradientDescent().optimize(objective, start, [3], space.neighbors)
    >>> bool(result.history[-1] < 0.1 * result.history[0])
    True
    """

    def __init__(
        self,
        *,
        step: float = 0.5,
        probe: float = 0.5,
        max_sweeps: int = 200,
        tol: float = 1e-6,
        patience: int = 20,
    ) -> None:
        for name, value in (("step", step), ("probe", probe)):
            if not value > 0:
                raise WorkbenchError(f"{name}: got {value}, want a number above 0")
        for name, value in (("max_sweeps", max_sweeps), ("patience", patience)):
            whole_number(name, value)
        if not tol >= 0:
            raise WorkbenchError(f"tol: got {tol}, want 0 or a number above")
        self.step = step
        self.probe = probe
        self.max_sweeps = max_sweeps
        self.tol = tol
        self.patience = patience

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
            Indices of the samples to move.
        neighbors : array-like of shape (n_samples, 2)
            Two neighbours of each sample.
        callback : callable, optional
            ``callback(sweep, mean_error, embedding)``; a true result stops the search.

        Returns
        -------
        OptimizationResult

        Raises
        ------
        WorkbenchError
            If the arrays do not fit each other, or the back-projector gives values that
            are not finite.
        """
        points = as_embedding(embedding).copy()
        free = control_point_indices(free, len(points), name="free")
        pairs = as_neighbors(neighbors, len(points))[free]
        started_at = objective.effort
        objective.stage = "start"
        errors = objective(points[free], free)
        history = [float(errors.mean())]
        best, best_points, best_errors = history[0], points.copy(), errors
        best_sweep, reason = 0, f"reached {self.max_sweeps} sweeps"
        for sweep in range(1, self.max_sweeps + 1):
            radii = neighbor_radii(points, free, pairs)
            directions = self._directions(objective, points[free], free, errors, radii)
            points[free] += self.step * radii[:, None] * directions
            objective.stage = "step"
            errors = objective(points[free], free)
            history.append(float(errors.mean()))
            if history[-1] < best:
                best, best_points, best_errors = history[-1], points.copy(), errors
                best_sweep = sweep
            if callback is not None and callback(sweep, history[-1], points):
                reason = "stopped by the callback"
                break
            if abs(history[-1] - history[-2]) <= self.tol * history[-2]:
                reason = "the total error stopped changing"
                break
            if sweep - best_sweep >= self.patience:
                reason = f"no new minimum for {self.patience} sweeps"
                break
        effort = objective.effort - started_at
        return OptimizationResult(
            best_points, best_errors, np.array(history), effort.evaluations, reason, effort
        )

    def _directions(
        self,
        objective: Objective,
        points: NDArray[np.float64],
        free: NDArray[np.intp],
        errors: NDArray[np.float64],
        radii: NDArray[np.float64],
    ) -> NDArray[np.float64]:
        """Estimate each point's unit direction of descent, or 0 at a local minimum."""
        n, dimensions = points.shape
        offsets = np.concatenate([np.eye(dimensions), -np.eye(dimensions)])
        probes = points + self.probe * radii[:, None] * offsets[:, None]
        objective.stage = "probe"
        probed = objective(probes.reshape(-1, dimensions), np.tile(free, 2 * dimensions))
        forward, backward = probed.reshape(2, dimensions, n)
        better = (forward < errors) | (backward < errors)
        slope = np.where(better, backward - forward, 0.0).T
        length = np.linalg.norm(slope, axis=1, keepdims=True)
        return np.divide(slope, length, out=np.zeros_like(slope), where=length > 0)
