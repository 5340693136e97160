"""The principal components of a motion's curves."""

from __future__ import annotations

import warnings
from numbers import Integral, Real

import numpy as np
from numpy.typing import NDArray

from workbench.errors import AdjustmentWarning, WorkbenchError

MIN_COMPONENTS = 7

# A column whose spread is below this share of the largest value, or a principal component whose
# variance is below this share of the largest, holds nothing but rounding errors, which
# standardising would make as large as a movement.
_CONSTANT = 1e-9

# Between these, squares and their sums neither overflow nor vanish.
_SMALLEST, _LARGEST = 1e-130, 1e130


def principal_curves(
    values: NDArray[np.float64],
    n_components: int | None = None,
    *,
    variance: float = 0.9,
    standardize: bool = True,
    n_feet: int = 0,
) -> tuple[NDArray[np.float64], NDArray[np.float64], float]:
    """Reduce the curves of a motion to the most important ones.

    The eigenvectors of the covariance matrix of the standardised columns (Halit 2010,
    Eq. 3.1 to 3.3). Columns that do not vary are dropped.

    Parameters
    ----------
    values : ndarray of shape (n_frames, n_values)
        Finite numbers, at least one frame.
    n_components : int, optional
        k, the number of curves, those of the feet included; by default as many as keep the
        share ``variance``, but at least 7.
    variance : float
        That share, above 0 and at most 1.
    standardize : bool
        Whether to bring the columns to unit variance, not only to zero mean.
    n_feet : int
        How many of the k curves are left out, because feet take their place.

    Returns
    -------
    curves : ndarray of shape (n_frames, n_components − n_feet)
        The most important first; none where nothing varies.
    eigenvalues : ndarray of shape (n_components − n_feet,)
        Their variances.
    explained : float
        Share of the variance that they keep.

    Raises
    ------
    WorkbenchError
        If the number or the share is out of range, or the values are too large or too small to
        be squared.

    Warns
    -----
    AdjustmentWarning
        If there are fewer components than asked for.

    Examples
    --------
    >>> frames = np.arange(5.0)
    >>> curves, eigenvalues, explained = principal_curves(np.stack([frames, -frames], axis=1))
    >>> curves.shape, float(eigenvalues[0].round(9)), round(explained, 9)
    ((5, 1), 2.0, 1.0)
    """
    if not isinstance(variance, Real) or not 0 < variance <= 1:
        raise WorkbenchError(f"variance: got {variance!r}, want a number above 0 and at most 1")
    if n_components is not None and (
        not isinstance(n_components, Integral)
        or isinstance(n_components, bool)
        or n_components <= n_feet
    ):
        beyond = f" beside the {n_feet} of the feet" if n_feet else ""
        raise WorkbenchError(f"n_components: got {n_components!r}, want at least 1{beyond}")
    varies = columns_vary(values)
    if not varies.any():
        return np.empty((len(values), 0)), np.empty(0), 0.0
    largest = float(np.abs(values).max())
    if not _SMALLEST < largest < _LARGEST:
        raise WorkbenchError(
            f"values: got numbers up to {largest:g}, want the largest between {_SMALLEST:g} and "
            f"{_LARGEST:g}, so that their squares are finite and not 0"
        )
    centred = values - values.mean(axis=0)
    if not varies.all():
        centred = centred[:, varies]
    covariance = centred.T @ centred / len(centred)
    # Columns are standardised by what they are multiplied with: the array is large.
    scales = 1.0 / np.sqrt(covariance.diagonal()) if standardize else np.ones(len(covariance))
    eigenvalues, vectors = np.linalg.eigh(covariance * scales * scales[:, None])
    eigenvalues, vectors = eigenvalues[::-1], vectors[:, ::-1]
    rank = int(np.count_nonzero(eigenvalues > _CONSTANT * eigenvalues[0]))
    shares = np.cumsum(eigenvalues[:rank]) / eigenvalues[:rank].sum()
    if n_components is None:
        wanted = max(MIN_COMPONENTS, int(np.searchsorted(shares, variance - 1e-12)) + 1)
        n_components = min(wanted, rank + n_feet)
    elif n_components > rank + n_feet:
        warnings.warn(
            f"n_components: got {n_components}, took {rank + n_feet}, as many as the motion has",
            AdjustmentWarning,
            stacklevel=3,
        )
    kept = min(max(1, n_components - n_feet), rank)
    curves = centred @ (scales[:, None] * vectors[:, :kept])
    return curves, eigenvalues[:kept], float(shares[kept - 1])


def columns_vary(values: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Tell which columns vary by more than rounding errors of the largest value of all.

    Parameters
    ----------
    values : ndarray of shape (n_frames, n_values)
        Finite numbers, at least one frame.

    Returns
    -------
    ndarray of bool, of shape (n_values,)

    Examples
    --------
    >>> columns_vary(np.array([[1.0, 90.0], [2.0, 90.0 + 1e-13]]))
    array([ True, False])
    """
    lowest, highest = values.min(axis=0), values.max(axis=0)
    largest = max(-lowest.min(initial=0.0), highest.max(initial=0.0))
    # Halves, because the difference of the largest numbers is none.
    return highest / 2.0 - lowest / 2.0 > _CONSTANT / 2.0 * largest
