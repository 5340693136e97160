"""What an optimizer does with one sample, step by step: where it tries, and where it goes."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from workbench.optimization.objective import Objective, OptimizationResult
from workbench.optimization.trust_region import ErrorModel


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


class History:
    """Steps of one sample, made of what was tried between two looks at where it is.

    Parameters
    ----------
    objective : Objective
        Measures the error where the optimizer did not.
    sample : int
        Index of the sample.
    start : ndarray of shape (n_dimensions,)
        Where it was.
    """

    def __init__(self, objective: Objective, sample: int, start: NDArray[np.float64]) -> None:
        self._objective = objective
        self._sample = sample
        self._tries: list[Try] = []
        self._known: dict[bytes, Try] = {}
        self._place = start.copy()
        self._steps: list[Step] = []
        self._iterations = 0
        self._begun = False

    def add_tries(self, tries: list[Try]) -> None:
        """Note what was tried since the last look."""
        self._tries += tries

    def note(self, place: NDArray[np.float64]) -> None:
        """Note where the sample is after an iteration."""
        self._begin()
        self._iterations += 1
        self._add(place)

    def trace(self, result: OptimizationResult, mean_error: float) -> Trace:
        """Sum up, when the optimizer is done."""
        self._begin()
        place = np.asarray(result.embedding)[self._sample]
        if self._tries:
            self._add(self._place if len(self._steps) > 1 else place)
        if not np.array_equal(place, self._place):
            self._add(place, returned=True)
        while len(self._steps) > 1 and not (self._steps[-1].tries or self._steps[-1].moved):
            self._steps.pop()
        steps = tuple(self._steps)
        return Trace(self._sample, steps, self._iterations, result.reason, mean_error)

    def _begin(self) -> None:
        """Take the first measured error, that at the start, for a step of its own."""
        if self._begun:
            return
        self._begun = True
        tries = self._tries
        rest = tries[1:] if tries and np.array_equal(tries[0].position, self._place) else tries
        self._tries = tries[: len(tries) - len(rest)]
        self._add(self._place)
        self._tries = rest

    def _add(self, place: NDArray[np.float64], *, returned: bool = False) -> None:
        tries = self._with_predictions(self._tries)
        self._tries = []
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
        measured = self._objective(place[None], [self._sample])
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
