"""Turn a user's data frame into a table, saying what that took.

Nothing is left out, dropped or replaced without a sentence in the table's notes; what
cannot be treated sensibly is an error that says where it stands.
"""

from __future__ import annotations

import difflib
import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from workbench.datasets.tables import LARGEST, Table, counted
from workbench.errors import DataError
from workbench.validation import MIN_SAMPLES

if TYPE_CHECKING:
    import pandas as pd

#: Texts, in lower case, that stand for a missing value in whatever file.
MISSING = frozenset(["", "na", "n/a", "nan", "null", "none", "?", "-", "#n/a", "nat", "<na>"])
_TRUTH = {"true": 1.0, "false": 0.0}
_UNLABELLED = "(missing)"
_MIN_COLUMNS = 2
_SHOWN = 8


def table_from_frame(
    frame: pd.DataFrame,
    name: str,
    label: str | None = None,
    notes: tuple[str, ...] = (),
) -> Table:
    """Make a table of the numbers in a data frame.

    Columns that are not numbers are left out, as are columns without any value; rows with a
    missing value are dropped; truth values become 0 and 1. Constant columns and duplicate
    rows are kept. Each of these is said in the table's notes.

    Parameters
    ----------
    frame : DataFrame
        The user's data.
    name : str
        What to call it.
    label : str, optional
        The column that holds each row's class; it is no feature then.
    notes : tuple of str
        What was already done to the data.

    Returns
    -------
    Table

    Raises
    ------
    DataError
        If the label column does not exist, a value is infinite, or fewer than 3 rows or 2
        columns of numbers remain.

    Examples
    --------
    >>> import pandas as pd
    >>> frame = pd.DataFrame({"x": [1, 2, 4], "y": [3.0, 5.0, 9.0], "who": ["a", "b", "b"]})
    >>> table_from_frame(frame, "mine", label="who").class_counts
    {'a': 1, 'b': 2}
    """
    frame = frame.rename(columns=str)
    said = list(notes)
    if len(frame) == 0:
        raise DataError(f"{name}: found no rows")
    labels = None if label is None else _labels(_label_column(frame, name, label), said)
    features = frame if label is None else frame.drop(columns=label)
    features = _without_row_index(features, said)

    names: list[str] = []
    numbers: list[NDArray[np.float64]] = []
    left_out: list[str] = []
    for position in range(features.shape[1]):
        column = features.iloc[:, position]
        values, reason = _as_numbers(column, said)
        if values is None:
            left_out.append(f"{column.name!r} ({reason})")
        else:
            names.append(str(column.name))
            numbers.append(values)
    if left_out:
        said.append(f"left out {_listed(left_out, 'column')}")
    if len(numbers) < _MIN_COLUMNS:
        raise DataError(
            f"{name}: found {counted(len(numbers), 'column')} of numbers, want at least "
            f"{_MIN_COLUMNS}" + (f"; {said[-1]}" if left_out else "")
        )

    values = np.column_stack(numbers)
    columns = tuple(names)
    _refuse_infinities(values, columns, name)
    complete = ~np.isnan(values).any(axis=1)
    if not complete.all():
        if not complete.any():
            worst = columns[int(np.isnan(values).sum(axis=0).argmax())]
            raise DataError(
                f"{name}: every row has a missing value, most of them in column {worst!r}; "
                "leave that column out"
            )
        dropped = int((~complete).sum())
        said.append(f"dropped {dropped} of {len(values)} rows, which have missing values")
        if complete.sum() < MIN_SAMPLES:
            raise DataError(
                f"{name}: {said[-1]}; want at least {MIN_SAMPLES} rows without missing values"
            )
        values = values[complete]
        labels = None if labels is None else labels[complete]
    _remark_on_content(values, columns, said)
    return Table(name, values, columns, labels, label or "", tuple(said))


def _label_column(frame: pd.DataFrame, name: str, label: str) -> pd.Series:
    if label in frame.columns:
        column = frame[label]
        if column.ndim == 1:
            return column
        raise DataError(f"{name}: {column.shape[1]} columns are called {label!r}, want one")
    columns = [str(column) for column in frame.columns]
    close = difflib.get_close_matches(label, columns, n=1)
    hint = f"; did you mean {close[0]!r}?" if close else ""
    raise DataError(f"{name}: no column {label!r} among {_listed(columns, 'column')}{hint}")


