"""Read a user's own table, told by its content rather than by the file's ending."""

from __future__ import annotations

from pathlib import Path

from workbench.datasets.delimited import read_delimited
from workbench.datasets.formats import read_arff
from workbench.datasets.tables import Table
from workbench.datasets.treatment import table_from_frame
from workbench.errors import DataError


def read_table(path: str | Path, label: str | None = None) -> Table:
    """Read a user's table: delimited text, ARFF or Parquet.

    Parameters
    ----------
    path : path-like
        The file. Text may be delimited by commas, semicolons, tabs, bars or blanks and may
        have a line of column names or not.
    label : str, optional
        The column that holds each row's class.

    Returns
    -------
    Table
        Its notes say how the file was treated.

    Raises
    ------
    DataError
        If the file cannot be read as a table, or its content cannot become one.
    """
    path = Path(path)
    if path.is_dir():
        raise DataError(f"{path}: is a folder, want a file")
    try:
        with path.open("rb") as file:
            start = file.read(64)
    except OSError as error:
        raise DataError(f"{path}: cannot be read ({error.strerror})") from None
    if start.startswith(b"PAR1"):
        return _read_parquet(path, label)
    if start.startswith((b"PK\x03\x04", b"\xd0\xcf\x11\xe0")):
        raise DataError(f"{path}: is a spreadsheet or an archive; save the table as CSV")
    if start.startswith((b"\x1f\x8b", b"\x1f\x9d", b"BZh", b"\xfd7zXZ")):
        raise DataError(f"{path}: is compressed; unpack it first")
    if path.suffix.lower() in {".parquet", ".pq"}:
        raise DataError(f"{path}: is not a Parquet file")
    if start.lstrip(b"\xef\xbb\xbf \r\n\t").upper().startswith(b"HIERARCHY"):
        raise DataError(f"{path}: looks like a BVH motion; give it the ending .bvh")
    if path.suffix.lower() == ".arff":
        return _read_arff_table(path, label)
    frame, notes = read_delimited(path)
    return table_from_frame(frame, path.name, label, notes)


def _read_parquet(path: Path, label: str | None) -> Table:
    # Imported here because it takes most of a second and listing data sets needs none of it.
    import pandas as pd
    from pyarrow import ArrowException

    try:
        frame = pd.read_parquet(path)
    except (ArrowException, OSError, ValueError) as error:
        reason = (str(error).splitlines() or [type(error).__name__])[0]
        raise DataError(f"{path}: is not a readable Parquet file ({reason})") from None
    return table_from_frame(frame.reset_index(drop=True), path.name, label)


def _read_arff_table(path: Path, label: str | None) -> Table:
    import pandas as pd  # for the same reason

    names, rows = read_arff(path)
    frame = pd.DataFrame([fields for _, fields in rows], columns=pd.Index(names), dtype=str)
    return table_from_frame(frame, path.name, label)
