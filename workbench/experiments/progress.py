"""Tell how far a grid is and how long it may still take."""

from __future__ import annotations

import sys
import time
from collections import defaultdict
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Self

from workbench.experiments.costs import Costs
from workbench.experiments.runs.base import Run

#: Share of the work below which an estimate of the rest would be a guess.
_ENOUGH = 0.1
#: Width of the line, so that what stood there before is overwritten.
_WIDTH = 100


@dataclass(frozen=True)
class Advance:
    """How far a grid is.

    Attributes
    ----------
    finished, total : int
        Runs.
    share : float
        Estimated share of the work that is done, from 0 to 1; what was found finished is no
        work.
    what : str
        What was just finished.
    """

    finished: int
    total: int
    share: float
    what: str


Progress = Callable[[Advance], None]


class Reporter:
    """Turn finished runs into calls of a progress function.

    Runs differ in cost by a factor of thousands. What is left is estimated from the runs of
    the same method that were finished here, so the estimate gets better on the way.

    Parameters
    ----------
    progress : callable or None
        Called with an :class:`Advance`, if there is one.
    total : int
        Number of runs, with those found finished.
    work : mapping of Run to int
        The number of samples of each run that is to be executed.
    costs : Costs
        What runs are expected to take; learns from those that are finished.
    """

    def __init__(
        self, progress: Progress | None, total: int, work: Mapping[Run, int], costs: Costs
    ) -> None:
        self._progress = progress
        self._total = total
        self._finished = total - len(work)
        self._work = work
        self._costs = costs
        self._spent = 0.0
        # Runs of one method have one rate, so that their work can be added up.
        self._left: dict[str, float] = defaultdict(float)
        self._example: dict[str, Run] = {}
        for run, n_samples in work.items():
            self._left[costs.method(run)] += costs.size(run, n_samples)
            self._example.setdefault(costs.method(run), run)

    def start(self, what: str) -> None:
        """Tell that the runs begin."""
        self._tell(what)

    def finished(self, run: Run, seconds: float | None, what: str) -> None:
        """Tell that a run is finished.

        Parameters
        ----------
        run : Run
            One of those that were to be executed.
        seconds : float or None
            Time that it took; None if it failed.
        what : str
            Passed on.
        """
        method = self._costs.method(run)
        size = self._costs.size(run, self._work[run])
        if seconds is None:
            self._spent += size * self._costs.rate(run)
        else:
            self._spent += seconds
            self._costs.learn(run, self._work[run], seconds)
        self._left[method] -= size
        self._finished += 1
        self._tell(what)

    def _tell(self, what: str) -> None:
        if self._progress is None:
            return
        left = 0.0
        if self._finished < self._total:
            left = sum(
                self._left[method] * self._costs.rate(run) for method, run in self._example.items()
            )
        share = self._spent / (self._spent + left) if left > 0 else 1.0
        self._progress(Advance(self._finished, self._total, share, what))


class ProgressLine:
    """Print one line on stderr that is overwritten as a grid advances.

    As a context manager it ends the line when the grid stops half-way, so that the reason
    stands on a line of its own.

    Parameters
    ----------
    title : str
        What is being computed.
    """

    def __init__(self, title: str) -> None:
        self.title = title
        self._started: float | None = None
        self._open = False

    def __enter__(self) -> Self:
        """Give itself."""
        return self

    def __exit__(self, *_: object) -> None:
        """End the line if it waits for more."""
        if self._open:
            print(file=sys.stderr, flush=True)  # noqa: T201 - its purpose

    def __call__(self, advance: Advance) -> None:
        """Show how far the grid is, and from a tenth of the work on what may remain."""
        now = time.monotonic()
        # Looking up what is finished already is over by the first call, and no measure of
        # what remains.
        if self._started is None:
            self._started = now
        remains = ""
        if _ENOUGH <= advance.share < 1.0:
            left = (now - self._started) * (1 - advance.share) / advance.share
            remains = f", about {duration(left)} left"
        self._open = advance.finished < advance.total
        end = "" if self._open else "\n"
        line = f"{self.title}: {advance.finished} of {advance.total} runs{remains} ({advance.what})"
        print(f"\r{line:<{_WIDTH}}", end=end, file=sys.stderr, flush=True)  # noqa: T201 - its purpose


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
