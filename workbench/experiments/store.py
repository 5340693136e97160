"""Results on disk: one small file for each finished run, whole or not there at all."""

from __future__ import annotations

import hashlib
import io
import json
import os
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from workbench.errors import DataError
from workbench.files import write_atomically

Row = dict[str, Any]
Arrays = dict[str, NDArray[Any]]


def default_results_folder() -> Path:
    """Tell where a notebook that is run alone keeps its results: in the download cache."""
    from workbench.datasets.search import cache_folder

    return cache_folder() / "results"


class ResultStore:
    """A folder of results, one file for each run, named by its content key.

    A row of values is a JSON file with its own checksum; arrays (embeddings) lie beside it
    in an ``.npz`` file, written first and named by its checksum, which the row carries. So a
    result that can be read is complete, whenever the process that wrote it was ended and
    whoever wrote it too, and one that was damaged later is noticed.

    Parameters
    ----------
    folder : path-like
        Made when the first result is written.
    """

    def __init__(self, folder: str | Path) -> None:
        self.folder = Path(folder)

    def require_writable(self) -> None:
        """Make the folder, before anything is computed that could not be stored.

        Raises
        ------
        DataError
            If it cannot be made or written to.
        """
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise DataError(f"{self.folder}: cannot be made ({error.strerror})") from None
        if not os.access(self.folder, os.W_OK | os.X_OK):
            raise DataError(f"{self.folder}: results cannot be stored there, it is read-only")

    def write(self, key: str, row: Row, arrays: Arrays) -> None:
        """Store a finished run.

        Parameters
        ----------
        key : str
            Its content key.
        row : dict
            Values that JSON can hold.
        arrays : dict of str to ndarray
            What does not fit a row; may be empty.
        """
        packed, checksum = b"", None
        if arrays:
            buffer = io.BytesIO()
            np.savez_compressed(buffer, **arrays)  # type: ignore[arg-type]  # arrays by name
            packed = buffer.getvalue()
            checksum = _sha256(packed)
        content = {"key": key, "row": row, "arrays": checksum}
        record = {**content, "sha256": _sha256(_canonical(content))}
        # The file keeps the order of the columns, on which the checksum does not depend.
        text = json.dumps(record, allow_nan=False, indent=1) + "\n"
        if checksum is not None:
            write_atomically(self._arrays_path(key, checksum), packed)
        write_atomically(self._row_path(key), text.encode())

    def read(self, key: str) -> Row | None:
        """Read the row of a finished run.

        Returns
        -------
        dict or None
            None if there is no such result or it is damaged, which a warning says.
        """
        record = self._record(self._row_path(key))
        if record is None:
            return None
        checksum = record["arrays"]
        if checksum is not None and self._packed(key, checksum) is None:
            warnings.warn(f"{self._arrays_path(key, checksum)} is damaged", stacklevel=2)
            return None
        return dict(record["row"])

    def arrays(self, key: str) -> Arrays:
        """Read the arrays of a finished run.

        Parameters
        ----------
        key : str
            Its content key, in the column ``key`` of the result table.

        Returns
        -------
        dict of str to ndarray

        Raises
        ------
        DataError
            If the run is not stored, or its arrays are damaged.
        """
        record = self._record(self._row_path(key))
        packed = None if record is None else self._packed(key, record["arrays"])
        if packed is None:
            raise DataError(f"{self.folder}: holds no arrays of run {key[:12]}…, run it again")
        with np.load(io.BytesIO(packed)) as file:
            return {name: file[name] for name in file.files}

    def rows(self) -> Iterator[Row]:
        """Go through all rows that can be read, in the order of their keys."""
        for path in sorted(self.folder.glob("*.json")):
            record = self._record(path)
            if record is not None:
                yield dict(record["row"])

    def has_table(self) -> bool:
        """Tell whether the rows have been gathered in ``runs.parquet``."""
        return (self.folder / "runs.parquet").is_file()

    def write_table(self) -> pd.DataFrame:
        """Gather all rows into ``runs.parquet``.

        Returns
        -------
        DataFrame
            One row per stored run.
        """
        table = pd.DataFrame(list(self.rows()))
        buffer = io.BytesIO()
        table.to_parquet(buffer, index=False)
        write_atomically(self.folder / "runs.parquet", buffer.getvalue())
        return table

    def _row_path(self, key: str) -> Path:
        return self.folder / f"{key}.json"

    def _arrays_path(self, key: str, checksum: str) -> Path:
        # Two processes that finish the same run at once do not mix what they write.
        return self.folder / f"{key}-{checksum[:16]}.npz"

    def _packed(self, key: str, checksum: str | None) -> bytes | None:
        if checksum is None:
            return None
        try:
            packed = self._arrays_path(key, checksum).read_bytes()
        except OSError:
            return None
        return packed if _sha256(packed) == checksum else None

    def _record(self, path: Path) -> dict[str, Any] | None:
        try:
            record = json.loads(path.read_bytes())
            checksum = record.pop("sha256")
            if checksum == _sha256(_canonical(record)) and record["key"] == path.stem:
                return dict(record)
        except (FileNotFoundError, NotADirectoryError):
            return None
        except (OSError, ValueError, KeyError, AttributeError, TypeError):
            pass
        warnings.warn(f"{path} is damaged and is not used", stacklevel=3)
        return None


def _canonical(content: Any) -> bytes:
    return json.dumps(content, sort_keys=True, allow_nan=False).encode()


def _sha256(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()
