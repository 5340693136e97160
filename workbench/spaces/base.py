"""What all spaces share."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.validation import (
    require_memory,
)


class Space(ABC):
    """The base of all spaces.

    Attributes
    ----------
    name : str
        What to call the data in messages and figures.
    samples : ndarray of shape (n_samples, ...)
        The samples themselves.
    labels : ndarray of shape (n_samples,) or None
        A class for each sample.
    notes : tuple of str
        What was done to the data when they were read, for the user to know.
    """

    name: str
    samples: NDArray[np.float64]
    labels: NDArray[Any] | None = None
    notes: tuple[str, ...] = ()

    def __len__(self) -> int:
        return len(self.samples)

    @property
    @abstractmethod
    def features(self) -> NDArray[np.float64]:
        """Samples as vectors, for methods that need coordinates: (n_samples, n_features)."""

    @property
    @abstractmethod
    def distances(self) -> NDArray[np.float64]:
        """Distances between all pairs of samples: (n_samples, n_samples)."""

    @abstractmethod
    def pair_distances(self, first: ArrayLike, second: ArrayLike) -> NDArray[np.float64]:
        """Measure the distances between pairs of samples.

        Parameters
        ----------
        first, second : array-like of shape (n_pairs,)
            Indices of samples.

        Returns
        -------
        ndarray of shape (n_pairs,)
        """

    @abstractmethod
    def cross_distances(self, first: ArrayLike, second: ArrayLike) -> NDArray[np.float64]:
        """Measure the distances between samples of two sets, new ones too.

        Parameters
        ----------
        first : array-like of shape (n_first, ...)
            Samples like those of the space.
        second : array-like of shape (n_second, ...)
            As many or others.

        Returns
        -------
        ndarray of shape (n_first, n_second)
        """

    @abstractmethod
    def subset(self, indices: ArrayLike) -> Space:
        """Make a space of some of the samples, under the same distance.

        Parameters
        ----------
        indices : array-like of shape (n_subset,)
            Sorted, each once, at least 3.

        Returns
        -------
        Space
        """

    @abstractmethod
    def errors(self, indices: ArrayLike, reconstructions: ArrayLike) -> NDArray[np.float64]:
        """Measure how far reconstructions are from the samples that they stand for.

        Parameters
        ----------
        indices : array-like of shape (n_points,)
            The sample that each reconstruction stands for; repetitions are allowed.
        reconstructions : array-like of shape (n_points, ...)
            Reconstructed samples.

        Returns
        -------
        ndarray of shape (n_points,)
        """

    @abstractmethod
    def error_table(self, indices: ArrayLike, reconstructions: ArrayLike) -> NDArray[np.float64]:
        """Measure the error of every reconstruction as one of every given sample.

        Parameters
        ----------
        indices : array-like of shape (n_indices,)
            Samples.
        reconstructions : array-like of shape (n_reconstructions, ...)
            Reconstructed samples.

        Returns
        -------
        ndarray of shape (n_indices, n_reconstructions)
        """

    @abstractmethod
    def error_derivatives(
        self, indices: ArrayLike, reconstructions: ArrayLike, jacobians: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """Measure errors and how they change with what the reconstructions depend on.

        Parameters
        ----------
        indices, reconstructions
            As for :meth:`errors`.
        jacobians : ndarray of shape (n_points, ..., n_dimensions)
            Derivatives of the reconstructions by position.

        Returns
        -------
        errors : ndarray of shape (n_points,)
        gradients : ndarray of shape (n_points, n_dimensions)
        curvatures : ndarray of shape (n_points, n_dimensions, n_dimensions)
            Second derivatives as if the Jacobians were constant (Gauss and Newton):
            positive semidefinite. All 0 where the error is 0 and has a kink.
        """

    @property
    @abstractmethod
    def neighbors(self) -> NDArray[np.intp]:
        """Two neighbours of each sample, equal where there is only one: (n_samples, 2)."""

    @abstractmethod
    def mean_prediction_error(self) -> float:
        """Mean error of the poorest sensible reconstruction: every sample by the mean."""

    def matched(
        self, indices: ArrayLike, reconstructions: ArrayLike
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Pair samples with their reconstructions, whoever made these.

        Parameters
        ----------
        indices : array-like of shape (n_points,)
            The sample that each reconstruction stands for.
        reconstructions : array-like of shape (n_points, ...)
            Reconstructed samples.

        Returns
        -------
        samples, reconstructions : ndarray of shape (n_points, ...)

        Raises
        ------
        WorkbenchError
            If they are not as many, or of another shape.
        """
        originals = self.samples[sample_indices(indices)]
        rebuilt = np.asarray(reconstructions, dtype=np.float64)
        if rebuilt.shape != originals.shape:
            raise WorkbenchError(
                f"reconstructions: got shape {rebuilt.shape}, want {originals.shape}"
            )
        return originals, rebuilt

    def _require_memory_for_distances(self) -> None:
        # Twice the matrix: methods that work on it need a copy.
        require_memory(
            16.0 * len(self) ** 2,
            f"{self.name or 'data'}: the distances between {len(self)} samples",
            "take a sample of them, or a shorter or thinner clip",
        )


def check_space(space: Any) -> None:
    """Refuse what is no space of samples.

    Raises
    ------
    WorkbenchError
        If it is not; the message says how to make one.
    """
    if not isinstance(space, Space):
        raise WorkbenchError(
            f"space: got {type(space).__name__}, want a VectorSpace or a PoseSpace, "
            "as workbench.load_space gives them"
        )


def sample_indices(indices: ArrayLike) -> NDArray[np.intp]:
    """Take indices of samples, refusing fractions, which numpy would cut off."""
    array = np.asarray(indices)
    if array.size and array.dtype.kind not in "iu":
        raise WorkbenchError(f"indices: got {array.dtype}, want whole numbers")
    return array.astype(np.intp)
