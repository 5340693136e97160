"""The error landscape of one sample: its back-projection error at every place of the plane."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.backprojection import BackProjector
from workbench.errors import WorkbenchError
from workbench.spaces import Space
from workbench.validation import as_embedding, whole_number

#: Points rebuilt between two reports: below a tenth of a second for most methods.
_BLOCK = 512


@dataclass(frozen=True, eq=False)
class PlaneGrid:
    """Places in rows and columns over a plane.

    Attributes
    ----------
    x : ndarray of shape (n_columns,)
    y : ndarray of shape (n_rows,)
        Ascending.
    """

    x: NDArray[np.float64]
    y: NDArray[np.float64]

    @classmethod
    def around(cls, embedding: ArrayLike, side: int, padding: float = 0.25) -> PlaneGrid:
        """Lay a square grid over an embedding and its surroundings.

        Parameters
        ----------
        embedding : array-like of shape (n_samples, 2)
            What it covers.
        side : int
            Rows, and columns.
        padding : float
            How far it reaches beyond, relative to the larger extent of the embedding; by
            default as far as the grid of the global search.

        Returns
        -------
        PlaneGrid

        Raises
        ------
        WorkbenchError
            If the embedding has not two dimensions or the side is below 2.

        Examples
        --------
        >>> PlaneGrid.around([[0.0, 0.0], [1.0, 0.5]], side=3, padding=0.5).y
        array([-0.75,  0.25,  1.25])
        """
        points = as_embedding(embedding)
        if points.shape[1] != 2:
            raise WorkbenchError(f"embedding: got {points.shape[1]} dimensions, want 2")
        if whole_number("side", side) < 2:
            raise WorkbenchError(f"side: got {side}, want 2 or more")
        low, high = points.min(axis=0), points.max(axis=0)
        reach = (0.5 + padding) * (float((high - low).max()) or 1.0)
        middle = (low + high) / 2.0
        x, y = (np.linspace(m - reach, m + reach, side) for m in middle)
        return cls(x, y)

    @property
    def points(self) -> NDArray[np.float64]:
        """All places, row after row: (n_rows · n_columns, 2)."""
        return np.stack(np.meshgrid(self.x, self.y), axis=-1).reshape(-1, 2)


@dataclass(frozen=True, eq=False)
class ErrorLandscape:
    """Errors of one sample over a grid.

    Attributes
    ----------
    sample : int
        Its index.
    grid : PlaneGrid
        The places.
    errors : ndarray of shape (n_rows, n_columns)
        The back-projection error with the sample's point at each place.
    """

    sample: int
    grid: PlaneGrid
    errors: NDArray[np.float64]

    @property
    def minimum(self) -> tuple[NDArray[np.float64], float]:
        """The place of the lowest error on the grid, and that error."""
        row, column = np.unravel_index(self.errors.argmin(), self.errors.shape)
        place = np.array([self.grid.x[column], self.grid.y[row]])
        return place, float(self.errors[row, column])


def rebuild_grid(
    back_projector: BackProjector,
    grid: PlaneGrid,
    report: Callable[[float], None] | None = None,
) -> NDArray[np.float64]:
    """Rebuild a sample at every place of a grid, for the landscapes of any number of samples.

    Parameters
    ----------
    back_projector : back-projector
        Fitted.
    grid : PlaneGrid
        The places.
    report : callable, optional
        Gets how much is done, 0 to 1.

    Returns
    -------
    ndarray of shape (n_rows · n_columns, ...)
    """
    points = grid.points
    parts = []
    for start in range(0, len(points), _BLOCK):
        parts.append(np.asarray(back_projector.predict(points[start : start + _BLOCK])))
        if report is not None:
            report(min(1.0, (start + _BLOCK) / len(points)))
    return np.concatenate(parts)


def error_landscape(
    space: Space, sample: int, grid: PlaneGrid, reconstructions: NDArray[np.float64]
) -> ErrorLandscape:
    """Measure one sample's error at every place of a grid.

    Parameters
    ----------
    space : Space
        The samples.
    sample : int
        Index of the one whose landscape it is.
    grid : PlaneGrid
        The places.
    reconstructions : ndarray of shape (n_rows · n_columns, ...)
        As :func:`rebuild_grid` gives them.

    Returns
    -------
    ErrorLandscape

    Raises
    ------
    WorkbenchError
        If there is no such sample, or an error is not finite.

    Examples
    --------
    >>> from workbench.backprojection.rbf import RBF
    >>> from workbench.spaces import VectorSpace
    >>> plane = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.5]])
    >>> grid = PlaneGrid.around(plane, side=5, padding=0.0)
    >>> rebuilt = rebuild_grid(RBF().fit(plane[:3], plane[:3]), grid)
    >>> place, error = error_landscape(VectorSpace(plane), 3, grid, rebuilt).minimum
    >>> place, round(error, 12)
    (array([0.5, 0.5]), 0.0)
    """
    if not 0 <= sample < len(space):
        raise WorkbenchError(f"sample: got {sample}, want 0 to {len(space) - 1}")
    errors = space.error_table(np.array([sample]), reconstructions)[0]
    return ErrorLandscape(sample, grid, errors.reshape(len(grid.y), len(grid.x)))
