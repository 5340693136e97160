"""Checks at the public border, so that no later step has to repeat them."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator
from contextlib import contextmanager
from numbers import Integral, Real
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import DataError, WorkbenchError

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
    array = as_numbers(name, points)
    rows = "n_points" if n is None else str(n)
    if array.ndim != 2 or array.shape[1] not in (2, 3) or (n is not None and len(array) != n):
        raise WorkbenchError(f"{name}: got shape {array.shape}, want ({rows}, 2) or ({rows}, 3)")
    return finite(array, name)


def as_numbers(name: str, values: ArrayLike, *ending: int) -> NDArray[np.float64]:
    """Take values as numbers, refusing an array whose last axes have other lengths.

    Parameters
    ----------
    name : str
        The argument's name, for the message.
    values : array-like of shape (..., *ending)
        The values.
    *ending : int
        Lengths of the last axes.

    Returns
    -------
    ndarray of shape (..., *ending)

    Raises
    ------
    WorkbenchError
        If they are no numbers or of another shape.
    """
    try:
        array = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise WorkbenchError(f"{name}: got what is no array of numbers") from None
    if array.shape[array.ndim - len(ending) :] != ending:
        wanted = ", ".join(["...", *map(str, ending)])
        raise WorkbenchError(f"{name}: got shape {array.shape}, want ({wanted})")
    return array


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


@contextmanager
def said_in_one_line() -> Iterator[None]:
    """Turn scikit-learn's refusal of an array into an error of this package.

    Its text stays, because scikit-learn's conventions ask for it, but for the advice to use
    other estimators.

    Raises
    ------
    WorkbenchError
        In place of a ValueError inside the ``with`` block.

    Examples
    --------
    >>> with said_in_one_line():
    ...     raise ValueError("Input X contains NaN.")
    Traceback (most recent call last):
    workbench.errors.WorkbenchError: Input X contains NaN, want finite numbers
    """
    try:
        yield
    except WorkbenchError:
        raise
    except ValueError as error:
        message = str(error)
        if message.startswith("Input "):
            message = message.splitlines()[0].rstrip(".") + ", want finite numbers"
        raise WorkbenchError(" ".join(message.split())) from None


def as_distances(distances: ArrayLike, n: int | None = None) -> NDArray[np.float64]:
    """Check a matrix of distances.

    Parameters
    ----------
    distances : array-like of shape (n_samples, n_samples)
        Distances between all pairs.
    n : int, optional
        The number of samples that is wanted.

    Returns
    -------
    ndarray of shape (n_samples, n_samples)

    Raises
    ------
    WorkbenchError
        If it is not square, finite, symmetric and at least 0.
    """
    array = as_numbers("distances", distances)
    wanted = array.shape[0] if array.ndim and n is None else n
    if array.shape != (wanted, wanted):
        size = "a square matrix" if n is None else f"({n}, {n})"
        raise WorkbenchError(f"distances: got shape {array.shape}, want {size}")
    finite(array, "distances")
    if array.size and array.min() < 0:
        raise WorkbenchError(f"distances: got {array.min()}, want none below 0")
    if not _is_symmetric(array):
        raise WorkbenchError("distances: got a matrix that is not symmetric")
    largest = float(array.max()) if array.size else 0.0
    if np.any(np.diagonal(array) > 1e-6 * largest):
        raise WorkbenchError(
            f"distances: got {np.diagonal(array).max()} from a sample to itself, want 0"
        )
    return array


def whole_number(name: str, value: Any, at_least: int = 1) -> int:
    """Refuse a setting that is no whole number, or too small.

    Raises
    ------
    WorkbenchError
        If it is not; the message names the setting.
    """
    if not isinstance(value, Integral) or isinstance(value, bool) or value < at_least:
        raise WorkbenchError(f"{name}: got {value!r}, want a whole number above {at_least - 1}")
    return int(value)


def _is_symmetric(array: NDArray[np.float64], block: int = 256) -> bool:
    """Tell whether a matrix is symmetric up to rounding, in blocks that fit the caches."""
    for start in range(0, len(array), block):
        rows = array[start : start + block, start:]
        columns = array[start:, start : start + block].T
        if np.any(np.abs(rows - columns) > 1e-8 + 1e-5 * np.abs(columns)):
            return False
    return True


def require_memory(n_bytes: float, what: str, instead: str) -> None:
    """Refuse a computation that the machine's free memory will not hold.

    Parameters
    ----------
    n_bytes : float
        Memory that is needed.
    what : str
        What needs it, for the message.
    instead : str
        What to do instead.

    Raises
    ------
    DataError
        If there is less than that.
    """
    try:
        free = os.sysconf("SC_AVPHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
        with open("/proc/meminfo", encoding="ascii") as lines:
            # Memory that caches hold can be had too.
            found = [line.split()[1] for line in lines if line.startswith("MemAvailable:")]
        free = int(found[0]) * 1024 if found else free
    except (OSError, ValueError, AttributeError):
        return  # a system that does not tell
    if n_bytes > free:
        raise DataError(
            f"{what} needs {n_bytes / 1e9:.1f} GB of memory, "
            f"{free / 1e9:.1f} GB are free; {instead}"
        )


def control_point_indices(
    indices: ArrayLike, n_samples: int, *, at_least: int = 1, name: str = "control points"
) -> NDArray[np.intp]:
    """Check the indices of control points, keyframes or other samples.

    Parameters
    ----------
    indices : array-like of shape (n_control_points,)
        Sorted, each once.
    n_samples : int
        Number of samples that they index.
    at_least : int
        How many are needed.
    name : str
        The argument's name, for the message.

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
            f"{name}: got {array.dtype} of shape {array.shape}, "
            f"want a list of at least {at_least} sample indices"
        )
    if array.min() < 0 or array.max() >= n_samples:
        raise WorkbenchError(
            f"{name}: got {array.min()}…{array.max()}, want indices from 0 to {n_samples - 1}"
        )
    if np.any(np.diff(array) <= 0):
        raise WorkbenchError(f"{name}: got unsorted or repeated indices, want each once")
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
        Share of the samples, between 0 and 1: max(3, floor(ratio · n_samples)), which 3
        samples cannot give and get 2.

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
        if not isinstance(ratio, Real) or not 0.0 < ratio < 1.0:
            raise WorkbenchError(f"ratio: got {ratio!r}, want a number between 0 and 1")
        # A share such as 0.3 of 10 is 2.9999… in binary; it means 3.
        count = min(max(3, math.floor(ratio * n_samples + 1e-9)), n_samples - 1)
    if not isinstance(count, Integral) or isinstance(count, bool) or not 2 <= count < n_samples:
        raise WorkbenchError(
            f"count: got {count!r} control points for {n_samples} samples, "
            f"want from 2 to {n_samples - 1}"
        )
    return int(count)
