"""What control-point projectors share: they place samples around control points on a map."""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.spaces import Space, check_space
from workbench.validation import as_embedding, control_point_indices, finite


class ControlPointProjector(ABC):
    """The base of projectors that extend a map of control points to all other samples.

    A subclass implements ``_fit`` and ``_transform``, which may rely on checked input. What
    it learns of the control points places new samples too.

    Attributes
    ----------
    space_ : Space
        Where distances between samples are measured.
    control_samples_ : ndarray of shape (n_control_points, ...)
        The control points as samples.
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
        """
        check_space(space)
        indices = control_point_indices(control_points, len(space))
        self.positions_ = as_embedding(positions, "positions", len(indices))
        self.space_ = space
        self.control_samples_ = space.samples[indices]
        self._fit()
        return self

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
        array = np.asarray(samples, dtype=np.float64)
        if array.shape[1:] != self.control_samples_.shape[1:]:
            wanted = ("n_samples", *self.control_samples_.shape[1:])
            raise WorkbenchError(
                f"samples: got shape {array.shape}, want ({', '.join(map(str, wanted))})"
            )
        return self._transform(finite(array, "samples"))

    @abstractmethod
    def _fit(self) -> None:
        """Learn from ``control_samples_`` and ``positions_``."""

    @abstractmethod
    def _transform(self, samples: NDArray[np.float64]) -> NDArray[np.float64]:
        """Place validated samples."""
