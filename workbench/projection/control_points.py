"""What control-point projectors share: they place samples around control points on a map."""

from __future__ import annotations

import warnings
from abc import ABC, abstractmethod

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import DegenerateDataWarning, WorkbenchError
from workbench.spaces import PoseSpace, Space, check_space
from workbench.validation import as_embedding, as_numbers, control_point_indices, finite

# Entries of the table of distances of one block: 2 MB, so that it stays in a core's cache.
_BLOCK_ENTRIES = 250_000


class ControlPointProjector(ABC):
    """The base of projectors that extend a map of control points to all other samples.

    A subclass implements ``_fit`` and ``_transform``, which may rely on checked input, on
    control points that differ, and on blocks of samples small enough for a table of their
    distances to the control points. What it learns of these places new samples too.

    Attributes
    ----------
    space_ : Space
        Where distances between samples are measured.
    control_samples_ : ndarray of shape (n_control_points, ...)
        The different control points as samples.
    positions_ : ndarray of shape (n_control_points, n_components)
        Where they lie on the map.
    """

    space_: Space
    control_samples_: NDArray[np.float64]
    positions_: NDArray[np.float64]

    def fit(
        self, space: Space, control_points: ArrayLike, positions: ArrayLike
    ) -> ControlPointProjector:
        """Learn a map from its control points.

        Parameters
        ----------
        space : Space
            The samples.
        control_points : array-like of shape (n_control_points,)
            Sorted indices of the samples whose positions are known.
        positions : array-like of shape (n_control_points, n_components)
            Their positions.

        Returns
        -------
        ControlPointProjector
            Itself.

        Raises
        ------
        WorkbenchError
            If the indices or the positions are not valid.

        Warns
        -----
        DegenerateDataWarning
            If equal samples have different positions; they get the mean.
        """
        check_space(space)
        indices = control_point_indices(control_points, len(space))
        self._learn(space, indices, as_embedding(positions, "positions", len(indices)))
        return self

    def _learn(
        self, space: Space, indices: NDArray[np.intp], positions: NDArray[np.float64]
    ) -> None:
        """Learn from checked input; positions may have any number of columns."""
        different, self.positions_ = _merge_equal(_telling_features(space, indices), positions)
        self.space_ = space
        self.control_samples_ = space.samples[indices[different]]
        self._fit()

    def transform(self, samples: ArrayLike) -> NDArray[np.float64]:
        """Place samples on the map.

        Parameters
        ----------
        samples : array-like of shape (n_samples, ...)
            Samples like those of the space, new ones too.

        Returns
        -------
        ndarray of shape (n_samples, n_components)

        Raises
        ------
        WorkbenchError
            If the map was not fitted, or samples are of another shape or not finite.
        """
        if not hasattr(self, "control_samples_"):
            raise WorkbenchError(f"{type(self).__name__}: call fit before transform")
        array = as_numbers("samples", samples)
        if array.shape[1:] != self.control_samples_.shape[1:]:
            wanted = ("n_samples", *self.control_samples_.shape[1:])
            raise WorkbenchError(
                f"samples: got shape {array.shape}, want ({', '.join(map(str, wanted))})"
            )
        finite(array, "samples")
        positions = np.empty((len(array), self.positions_.shape[1]))
        rows = max(1, _BLOCK_ENTRIES // len(self.control_samples_))
        for start in range(0, len(array), rows):
            block = slice(start, start + rows)
            positions[block] = self._transform(array[block])
        return positions

    @abstractmethod
    def _fit(self) -> None:
        """Learn from ``control_samples_`` and ``positions_``."""

    @abstractmethod
    def _transform(self, samples: NDArray[np.float64]) -> NDArray[np.float64]:
        """Place a block of validated samples."""


def _telling_features(space: Space, indices: NDArray[np.intp]) -> NDArray[np.float64]:
    """Give the features of some samples without those that no distance sees."""
    if not isinstance(space, PoseSpace):
        return space.features[indices]
    # Joints without a bone have no weight in D_q, so poses that differ in them are the same.
    return space.samples[indices][:, space.weights > 0].reshape(len(indices), -1)


def _merge_equal(
    features: NDArray[np.float64], positions: NDArray[np.float64]
) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Find the different samples, and give each the mean position of those equal to it.

    Samples that differ by less than 1e-12 of the extent count as equal: no map could tell
    them apart in double precision.
    """
    extent = float(np.ptp(features, axis=0).max()) or 1.0
    keys = np.round((features - features.min(axis=0)) / (1e-12 * extent))
    _, first, group = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    if len(first) == len(features):
        return np.arange(len(features)), positions
    group = group.ravel()
    sums = np.zeros((len(first), positions.shape[1]))
    np.add.at(sums, group, positions)
    means = sums / np.bincount(group)[:, None]
    if not np.allclose(means[group], positions):
        warnings.warn(
            f"{len(features) - len(first)} control points equal others but have different "
            "positions; they get the mean of these",
            DegenerateDataWarning,
            stacklevel=4,
        )
    return first, means
