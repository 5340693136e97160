"""Intervals for statistics over clips, or tables, and seeds."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.validation import finite

#: How often the data are drawn anew: enough that the ends of an interval stand still to a few
#: per cent of its width.
N_RESAMPLES = 2000


@dataclass(frozen=True)
class Estimate:
    """A statistic and the interval that it may lie in.

    Attributes
    ----------
    value : float
        The statistic of the data as they are.
    low, high : float
        Ends of the interval.
    n_units : int
        How many clips, tables or pairs it rests on.
    n_seeds : int
        How many seeds each of them was run with.
    """

    value: float
    low: float
    high: float
    n_units: int
    n_seeds: int = 1

    @classmethod
    def exact(cls, value: float) -> Estimate:
        """Give a value that follows from a formula and not from data."""
        return cls(value, value, value, 0, 0)


def bootstrap(
    values: ArrayLike,
    statistic: Callable[[NDArray[np.float64]], float],
    *,
    seeds: bool = False,
    level: float = 0.95,
    random_state: int = 0,
) -> Estimate:
    """Estimate a statistic over units such as clips, with a percentile bootstrap interval.

    Units are drawn with replacement and, where each was run with several seeds, for each
    drawn unit its seeds too: the interval then says how far the statistic might be with
    other clips and other seeds. Columns are kept together, so that schemes are compared on
    the same clips.

    Parameters
    ----------
    values : array-like of shape (n_units, ...) or, with seeds, (n_units, n_seeds, ...)
        Finite numbers; further axes, such as the schemes that are compared, are not resampled.
    statistic : callable
        Takes values of shape (n_units, ...), or (n_units * n_seeds, ...) with seeds, and
        gives a number; such as the ratio of two columns' medians.
    seeds : bool
        Whether the second axis holds seeds.
    level : float
        Share of the resampled statistics inside the interval.
    random_state : int
        Seed of the resampling.

    Returns
    -------
    Estimate

    Raises
    ------
    WorkbenchError
        If there is no unit, or a number is not finite.

    Examples
    --------
    >>> bootstrap([[1.0, 2.0], [2.0, 4.0]], lambda v: v[:, 0].sum() / v[:, 1].sum())
    Estimate(value=0.5, low=0.5, high=0.5, n_units=2, n_seeds=1)
    """
    data = np.asarray(values, dtype=np.float64)
    if data.ndim < 1 + seeds or data.shape[0] == 0 or (seeds and data.shape[1] == 0):
        raise WorkbenchError(f"values: got shape {data.shape}, want at least one unit")
    finite(data, "values")
    if not seeds:
        data = data[:, np.newaxis]
    n_units, n_seeds = data.shape[:2]
    flat = data.reshape(n_units * n_seeds, *data.shape[2:])
    generator = np.random.default_rng(random_state)
    # All at once: a call of the generator takes longer than the numbers that it draws.
    units = generator.integers(n_units, size=(N_RESAMPLES, n_units, 1))
    chosen = units * n_seeds + generator.integers(n_seeds, size=(N_RESAMPLES, n_units, n_seeds))
    drawn = [statistic(flat[rows]) for rows in chosen.reshape(N_RESAMPLES, -1)]
    low, high = np.quantile(drawn, [(1 - level) / 2, (1 + level) / 2])
    return Estimate(float(statistic(flat)), float(low), float(high), n_units, n_seeds)
