"""Read answers from a file, told by its content rather than by its ending, and export them."""

from __future__ import annotations

import csv
import io
from pathlib import Path
from typing import TYPE_CHECKING

from workbench.errors import DataError
from workbench.files import write_atomically
from workbench.study.answers import check_answers, check_columns, check_rows
from workbench.study.database import read_study
from workbench.study.study_file import SQLITE_MAGIC

if TYPE_CHECKING:
    import pandas as pd

_DELIMITERS = (",", ";", "\t")


def read_answers(path: str | Path) -> pd.DataFrame:
    """Read the answers of a study.

    Parameters
    ----------
    path : path-like
        A study made by :func:`workbench.study.database.create_study`, or a CSV (delimited by
        commas, semicolons or tabs) or Parquet file with the columns that
        :func:`workbench.study.answers.check_answers` lists.

    Returns
    -------
    DataFrame
        As from :func:`workbench.study.answers.check_answers`.

    Raises
    ------
    DataError
        If the file cannot be read or an answer is not as it should be; the message names the
        file, the line or row, and what is wanted.
    """
    path = Path(path)
    try:
        content = path.read_bytes()
    except FileNotFoundError:
        raise DataError(f"{path}: there is no such file") from None
    except IsADirectoryError:
        raise DataError(f"{path}: is a folder, want a file of answers") from None
    except (OSError, ValueError) as error:  # ValueError: a NUL in the path
        reason = getattr(error, "strerror", None) or error
        raise DataError(f"{path}: cannot be read ({reason})") from None
    if content.startswith(SQLITE_MAGIC):
        return read_study(path)
    if content.startswith(b"PAR1"):
        return _read_parquet(path)
    return _read_csv(path, content)


def write_csv(answers: pd.DataFrame, path: str | Path) -> None:
    """Export checked answers as CSV, which :func:`read_answers` reads back identically.

    Parameters
    ----------
    answers : DataFrame
        As from :func:`read_answers`.
    path : path-like
        The file, replaced as a whole if it is there.

    Raises
    ------
    DataError
        If the answers are not as they should be, or the file cannot be written.
    """
    text = check_answers(answers).to_csv(index=False, lineterminator="\n")
    try:
        write_atomically(Path(path), text.encode("utf-8"))
    except OSError as error:
        raise DataError(f"{path}: cannot be written ({error.strerror})") from None


def _read_parquet(path: Path) -> pd.DataFrame:
    # Imported here because it takes most of a second and the command line needs none of it.
    import pandas as pd
    from pyarrow import ArrowException

    try:
        frame = pd.read_parquet(path)
    except (ArrowException, OSError, ValueError) as error:
        reason = (str(error).splitlines() or [type(error).__name__])[0]
        raise DataError(f"{path}: is not a readable Parquet file ({reason})") from None
    return check_answers(frame.reset_index(drop=True), str(path))


def _read_csv(path: Path, content: bytes) -> pd.DataFrame:
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise DataError(f"{path}: is no SQLite, Parquet or UTF-8 text file of answers") from None
    head = next((line for line in text.splitlines() if line.strip()), "")
    delimiter = max(_DELIMITERS, key=head.count)
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=delimiter, strict=True)
    rows: list[dict[str, str]] = []
    lines: list[int] = []
    names: list[str] = []
    try:
        for fields in reader:
            if not any(field.strip() for field in fields):
                continue
            if not names:
                names = [field.strip() for field in fields]
                check_columns(names, str(path))
                if len(set(names)) < len(names):
                    raise DataError(f"{path}, line {reader.line_num}: found two equal column names")
                continue
            if len(fields) != len(names):
                raise DataError(
                    f"{path}, line {reader.line_num}: "
                    f"found {len(fields)} fields, want {len(names)} as in the first line"
                )
            rows.append(dict(zip(names, fields, strict=True)))
            lines.append(reader.line_num)
    except csv.Error as error:
        raise DataError(f"{path}, line {reader.line_num}: is no CSV ({error})") from None
    if not names:
        raise DataError(f"{path}: is empty, want a file of answers")
    return check_rows(rows, lambda index: f"{path}, line {lines[index]}", str(path))
