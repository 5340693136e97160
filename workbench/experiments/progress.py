"""Tell how far a grid is and how long it may still take."""

from __future__ import annotations

import sys
import time
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from workbench.experiments.grid import Advance

#: Share of the work below which an estimate of the rest would be a guess.
_ENOUGH = 0.1


class ProgressLine:
    """Print one line on stderr that is overwritten as a grid advances.

    Parameters
    ----------
    title : str
        What is being computed.
    """

    def __init__(self, title: str) -> None:
        self.title = title
        self._started = time.monotonic()

    def __call__(self, advance: Advance) -> None:
        """Show how far the grid is, and from a tenth of the work on what may remain."""
        remains = ""
        if _ENOUGH <= advance.share < 1.0:
            took = time.monotonic() - self._started
            remains = f", about {duration(took * (1 - advance.share) / advance.share)} left"
        end = "\n" if advance.finished == advance.total else ""
        line = f"{self.title}: {advance.finished} of {advance.total} runs{remains} ({advance.what})"
        print(f"\r{line:<78}", end=end, file=sys.stderr, flush=True)  # noqa: T201 - its purpose


def duration(seconds: float) -> str:
    """Write a time as a reader says it.

    Examples
    --------
    >>> duration(8.2), duration(80), duration(3 * 3600 + 120)
    ('8 s', '1 min 20 s', '3 h 2 min')
    """
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60} s"
    return f"{whole // 3600} h {whole % 3600 // 60} min"
