"""Recording an optimization: the optimizer runs as ever, on an objective that takes notes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.backprojection import BackProjector
from workbench.errors import WorkbenchError
from workbench.optimization.objective import Callback, Objective, OptimizationResult
from workbench.optimization.trace import History, Trace, Try
from workbench.spaces import Space, check_space
from workbench.validation import as_embedding, control_point_indices


def trace_optimization(
    optimizer: Any,
    space: Space,
    back_projector: BackProjector,
    embedding: ArrayLike,
    control_points: ArrayLike,
    sample: int,
    callback: Callback | None = None,
) -> Trace:
    """Run an optimizer and record what it does with one sample.

    All samples are optimized, since the searches look at their neighbours too; the numbers
    are those of a run that is not watched, to the last bit.

    Parameters
    ----------
    optimizer : optimizer
        An object with ``optimize``, of this package or anyone's.
    space : Space
        The samples.
    back_projector : back-projector
        Fitted on the control points.
    embedding : array-like of shape (n_samples, n_dimensions)
        The start.
    control_points : array-like of shape (n_control_points,)
        Sorted indices of the samples that stay.
    sample : int
        The one to follow; no control point.
    callback : callable, optional
        ``callback(iteration, mean_error, embedding)``; a true result stops the search.

    Returns
    -------
    Trace

    Raises
    ------
    WorkbenchError
        If the sample is none that moves, the arrays do not fit each other, or the
        back-projector gives values that are not finite.

    Examples
    --------
    >>> from workbench.backprojection.rbf import RBF
    >>> from workbench.optimization.gradient_descent import GradientDescent
    >>> from workbench.spaces import VectorSpace
    >>> plane = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.5]])
    >>> start = plane.copy()
    >>> start[3] = [0.2, 0.9]
    >>> model = RBF().fit(start[:3], plane[:3])
    >>> trace = trace_optimization(
    ...     GradientDescent(), VectorSpace(plane), model, start, [0, 1, 2], 3
    ... )
    >>> [tried.stage for tried in trace.steps[1].tries]
    ['probe', 'probe', 'probe', 'probe', 'step']
    >>> bool(trace.errors[-1] < 0.1 * trace.errors[0])
    True
    """
    recording = record_optimization(
        optimizer, space, back_projector, embedding, control_points, callback
    )
    return recording.trace(sample)


def record_optimization(
    optimizer: Any,
    space: Space,
    back_projector: BackProjector,
    embedding: ArrayLike,
    control_points: ArrayLike,
    callback: Callback | None = None,
) -> Recording:
    """Run an optimizer and record what it does, for the traces of any number of samples.

    Parameters
    ----------
    optimizer, space, back_projector, embedding, control_points, callback
        As for :func:`trace_optimization`.

    Returns
    -------
    Recording

    Raises
    ------
    WorkbenchError
        If the arrays do not fit each other, or the back-projector gives values that are not
        finite.
    """
    check_space(space)
    start = as_embedding(embedding, "embedding", len(space))
    fixed = control_point_indices(control_points, len(space), at_least=1)
    free = np.setdiff1d(np.arange(len(space)), fixed)
    objective = _Recorder(space, back_projector)
    ends: list[tuple[int, NDArray[np.float64]]] = []

    def follow(iteration: int, error: float, points: NDArray[np.float64]) -> bool | None:
        ends.append((len(objective.calls), points.copy()))
        return callback(iteration, error, points) if callback is not None else None

    result = optimizer.optimize(objective, start, free, space.neighbors, callback=follow)
    plain = Objective.of(space, back_projector)
    return Recording(start, free, tuple(objective.calls), tuple(ends), result, plain)


@dataclass(frozen=True, eq=False)
class Recording:
    """An optimization with all that was asked of its objective.

    Attributes
    ----------
    start : ndarray of shape (n_samples, n_dimensions)
        Where the samples were.
    free : ndarray of shape (n_free,)
        Indices of the samples that move.
    calls : tuple of Call
        What was measured, in order.
    ends : tuple of (int, ndarray of shape (n_samples, n_dimensions))
        For each iteration the number of calls until its end, and where the samples were then.
    result : OptimizationResult
        What the optimizer returned.
    objective : Objective
        Measures errors where the optimizer did not.
    """

    start: NDArray[np.float64]
    free: NDArray[np.intp]
    calls: tuple[Call, ...]
    ends: tuple[tuple[int, NDArray[np.float64]], ...]
    result: OptimizationResult
    objective: Objective

    @property
    def size(self) -> int:
        """Numbers that are kept."""
        measured = sum(call.points.size * (4 if call.slopes else 2) for call in self.calls)
        return measured + sum(points.size for _, points in self.ends)

    def trace(self, sample: int) -> Trace:
        """Follow one sample.

        Parameters
        ----------
        sample : int
            Its index; no control point.

        Returns
        -------
        Trace

        Raises
        ------
        WorkbenchError
            If it is no sample that moves.
        """
        if sample not in self.free:
            raise WorkbenchError(
                f"sample: got {sample!r}, want one of the {len(self.free)} samples of "
                f"{len(self.start)} that are no control points; control points stay where they are"
            )
        history = History(self.objective, int(sample), self.start[sample])
        done = 0
        for end, points in self.ends:
            history.add_tries(self._tries(sample, done, end))
            history.note(points[sample])
            done = end
        history.add_tries(self._tries(sample, done, len(self.calls)))
        return history.trace(self.result, float(self.result.errors.mean()))

    def _tries(self, sample: int, first: int, end: int) -> list[Try]:
        return [tried for call in self.calls[first:end] for tried in call.tries_of(sample)]


@dataclass(frozen=True, eq=False)
class Call:
    """Errors that the optimizer asked for at once.

    Attributes
    ----------
    stage : str
        What for, see :class:`Try`.
    indices : ndarray of shape (n_rows,)
        Samples.
    points : ndarray of shape (n_rows, n_dimensions), or (n_columns, n_dimensions) of a table
        Where they were tried.
    errors : ndarray of shape (n_rows,), or (n_rows, n_columns) of a table
        What was found.
    slopes : tuple of two ndarrays, or None
        Gradients and curvatures, where they were asked for.
    """

    stage: str
    indices: NDArray[np.intp]
    points: NDArray[np.float64]
    errors: NDArray[np.float64]
    slopes: tuple[NDArray[np.float64], NDArray[np.float64]] | None = None

    def tries_of(self, sample: int) -> list[Try]:
        """Give what concerns one sample."""
        rows = np.flatnonzero(self.indices == sample)
        if self.errors.ndim == 2:
            found = [zip(self.points, self.errors[row], strict=True) for row in rows]
            return [Try(self.stage, p, float(e)) for pairs in found for p, e in pairs]
        if self.slopes is None:
            return [Try(self.stage, self.points[row], float(self.errors[row])) for row in rows]
        gradients, curvatures = self.slopes
        return [
            Try(self.stage, self.points[r], float(self.errors[r]), gradients[r], curvatures[r])
            for r in rows
        ]


class _Recorder(Objective):
    """An objective that notes what it is asked."""

    def __init__(self, space: Space, back_projector: BackProjector) -> None:
        super().__init__(back_projector, space.errors, space)
        self.calls: list[Call] = []

    def __call__(self, points: NDArray[np.float64], indices: ArrayLike) -> NDArray[np.float64]:
        errors = super().__call__(points, indices)
        self._note(indices, points, errors)
        return errors

    def derivatives(
        self, points: NDArray[np.float64], indices: ArrayLike
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        errors, gradients, curvatures = super().derivatives(points, indices)
        self._note(indices, points, errors, (gradients.copy(), curvatures.copy()))
        return errors, gradients, curvatures

    def table(
        self,
        indices: NDArray[np.intp],
        reconstructions: NDArray[np.float64],
        points: NDArray[np.float64] | None = None,
    ) -> NDArray[np.float64]:
        errors = super().table(indices, reconstructions, points)
        if points is not None:
            self._note(indices, points, errors)
        return errors

    def _note(
        self,
        indices: ArrayLike,
        points: NDArray[np.float64],
        errors: NDArray[np.float64],
        slopes: tuple[NDArray[np.float64], NDArray[np.float64]] | None = None,
    ) -> None:
        # Copied, because a search goes on in the same arrays.
        copied = np.array(indices, dtype=np.intp), points.copy(), errors.copy()
        self.calls.append(Call(self.stage, *copied, slopes))
