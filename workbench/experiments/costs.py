"""Estimate how long runs will take, from those that are finished."""

from __future__ import annotations

import json
from collections import defaultdict
from typing import Any

from workbench.experiments.runs.base import Run

#: Seconds for a thousand samples, as measured on motion clips with one thread. Only their
#: ratios count: as soon as runs are finished, the estimate follows these.
_TEMPORAL = 0.06
_DISTANCES = 1.0
_OPTIMIZER = 7.0
_PROJECTORS = {"tsne": 18.0, "umap": 5.0, "force": 5.0}

#: Values of a run that tell little of how long it takes, next to the number of samples.
_NO_METHOD = ("dataset", "seed")


class Costs:
    """Expected seconds of runs: with the square of the number of samples, times a rate.

    The rate of a method is that of its finished runs; of a method without any, that of its
    kind of run; without any of these, that of all.

    Examples
    --------
    >>> from workbench.experiments.runs.schemes import SchemeRun
    >>> from workbench.schemes import SpatialScheme
    >>> raw = SchemeRun("cmu/05_10", SpatialScheme("pca"), ratio=0.03)
    >>> costs = Costs()
    >>> costs.learn(raw, 100, 2.0)
    >>> costs.expected(raw, 200)
    8.0
    """

    def __init__(self) -> None:
        self._seconds: dict[str, float] = defaultdict(float)
        self._sizes: dict[str, float] = defaultdict(float)
        self._names: dict[Run, tuple[str, float]] = {}

    def learn(self, run: Run, n_samples: int, seconds: float) -> None:
        """Take note of a finished run.

        Parameters
        ----------
        run : Run
            The run.
        n_samples : int
            Number of samples of its data.
        seconds : float
            Time that it took.
        """
        method, weight = self._method(run)
        for level in _levels(run, method):
            self._seconds[level] += seconds
            self._sizes[level] += weight * n_samples**2

    def expected(self, run: Run, n_samples: int) -> float:
        """Estimate the seconds of a run on so many samples."""
        return self.size(run, n_samples) * self.rate(run)

    def size(self, run: Run, n_samples: int) -> float:
        """Give the work of a run in seconds of an unknown machine."""
        return self._method(run)[1] * n_samples**2

    def rate(self, run: Run) -> float:
        """Give the seconds that a unit of work takes here; of one method it is the same."""
        for level in _levels(run, self._method(run)[0]):
            if self._sizes.get(level, 0.0) > 0:
                return self._seconds[level] / self._sizes[level]
        return 1.0

    def method(self, run: Run) -> str:
        """Name the method of a run, the same for all data sets and seeds."""
        return self._method(run)[0]

    def _method(self, run: Run) -> tuple[str, float]:
        if run not in self._names:
            values = run.specification()
            method = {name: value for name, value in values.items() if name not in _NO_METHOD}
            text = json.dumps([type(run).__qualname__, method], sort_keys=True, default=str)
            self._names[run] = (text, _weight(values) / 1000**2)
        return self._names[run]


def _levels(run: Run, method: str) -> tuple[str, str, str]:
    return method, type(run).__qualname__, ""


def _weight(values: dict[str, Any]) -> float:
    if values.get("interpolator"):
        return _TEMPORAL
    projector = _PROJECTORS.get(str(values.get("projector")), 0.0)
    return _DISTANCES + projector + (_OPTIMIZER if values.get("optimizer") else 0.0)
