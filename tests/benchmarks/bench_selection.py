"""Keyframe selectors on long clips, and the exact one."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from tests.benchmarks.measuring import Measurement, growth_exponent, time_of
from workbench import load_space
from workbench.mocap.motion import Motion
from workbench.mocap.rotations import rotations_from_vectors
from workbench.selection.optimal import Optimal
from workbench.selection.pb import PositionBased
from workbench.selection.scs import SimpleCurveSimplification
from workbench.spaces import PoseSpace

LONG, SHORT, KEYS = 100_000, 10_000, 300
EXPONENT = 1.2


def long_space(n_frames: int, clip: str = "cmu/05_10") -> PoseSpace:
    """Make a clip of that length: a real one there and back, again and again, never the same.

    Slow smooth turns of some degrees are added to all joints, so that no two rounds are alike.
    """
    motion = load_space(clip).motion
    there_and_back = np.abs((np.arange(n_frames) + len(motion)) % (2 * len(motion)) - len(motion))
    frames = np.minimum(there_and_back, len(motion) - 1)
    rng = np.random.default_rng(0)
    knots = rng.normal(0.0, 0.08, (n_frames // 50 + 2, motion.skeleton.n_joints, 3))
    at = np.arange(n_frames) / 50.0
    left, share = at.astype(int), (at % 1.0)[:, None, None]
    share = share * share * (3.0 - 2.0 * share)
    turns = knots[left] + share * (knots[left + 1] - knots[left])
    rotations = motion.rotations[frames] @ rotations_from_vectors(turns)
    return PoseSpace(
        Motion(motion.skeleton, rotations, motion.root_translation[frames], motion.frame_time)
    )


def measurements() -> Iterator[Measurement]:
    """Yield one row per target."""
    long, short = long_space(LONG), long_space(SHORT)
    for selector in (SimpleCurveSimplification(), PositionBased()):
        name = type(selector).__name__
        row = time_of(
            f"{name}, {LONG} frames x {long.samples.shape[1]} joints, {KEYS} keys",
            lambda selector=selector: selector.select(long, KEYS),
            below=10,
        )
        # The same share of keys and the same number of keys grow differently; both count.
        exponents = [
            growth_exponent(
                {
                    SHORT: _median_time(lambda s=selector, k=keys: s.select(short, k)),
                    LONG: row.seconds,
                }
            )
            for keys in (KEYS, KEYS // 10)
        ]
        met = row.met and max(exponents) <= EXPONENT
        note = (
            f"time grows with the {exponents[0]:.2f}th power of the frames for {KEYS} keys, the "
            f"{exponents[1]:.2f}th for one key in {LONG // KEYS} frames (wanted at most {EXPONENT})"
        )
        yield replace(row, met=met, note=note)
    clip = load_space("cmu/05_09").motion[:1000]
    exact = PoseSpace(clip)
    yield time_of(
        f"Optimal, {len(exact)} frames, 30 keys",
        lambda: Optimal().select(exact, 30),
        below=30,
        repeats=1,
        warm=False,
    )


def _median_time(call: Callable[[], Any]) -> float:
    times = []
    for _ in range(3):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return sorted(times)[1]