def _labels(column: pd.Series, said: list[str]) -> NDArray[np.str_]:
    import pandas as pd

    numbers = pd.to_numeric(column, errors="coerce") if column.dtype != bool else None
    if numbers is not None and pd.api.types.is_float_dtype(numbers.dtype):
        whole = numbers.notna() & (numbers == np.floor(numbers)) & np.isfinite(numbers)
        if whole.any() and (whole | column.isna()).all():
            # A missing class makes pandas write 1 as 1.0.
            column = numbers.astype("Int64")
    text = column.astype("string").str.strip()
    missing = text.isna() | text.str.lower().isin(MISSING)
    if missing.any():
        said.append(f"{counted(int(missing.sum()), 'row')} without a label got {_UNLABELLED!r}")
    return np.asarray(text.mask(missing, _UNLABELLED).tolist(), dtype=np.str_)


def _without_row_index(frame: pd.DataFrame, said: list[str]) -> pd.DataFrame:
    """Leave out the row numbers that pandas writes as a first column without a name."""
    if frame.shape[1] == 0 or str(frame.columns[0]) != "Unnamed: 0":
        return frame
    numbered = np.arange(len(frame))
    try:
        first = frame.iloc[:, 0].astype(float).to_numpy()
    except (TypeError, ValueError):
        return frame
    if np.array_equal(first, numbered) or np.array_equal(first, numbered + 1):
        said.append("left out the first column, which has no name and counts the rows")
        return frame.iloc[:, 1:]
    return frame


def _as_numbers(column: pd.Series, said: list[str]) -> tuple[NDArray[np.float64] | None, str]:
    """Read a column as numbers, or tell why it is none."""
    import pandas as pd

    kinds = pd.api.types
    if kinds.is_complex_dtype(column.dtype) or kinds.is_datetime64_any_dtype(column.dtype):
        return None, f"holds {column.dtype} values"
    if kinds.is_timedelta64_dtype(column.dtype):
        return None, "holds time spans"
    if kinds.is_numeric_dtype(column.dtype) and not kinds.is_bool_dtype(column.dtype):
        values = np.asarray(column.to_numpy(dtype=np.float64, na_value=np.nan), dtype=np.float64)
        return (None, "holds no values") if np.isnan(values).all() else (values, "")
    items = [None if _is_missing(item) else item for item in column.tolist()]
    if all(item is None for item in items):
        return None, "holds no values"
    if all(item is None or str(item).lower() in _TRUTH for item in items):
        said.append(f"truth values of column {column.name!r} became 0 and 1")
        return np.array([_TRUTH.get(str(item).lower(), np.nan) for item in items]), ""
    return _parse(items)


def _is_missing(item: object) -> bool:
    if isinstance(item, str):
        return item.strip().lower() in MISSING
    import pandas as pd

    return item is None or item is pd.NA or item is pd.NaT or _is_nan(item)


def _is_nan(item: object) -> bool:
    return isinstance(item, float) and math.isnan(item)


def _parse(items: list[object]) -> tuple[NDArray[np.float64] | None, str]:
    """Parse text or mixed objects as numbers, or tell which one is none."""
    import pandas as pd

    array = np.fromiter(items, dtype=object, count=len(items))
    try:
        numbers = np.asarray(pd.to_numeric(array, errors="coerce"), dtype=np.float64)
    except (TypeError, ValueError):
        return None, "does not hold single values"
    unreadable = np.isnan(numbers) & np.array([item is not None for item in items])
    if unreadable.any():
        row = int(np.flatnonzero(unreadable)[0])
        return None, f"row {row + 1} holds {str(items[row]).strip()[:30]!r}"
    return numbers, ""


def _refuse_infinities(values: NDArray[np.float64], columns: tuple[str, ...], name: str) -> None:
    beyond = np.abs(values) > LARGEST
    if beyond.any():
        row, column = (int(i) for i in np.argwhere(beyond)[0])
        raise DataError(
            f"{name}: found {values[row, column]} in row {row + 1} of column {columns[column]!r} "
            f"({counted(int(beyond.sum()), 'such value')}), want numbers up to {LARGEST:g}; leave "
            "such cells empty to have their rows dropped"
        )


def _remark_on_content(
    values: NDArray[np.float64], columns: tuple[str, ...], said: list[str]
) -> None:
    constant = [repr(columns[i]) for i in np.flatnonzero(np.ptp(values, axis=0) == 0)]
    if constant:
        said.append(
            f"kept constant {_listed(constant, 'column')}; standardised, a constant column is 0"
        )
    duplicates = len(values) - len(np.unique(values, axis=0))
    if duplicates:
        said.append(f"kept {counted(duplicates, 'row')} that repeat another")


def _listed(items: list[str], noun: str) -> str:
    """List a few items and count the rest."""
    rest = len(items) - _SHOWN
    shown = ", ".join(items[:_SHOWN])
    more = f" and {rest} more" if rest > 0 else ""
    return f"{noun}{'s' if len(items) > 1 else ''} {shown}{more}"
