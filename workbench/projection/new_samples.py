"""Places of new samples on an existing map, by the samples that are on it."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from workbench.projection.fitted import Projection
from workbench.spaces import Space

#: Samples of the map that a new sample is placed by.
NEIGHBORS = 5


def placed_by_projector(
    projection: Projection, training: Space, test: Space
) -> NDArray[np.float64] | None:
    """Place new samples by the projector's own map.

    Parameters
    ----------
    projection : Projection
        Of the training samples.
    training, test : Space
        Known and new samples.

    Returns
    -------
    ndarray of shape (n_test, n_components), or None
        On the scale of the projection's embedding; None if the projector places no new
        samples.
    """
    projector = projection.projector
    if not hasattr(projector, "transform"):
        return None
    samples = test.features
    if getattr(projector, "metric", None) == "precomputed":
        samples = training.cross_distances(test.samples, training.samples)
    points: NDArray[np.float64] = (projector.transform(samples) - projection.low) / (
        projection.extent
    )
    return points


class Neighborhood:
    """The nearest training samples of new ones, and of the training samples themselves.

    Parameters
    ----------
    training : Space
        Samples whose positions are known.
    test : Space
        New samples.
    """

    def __init__(self, training: Space, test: Space) -> None:
        self._training = training
        self._distances = training.cross_distances(test.samples, training.samples)

    @property
    def nearest(self) -> NDArray[np.intp]:
        """The nearest training sample of each new one: (n_test,)."""
        return self._distances.argmin(axis=1)

    def mean_positions(self, embedding: NDArray[np.float64]) -> NDArray[np.float64]:
        """Place new samples at the mean of their nearest training samples' positions.

        Each counts by the inverse of its distance; an equal sample alone.

        Parameters
        ----------
        embedding : ndarray of shape (n_training, n_components)
            Positions of the training samples.

        Returns
        -------
        ndarray of shape (n_test, n_components)
        """
        return _weighted_mean(*self._of_test, embedding)

    def unexplained(self, embedding: NDArray[np.float64], rows: NDArray[np.intp]) -> float:
        """Measure what the other training samples do not tell about a sample's position.

        √(Σ ‖p_i − p̂_i‖² / Σ ‖p_i − p̄‖²) over the given samples, where p̂_i is the place
        that :meth:`mean_positions` would give sample i if it were new, and p̄ their mean
        position: 0 where positions change evenly with the samples, 1 where they might as
        well be guessed.

        Parameters
        ----------
        embedding : ndarray of shape (n_training, n_components)
            Positions of the training samples.
        rows : ndarray of shape (n_rows,)
            Training samples to take the sums over.

        Returns
        -------
        float
        """
        guessed = _weighted_mean(*self._of_training, embedding)[rows]
        places = embedding[rows]
        spread = ((places - places.mean(axis=0)) ** 2).sum()
        return float(np.sqrt(((places - guessed) ** 2).sum() / spread)) if spread > 0 else 0.0

    @cached_property
    def _of_test(self) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
        return _nearest(self._distances)

    @cached_property
    def _of_training(self) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
        distances = self._training.distances.copy()
        np.fill_diagonal(distances, np.inf)
        # One less than there are: a sample is no neighbour of its own.
        return _nearest(distances, at_most=len(distances) - 1)


def _nearest(
    distances: NDArray[np.float64], at_most: int = NEIGHBORS
) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Find the nearest columns of each row, with the share that each of them counts."""
    count = min(NEIGHBORS, at_most, distances.shape[1])
    # Sorted in a stable way, so that equal distances are told apart by the samples' order.
    nearest = np.argsort(distances, axis=1, kind="stable")[:, :count]
    near = np.take_along_axis(distances, nearest, axis=1)
    equal = near == 0
    with np.errstate(divide="ignore"):
        weights = np.where(equal.any(axis=1, keepdims=True), equal, 1.0 / near)
    return nearest, weights / weights.sum(axis=1, keepdims=True)


def _weighted_mean(
    nearest: NDArray[np.intp], weights: NDArray[np.float64], embedding: NDArray[np.float64]
) -> NDArray[np.float64]:
    means: NDArray[np.float64] = np.einsum("nk,nkd->nd", weights, embedding[nearest])
    return means
