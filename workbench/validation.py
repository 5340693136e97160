"""Checks at the public border, so that no later step has to repeat them."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError

MIN_SAMPLES = 3


def as_embedding(
    points: ArrayLike, name: str = "embedding", n: int | None = None
) -> NDArray[np.float64]:
    """Check plane or space positions.

    Parameters
    ----------
    points : array-like of shape (n_points, n_dimensions)
        Positions in two or three dimensions.
    name : str
        The argument's name, for the message.
    n : int, optional
        The number of points that are wanted.

    Returns
    -------
    ndarray of shape (n_points, n_dimensions)

    Raises
    ------
    WorkbenchError
        If the shape is another or a value is not finite.
    """
    array = np.asarray(points, dtype=np.float64)
    rows = "n_points" if n is None else str(n)
    if array.ndim != 2 or array.shape[1] not in (2, 3) or (n is not None and len(array) != n):
        raise WorkbenchError(f"{name}: got shape {array.shape}, want ({rows}, 2) or ({rows}, 3)")
    return finite(array, name)


def finite(array: NDArray[np.float64], name: str) -> NDArray[np.float64]:
    """Refuse missing and infinite values.

    Raises
    ------
    WorkbenchError
        If there are any; the message says where the first one stands.
    """
    bad = ~np.isfinite(array)
    if bad.any():
        where = tuple(int(i) for i in np.argwhere(bad)[0])
        raise WorkbenchError(
            f"{name}: got {array[where]} at {list(where)} ({int(bad.sum())} such values), "
            "want finite numbers"
        )
    return array


def control_point_indices(
    indices: ArrayLike, n_samples: int, *, at_least: int = 1
) -> NDArray[np.intp]:
    """Check the indices of control points or keyframes.

    Parameters
    ----------
    indices : array-like of shape (n_control_points,)
        Sorted, each once.
    n_samples : int
        Number of samples that they index.
    at_least : int
        How many are needed.

    Returns
    -------
    ndarray of shape (n_control_points,)

    Raises
    ------
    WorkbenchError
        If they are not integers, out of range, unsorted or repeated.
    """
    array = np.asarray(indices)
    if array.ndim != 1 or not np.issubdtype(array.dtype, np.integer) or len(array) < at_least:
        raise WorkbenchError(
            f"control points: got {array.dtype} of shape {array.shape}, "
            f"want a list of at least {at_least} sample indices"
        )
    if array.min() < 0 or array.max() >= n_samples:
        raise WorkbenchError(
            f"control points: got {array.min()}…{array.max()}, "
            f"want indices from 0 to {n_samples - 1}"
        )
    if np.any(np.diff(array) <= 0):
        raise WorkbenchError("control points: got unsorted or repeated indices, want each once")
    return array.astype(np.intp)


def control_point_count(
    n_samples: int, *, count: int | None = None, ratio: float | None = None
) -> int:
    """Turn a count or a ratio into a number of control points.

    Parameters
    ----------
    n_samples : int
        Number of samples.
    count : int, optional
        The number itself.
    ratio : float, optional
        Share of the samples, between 0 and 1: max(3, floor(ratio · n_samples)).

    Returns
    -------
    int

    Raises
    ------
    WorkbenchError
        If neither or both are given, or the number is not within 2 and n_samples − 1.

    Examples
    --------
    >>> control_point_count(817, ratio=0.03)
    24
    """
    if (count is None) == (ratio is None):
        raise WorkbenchError("count and ratio: want exactly one of them")
    if ratio is not None:
        if not 0.0 < ratio < 1.0:
            raise WorkbenchError(f"ratio: got {ratio}, want a number between 0 and 1")
        # A share such as 0.3 of 10 is 2.9999… in binary; it means 3.
        count = max(MIN_SAMPLES, math.floor(ratio * n_samples + 1e-9))
    assert count is not None
    if not 2 <= count < n_samples:
        raise WorkbenchError(
            f"count: got {count} control points for {n_samples} samples, "
            f"want from 2 to {n_samples - 1}"
        )
    return int(count)
