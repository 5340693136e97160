"""Shortest paths from the first frame to the last: exact selection by dynamic programming.

Keyframes are stops of a path, and each leg from one key to the next costs the errors of the
frames that it leaves out: their sum, or the largest of them. With F[i, v] the least cost of
reaching frame v by i legs,

    F[i + 1, v] = min over u < v of F[i, u] + cost(u, v)        (or max(F[i, u], cost(u, v))),

and F[k − 1, last] is the optimum for k keys. The costs of all n² / 2 legs take n³ / 6 frame
errors, nearly all of the time, so most are not computed to the end. Three things make that
safe. All errors are at least 0, hence so are all legs.

1. A path of k legs is known beforehand, of cost B[k]. The best one costs no more.
2. Legs are taken in the order of their first frame u, so F[i, u] is final then, and a path
   through a leg (u, v) that continues after i legs costs at least F[i, u] + cost(u, v) (or
   the larger of the two), whatever follows. If that exceeds B[k] for all i and all k > i
   that matter, no best path has that leg. It needs one leg more if v is not the last frame.
3. Part of a leg's frames is a lower bound of its cost, so its computation stops as soon as
   the part is too much.

Neither the length of a leg nor the number of frames between keys is limited. The bounds B
come from SCS, then from the same procedure with only some frames as possible keys: every
16th, then every 4th (more steps of 4 where keys are few, none where they are many), which
errs by a few per cent and takes 1/256 and 1/16 of the time.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numba import prange
from numpy.typing import NDArray

from workbench.kernels import compiled, compiled_parallel
from workbench.selection.splitting import split_at_worst
from workbench.selection.track_errors import BLOCK, frame_errors
from workbench.selection.tracks import Track
from workbench.selection.worst_frames import WorstFrames

# Sums of the same errors differ by rounding, which must not cut a path off: relatively, and
# where the best path costs nothing but rounding errors, such as at constant speed, by any factor.
_ROUNDING = 1.0 + 1e-9
_ROUNDING_OF_FRAME = 1e-12


def best_paths(
    track: Track, stops: NDArray[np.intp], max_count: int, largest: bool, only: bool
) -> Iterator[tuple[NDArray[np.intp], float]]:
    """Find the best keys for every count up to a largest one.

    Parameters
    ----------
    track : Track
        The frames.
    stops : ndarray of shape (n_stops,)
        Sorted frames that must be keys, the first and the last among them.
    max_count : int
        The largest number of keys, from n_stops to the number of frames.
    largest : bool
        Whether a path costs its largest frame error, instead of the sum.
    only : bool
        Whether only ``max_count`` itself is wanted.

    Yields
    ------
    keys : ndarray of shape (count,)
        For each count from n_stops on.
    cost : float
        Least cost.
    """
    bounds = _greedy_bounds(track, stops, max_count, largest)
    if only:
        bounds[:-1] = -np.inf
    stride = 1
    while track.n_frames > 8 * stride * max_count:
        stride *= 4
    while stride > 1:
        coarse = np.union1d(np.arange(0, track.n_frames, stride), stops)
        costs, _ = _solve(track, coarse, stops, bounds, largest)
        bounds = np.minimum(bounds, costs[:, -1])
        stride //= 4
    frames = np.arange(track.n_frames)
    costs, previous = _solve(track, frames, stops, bounds, largest)
    for legs in range(max_count - 1 if only else len(stops) - 1, max_count):
        keys = [track.n_frames - 1]
        for i in range(legs, 0, -1):
            keys.append(int(previous[i, keys[-1]]))
        yield np.array(keys[::-1], dtype=np.intp), float(costs[legs, -1])


def _greedy_bounds(
    track: Track, stops: NDArray[np.intp], max_count: int, largest: bool
) -> NDArray[np.float64]:
    """Compute the costs of SCS for every number of legs; −inf for numbers out of question."""
    order = split_at_worst(WorstFrames(track).between, stops, max_count)
    bounds = np.full(max_count, -np.inf)
    for count in range(len(stops), max_count + 1):
        keys = np.sort(order[:count])
        bounds[count - 1] = _path_cost(track, keys, largest)
    return bounds


def _solve(
    track: Track,
    frames: NDArray[np.intp],
    stops: NDArray[np.intp],
    bounds: NDArray[np.float64],
    largest: bool,
) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
    """Fill the table F, with ``frames`` as the only possible keys.

    Returns
    -------
    costs : ndarray of shape (n_legs + 1, n_frames)
        F; inf where it is above all bounds that matter.
    previous : ndarray of shape (n_legs + 1, n_frames)
        Position of the key before, in ``frames``.
    """
    n_legs, end = len(bounds) - 1, len(frames) - 1
    limits = bounds * _ROUNDING + track.n_frames * _ROUNDING_OF_FRAME
    # The loosest bound of paths of at least so many legs.
    loosest = np.maximum.accumulate(limits[::-1])[::-1]
    costs = np.full((n_legs + 1, len(frames)), np.inf)
    previous = np.zeros((n_legs + 1, len(frames)), dtype=np.intp)
    costs[0, 0] = 0.0
    legs = np.empty(len(frames))
    barriers = np.searchsorted(frames, stops)
    for u in range(end):
        barrier = int(barriers[np.searchsorted(barriers, u, side="right")])
        here = costs[:-1, u]
        # What a leg may cost: as the last one, and with at least one leg after it.
        as_last = _room(here, limits[1:], largest)
        onwards = _room(here[:-1], loosest[2:], largest)
        if max(as_last, onwards) < 0.0:
            continue
        span = slice(u + 1, barrier + 1)
        _leg_costs(track, frames, u, barrier, onwards, as_last, largest, legs)
        reached = (
            here[:, None] + legs[span] if not largest else np.maximum(here[:, None], legs[span])
        )
        better = (reached < costs[1:, span]) & (reached <= loosest[1:, None])
        costs[1:, span][better] = reached[better]
        previous[1:, span][better] = u
    return costs, previous


def _room(here: NDArray[np.float64], limits: NDArray[np.float64], largest: bool) -> float:
    """Compute how much a leg may cost after paths of these costs; below 0 for none."""
    if largest:
        return float(np.max(np.where(here <= limits, limits, -1.0), initial=-1.0))
    return float(np.max(limits - here, initial=-1.0))


@compiled
def _leg_cost(track, first, last, room, largest, errors):  # type: ignore[no-untyped-def]  # compiled
    """Compute the cost of a leg, or give up and say infinity if it is more than ``room``."""
    n_blocks = (last - first - 1 + BLOCK - 1) // BLOCK
    cost = 0.0
    for block in range(n_blocks):
        # Errors are largest halfway between two keys: there the sum grows soonest.
        begin = first + 1 + ((block + n_blocks // 2) % n_blocks) * BLOCK
        part = errors[: min(BLOCK, last - begin)]
        frame_errors(track, first, last, begin, part)
        for error in part:
            cost = max(cost, error) if largest else cost + error
        if cost > room:
            return math.inf
    return cost


@compiled_parallel
def _leg_costs(  # type: ignore[no-untyped-def]  # compiled
    track, frames, u, barrier, onwards, as_last, largest, legs
):
    """Compute the costs of the legs from one frame to all up to the next that must be a key."""
    n_legs = barrier - u
    for task in prange(n_legs):
        # Long legs and short ones in turns, so that the threads have equal work.
        step = np.int64(task)
        v = u + 1 + step // 2 if step % 2 == 0 else barrier - step // 2
        errors = np.empty(BLOCK)
        room = as_last if v == frames.shape[0] - 1 else onwards
        legs[v] = _leg_cost(track, frames[u], frames[v], room, largest, errors)


@compiled
def _path_cost(track, keys, largest):  # type: ignore[no-untyped-def]  # compiled
    """Compute the cost of a path through the given keys."""
    errors = np.empty(BLOCK)
    cost = 0.0
    for i in range(keys.shape[0] - 1):
        leg = _leg_cost(track, keys[i], keys[i + 1], math.inf, largest, errors)
        cost = max(cost, leg) if largest else cost + leg
    return cost
