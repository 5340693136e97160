"""A table of numbers: what every source of tabular data is read into."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from workbench.errors import DataError
from workbench.validation import MIN_SAMPLES

if TYPE_CHECKING:
    from workbench.spaces import VectorSpace

# The squares of larger numbers, of which distances are made, leave the range of float64.
LARGEST = 1e150


@dataclass(frozen=True, eq=False)
class Table:
    """A table of finite numbers, with a class for each row where there is one.

    Parameters
    ----------
    name : str
        What to call the table in messages and figures.
    values : ndarray of shape (n_rows, n_columns)
        The numbers, in the units of the source.
    columns : tuple of str
        Names of the columns.
    labels : ndarray of shape (n_rows,) of str, optional
        The class of each row.
    label_name : str
        What the classes are called.
    notes : tuple of str
        What was done to the source to make it a table, one sentence each, so that no
        treatment goes unsaid.

    Raises
    ------
    DataError
        If the parts do not fit each other, a value is not finite or there are fewer than
        3 rows.

    Examples
    --------
    >>> table = Table("squares", np.array([[1, 1], [2, 4], [3, 9]]), ("x", "x²"))
    >>> table.values.shape
    (3, 2)
    """

    name: str
    values: NDArray[np.float64]
    columns: tuple[str, ...]
    labels: NDArray[np.str_] | None = None
    label_name: str = ""
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        values = np.ascontiguousarray(self.values, dtype=np.float64)
        if values.ndim != 2 or values.shape[1] < 1:
            raise DataError(f"{self.name}: got values of shape {values.shape}, want a table")
        n_rows, n_columns = values.shape
        if n_rows < MIN_SAMPLES:
            raise DataError(
                f"{self.name}: got {counted(n_rows, 'row')}, want at least {MIN_SAMPLES}"
            )
        if len(self.columns) != n_columns:
            raise DataError(f"{self.name}: got {len(self.columns)} column names, want {n_columns}")
        unfit = ~(np.abs(values) <= LARGEST)
        if unfit.any():
            row, column = (int(i) for i in np.argwhere(unfit)[0])
            raise DataError(
                f"{self.name}: got {values[row, column]} in row {row + 1} of column "
                f"{self.columns[column]!r} ({counted(int(unfit.sum()), 'such value')}), "
                f"want finite numbers up to {LARGEST:g}"
            )
        object.__setattr__(self, "values", values)
        if self.labels is not None:
            labels = np.asarray(self.labels).astype(np.str_)
            if labels.shape != (n_rows,):
                raise DataError(
                    f"{self.name}: got labels of shape {labels.shape}, want ({n_rows},)"
                )
            object.__setattr__(self, "labels", labels)

    def __len__(self) -> int:
        return len(self.values)

    @property
    def class_counts(self) -> dict[str, int]:
        """Number of rows of each class, in alphabetical order; empty without labels."""
        if self.labels is None:
            return {}
        names, counts = np.unique(self.labels, return_counts=True)
        return dict(zip(names.tolist(), counts.tolist(), strict=True))

    @property
    def checksum(self) -> str:
        """SHA-256 of the numbers and labels, the same however a file formats them."""
        return content_checksum(self.values, self.labels)

    def space(self, *, standardize: bool = False) -> VectorSpace:
        """Make the table a space of samples under the Euclidean distance.

        Parameters
        ----------
        standardize : bool
            Whether to bring each column to zero mean and unit variance first.

        Returns
        -------
        VectorSpace
        """
        # Imported here so that listing data sets does not wait for the pipeline.
        from workbench.spaces import VectorSpace

        return VectorSpace(
            self.values,
            columns=self.columns,
            labels=self.labels,
            name=self.name,
            standardize=standardize,
            notes=self.notes,
        )


def content_checksum(values: NDArray[np.float64], labels: NDArray[Any] | None = None) -> str:
    """Compute a checksum of parsed content.

    Two files that write the same numbers differently (``5.10`` and ``5.1``, blanks and
    commas) have the same checksum; a single changed digit changes it.

    Parameters
    ----------
    values : ndarray of shape (n_rows, n_columns)
        The numbers.
    labels : ndarray of shape (n_rows,) of str, optional
        The classes.

    Returns
    -------
    str
        SHA-256 in hexadecimal digits.
    """
    digest = hashlib.sha256()
    digest.update(f"{values.shape[0]} {values.shape[1]} ".encode())
    # Adding 0 turns -0 into 0, which is the same number with another bit pattern.
    digest.update((np.ascontiguousarray(values, dtype="<f8") + 0.0).tobytes())
    if labels is not None:
        digest.update("\0".join(labels.tolist()).encode())
    return digest.hexdigest()


def counted(number: int, noun: str) -> str:
    """Write a number of things for a message: "no rows", "1 row", "2 rows"."""
    return f"{number or 'no'} {noun}{'' if number == 1 else 's'}"
