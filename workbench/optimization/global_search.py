"""The global optimizer: samples start from shared points and tell each other where it is good."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from workbench.errors import WorkbenchError
from workbench.optimization.descent import Descent
from workbench.optimization.objective import Objective
from workbench.optimization.progress import Bounds, Progress
from workbench.optimization.search import Search
from workbench.optimization.trust_region import ErrorModel
from workbench.validation import whole_number

#: Nearest control points that a control point makes a starting point with, halfway.
_HALFWAY = 3

#: Entries of the table of samples and coarse points that is held at once.
_TABLE = 2**20

#: Improvement, relative to a sample's error, that a neighbour's position must promise.
_WORTHWHILE = 1e-3


class GlobalSearch(Search):
    """Lower every sample's error wherever in the plane that is possible, never raising one.

    The same problem as that of Costa 2018, Alg. 12, whose result depends on the start: where
    the projection folds, a sample may lie in a poor basin. Here

    1. a coarse set of points, a grid over the padded plane and places between control
       points, is back-projected once and serves all samples as starts. Each sample measures
       its error against a few of them, in turns, so that neighbours measure different ones;
       every ``scouts``-th sample measures all, and goes down from its best ``starts``;
    2. each sample goes down from its best start, as :class:`LocalSearch` does;
    3. samples try the positions of their two neighbours, and go down from there if that
       promises a lower error, until nobody finds any more. What one has found thus passes on
       along the motion, as matches spread in PatchMatch (Barnes et al. 2009).

    Parameters
    ----------
    grid : int
        Grid points, about; rounded to a whole number for each side.
    padding : float
        How far the grid reaches beyond the start, relative to its larger extent.
    share : int
        Every how many coarse points a sample measures one.
    scouts : int
        Every how many samples one measures all coarse points.
    starts : int
        From how many of those it goes down.
    tolerance : float
        Expected improvement, relative to a sample's error, below which it rests.
    max_iterations : int
        Upper limit of iterations of each descent, and of rounds among neighbours.
    bounds : tuple of two array-likes of shape (n_dimensions,), optional
        Low and high corner of a box that no sample leaves. Without it samples may go down
        beyond the padded plane.

    Examples
    --------
    >>> from workbench.spaces import VectorSpace
    >>> from workbench.backprojection.rbf import RBF
    >>> plane = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.5]])
    >>> space = VectorSpace(plane)
    >>> start = plane.copy()
    >>> start[3] = [0.2, 0.9]
    >>> objective = Objective.of(space, RBF().fit(start[:3], plane[:3]))
    >>> result = GlobalSearch().optimize(objective, start, [3], space.neighbors)
    >>> bool(np.allclose(result.embedding[3], [0.5, 0.5], atol=1e-3))
    True
    """

    def __init__(
        self,
        *,
        grid: int = 196,
        padding: float = 0.25,
        share: int = 32,
        scouts: int = 16,
        starts: int = 3,
        tolerance: float = 1e-3,
        max_iterations: int = 50,
        bounds: Bounds | None = None,
    ) -> None:
        super().__init__(tolerance=tolerance, max_iterations=max_iterations, bounds=bounds)
        for name, value in (
            ("grid", grid),
            ("share", share),
            ("scouts", scouts),
            ("starts", starts),
        ):
            whole_number(name, value)
        if not 0 <= padding < np.inf:
            raise WorkbenchError(f"padding: got {padding}, want 0 or a number above")
        self.grid = grid
        self.padding = padding
        self.share = share
        self.scouts = scouts
        self.starts = starts

    def _steps(
        self,
        objective: Objective,
        progress: Progress,
        bounds: tuple[NDArray[np.float64], NDArray[np.float64]],
    ) -> Iterator[None]:
        objective.stage = "start"
        progress.begin(objective(progress.points, progress.free))
        progress.reason = "no sample found a better place"
        yield from _Run(objective, progress, bounds, self).steps()


@dataclass(frozen=True, eq=False)
class _CoarsePoints:
    """Points that are back-projected once for all samples."""

    points: NDArray[np.float64]
    reconstructions: NDArray[np.float64]
    spacing: float


class _Run:
    """One run of the global search."""

    def __init__(
        self,
        objective: Objective,
        progress: Progress,
        bounds: tuple[NDArray[np.float64], NDArray[np.float64]],
        settings: GlobalSearch,
    ) -> None:
        self.objective = objective
        self.progress = progress
        self.bounds = bounds
        self.settings = settings
        self.radii = progress.radii

    def steps(self) -> Iterator[None]:
        """Search, yielding after each iteration."""
        every = np.arange(len(self.progress.free))
        coarse = self._coarse_points()
        radii = self._take_coarse_starts(coarse)
        yield
        scouts, starts = self._scouts(coarse)
        yield from self._descend(
            np.concatenate([every, scouts]),
            np.concatenate([self._positions(every), starts]),
            np.concatenate([radii, np.full(len(scouts), coarse.spacing / 2.0)]),
        )
        yield from self._ask_neighbors()

    def _positions(self, which: NDArray[np.intp]) -> NDArray[np.float64]:
        return self.progress.embedding[self.progress.free[which]]

    def _coarse_points(self) -> _CoarsePoints:
        embedding = self.progress.embedding
        settings = self.settings
        extent = float(np.ptp(embedding, axis=0).max())
        margin = settings.padding * extent
        low = np.maximum(embedding.min(axis=0) - margin, self.bounds[0])
        high = np.minimum(embedding.max(axis=0) + margin, self.bounds[1])
        side = max(2, round(settings.grid ** (1.0 / embedding.shape[1])))
        spacing = float((high - low).max()) / (side - 1) or 1.0
        axes = [
            np.linspace(a, b, max(2, round((b - a) / spacing) + 1))
            for a, b in zip(low, high, strict=True)
        ]
        grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, len(axes))
        fixed = np.setdiff1d(np.arange(len(embedding)), self.progress.free)
        points = np.concatenate([grid, _between(embedding[fixed])])
        return _CoarsePoints(points, self.objective.back_project(points), spacing)

    def _take_coarse_starts(self, coarse: _CoarsePoints) -> NDArray[np.float64]:
        """Let each sample start at the best of its share of coarse points, if that is better."""
        share = self.settings.share
        radii = self.radii.copy()
        free = self.progress.free
        for turn in range(min(share, len(coarse.points), len(free))):
            which = np.arange(turn, len(free), share)
            self.objective.stage = "coarse"
            errors = self.objective.table(
                free[which], coarse.reconstructions[turn::share], coarse.points[turn::share]
            )
            best = errors.argmin(axis=1)
            lowest = errors[np.arange(len(which)), best]
            radii[which[lowest < self.progress.errors[which]]] = coarse.spacing
            self.progress.place(which, coarse.points[turn::share][best], lowest)
        return radii

    def _scouts(self, coarse: _CoarsePoints) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
        """Let some samples measure all coarse points; return them with their best few."""
        every, n = self.settings.scouts, len(self.progress.free)
        which = np.arange(min(every, n) // 2, n, every)
        size = max(1, _TABLE // len(coarse.points))
        parts = [
            self._best_starts(which[start : start + size], coarse)
            for start in range(0, len(which), size)
        ]
        scouts, starts = zip(*parts, strict=True)
        return np.concatenate(scouts), np.concatenate(starts)

    def _best_starts(
        self, which: NDArray[np.intp], coarse: _CoarsePoints
    ) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
        """Find each sample's best few of all coarse points."""
        self.objective.stage = "scout"
        errors = self.objective.table(
            self.progress.free[which], coarse.reconstructions, coarse.points
        )
        scouts, starts = [], []
        for _ in range(self.settings.starts):
            best = errors.argmin(axis=1)
            left = np.isfinite(errors[np.arange(len(which)), best])
            scouts.append(which[left])
            starts.append(coarse.points[best[left]])
            # The next start is to lie in another basin, as far as the grid can tell.
            away = np.linalg.norm(coarse.points - coarse.points[best][:, None], axis=2)
            errors[away < 1.5 * coarse.spacing] = np.inf
        return np.concatenate(scouts), np.concatenate(starts)

    def _ask_neighbors(self) -> Iterator[None]:
        """Try the neighbours' positions until no sample finds a better one among them."""
        progress = self.progress
        asking = np.repeat(np.arange(len(progress.free)), 2)
        neighbors = progress.neighbors.ravel()
        tried = np.full((len(asking), progress.embedding.shape[1]), np.inf)
        for _ in range(self.settings.max_iterations):
            places, own = progress.embedding[neighbors], self._positions(asking)
            # What is about where it was, or where the sample is, promises nothing new.
            new = np.linalg.norm(places - tried, axis=1) > 0.5 * self.radii[asking]
            away = np.linalg.norm(places - own, axis=1)
            ask = np.flatnonzero(new & (away > self.radii[asking]))
            if not len(ask):
                return
            tried[ask] = places[ask]
            which = asking[ask]
            promised = self._promised(which, places[ask], 0.5 * away[ask])
            promising = promised < (1.0 - _WORTHWHILE) * progress.errors[which]
            which, starts = which[promising], places[ask[promising]]
            yield from self._descend(which, starts, self.radii[which])
        progress.reason = f"reached {self.settings.max_iterations} rounds among neighbours"

    def _promised(
        self, which: NDArray[np.intp], places: NDArray[np.float64], within: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Estimate what error samples would reach from places, by one step of a descent."""
        indices = self.progress.free[which]
        self.objective.stage = "neighbor"
        if not self.objective.has_derivatives:
            return self.objective(places, indices)
        model = ErrorModel(*self.objective.derivatives(places, indices))
        return model.errors - model.gains(model.steps(within))

    def _descend(
        self,
        which: NDArray[np.intp],
        starts: NDArray[np.float64],
        radii: NDArray[np.float64],
    ) -> Iterator[None]:
        """Send samples down from starts; they move there once it is better than where they are."""
        if not len(which):
            return
        descent = Descent(
            self.objective,
            self.progress.free[which],
            starts.copy(),
            radii,
            self.bounds,
            self.settings.tolerance,
            self.settings.max_iterations,
        )
        moved = self.progress.place(which, descent.points, descent.errors)
        for _ in descent.run():
            self.progress.place(which, descent.points, descent.errors)
            moved = False
            yield
        if moved:
            yield


def _between(control_points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Find the places halfway between each control point and its nearest others.

    A back-projection is as fine as its control points are dense, however coarse the grid.
    """
    n = len(control_points)
    if n < 2:
        return np.empty((0, control_points.shape[1]))
    from sklearn.neighbors import NearestNeighbors

    nearest = NearestNeighbors(n_neighbors=min(_HALFWAY, n - 1)).fit(control_points)
    neighbors = nearest.kneighbors(return_distance=False)
    halfway = (control_points[:, None] + control_points[neighbors]) / 2.0
    return np.unique(halfway.reshape(-1, control_points.shape[1]), axis=0)
