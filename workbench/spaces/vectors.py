"""Rows of a table as a space."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.spaces.base import Space, sample_indices
from workbench.validation import (
    MIN_SAMPLES,
    control_point_indices,
    finite,
)


class VectorSpace(Space):
    """Rows of a table under the Euclidean distance.

    Parameters
    ----------
    values : array-like of shape (n_samples, n_features)
        The table's numbers.
    columns : iterable of str, optional
        Names of the features.
    labels : array-like of shape (n_samples,), optional
        A class for each row; never used by a projection, only to colour it.
    name : str
        What to call the table.
    standardize : bool
        Whether to bring each column to zero mean and unit variance; a constant column
        becomes 0. It changes every result, so figures and tables say which was used.
    notes : sequence of str
        What was done to the data when they were read.

    Raises
    ------
    WorkbenchError
        If the table is not 2-D, has fewer than 3 rows or values that are not finite.

    Examples
    --------
    >>> space = VectorSpace([[0, 0], [3, 4], [0, 1]])
    >>> space.pair_distances([0], [1])
    array([5.])
    """

    def __init__(
        self,
        values: ArrayLike,
        *,
        columns: Iterable[str] | None = None,
        labels: ArrayLike | None = None,
        name: str = "",
        standardize: bool = False,
        notes: tuple[str, ...] = (),
    ) -> None:
        try:
            array = np.array(values, dtype=np.float64)
        except (TypeError, ValueError):
            raise WorkbenchError(
                "values: got entries that are no numbers, or rows of different lengths, "
                "want a table of numbers (workbench.load_space reads files with text columns)"
            ) from None
        if array.ndim != 2 or len(array) < MIN_SAMPLES or array.shape[1] < 1:
            raise WorkbenchError(
                f"values: got shape {array.shape}, want at least {MIN_SAMPLES} rows "
                "and 1 column of numbers"
            )
        finite(array, "values")
        if standardize:
            # By the range: the mean of equal numbers may differ from them by rounding.
            varies = np.ptp(array, axis=0) > 0
            spread = np.where(varies, array.std(axis=0), 1.0)
            array = np.where(varies, (array - array.mean(axis=0)) / spread, 0.0)
        self.samples = array
        self.name = name
        self.standardized = standardize
        if columns is None:
            columns = [f"x{i}" for i in range(array.shape[1])]
        self.columns = tuple(columns)
        self.labels = None if labels is None else np.asarray(labels)
        self.notes = tuple(notes)
        if len(self.columns) != array.shape[1]:
            raise WorkbenchError(f"columns: got {len(self.columns)} names, want {array.shape[1]}")
        if self.labels is not None and self.labels.shape != (len(array),):
            raise WorkbenchError(f"labels: got shape {self.labels.shape}, want ({len(array)},)")

    @property
    def features(self) -> NDArray[np.float64]:
        """The table's numbers: (n_samples, n_features)."""
        return self.samples

    @cached_property
    def distances(self) -> NDArray[np.float64]:
        """Euclidean distances between all rows: (n_samples, n_samples)."""
        from scipy.spatial.distance import pdist, squareform

        self._require_memory_for_distances()
        return squareform(pdist(self.samples))

    def pair_distances(self, first: ArrayLike, second: ArrayLike) -> NDArray[np.float64]:
        """Measure the Euclidean distances between pairs of rows."""
        return np.linalg.norm(
            self.samples[sample_indices(first)] - self.samples[sample_indices(second)], axis=1
        )

    def cross_distances(self, first: ArrayLike, second: ArrayLike) -> NDArray[np.float64]:
        """Measure the Euclidean distances between rows of two tables."""
        from scipy.spatial.distance import cdist

        return cdist(np.asarray(first, dtype=np.float64), np.asarray(second, dtype=np.float64))

    def subset(self, indices: ArrayLike) -> VectorSpace:
        """Make a table of some of the rows; standardised columns stay as they are."""
        rows = control_point_indices(indices, len(self), at_least=MIN_SAMPLES, name="indices")
        return VectorSpace(
            self.samples[rows],
            columns=self.columns,
            labels=None if self.labels is None else self.labels[rows],
            name=self.name,
            notes=self.notes,
        )

    def errors(self, indices: ArrayLike, reconstructions: ArrayLike) -> NDArray[np.float64]:
        """Measure the Euclidean distances between rows and their reconstructions."""
        originals, rebuilt = self.matched(indices, reconstructions)
        return finite(np.linalg.norm(originals - rebuilt, axis=1), "errors of reconstructions")

    def error_table(self, indices: ArrayLike, reconstructions: ArrayLike) -> NDArray[np.float64]:
        """Measure Euclidean distances: (n_indices, n_reconstructions)."""
        errors = self.cross_distances(self.samples[sample_indices(indices)], reconstructions)
        return finite(errors, "errors of reconstructions")

    def error_derivatives(
        self, indices: ArrayLike, reconstructions: ArrayLike, jacobians: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """Measure Euclidean distances to rows, and their derivatives."""
        originals, rebuilt = self.matched(indices, reconstructions)
        difference = rebuilt - originals
        errors = finite(np.linalg.norm(difference, axis=1), "errors of reconstructions")
        per_error = np.divide(1.0, errors, out=np.zeros_like(errors), where=errors > 0)
        gradients = np.einsum("nf,nfd,n->nd", difference, jacobians, per_error)
        curvatures = np.swapaxes(jacobians, 1, 2) @ jacobians
        curvatures -= gradients[:, :, None] * gradients[:, None, :]
        return errors, gradients, curvatures * per_error[:, None, None]

    @cached_property
    def neighbors(self) -> NDArray[np.intp]:
        """The two nearest other rows of each row: (n_samples, 2).

        Rows have no order in time, so these take the place of the previous and the next
        frame (Costa 2018, section 5.2).
        """
        from sklearn.neighbors import NearestNeighbors

        return NearestNeighbors(n_neighbors=2).fit(self.samples).kneighbors(return_distance=False)

    def mean_prediction_error(self) -> float:
        """Mean Euclidean distance between the rows and their mean."""
        return float(np.linalg.norm(self.samples - self.samples.mean(axis=0), axis=1).mean())
