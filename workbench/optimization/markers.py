"""One step further: the control points move too, or other samples take their place.

The optimizers take the back-projector as it is. Here it is fitted anew whenever a marker, the
place of a control point in the embedding, has moved; a change is kept only if it lowers the
mean error over all samples, so the error never rises.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.backprojection import BackProjector
from workbench.optimization.objective import Callback, Effort, Objective
from workbench.registry import Registry, fresh_copy
from workbench.spaces import Space, check_space
from workbench.validation import as_embedding, control_point_indices, whole_number

#: Relative improvement of a round below which the search ends.
_WORTHWHILE = 1e-3

#: How far a control point may hop from neighbour to neighbour at once.
_HOPS = 3


@dataclass(frozen=True, eq=False)
class Markers:
    """Control points, where they lie, and what follows from it.

    Attributes
    ----------
    control_points : ndarray of shape (n_control_points,)
        Sorted indices of samples.
    embedding : ndarray of shape (n_samples, n_dimensions)
        Positions of all samples; those of control points are the markers.
    back_projector : back-projector
        Fitted on the control points there.
    errors : ndarray of shape (n_samples,)
        Error of each sample; 0 for control points, which are kept as they are.
    """

    control_points: NDArray[np.intp]
    embedding: NDArray[np.float64]
    back_projector: BackProjector
    errors: NDArray[np.float64]

    @property
    def error(self) -> float:
        """Mean error over all samples."""
        return float(self.errors.mean())

    @property
    def free(self) -> NDArray[np.intp]:
        """Indices of the samples that are no control points."""
        return np.setdiff1d(np.arange(len(self.embedding)), self.control_points)


@dataclass(frozen=True, eq=False)
class MarkerResult:
    """Better markers and how they were found.

    Attributes
    ----------
    markers : Markers
        The best that was found.
    history : ndarray of shape (n_rounds + 1,)
        Mean error over all samples, at the start and after each round.
    effort : Effort
        What was computed.
    fits : int
        How often the back-projector was fitted.
    reason : str
        Why the search ended.
    """

    markers: Markers
    history: NDArray[np.float64]
    effort: Effort
    fits: int
    reason: str


class MarkerSearch(ABC):
    """The base of searches for better markers.

    A subclass implements ``_proposals``: for one control point, the markers that might be
    better, one after the other.

    Parameters
    ----------
    optimizer : optimizer, optional
        Moves the other samples after each round; by default the local search. It must never
        raise a sample's error.
    max_rounds : int
        Upper limit of rounds; in each, every control point is tried once.
    """

    #: Rounds before which a fruitless one is no reason to end.
    min_rounds = 1

    def __init__(self, *, optimizer: Any = None, max_rounds: int = 10) -> None:
        self.optimizer = optimizer
        self.max_rounds = whole_number("max_rounds", max_rounds)

    def search(
        self,
        space: Space,
        back_projector: BackProjector,
        control_points: ArrayLike,
        embedding: ArrayLike,
        callback: Callback | None = None,
    ) -> MarkerResult:
        """Search for better markers.

        Parameters
        ----------
        space : Space
            The samples.
        back_projector : back-projector
            The method; it is copied and fitted.
        control_points : array-like of shape (n_control_points,)
            Sorted indices of the samples that are kept.
        embedding : array-like of shape (n_samples, n_dimensions)
            Start: positions of all samples.
        callback : callable, optional
            ``callback(round, mean_error, embedding)``; a true result stops the search.

        Returns
        -------
        MarkerResult

        Raises
        ------
        WorkbenchError
            If the indices or positions are not valid.
        """
        from workbench.optimization.local_search import LocalSearch

        check_space(space)
        indices = control_point_indices(control_points, len(space), at_least=2)
        positions = as_embedding(embedding, n=len(space))
        run = _Run(space, back_projector, self.optimizer or LocalSearch())
        markers = run.settled(run.placed(indices, positions))
        history = [markers.error]
        reason = f"reached {self.max_rounds} rounds"
        for number in range(1, self.max_rounds + 1):
            for rank in range(len(indices)):
                markers = self._improved(run, markers, rank)
            markers = run.settled(markers)
            history.append(markers.error)
            if callback is not None and callback(number, markers.error, markers.embedding):
                reason = "stopped by the callback"
                break
            resting = history[-2] - history[-1] <= _WORTHWHILE * history[-2]
            if resting and number >= self.min_rounds:
                reason = "no marker found a better place"
                break
        return MarkerResult(markers, np.array(history), run.effort, run.fits, reason)

    def _improved(self, run: _Run, markers: Markers, rank: int) -> Markers:
        """Take the best proposal for one control point, if it is better than what there is."""
        proposals = [run.placed(*proposal) for proposal in self._proposals(run, markers, rank)]
        best = min(proposals, key=lambda proposal: proposal.error, default=markers)
        return best if best.error < markers.error else markers

    @abstractmethod
    def _proposals(
        self, run: _Run, markers: Markers, rank: int
    ) -> Iterator[tuple[NDArray[np.intp], NDArray[np.float64]]]:
        """Yield control points and embeddings that differ in the one at ``rank``."""


class MoveMarkers(MarkerSearch):
    """Move each marker along the axes, as far as a quarter of the way to its nearest other marker.

    The steps are halved from round to round, so a round without success is no reason to end
    before the fourth.

    Parameters
    ----------
    optimizer : optimizer, optional
        Moves the other samples after each round; by default the local search.
    max_rounds : int
        Upper limit of rounds.

    Examples
    --------
    >>> from workbench.backprojection.rbf import RBF
    >>> from workbench.spaces import VectorSpace
    >>> plane = np.random.default_rng(0).random((30, 2))
    >>> space = VectorSpace(np.column_stack([plane, plane[:, 0] ** 2]))
    >>> result = MoveMarkers(max_rounds=2).search(space, RBF(), np.arange(0, 30, 3), plane)
    >>> bool(result.history[-1] < result.history[0])
    True
    """

    min_rounds = 4

    def _proposals(
        self, run: _Run, markers: Markers, rank: int
    ) -> Iterator[tuple[NDArray[np.intp], NDArray[np.float64]]]:
        places = markers.embedding[markers.control_points]
        away = np.linalg.norm(places - places[rank], axis=1)
        apart = away[away > 0]
        if not len(apart):
            return
        length = 0.5 ** (1 + run.rounds) * apart.min()
        for direction in np.concatenate([np.eye(places.shape[1]), -np.eye(places.shape[1])]):
            embedding = markers.embedding.copy()
            embedding[markers.control_points[rank]] += length * direction
            yield markers.control_points, embedding


class ExchangeMarkers(MarkerSearch):
    """Let a neighbouring sample take the place of each control point.

    Tried are the neighbours of its neighbours' neighbours too: three frames to each side in a
    motion. Positions stay; which samples are kept changes.

    Parameters
    ----------
    optimizer : optimizer, optional
        Moves the other samples after each round; by default the local search.
    max_rounds : int
        Upper limit of rounds.
    """

    def _proposals(
        self,
        run: _Run,
        markers: Markers,
        rank: int,
    ) -> Iterator[tuple[NDArray[np.intp], NDArray[np.float64]]]:
        kept = markers.control_points
        reached = kept[rank : rank + 1]
        for _ in range(_HOPS):
            reached = np.union1d(reached, run.space.neighbors[reached])
        for neighbor in np.setdiff1d(reached, kept):
            yield np.sort(np.append(np.delete(kept, rank), neighbor)), markers.embedding


class _Run:
    """Fits, errors and what they cost, for one search."""

    def __init__(self, space: Space, back_projector: BackProjector, optimizer: Any) -> None:
        self.space = space
        self.effort = Effort()
        self.fits = 0
        self.rounds = 0
        self._back_projector = back_projector
        self._optimizer = optimizer

    def placed(self, control_points: NDArray[np.intp], embedding: NDArray[np.float64]) -> Markers:
        """Fit the back-projector to markers and measure all samples where they are."""
        fitted = fresh_copy(self._back_projector)
        fitted.fit(embedding[control_points], self.space.samples[control_points])
        self.fits += 1
        markers = Markers(control_points, embedding, fitted, np.zeros(len(embedding)))
        objective = Objective.of(self.space, fitted)
        markers.errors[markers.free] = objective(embedding[markers.free], markers.free)
        self.effort += objective.effort
        return markers

    def settled(self, markers: Markers) -> Markers:
        """Let all other samples go down from where they are; end a round."""
        objective = Objective.of(self.space, markers.back_projector)
        found = self._optimizer.optimize(
            objective, markers.embedding, markers.free, self.space.neighbors
        )
        self.effort += objective.effort
        self.rounds += 1
        errors = markers.errors.copy()
        errors[markers.free] = found.errors
        return replace(markers, embedding=found.embedding, errors=errors)


marker_searches = Registry(
    "marker search",
    {
        "move": "workbench.optimization.markers:MoveMarkers",
        "exchange": "workbench.optimization.markers:ExchangeMarkers",
    },
    needs=("search",),
)
