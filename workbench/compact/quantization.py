"""Rounding numbers to whole multiples of a step, so that few bits hold them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from workbench.errors import WorkbenchError

#: The finest that is offered: counts of so many bits, the sign included, leave room to
#: subtract neighbours, and numbers near the largest one lose nothing.
FINEST_BITS = 62


@dataclass(frozen=True, eq=False)
class Quantized:
    """Numbers that are whole multiples of a step, counted from an origin.

    Attributes
    ----------
    counts : ndarray of int64 of shape (n_rows, n_columns)
        How many steps each number is from its column's origin.
    step : float
        A power of two, so that multiplying by it rounds nothing.
    origin : ndarray of shape (n_columns,)
        Where each column is counted from.
    """

    counts: NDArray[np.int64]
    step: float
    origin: NDArray[np.float64]

    @property
    def values(self) -> NDArray[np.float64]:
        """The rounded numbers: (n_rows, n_columns)."""
        return self.origin + self.step * self.counts

    @property
    def bound(self) -> float:
        """The most that rounding changed a number by: half a step."""
        return self.step / 2


def quantize(
    values: NDArray[np.float64], step: float, origin: NDArray[np.float64] | None = None
) -> Quantized:
    """Round numbers to the nearest multiples of a step.

    Parameters
    ----------
    values : ndarray of shape (n_rows, n_columns)
        The numbers.
    step : float
        A power of two, such as :func:`step_for_bits` gives.
    origin : ndarray of shape (n_columns,), optional
        Where each column is counted from; 0 by default. A column that never leaves its
        origin is kept exactly.

    Returns
    -------
    Quantized

    Raises
    ------
    WorkbenchError
        If a number is too large to be counted in such steps.

    Examples
    --------
    >>> rounded = quantize(np.array([[0.3], [-1.1]]), 0.25)
    >>> rounded.counts.ravel(), rounded.values.ravel(), rounded.bound
    (array([ 1, -4]), array([ 0.25, -1.  ]), 0.125)
    """
    start = np.zeros(values.shape[1]) if origin is None else origin
    counts = np.rint((values - start) / step)
    if np.abs(counts).max(initial=0.0) > 2.0**FINEST_BITS:
        raise WorkbenchError(f"step: got {step}, too small to count numbers of this size in")
    return Quantized(counts.astype(np.int64), step, start)


def step_for_bits(values: NDArray[np.float64], bits: int) -> float:
    """Choose the step at which counts of so many bits reach the largest of some numbers.

    Parameters
    ----------
    values : ndarray
        The numbers, of either sign.
    bits : int
        Bits of a count, the sign included.

    Returns
    -------
    float
        2^(e − bits + 1), with the smallest e so that no number exceeds 2^e.

    Examples
    --------
    >>> step_for_bits(np.array([-1.0, 0.3]), 4)
    0.125
    """
    mantissa, exponent = math.frexp(float(np.abs(values).max(initial=0.0)))
    if mantissa == 0.5:  # a power of two itself
        exponent -= 1
    # Where there is nothing but 0, or nearly so, any step does.
    return math.ldexp(1.0, max(exponent, -500) - bits + 1)


def power_of_two_below(limit: float) -> float:
    """Round a step down to a power of two.

    Examples
    --------
    >>> power_of_two_below(0.01)
    0.0078125
    """
    return math.ldexp(1.0, math.frexp(limit)[1] - 1)
