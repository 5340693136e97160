"""What the back-projectors check alike."""

from __future__ import annotations

import warnings
from numbers import Integral
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from sklearn.utils.validation import check_is_fitted, validate_data

from workbench.errors import AdjustmentWarning, WorkbenchError
from workbench.validation import require_memory, said_in_one_line

#: Results below this many bytes are not worth asking the system for its free memory.
_SMALL = 2**26


def control_points(
    estimator: Any, X: ArrayLike, y: ArrayLike
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Check control points and their samples, as scikit-learn does.

    Parameters
    ----------
    estimator : scikit-learn estimator
        The one that learns them.
    X : array-like of shape (n_control_points, n_dimensions)
        Positions in the embedding.
    y : array-like of shape (n_control_points, n_outputs) or (n_control_points,)
        Samples there.

    Returns
    -------
    points : ndarray of shape (n_control_points, n_dimensions)
    values : ndarray of shape (n_control_points, n_outputs) or (n_control_points,)

    Raises
    ------
    WorkbenchError
        If they do not belong together or are not finite.
    """
    with said_in_one_line():
        points, values = validate_data(
            estimator, X, y, multi_output=True, y_numeric=True, dtype=np.float64
        )
    return _plain(points), _plain(np.asarray(values, dtype=np.float64))


def positions(estimator: Any, X: ArrayLike) -> NDArray[np.float64]:
    """Check positions to rebuild samples at.

    Optimizers ask for few points many times, so what is obviously good passes without
    scikit-learn's checks, which would take longer than the work itself.

    Parameters
    ----------
    estimator : scikit-learn estimator
        The fitted one.
    X : array-like of shape (n_points, n_dimensions)
        Positions.

    Returns
    -------
    ndarray of shape (n_points, n_dimensions)
        In rows, one after the other.

    Raises
    ------
    NotFittedError
        If nothing was learnt yet.
    WorkbenchError
        If the dimensions are others, or a value is not finite.
    """
    if (
        type(X) is np.ndarray
        and X.dtype == np.float64
        and X.ndim == 2
        and len(X) > 0
        and X.shape[1] == getattr(estimator, "n_features_in_", -1)
        and not hasattr(estimator, "feature_names_in_")
        and np.isfinite(X).all()
    ):
        points = X
    else:
        check_is_fitted(estimator)
        with said_in_one_line():
            points = validate_data(estimator, X, reset=False, dtype=np.float64)
    return _plain(points)


def _plain(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Put values in rows that may be written: numba compiles another version for others."""
    rows = np.ascontiguousarray(values)
    return rows if rows.flags.writeable else rows.copy()


def at_most(estimator: Any, name: str, limit: int) -> int:
    """Return a count, lowered to the number of control points, and say so if it was.

    Parameters
    ----------
    estimator : object
        The method whose parameter it is.
    name : str
        The parameter's name.
    limit : int
        Number of control points.

    Returns
    -------
    int

    Raises
    ------
    WorkbenchError
        If it is not an integer of at least 1.
    """
    count = getattr(estimator, name)
    if not isinstance(count, Integral) or isinstance(count, bool) or count < 1:
        raise WorkbenchError(f"{name}: got {count!r}, want an integer of at least 1")
    if count <= limit:
        return int(count)
    warnings.warn(
        f"{type(estimator).__name__}: {name}={count} lowered to {limit} ({limit} control points)",
        AdjustmentWarning,
        stacklevel=3,
    )
    return limit


def empty_result(*shape: int) -> NDArray[np.float64]:
    """Allocate what is to be returned, after a look whether memory suffices.

    Parameters
    ----------
    *shape : int
        Its shape, rows first.

    Returns
    -------
    ndarray of that shape

    Raises
    ------
    DataError
        If memory will not suffice.
    """
    n_bytes = 8.0 * np.prod(shape, dtype=np.float64)
    if n_bytes > _SMALL:
        require_memory(
            1.1 * n_bytes, f"the back-projection of {shape[0]} points", "do it in several parts"
        )
    return np.empty(shape)
