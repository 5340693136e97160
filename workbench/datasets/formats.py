"""Readers of the formats in which the UCI data sets are published.

Each reads one format into :class:`Rows`, numbers and class codes as the file has them;
the catalogue knows what columns and codes are called.
"""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from workbench.errors import DataError

_SEPARATORS = re.compile(r"[,;\s]+")


@dataclass(frozen=True, eq=False)
class Rows:
    """The content of a data file before its columns and classes have names.

    Attributes
    ----------
    values : ndarray of shape (n_rows, n_columns)
        The numbers.
    codes : tuple of str or None
        Class code of each row, as the file writes it.
    """

    values: NDArray[np.float64]
    codes: tuple[str, ...] | None = None


def read_text(path: Path) -> str:
    """Read a text file in UTF-8, UTF-16 or Latin-1.

    Raises
    ------
    DataError
        If it cannot be opened, is empty or is not text.
    """
    try:
        content = path.read_bytes()
    except OSError as error:
        raise DataError(f"{path}: cannot be read ({error.strerror})") from None
    if not content.strip():
        raise DataError(f"{path}: the file is empty")
    if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
        try:
            return content.decode("utf-16")
        except UnicodeDecodeError:
            raise DataError(f"{path}: found bytes that are not text, want a text file") from None
    control = sum(content.count(byte) for byte in range(9))
    if control:
        raise DataError(f"{path}: found bytes that are not text, want a text file")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("latin-1")


def read_counted(path: Path) -> Rows:
    """Read scikit-learn's format: a line ``rows,columns,class…``, then rows ending in a class.

    Raises
    ------
    DataError
        If the file does not hold what its first line announces.
    """
    lines = _rows(path)
    number, header = lines[0]
    if len(header) < 2 or not (header[0].isdigit() and header[1].isdigit()):
        raise DataError(
            f"{path}, line {number}: found {','.join(header)[:40]!r}, "
            "expected the numbers of rows and columns"
        )
    rows = _labelled(path, lines[1:])
    if rows.values.shape != (int(header[0]), int(header[1])):
        raise DataError(
            f"{path}: found {rows.values.shape[0]} rows of {rows.values.shape[1]} numbers, "
            f"expected {header[0]} of {header[1]}"
        )
    return rows


def read_labelled(path: Path) -> Rows:
    """Read rows of numbers that end in a class code, below a header or not."""
    lines = _rows(path)
    if any(_number(token) is None for token in lines[0][1][:-1]) or lines[0][1][-1] == "class":
        lines = lines[1:]
    return _labelled(path, lines)


def read_named(path: Path) -> Rows:
    """Read rows that begin with the sample's name and end in a class code."""
    return _labelled(path, [(number, tokens[1:]) for number, tokens in _rows(path)])


def read_cloud(path: Path) -> Rows:
    """Read the first table of UCI's cloud.data.

    The file that UCI serves describes itself in prose and then holds two tables of 1024
    rows, of which the first is the data set; other copies hold just that one.
    """
    tables: list[list[list[float]]] = []
    previous = None
    for number, line in enumerate(read_text(path).splitlines(), 1):
        numbers = [_number(token) for token in line.split()]
        row = [value for value in numbers if value is not None]
        if len(numbers) != 10 or len(row) != 10:
            continue
        if previous != number - 1:
            tables.append([])
        previous = number
        tables[-1].append(row)
    if not tables:
        raise DataError(f"{path}: found no row of 10 numbers")
    # Numbers in the prose may form short runs of their own.
    table = next((rows for rows in tables if len(rows) >= 1024), max(tables, key=len))
    return Rows(np.array(table[:1024] if len(tables) > 1 else table))


def read_arff_rows(path: Path) -> Rows:
    """Read an ARFF file whose attributes are numbers but for the last, the class."""
    _, rows = read_arff(path)
    return _labelled(path, rows)


def read_arff(path: Path) -> tuple[list[str], list[tuple[int, list[str]]]]:
    """Read an ARFF file's attribute names and its rows of text.

    Returns
    -------
    names : list of str
        The attributes.
    rows : list of (int, list of str)
        Line number and fields of each row.

    Raises
    ------
    DataError
        If the file has no data section, is in the sparse form, or a row has not as many
        fields as there are attributes.
    """
    names: list[str] = []
    rows: list[tuple[int, list[str]]] = []
    in_data = False
    for number, line in enumerate(read_text(path).splitlines(), 1):
        line = line.strip()
        if not line or line.startswith("%"):
            continue
        if in_data:
            if line.startswith("{"):
                raise DataError(f"{path}, line {number}: found a sparse row, expected a full one")
            fields = next(csv.reader([line], quotechar="'", skipinitialspace=True))
            if len(fields) != len(names):
                raise DataError(
                    f"{path}, line {number}: found {len(fields)} fields, expected {len(names)}"
                )
            rows.append((number, [field.strip() for field in fields]))
        elif line.lower().startswith("@attribute"):
            match = re.match(r"@attribute\s+('[^']*'|\"[^\"]*\"|\S+)", line, re.IGNORECASE)
            if match is None:
                raise DataError(f"{path}, line {number}: found {line!r}, expected a name")
            names.append(match[1].strip("'\""))
        in_data = in_data or line.lower().startswith("@data")
    if not in_data or not names:
        raise DataError(f"{path}: found no @attribute and @data, expected an ARFF file")
    return names, rows


def _rows(path: Path) -> list[tuple[int, list[str]]]:
    """Split the lines that are not blank, whichever of comma, semicolon or blanks parts them."""
    lines = enumerate(read_text(path).splitlines(), 1)
    return [(number, _SEPARATORS.split(line.strip())) for number, line in lines if line.strip()]


def _labelled(path: Path, lines: Sequence[tuple[int, list[str]]]) -> Rows:
    if not lines:
        raise DataError(f"{path}: found no rows")
    width = len(lines[0][1])
    if width < 2:
        raise DataError(f"{path}, line {lines[0][0]}: found no numbers and a class")
    values = np.empty((len(lines), width - 1))
    for row, (number, tokens) in enumerate(lines):
        if len(tokens) != width:
            raise DataError(f"{path}, line {number}: found {len(tokens)} fields, expected {width}")
        for column, token in enumerate(tokens[:-1]):
            value = _number(token)
            if value is None:
                raise DataError(f"{path}, line {number}: found {token!r}, expected a number")
            values[row, column] = value
    return Rows(values, tuple(tokens[-1] for _, tokens in lines))


def _number(token: str) -> float | None:
    try:
        value = float(token)
    except ValueError:
        return None
    return value if math.isfinite(value) else None
