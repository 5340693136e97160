"""The places of control points: which coincide, and which cover the plane."""

from __future__ import annotations

import warnings
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from workbench.errors import DegenerateDataWarning


@dataclass(frozen=True)
class Places:
    """Control points at different places.

    Attributes
    ----------
    points : ndarray of shape (n_places, n_dimensions)
        The places.
    values : ndarray of shape (n_places, n_outputs)
        Mean sample of the control points at each.
    counts : ndarray of shape (n_places,)
        How many control points it stands for.
    contradicting : bool
        Whether control points at one place had different samples.
    """

    points: NDArray[np.float64]
    values: NDArray[np.float64]
    counts: NDArray[np.float64]
    contradicting: bool

    def warn_if_contradicting(self) -> None:
        """Say that some samples were replaced by their mean.

        Warns
        -----
        DegenerateDataWarning
            If they differed from it.
        """
        if self.contradicting:
            merged = int(self.counts.sum()) - len(self.points)
            warnings.warn(
                f"{merged} control points coincide with others but have different samples; "
                "each place gets the mean of its samples",
                DegenerateDataWarning,
                stacklevel=3,
            )


def merge_coinciding(points: NDArray[np.float64], values: NDArray[np.float64]) -> Places:
    """Replace control points at the same place by one with their mean sample.

    Points closer than 1e-12 of the cloud's extent count as the same: no weights could
    tell them apart in double precision. The mean with its count says all that least
    squares needs to know of them.

    Parameters
    ----------
    points : ndarray of shape (n_control_points, n_dimensions)
        Positions.
    values : ndarray of shape (n_control_points, n_outputs)
        Samples there.

    Returns
    -------
    Places
    """
    extent = float(np.ptp(points, axis=0).max()) or 1.0
    keys = np.round((points - points.min(axis=0)) / (1e-12 * extent))
    _, first, group = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    if len(first) == len(points):
        return Places(points, values, np.ones(len(points)), contradicting=False)
    group = group.ravel()
    counts = np.bincount(group).astype(np.float64)
    # Relative to the first sample of each place, so that equal ones keep their value.
    sums = np.zeros((len(first), values.shape[1]))
    np.add.at(sums, group, values - values[first][group])
    means = values[first] + sums / counts[:, None]
    return Places(points[first], means, counts, not np.allclose(means[group], values))


def spread_out(points: NDArray[np.float64], count: int) -> NDArray[np.intp]:
    """Choose points that cover the cloud, each the farthest from those chosen before.

    The first is the one nearest to the mean.

    Parameters
    ----------
    points : ndarray of shape (n_points, n_dimensions)
        Candidates.
    count : int
        How many to choose.

    Returns
    -------
    ndarray of shape (count,)
        Sorted indices.
    """
    chosen = [int(((points - points.mean(axis=0)) ** 2).sum(axis=1).argmin())]
    gaps = ((points - points[chosen[0]]) ** 2).sum(axis=1)
    while len(chosen) < count:
        chosen.append(int(gaps.argmax()))
        np.minimum(gaps, ((points - points[chosen[-1]]) ** 2).sum(axis=1), out=gaps)
    return np.sort(chosen)
