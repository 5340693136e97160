"""What the explained optimizer is to show, and what of it is known."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.dashboards.explanation.jobs import Area, Job, Method, Plane, Setup
from workbench.optimization.landscape import ErrorLandscape
from workbench.optimization.trace import Trace

_COARSE, _FINE = 24, 96
_AROUND, _CLOSE = 0.25, 0.15  # padding of the whole plane and of a close-up
_REMEMBERED = 200  # results of samples and setups that were shown before
_CONTROL_POINT = (
    "A control point: it stays where it is, and is rebuilt from itself. "
    "Pick another sample to see how it moves."
)


class ExplainState:
    """The plane that is shown, the picked sample, and what is known of both.

    Attributes
    ----------
    setup : Setup or None
        What the plane shows.
    plane : Plane or None
        The plane.
    stale : bool
        Whether the plane is to be computed anew.
    sample : int
        The picked sample, -1 for the default one.
    optimizers : dict of str to Method
        Whose ways are shown.
    active : str
        The optimizer whose steps are shown first.
    zoomed : bool
        Whether the surroundings of the ways are mapped.
    place : tuple of float or None
        A clicked place, x and y.
    results : dict of Job to object
        Answers.
    failures : dict of Job to str
        Why there are none.
    """

    def __init__(self, sample: int, optimizers: dict[str, Method]) -> None:
        self.setup: Setup | None = None
        self.plane: Plane | None = None
        self.stale = False
        self.sample = sample
        self.optimizers = optimizers
        self.active = next(iter(optimizers))
        self.zoomed = False
        self.place: tuple[float, ...] | None = None
        self.results: dict[Job, Any] = {}
        self.failures: dict[Job, str] = {}

    def take(self, setup: Setup, plane: Plane) -> None:
        """Show another plane; the sample stays the same in the same data."""
        same = self.setup is None or self.setup.source == setup.source
        kept = self.sample if same else -1
        self.setup, self.plane, self.place = setup, plane, None
        self.stale = False
        self.sample = kept if 0 <= kept < len(plane.embedding) else _largest(plane)

    def forget(self) -> None:
        """Let everything be computed anew; the plane stays until there is another."""
        self.results.clear()
        self.stale = True

    def remember(self, job: Job, result: Any) -> None:
        """Keep a result, and forget the oldest of many."""
        self.results[job] = result
        while len(self.results) > _REMEMBERED:
            del self.results[next(iter(self.results))]

    @property
    def is_control_point(self) -> bool:
        """Whether the picked sample stays where it is."""
        return self.plane is not None and self.sample in self.plane.control_points

    @property
    def asked_place(self) -> tuple[float, float]:
        """Where Python is to rebuild the sample: the clicked place, or where it starts."""
        assert self.plane is not None
        x, y = self.place or self.plane.embedding[self.sample]
        return float(x), float(y)

    @property
    def traces(self) -> dict[str, Trace]:
        """Ways of the sample that are known, by optimizer."""
        if self.setup is None:
            return {}
        found = {name: self.results.get(self._walk(name)) for name in self.optimizers}
        return {name: trace for name, trace in found.items() if trace is not None}

    @property
    def told(self) -> dict[str, Trace | str]:
        """The way of each optimizer, or in words why there is none."""
        if self.is_control_point:
            return dict.fromkeys(self.optimizers, _CONTROL_POINT)
        missing = {
            name: self.failures.get(self._walk(name), "computing …") for name in self.optimizers
        }
        return {**missing, **self.traces}

    @property
    def landscape(self) -> ErrorLandscape | None:
        """Errors over the whole plane, None before they are there."""
        return self.results.get(self._map(self._whole(_FINE))) if self.setup else None

    @property
    def best_map(self) -> ErrorLandscape | None:
        """The most telling map that there is."""
        if self.setup is None:
            return None
        areas = [self._close_up(), self._whole(_FINE), self._whole(_COARSE)]
        maps = (self.results.get(self._map(area)) for area in areas if area)
        return next((found for found in maps if found is not None), None)

    def answer_of(self, method: str, *rest: Any) -> Any:
        """Give the answer of a job on this plane, None before it is there."""
        return self.results.get(Job(method, self.setup, rest)) if self.setup else None

    def jobs(self) -> list[Job]:
        """List what the views show, what is seen first before what refines it."""
        if self.setup is None or self.plane is None:
            return []
        first = [Job("original", self.setup, (self.sample,))]
        if self.plane.radial is None:
            first.append(Job("rebuild", self.setup, (self.asked_place,)))
        fine = self._map(self._whole(_FINE))
        if fine not in self.results:
            first.append(self._map(self._whole(_COARSE)))
        others = [name for name in self.optimizers if name != self.active]
        names = [] if self.is_control_point else [self.active, *others]
        walks = [self._walk(name) for name in names if name in self.optimizers]
        close_up = self._close_up()
        last = [self._map(close_up)] if close_up else []
        return [*first, *walks[:1], fine, *walks[1:], *last]

    def missing(self) -> list[Job]:
        """List those that are neither done nor failed."""
        return [job for job in self.jobs() if self.lacks(job)]

    def lacks(self, job: Job) -> bool:
        """Tell whether a job on this plane is neither done nor failed."""
        known = job.method == "prepare" or job in self.results or job in self.failures
        return job.setup == self.setup and not known

    def faults(self) -> list[str]:
        """Tell what of the plane failed; ways tell their own faults."""
        failed = (j for j in self.jobs() if j in self.failures and j.method != "trace")
        return list(dict.fromkeys(self.failures[job] for job in failed))

    def _walk(self, optimizer: str) -> Job:
        assert self.setup is not None
        return Job("trace", self.setup, (self.sample, self.optimizers[optimizer]))

    def _map(self, area: Area) -> Job:
        assert self.setup is not None
        return Job("landscape", self.setup, (self.sample, area))

    def _whole(self, side: int) -> Area:
        assert self.plane is not None
        return Area.around(self.plane.embedding, side, _AROUND)

    def _close_up(self) -> Area | None:
        """Choose the surroundings of the ways, once all of them are known."""
        traces = list(self.traces.values())
        settled = sum(isinstance(t, Trace) or t != "computing …" for t in self.told.values())
        if not self.zoomed or not traces or settled < len(self.optimizers):
            return None
        tried = (t for trace in traces for step in trace.steps for t in step.tries)
        probes = [t.position for t in tried if t.stage == "probe"]
        places = [place for trace in traces for place in trace.positions]
        return Area.around(np.array(places + probes), _FINE, _CLOSE)


def _largest(plane: Plane) -> int:
    """Choose the sample that an optimizer has most to do with."""
    free: NDArray[np.intp] = plane.free
    return int(free[plane.errors[free].argmax()]) if len(free) else 0
