"""Benchmarks of motion saliency."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import replace
from statistics import median

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import correlate1d

from tests.benchmarks.measuring import Measurement, compare, growth_exponent, time_of
from workbench.mocap.curve_saliency import SCALES, curve_saliency
from workbench.mocap.motion_saliency import motion_saliency

N_FRAMES = 100_000
N_CURVES = 62
SIGMA = 10.0


def measurements() -> Iterator[Measurement]:
    """Time the whole method, its growth with the clip, and its windows beside scipy's."""
    curves = smooth_curves(N_FRAMES)
    subject = f"saliency, {N_FRAMES:,} frames x {N_CURVES} curves"
    yield time_of(
        f"{subject}, k by 90 % of variance", lambda: motion_saliency(curves, SIGMA), below=1.0
    )
    yield time_of(
        f"{subject}, k = {N_CURVES}",
        lambda: motion_saliency(curves, SIGMA, N_CURVES),
        below=1.0,
        note="no reduction at all: every component is kept, where the thesis keeps 7 to 10",
    )
    yield growth(curves)
    components = curves[:, :7].copy()
    yield compare(
        f"curve saliency, {N_FRAMES:,} frames x 7 curves",
        lambda: curve_saliency(components, SIGMA),
        "the windows alone by scipy.ndimage.correlate1d",
        lambda: windows_by_scipy(components),
        at_least=1.0,
    )


def growth(curves: NDArray[np.float64]) -> Measurement:
    """Measure how the time grows from a tenth of the frames to all, in turns."""
    sizes = (N_FRAMES // 10, N_FRAMES)
    times: dict[int, list[float]] = {n: [] for n in sizes}
    for _ in range(7):
        for n in sizes:
            start = time.perf_counter()
            motion_saliency(curves[:n], SIGMA)
            times[n].append(time.perf_counter() - start)
    exponent = growth_exponent({n: median(seconds) for n, seconds in times.items()})
    row = time_of(
        f"saliency, from {sizes[0]:,} to {sizes[1]:,} frames",
        lambda: motion_saliency(curves, SIGMA),
        below=1.0,
    )
    return replace(
        row, target="exponent at most 1.1", met=exponent <= 1.1, note=f"exponent {exponent:.2f}"
    )


def windows_by_scipy(curves: NDArray[np.float64]) -> list[NDArray[np.float64]]:
    """Average curves in all windows of the method, as one would with scipy."""
    means = []
    for width in sorted({factor * scale * SIGMA for scale in SCALES for factor in (1.0, 2.0)}):
        reach = int(2 * width)
        weights = np.exp(-0.5 * (np.arange(-reach, reach + 1) / width) ** 2)
        totals = correlate1d(np.ones(len(curves)), weights, mode="constant")
        means.append(correlate1d(curves, weights, axis=0, mode="constant") / totals[:, None])
    return means


def smooth_curves(n_frames: int) -> NDArray[np.float64]:
    """Make curves that move as joints do: smooth, with shared and own parts."""
    rng = np.random.default_rng(0)
    frames = np.arange(n_frames)[:, None]
    shared = np.sin(frames * rng.uniform(0.005, 0.1, 12) + 6 * rng.random(12))
    own = np.sin(frames * rng.uniform(0.005, 0.2, N_CURVES) + 6 * rng.random(N_CURVES))
    return shared @ rng.normal(size=(12, N_CURVES)) * 10 + own
