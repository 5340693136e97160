"""Errors and warnings of the package.

Every error that a wrong input can cause is a :class:`WorkbenchError`, so that the
command line and the dashboards can show it as one plain line instead of a traceback.
"""

from __future__ import annotations

from pathlib import Path


class WorkbenchError(ValueError):
    """Signal an input that the package refuses; the message says what to change."""


class DataError(WorkbenchError):
    """Signal a data set that is missing, damaged or unfit for the requested use."""


class MotionFormatError(DataError):
    """Signal a motion file that breaks its format.

    Parameters
    ----------
    path : path-like
        The file.
    line : int
        Line number, counted from 1.
    found : str
        What stands there.
    expected : str
        What the format wants there.

    Examples
    --------
    >>> print(MotionFormatError("walk.bvh", 12, "'Frame Time: 0'", "a positive number of seconds"))
    walk.bvh, line 12: found 'Frame Time: 0', expected a positive number of seconds
    """

    def __init__(self, path: str | Path, line: int, found: str, expected: str) -> None:
        super().__init__(f"{path}, line {line}: found {found}, expected {expected}")
        self.path = Path(path)
        self.line = line
        self.found = found
        self.expected = expected

    def __reduce__(self) -> tuple[type, tuple[Path, int, str, str]]:
        # ValueError would be rebuilt from the message alone in a worker process.
        return type(self), (self.path, self.line, self.found, self.expected)


class AdjustmentWarning(UserWarning):
    """Tell that a parameter was adjusted to the data, and to what."""


class DegenerateDataWarning(UserWarning):
    """Tell that the data leave a result undetermined, and how that was settled."""
