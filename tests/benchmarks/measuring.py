"""Measure a call beside its baseline, in one process, interleaved."""

from __future__ import annotations

import ctypes
import gc
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Any


@dataclass(frozen=True)
class Measurement:
    """One row of the table.

    Attributes
    ----------
    subject : str
        What was done, on how much data.
    target : str
        What is asked for, such as "at least 3 x" or "below 5 s".
    seconds : float
        Median time of ours.
    baseline : str
        What it is compared with; empty where the target is a time.
    baseline_seconds : float or None
        Median time of that.
    peak_mb : float
        Largest growth of the process's memory during one call of ours.
    met : bool
        Whether the target is met.
    note : str
        Why not, or what else was measured.
    """

    subject: str
    target: str
    seconds: float
    baseline: str
    baseline_seconds: float | None
    peak_mb: float
    met: bool
    note: str = ""


def compare(
    subject: str,
    ours: Callable[[], Any],
    baseline: str,
    theirs: Callable[[], Any],
    at_least: float,
    repeats: int = 5,
    note: str = "",
) -> Measurement:
    """Measure a call and its baseline in turns, and compare the medians."""
    ours()  # compiled, and in the caches, before the clock starts
    theirs()
    peak = peak_memory(ours)
    pairs = [(_seconds(ours), _seconds(theirs)) for _ in range(repeats)]
    own, other = (median(times) for times in zip(*pairs, strict=True))
    target = f"at least {at_least:g} x"
    return Measurement(subject, target, own, baseline, other, peak, other >= at_least * own, note)


def time_of(
    subject: str,
    ours: Callable[[], Any],
    below: float,
    repeats: int = 3,
    note: str = "",
    warm: bool = True,
) -> Measurement:
    """Measure a call against a limit in seconds."""
    if warm:
        ours()
    peak = peak_memory(ours)
    own = median(_seconds(ours) for _ in range(repeats))
    return Measurement(subject, f"below {below:g} s", own, "", None, peak, own < below, note)


def growth_exponent(times: dict[int, float]) -> float:
    """Compute the exponent p of time ~ n^p between the smallest and the largest n."""
    from math import log

    small, large = min(times), max(times)
    return log(times[large] / times[small]) / log(large / small)


def peak_memory(call: Callable[[], Any]) -> float:
    """Measure by how many MB a call makes the process grow at its largest."""
    gc.collect()
    ctypes.CDLL("libc.so.6").malloc_trim(0)
    Path("/proc/self/clear_refs").write_text("5")
    before = _memory("VmRSS")
    call()
    return max(0.0, _memory("VmHWM") - before)


def _seconds(call: Callable[[], Any]) -> float:
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


def _memory(field: str) -> float:
    lines = Path("/proc/self/status").read_text(encoding="ascii").splitlines()
    kilobytes = next(line.split()[1] for line in lines if line.startswith(field))
    return int(kilobytes) / 1024
