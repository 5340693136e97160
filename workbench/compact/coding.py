"""Whole numbers as bytes that compress well, and back."""

from __future__ import annotations

import zlib
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

#: How often a number may be replaced by its difference to the row before.
MOST_DIFFERENCES = 2


@dataclass(frozen=True)
class Coded:
    """Rows of whole numbers as bytes.

    The columns' differences from row to row are taken ``differences`` times (a curve that
    moves evenly becomes nearly constant, then nearly 0); each is doubled, or mapped to
    −2·d − 1 if negative, so that small ones of either sign have zeros in front; of each
    number ``width`` bytes are kept, the least significant bytes of all numbers first, column
    after column.

    Attributes
    ----------
    content : bytes
        ``width`` · rows · columns of them.
    differences : int
        From 0 to 2.
    width : int
        Bytes for each number, from 1 to 8.
    """

    content: bytes
    differences: int
    width: int


def encode(counts: NDArray[np.int64]) -> Coded:
    r"""Turn rows of whole numbers into bytes, with the differences that compress best.

    Parameters
    ----------
    counts : ndarray of int64 of shape (n_rows, n_columns)
        The numbers.

    Returns
    -------
    Coded

    Examples
    --------
    >>> encode(np.arange(0, 80, 10)[:, None])
    Coded(content=b'\x00\x14\x14\x14\x14\x14\x14\x14', differences=1, width=1)
    """
    every = [_encode(counts, differences) for differences in range(MOST_DIFFERENCES + 1)]
    return min(every, key=lambda coded: len(zlib.compress(coded.content, 9)))


def _encode(counts: NDArray[np.int64], differences: int) -> Coded:
    changes = counts
    for _ in range(differences):
        # Differences too large for int64 wrap around; sums of them wrap back.
        changes = np.diff(changes, axis=0, prepend=0)
    codes = ((changes << 1) ^ (changes >> 63)).astype("<u8")
    width = max(1, (int(codes.max(initial=0)).bit_length() + 7) // 8)
    planes = np.ascontiguousarray(codes.T)[..., None].view(np.uint8)[..., :width]
    return Coded(np.moveaxis(planes, -1, 0).tobytes(), differences, width)


def decode(coded: Coded, shape: tuple[int, int]) -> NDArray[np.int64]:
    """Turn bytes back into rows of whole numbers; undoes :func:`encode`.

    Parameters
    ----------
    coded : Coded
        As :func:`encode` gave it.
    shape : tuple of int
        Numbers of rows and columns.

    Returns
    -------
    ndarray of int64 of shape (n_rows, n_columns)

    Raises
    ------
    ValueError
        If the number of bytes is another, or no encoder gives such a width or differences.
    """
    if not (1 <= coded.width <= 8 and 0 <= coded.differences <= MOST_DIFFERENCES):
        raise ValueError("numbers are coded in an unknown way")
    n_rows, n_columns = shape
    planes = np.frombuffer(coded.content, dtype=np.uint8).reshape(coded.width, n_columns, n_rows)
    codes = np.zeros((n_rows, n_columns), dtype=np.uint64)
    for place, plane in enumerate(planes):
        codes |= plane.T.astype(np.uint64) << np.uint64(8 * place)
    counts = (codes >> np.uint64(1)).astype(np.int64) ^ -(codes & np.uint64(1)).astype(np.int64)
    for _ in range(coded.differences):
        counts = np.cumsum(counts, axis=0)
    return counts
