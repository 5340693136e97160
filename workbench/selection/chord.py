"""Curve simplification by the distance from the chord."""

from __future__ import annotations

from collections.abc import Iterable
from numbers import Real
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.mocap.channels import motion_to_euler
from workbench.selection.base import Selector, fixed_samples
from workbench.selection.splitting import split_at_worst, worst_of
from workbench.selection.tracks import check_curves, motion_of, with_ends
from workbench.spaces import Space
from workbench.validation import control_point_count

#: Which segment is split next: that of the largest distance, by itself or per chord length.
MEASURES = ("relative", "distance")

# Stands for the length of a chord between equal poses, whose relative distance is largest.
_NO_LENGTH = 1e-30


class ChordSimplification(Selector):
    """Select frames where the curve of poses is farthest from the chords between keys.

    The method of Lim & Thalmann (2001), the baseline "curve simplification" of Halit 2010,
    section 4.1. A motion is a curve in the space of its joint angles, unwrapped, in degrees,
    without the root's translation. A segment between two keys is split at the frame farthest
    from the straight line through them; time does not matter for it, which is what sets the
    method apart from SCS. With p and q the ends of the segment and u = (q − p) / ‖q − p‖,

        distance(x) = ‖(x − p) − ((x − p)·u) u‖.

    The segment that is split next is that with the largest distance divided by ‖q − p‖, the
    significance by which Lowe (1987), whose algorithm it is, judges a segment, or with the
    largest distance itself. The source says neither, for want of a number of keys. On the
    clip that Halit calls "stretching" (CMU 13_29, 131 keys, published PSNR 40.20 dB) the first
    gives 39.4 dB, the second 45.3 dB, hence the default; the second is the better method.
    Of equal measures, that of the earlier frame counts.

    Only for motions, because the rows of a table have no order in time; for curves of
    numbers see :func:`chord_keyframes`.

    Parameters
    ----------
    measure : {"relative", "distance"}
        What decides which segment is split next.
    time_weight : float
        Degrees that a frame counts for, if time is to be one more coordinate; 0 ignores time.

    Raises
    ------
    WorkbenchError
        If a parameter is not valid; when selecting, if the space is a table, or ``count``
        leaves no room for the first and the last frame.

    Examples
    --------
    >>> from workbench import load_space
    >>> keys = ChordSimplification().select(load_space("cmu/01_01-jump"), 6)
    >>> len(keys), int(keys[0])
    (6, 0)
    """

    def __init__(self, measure: str = "relative", time_weight: float = 0.0) -> None:
        _check_options(measure, time_weight)
        self.measure = measure
        self.time_weight = time_weight

    def _select(self, space: Space, count: int, fixed: NDArray[np.intp]) -> NDArray[np.intp]:
        degrees = motion_to_euler(motion_of(space, "chord"), unwrap=True)
        keys = with_ends(fixed, len(space), count)
        return _split(degrees, keys, count, self.measure, self.time_weight)


def chord_keyframes(
    values: ArrayLike,
    count: int,
    fixed: Iterable[int] = (),
    *,
    measure: str = "relative",
    time_weight: float = 0.0,
) -> NDArray[np.intp]:
    """Select frames of curves by their distance from the chords between keys.

    :class:`ChordSimplification` for curves of numbers, such as the joint angles of a motion
    without a skeleton.

    Parameters
    ----------
    values : array-like of shape (n_frames, n_values)
        One row per frame, in the order of time; unwrap angles first.
    count : int
        How many frames to select, the first and the last included.
    fixed : iterable of int
        Frames that must be among them.
    measure, time_weight
        As in :class:`ChordSimplification`; the weight is in the unit of the values.

    Returns
    -------
    ndarray of shape (count,)
        Sorted.

    Raises
    ------
    WorkbenchError
        If an argument is not valid.

    Examples
    --------
    >>> chord_keyframes([[0, 0], [1, 0], [2, 0], [2, 1], [2, 2]], 3)
    array([0, 2, 4])
    """
    _check_options(measure, time_weight)
    curves = check_curves(values)
    count = control_point_count(len(curves), count=count)
    kept = fixed_samples(fixed, len(curves), count)
    return _split(curves, with_ends(kept, len(curves), count), count, measure, time_weight)


def _split(
    curves: NDArray[np.float64],
    keys: NDArray[np.intp],
    count: int,
    measure: str,
    time_weight: float,
) -> NDArray[np.intp]:
    if time_weight:
        curves = np.column_stack([curves, time_weight * np.arange(len(curves))])

    def worst_between(first: int, last: int) -> tuple[float, int]:
        offsets = curves[first + 1 : last] - curves[first]
        chord = curves[last] - curves[first]
        length = float(np.linalg.norm(chord))
        if length > 0.0:
            along = chord / length
            offsets -= np.outer(offsets @ along, along)
        found = np.linalg.norm(offsets, axis=1)
        if measure == "relative":
            found /= max(length, _NO_LENGTH)
        return worst_of(found, first + 1)

    return np.sort(split_at_worst(worst_between, keys, count))


def _check_options(measure: Any, time_weight: Any) -> None:
    if measure not in MEASURES:
        raise WorkbenchError(f"measure: got {measure!r}, want one of {', '.join(MEASURES)}")
    if not isinstance(time_weight, Real) or not 0.0 <= float(time_weight) < np.inf:
        raise WorkbenchError(f"time_weight: got {time_weight!r}, want a number of at least 0")
