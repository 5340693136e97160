"""Keyframes of curves of numbers, for motions of which no poses are known."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.errors import WorkbenchError
from workbench.mocap.motion_saliency import motion_saliency
from workbench.selection.chord import chord_keyframes
from workbench.selection.pb import decimated_keyframes
from workbench.selection.splitting import split_at_worst
from workbench.selection.tracks import value_track
from workbench.selection.worst_frames import WorstFrames
from workbench.validation import require_memory

#: Selectors that need nothing but curves.
CURVE_SELECTORS = ("saliency", "pb", "chord", "scs", "uniform", "exact")


def curve_keyframes(
    values: NDArray[np.float64], selector: str, count: int | None, **parameters: Any
) -> NDArray[np.intp]:
    """Select frames of curves of numbers, the first and the last among them.

    Parameters
    ----------
    values : ndarray of shape (n_frames, n_curves)
        One row per frame.
    selector : str
        One of :data:`CURVE_SELECTORS`.
    count : int or None
        How many; None for as many as the saliency method chooses.
    **parameters
        Those of :func:`~workbench.mocap.motion_saliency.motion_saliency`, or of the selector's
        function for curves.

    Returns
    -------
    ndarray of shape (n_keyframes,)
        Sorted.

    Raises
    ------
    WorkbenchError
        If the selector is another.

    Examples
    --------
    >>> curve_keyframes(np.array([[0.0], [1.0], [2.0], [1.0], [0.0]]), "exact", 3)
    array([0, 2, 4])
    """
    ends = np.array([0, len(values) - 1])
    if selector == "saliency" and count is None:
        return np.union1d(motion_saliency(values, **parameters).keyframes, ends).astype(np.intp)
    if count is None or selector not in CURVE_SELECTORS[1:]:
        raise WorkbenchError(
            f"selector: got {selector!r} for curves and a count, "
            f"want one of {', '.join(CURVE_SELECTORS[1:])}"
        )
    if selector == "pb":
        return decimated_keyframes(values, count, **parameters)
    if selector == "chord":
        return chord_keyframes(values, count, **parameters)
    if selector == "scs":
        between = WorstFrames(value_track(values)).between
        return np.sort(split_at_worst(between, ends, count))
    if selector == "exact":
        return least_squares_keyframes(values, count)
    return np.linspace(0, len(values) - 1, count).round().astype(np.intp)


def least_squares_keyframes(values: NDArray[np.float64], count: int) -> NDArray[np.intp]:
    """Find the keyframes between which linear interpolation has the least squared error.

    No selector of as many keyframes can have a higher peak signal-to-noise ratio. The squared
    error of a leg from frame i to frame j follows from three sums over the frames between, so
    that all n²/2 legs take O(n² · n_curves), and the best path over them O(n² · count) by
    dynamic programming (Bellman 1961).

    Parameters
    ----------
    values : ndarray of shape (n_frames, n_curves)
        One row per frame.
    count : int
        How many keyframes, the first and the last frame among them; from 2 to n_frames.

    Returns
    -------
    ndarray of shape (count,)
        Sorted.

    Raises
    ------
    WorkbenchError
        If memory will not suffice for the n² legs.
    """
    n_frames = len(values)
    require_memory(
        8.0 * n_frames**2 + 4.0 * n_frames * count,
        f"the exact keyframes of {n_frames} frames",
        "cut the clip into parts, or use the selector 'scs'",
    )
    # legs[j, i] is the error of the leg from i to j, so that a path's last leg is one row.
    legs = np.full((n_frames, n_frames), np.inf)
    for first in range(n_frames - 1):
        legs[first + 1 :, first] = _leg_errors(values[first + 1 :] - values[first])
    costs = legs[:, 0].copy()
    previous = np.zeros((count, n_frames), dtype=np.int32)
    for n_legs in range(2, count):
        for last in range(n_frames - 1, 0, -1):
            # From the end on, because the costs of earlier frames are those of a leg less.
            through = costs[:last] + legs[last, :last]
            previous[n_legs, last] = np.argmin(through)
            costs[last] = through[previous[n_legs, last]]
        costs[0] = np.inf
    keys = [n_frames - 1]
    for n_legs in range(count - 1, 0, -1):
        keys.append(int(previous[n_legs, keys[-1]]))
    return np.array(keys[::-1], dtype=np.intp)


def _leg_errors(offsets: NDArray[np.float64]) -> NDArray[np.float64]:
    """Sum the squared errors of the legs from one frame to each of the following ones.

    With y_u the offset after u frames and q that of the leg's end, m frames away,
    Σ‖y_u − (u/m)·q‖² = Σ‖y_u‖² − (2/m)·q·Σu·y_u + ‖q‖²·Σu²/m², over u = 1 … m.
    """
    steps = np.arange(1.0, len(offsets) + 1)
    squares = np.einsum("uc,uc->u", offsets, offsets)
    along = np.cumsum(steps[:, None] * offsets, axis=0)
    share = (steps + 1.0) * (2.0 * steps + 1.0) / (6.0 * steps)
    errors = (
        np.cumsum(squares) - 2.0 * np.einsum("uc,uc->u", offsets, along) / steps + squares * share
    )
    return np.maximum(errors, 0.0)


def rebuilt_linearly(values: NDArray[np.float64], keys: NDArray[np.intp]) -> NDArray[np.float64]:
    """Interpolate curves linearly between keyframes; beyond them the nearest one holds.

    Parameters
    ----------
    values : ndarray of shape (n_frames, n_curves)
        One row per frame.
    keys : ndarray of shape (n_keyframes,)
        Sorted frames.

    Returns
    -------
    ndarray of shape (n_frames, n_curves)
    """
    frames = np.arange(len(values))
    return np.stack([np.interp(frames, keys, curve[keys]) for curve in values.T], axis=1)
