"""What an optimizer does with one sample, step by step: where it tries, and where it goes."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.backprojection import BackProjector
from workbench.errors import WorkbenchError
from workbench.optimization.objective import Callback, Objective, OptimizationResult
from workbench.optimization.trust_region import ErrorModel
from workbench.spaces import Space, check_space
from workbench.validation import as_embedding, control_point_indices


@dataclass(frozen=True, eq=False)
class Try:
    """A position at which the optimizer measured the sample's error.

    Attributes
    ----------
    stage : str
        What for: ``"start"`` of a descent, ``"probe"`` along an axis, the ``"vertex"`` of
        the parabolas through probes, a ``"step"``, a ``"coarse"`` point of this sample's
        share, a coarse point measured by a ``"scout"``, or a ``"neighbor"``'s position.
        Optimizers from elsewhere may leave it empty.
    position : ndarray of shape (n_dimensions,)
        Where.
    error : float
        The back-projection error there.
    gradient : ndarray of shape (n_dimensions,) or None
        Of the error, where the optimizer asked for it.
    curvature : ndarray of shape (n_dimensions, n_dimensions) or None
        As Gauss and Newton have it, beside the gradient.
    predicted : float or None
        The error that the optimizer's quadratic model expected there, where it made one.
    """

    stage: str
    position: NDArray[np.float64]
    error: float
    gradient: NDArray[np.float64] | None = None
    curvature: NDArray[np.float64] | None = None
    predicted: float | None = None


@dataclass(frozen=True, eq=False)
class Step:
    """One iteration of the optimizer, as far as it concerns the sample.

    Attributes
    ----------
    iteration : int
        Number of the iteration, 0 for the start.
    tries : tuple of Try
        What was tried, in order.
    position : ndarray of shape (n_dimensions,)
        Where the sample is afterwards.
    error : float
        Its error there.
    moved : bool
        Whether it was elsewhere before.
    returned : bool
        Whether this is no iteration but the return to that one, the best of all.
    """

    iteration: int
    tries: tuple[Try, ...]
    position: NDArray[np.float64]
    error: float
    moved: bool
    returned: bool = False


@dataclass(frozen=True, eq=False)
class Trace:
    """The way of one sample through an optimization.

    Attributes
    ----------
    sample : int
        Its index.
    steps : tuple of Step
        The start, the iterations until the sample rests, and the return where there is one.
    iterations : int
        Iterations of the whole optimization; other samples may go on for longer.
    reason : str
        Why the optimization ended.
    mean_error : float
        Mean error of all free samples at the end.
    """

    sample: int
    steps: tuple[Step, ...]
    iterations: int
    reason: str
    mean_error: float

    @property
    def positions(self) -> NDArray[np.float64]:
        """Where the sample is at the start and after each step: (n_steps, n_dimensions)."""
        return np.array([step.position for step in self.steps])

    @property
    def errors(self) -> NDArray[np.float64]:
        """Its errors there: (n_steps,)."""
        return np.array([step.error for step in self.steps])


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
    check_space(space)
    start = as_embedding(embedding, "embedding", len(space))
    fixed = control_point_indices(control_points, len(space), at_least=1)
    free = np.setdiff1d(np.arange(len(space)), fixed)
    if sample not in free:
        raise WorkbenchError(
            f"sample: got {sample!r}, want one of the {len(free)} samples of {len(space)} that "
            "are no control points; control points stay where they are"
        )
    objective = _Recorder(space, back_projector, int(sample))
    history = _History(objective, start[sample])

    def follow(iteration: int, error: float, points: NDArray[np.float64]) -> bool | None:
        history.note(points[sample])
        return callback(iteration, error, points) if callback is not None else None

    result = optimizer.optimize(objective, start, free, space.neighbors, callback=follow)
    return history.trace(int(sample), result, float(result.errors.mean()))


class _Recorder(Objective):
    """An objective that notes what it is asked of one sample."""

    def __init__(self, space: Space, back_projector: BackProjector, sample: int) -> None:
        super().__init__(back_projector, space.errors, space)
        self.sample = sample
        self.tries: list[Try] = []

    def __call__(self, points: NDArray[np.float64], indices: ArrayLike) -> NDArray[np.float64]:
        errors = super().__call__(points, indices)
        for row in np.flatnonzero(np.asarray(indices) == self.sample):
            self.tries.append(Try(self.stage, points[row].copy(), float(errors[row])))
        return errors

    def derivatives(
        self, points: NDArray[np.float64], indices: ArrayLike
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        errors, gradients, curvatures = super().derivatives(points, indices)
        for row in np.flatnonzero(np.asarray(indices) == self.sample):
            known = gradients[row].copy(), curvatures[row].copy()
            self.tries.append(Try(self.stage, points[row].copy(), float(errors[row]), *known))
        return errors, gradients, curvatures

    def table(
        self,
        indices: NDArray[np.intp],
        reconstructions: NDArray[np.float64],
        points: NDArray[np.float64] | None = None,
    ) -> NDArray[np.float64]:
        errors = super().table(indices, reconstructions, points)
        if points is None:
            return errors
        for row in np.flatnonzero(indices == self.sample):
            pairs = zip(points, errors[row], strict=True)
            self.tries.extend(Try(self.stage, point.copy(), float(e)) for point, e in pairs)
        return errors


class _History:
    """Steps of one sample, made of what was tried between two looks at where it is."""

    def __init__(self, objective: _Recorder, start: NDArray[np.float64]) -> None:
        self._objective = objective
        self._known: dict[bytes, Try] = {}
        self._place = start.copy()
        self._steps: list[Step] = []
        self._iterations = 0
        self._begun = False

    def note(self, place: NDArray[np.float64]) -> None:
        """Note where the sample is after an iteration."""
        self._begin()
        self._iterations += 1
        self._add(place)

    def trace(self, sample: int, result: OptimizationResult, mean_error: float) -> Trace:
        """Sum up, when the optimizer is done."""
        self._begin()
        place = np.asarray(result.embedding)[sample]
        if self._objective.tries:
            self._add(self._place if len(self._steps) > 1 else place)
        if not np.array_equal(place, self._place):
            self._add(place, returned=True)
        while len(self._steps) > 1 and not (self._steps[-1].tries or self._steps[-1].moved):
            self._steps.pop()
        return Trace(sample, tuple(self._steps), self._iterations, result.reason, mean_error)

    def _begin(self) -> None:
        """Take the first measured error, that at the start, for a step of its own."""
        if self._begun:
            return
        self._begun = True
        tries = self._objective.tries
        rest = tries[1:] if tries and np.array_equal(tries[0].position, self._place) else tries
        self._objective.tries = tries[: len(tries) - len(rest)]
        self._add(self._place)
        self._objective.tries = rest

    def _add(self, place: NDArray[np.float64], *, returned: bool = False) -> None:
        tries = self._with_predictions(self._objective.tries)
        self._objective.tries = []
        for tried in tries:
            self._known[tried.position.tobytes()] = tried
        moved = not np.array_equal(place, self._place)
        self._place = np.array(place, dtype=np.float64)
        iteration = self._iterations
        if returned:
            same = (s.iteration for s in self._steps if np.array_equal(s.position, place))
            iteration = next(same, iteration)
        error = self._error_at(self._place)
        self._steps.append(Step(iteration, tuple(tries), self._place, error, moved, returned))

    def _error_at(self, place: NDArray[np.float64]) -> float:
        known = self._known.get(place.tobytes())
        if known is not None:
            return known.error
        # An optimizer from elsewhere may move a sample to where it did not measure.
        measured = self._objective(place[None], [self._objective.sample])
        self._objective.tries = []
        return float(measured[0])

    def _with_predictions(self, tries: list[Try]) -> list[Try]:
        """Add what the model of a single descent expected of its step."""
        here = self._known.get(self._place.tobytes())
        if len(tries) != 1 or tries[0].stage != "step" or here is None or here.gradient is None:
            return tries
        tried = tries[0]
        assert here.curvature is not None
        model = ErrorModel(
            np.array([here.error]), here.gradient[None].copy(), here.curvature[None].copy()
        )
        gain = float(model.gains((tried.position - here.position)[None])[0])
        predicted = here.error - gain
        return [replace(tried, predicted=predicted)]
