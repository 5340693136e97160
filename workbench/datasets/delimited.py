"""Read a user's delimited text file, whichever way it is delimited."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from workbench.datasets.formats import read_text
from workbench.datasets.tables import counted
from workbench.datasets.treatment import MISSING
from workbench.errors import DataError

if TYPE_CHECKING:
    import pandas as pd

_BLANKS = r"\s+"
_CANDIDATES = (",", ";", "\t", "|", _BLANKS)
_NUMBER = re.compile(r"[+-]?(\d+([.,]\d*)?|[.,]\d+)([eE][+-]?\d+)?|[+-]?inf(inity)?", re.IGNORECASE)
_SAMPLE_LINES = 200


@dataclass(frozen=True)
class Layout:
    """How a text file lays out its table.

    Attributes
    ----------
    delimiter : str
        A character, or the pattern of blanks.
    decimal : str
        ``"."`` or ``","``.
    header : bool
        Whether the first line names the columns.
    """

    delimiter: str
    decimal: str
    header: bool


def read_delimited(path: Path) -> tuple[pd.DataFrame, tuple[str, ...]]:
    """Read a delimited text file into a data frame of text.

    Parameters
    ----------
    path : Path
        A file delimited by commas, semicolons, tabs, bars or blanks, with or without a line
        of column names.

    Returns
    -------
    frame : DataFrame
        One row per line; numbers have decimal points; columns without a name in the file are
        called "column 1", "column 2", …
    notes : tuple of str
        What had to be assumed about the file.

    Raises
    ------
    DataError
        If the file is empty, is not text, or has a line with another number of fields.
    """
    # Imported here because it takes most of a second and listing data sets needs none of it.
    import pandas as pd

    # Blank lines stay, empty, so that pandas reports the file's own line numbers.
    lines = [line if line.strip() else "" for line in read_text(path).splitlines()]
    notes: list[str] = []
    lines = _without_comments(lines, notes)
    layout = detect_layout([line for line in lines if line][:_SAMPLE_LINES])
    try:
        frame = pd.read_csv(
            io.StringIO("\n".join(lines)),
            sep=layout.delimiter,
            header=0 if layout.header else None,
            dtype=str,
            skipinitialspace=True,
            keep_default_na=False,
        )
    except (pd.errors.ParserError, pd.errors.EmptyDataError, ValueError) as error:
        raise DataError(f"{path}: {_first_line(error)}") from None
    if not isinstance(frame.index, pd.RangeIndex):
        # pandas takes the fields that no column name stands above for row names.
        if frame.index.nlevels > 1:
            raise DataError(
                f"{path}: found rows with {frame.index.nlevels} fields more than column names"
            )
        frame = frame.reset_index(names="row name")
        notes.append("the first field of each row has no column name and was read as a row name")
    if not layout.header:
        frame.columns = pd.Index([f"column {i + 1}" for i in range(frame.shape[1])])
        notes.append("the file has no line of column names")
    if layout.decimal == ",":
        decimal_comma = frame.apply(lambda column: column.str.fullmatch(_NUMBER.pattern))
        frame = frame.where(~decimal_comma.fillna(False), frame.replace(",", ".", regex=True))
        notes.append("decimal commas were read as decimal points")
    return frame, tuple(notes)


def detect_layout(lines: Sequence[str]) -> Layout:
    """Find out how lines of text lay out a table.

    The delimiter is the one that makes most fields numbers, in rows of equal length.

    Parameters
    ----------
    lines : sequence of str
        The first lines of a file, without blank ones.

    Returns
    -------
    Layout

    Examples
    --------
    >>> detect_layout(["a;b", "1,5;2,5", "3,5;4,5"])
    Layout(delimiter=';', decimal=',', header=True)
    """
    delimiter, rows = max(
        ((candidate, _split(lines, candidate)) for candidate in _CANDIDATES),
        key=lambda split: _score(split[1]),
    )
    body = rows[1:] or rows
    fields = [field for row in body for field in row]
    numbers = [field for field in fields if _NUMBER.fullmatch(field)]
    decimal = "," if any("," in field for field in numbers) else "."
    if any("." in field for field in numbers):
        decimal = "."
    return Layout(delimiter, decimal, header=_has_header(rows))


def _without_comments(lines: list[str], notes: list[str]) -> list[str]:
    """Empty the comment lines at the top, but for one that names the columns."""
    start = next((i for i, line in enumerate(lines) if line and line[0] not in "#%"), None)
    comments = [i for i, line in enumerate(lines[:start]) if line]
    if start is None or not comments:
        return lines
    lines = list(lines)
    names, first = lines[comments[-1]].lstrip("#% "), lines[start]
    layout = detect_layout([line for line in lines[start:] if line][:_SAMPLE_LINES])
    fields, below = _split([names, first], layout.delimiter) if names else ([], [""])
    named = not any(_NUMBER.fullmatch(field) for field in fields)
    if named and not layout.header and len(fields) == len(below):
        lines[comments.pop()] = names
    for i in comments:
        lines[i] = ""
    if comments:
        notes.append(f"left out {counted(len(comments), 'comment line')} at the top")
    return lines


def _split(lines: Sequence[str], delimiter: str) -> list[list[str]]:
    if delimiter == _BLANKS:
        rows = [line.split() for line in lines]
    else:
        rows = list(csv.reader(lines, delimiter=delimiter, skipinitialspace=True))
    return [[field.strip() for field in row] for row in rows if row]


def _score(rows: list[list[str]]) -> tuple[bool, float, bool]:
    body = rows[1:] or rows
    widths = [len(row) for row in body]
    typical = max(set(widths), key=widths.count)
    regular = typical > 1 and widths.count(typical) >= 0.8 * len(widths)
    fields = [field for row in body for field in row]
    numeric = sum(bool(_NUMBER.fullmatch(field)) for field in fields) / max(len(fields), 1)
    return regular, numeric if regular else 0.0, typical > 1


def _has_header(rows: list[list[str]]) -> bool:
    """Tell names from data: a name stands above numbers, or the line holds names only."""
    first = rows[0]
    names = [field.lower() not in MISSING and not _NUMBER.fullmatch(field) for field in first]
    if len(rows) > 1:
        width = max(len(row) for row in rows[1:])
        # A line of column names may leave out that of the row names.
        offset = 1 if len(first) == width - 1 else 0
        below = [row[offset:] for row in rows[1:]]
        for column, named in enumerate(names):
            if named and any(column < len(row) and _NUMBER.fullmatch(row[column]) for row in below):
                return True
    return all(names)


def _first_line(error: Exception) -> str:
    message = str(error).strip().splitlines()
    text = message[0] if message else type(error).__name__
    return re.sub(r"^Error tokenizing data\. C error: ", "", text)
