"""Read rows of decimal numbers quickly, and find the fault where they are not."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np
from numba import prange
from numpy.typing import NDArray

from workbench.errors import MotionFormatError
from workbench.kernels import compiled, compiled_parallel
from workbench.mocap.textfile import lines_of, parse_number, quoted

_END = -1  # stands where the text has ended
_PART = 1 << 16  # bytes that a thread reads at once

_DONE, _HARD = 0, 1  # what the scanner returns; anything else is a fault
_POWERS = 10.0 ** np.arange(23)  # every one of them is exact


@compiled
def _byte(data, position):  # type: ignore[no-untyped-def]  # compiled
    """Give the byte at a position, or a mark behind the last one."""
    if position < len(data):
        # A signed index might count from the end, and asking that costs a quarter of the time.
        return np.int64(data[np.uint64(position)])
    return np.int64(_END)


@compiled
def _scan(  # type: ignore[no-untyped-def]  # compiled
    data, position, values, index, n_columns, mid_line, powers
):
    """Fill ``values`` from ``index`` on with the numbers from ``position`` on.

    Up to 18 digits are gathered in an integer. Where it is at most 2**53 and the power of
    ten is exact, one multiplication or division gives the correctly rounded number
    (Clinger 1990); other numbers are handed back as hard.

    Returns the position, the index and why it stopped there.
    """
    size = len(data)
    while True:
        byte = _byte(data, position)
        while byte == 32 or byte == 9:
            position += 1
            byte = _byte(data, position)
        if byte == 10 or byte == 13 or byte == _END:
            if index % n_columns != 0:
                return position, index, 2
            if position == size:
                return position, index, 0
            mid_line = False
            position += 1
            continue
        # A row ends with its line, and there are as many rows as there is room for.
        if (mid_line and index % n_columns == 0) or index == len(values):
            return position, index, 2
        start = position
        negative = byte == 45
        if negative or byte == 43:
            position += 1
            byte = _byte(data, position)
        mantissa, n_digits, exponent = np.int64(0), -position, 0
        while 48 <= byte <= 57:
            mantissa = mantissa * 10 + (byte - 48)
            position += 1
            byte = _byte(data, position)
        if byte == 46:
            position += 1
            n_digits -= 1  # the point is none
            exponent = position
            byte = _byte(data, position)
            while 48 <= byte <= 57:
                mantissa = mantissa * 10 + (byte - 48)
                position += 1
                byte = _byte(data, position)
            exponent -= position
        n_digits += position
        if n_digits == 0:
            return start, index, 2
        if byte == 101 or byte == 69:
            position += 1
            byte = _byte(data, position)
            downwards = byte == 45
            if downwards or byte == 43:
                position += 1
                byte = _byte(data, position)
            if not 48 <= byte <= 57:
                return start, index, 2
            written = 0
            while 48 <= byte <= 57:
                written = min(written * 10 + (byte - 48), 10000)
                position += 1
                byte = _byte(data, position)
            exponent += -written if downwards else written
        if byte != 32 and byte != 9 and byte != 10 and byte != 13 and byte != _END:
            return start, index, 2
        if n_digits > 18 or mantissa > 9007199254740992 or exponent < -22 or exponent > 22:
            return start, index, 1
        value = float(mantissa)
        value = value / powers[-exponent] if exponent < 0 else value * powers[exponent]
        values[index] = -value if negative else value
        index += 1
        mid_line = True


@compiled
def _count_lines(data):  # type: ignore[no-untyped-def]  # compiled
    """Count ends of lines; ``bytes.count`` is slow where there are many."""
    count = 0
    for i in range(len(data)):
        count += data[i] == 10
    return count


@compiled_parallel
def _scan_each(  # type: ignore[no-untyped-def]  # compiled
    data, cuts, firsts, lasts, values, n_columns, powers
):
    """Fill values[firsts[i]:lasts[i]] from data[cuts[i]:cuts[i + 1]], and tell if all fitted."""
    good = 0
    for part in prange(len(firsts)):
        piece = data[cuts[part] : cuts[part + 1]]
        room = values[firsts[part] : lasts[part]]
        _, index, state = _scan(piece, 0, room, 0, n_columns, False, powers)
        good += 1 if state == 0 and index == len(room) else 0
    return good == len(firsts)


def read_number_rows(
    path: str | Path, data: bytes, start: int, line: int, shape: tuple[int, int], announced: str
) -> NDArray[np.float64]:
    """Read the rest of a file as rows of numbers, one row a line, blank lines aside.

    Numbers are read correctly rounded, as Python reads them.

    Parameters
    ----------
    path : path-like
        The file, for messages.
    data : bytes
        Its content.
    start : int
        Offset of the first row.
    line : int
        Number of the line before the first row.
    shape : tuple of int
        Expected numbers of rows and of numbers in each.
    announced : str
        Where the file tells the number of rows, as used in messages.

    Returns
    -------
    ndarray of that shape

    Raises
    ------
    MotionFormatError
        If a row has too few or too many numbers, or there are too few or too many rows, or
        something is not a finite decimal number.
    """
    values = scan_numbers(data, start, shape)
    if values is None:
        raise _fault(path, data, start, line, shape, announced)
    return values


def scan_numbers(data: bytes, start: int, shape: tuple[int, int]) -> NDArray[np.float64] | None:
    """Read rows of numbers, or tell by None that there is a fault somewhere.

    Parameters
    ----------
    data : bytes
        Text with one row a line, blank lines aside.
    start : int
        Offset of the first row.
    shape : tuple of int
        Expected numbers of rows and of numbers in each.

    Returns
    -------
    ndarray of that shape, or None
    """
    n_rows, n_columns = shape
    # A number and the blank after it take two bytes. Asking for the memory first would let
    # one wrong digit in the number of rows exhaust the machine.
    if n_rows * n_columns > (len(data) - start + 1) // 2:
        return None
    values = np.empty(n_rows * n_columns)
    view = np.frombuffer(data, dtype=np.uint8)
    if not _scan_parts(data, view, start, values, n_columns) and not _scan_all(
        data, view, start, values, n_columns
    ):
        return None
    return values.reshape(shape)


def _scan_parts(
    data: bytes,
    view: NDArray[np.uint8],
    start: int,
    values: NDArray[np.float64],
    n_columns: int,
) -> bool:
    """Read the usual file with one row in every line, a part per thread.

    Returns
    -------
    bool
        Whether that went well; otherwise nothing is known but that it did not.
    """
    goals = np.linspace(start, len(data), 1 + max(1, (len(data) - start) // _PART))
    cuts = [start, *(data.find(b"\n", int(goal)) + 1 for goal in goals[1:-1]), len(data)]
    if sorted(cuts) != cuts:
        return False
    lines = [_count_lines(view[a:b]) for a, b in pairwise(cuts)]
    firsts = n_columns * np.cumsum([0, *lines[:-1]])
    if firsts[-1] > len(values):
        return False
    lasts = np.append(firsts[1:], len(values))
    return bool(_scan_each(view, np.array(cuts), firsts, lasts, values, n_columns, _POWERS))


def _scan_all(
    data: bytes,
    view: NDArray[np.uint8],
    start: int,
    values: NDArray[np.float64],
    n_columns: int,
) -> bool:
    """Read from beginning to end, whatever the lines and the numbers look like."""
    position, index, state = _scan(view, start, values, 0, n_columns, False, _POWERS)
    while state == _HARD:
        token = data[position : position + 4096].split(None, 1)[0]
        number = parse_number(token.decode("ascii"))
        if number is None:
            return False
        values[index] = number
        position += len(token)
        position, index, state = _scan(view, position, values, index + 1, n_columns, True, _POWERS)
    return bool(state == _DONE and index == len(values))


def _fault(
    path: str | Path, data: bytes, start: int, line: int, shape: tuple[int, int], announced: str
) -> MotionFormatError:
    """Describe the first fault of rows that cannot be read."""
    n_rows, n_columns = shape
    rows = 0
    last_line = line
    for number, (text, _) in enumerate(lines_of(data, start), start=line + 1):
        if not text:
            continue
        last_line = number
        if rows == n_rows:
            return MotionFormatError(
                path, number, f"more than {n_rows} rows", f"{n_rows} rows as {announced} says"
            )
        words = text.split()
        for column, word in enumerate(words[:n_columns], start=1):
            if parse_number(word) is None:
                return MotionFormatError(
                    path, number, f"{quoted(word)} in column {column}", "a finite decimal number"
                )
        if len(words) != n_columns:
            return MotionFormatError(path, number, f"{len(words)} numbers", f"{n_columns} in a row")
        rows += 1
    return MotionFormatError(path, last_line, f"{rows} rows", f"{n_rows} rows as {announced} says")
