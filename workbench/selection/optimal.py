"""Exact selection of keyframes."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from workbench.errors import WorkbenchError
from workbench.selection.base import Selector, fixed_samples
from workbench.selection.best_paths import best_paths
from workbench.selection.tracks import check_interpolator, pose_track, with_ends
from workbench.spaces import Space, check_space
from workbench.validation import control_point_count, require_memory

OBJECTIVES = ("sum", "maximum")


@dataclass(frozen=True)
class OptimalPath:
    """The best keyframes for every count.

    Attributes
    ----------
    counts : ndarray of shape (n_counts,)
        Numbers of keyframes, from the least that is possible.
    keyframes : tuple of ndarray of shape (count,)
        Sorted keyframes for each count.
    objectives : ndarray of shape (n_counts,)
        The objective that they reach, in the unit of the space's errors.
    """

    counts: NDArray[np.intp]
    keyframes: tuple[NDArray[np.intp], ...]
    objectives: NDArray[np.float64]


class Optimal(Selector):
    """Select the keyframes that rebuild a motion best, of all that there are.

    The objective is the sum over all frames, or the largest, of D_q(frame, interpolated
    frame) / n_joints; the sum divided by the number of frames is the error per frame per joint
    of Costa 2018, chapter 5. It is minimised exactly, by dynamic programming (Bellman 1961),
    which is possible because a frame interpolated by slerp or linearly depends on its two
    neighbouring keys only. The first, the last and the fixed frames are keys. How legs between
    keys are left out of the computation without losing exactness is proven in
    :mod:`workbench.selection.best_paths`.

    It shows how much room selectors have: at 3 % of the frames of CMU 02_01, 05_10, 06_07 and
    09_06 uniform keys are 11 to 33 % above the optimal sum, SCS 1 to 35 % and PB 9 to 35 %.
    Time grows with the cube of the number of frames at worst; 1000 frames and 30 keys take
    10 to 20 seconds on two cores, all counts up to 30 at once about three times as long.

    Only for motions, because the rows of a table have no order in time.

    Parameters
    ----------
    interpolator : {"slerp", "linear"}
        How poses between keys are rebuilt: joint rotations by slerp, or unwrapped Euler
        angles linearly, as the interpolators of these names do.
    objective : {"sum", "maximum"}
        What is minimised.

    Raises
    ------
    WorkbenchError
        If a parameter is another; when selecting, if the space is a table, or ``count``
        leaves no room for the first and the last frame.

    Examples
    --------
    >>> from workbench import load_space
    >>> space = load_space("cmu/01_01-jump")
    >>> path = Optimal().path(space, 6)
    >>> path.counts
    array([2, 3, 4, 5, 6])
    >>> bool(np.all(np.diff(path.objectives) < 0))
    True
    """

    def __init__(self, interpolator: str = "slerp", objective: str = "sum") -> None:
        check_interpolator(interpolator)
        if objective not in OBJECTIVES:
            raise WorkbenchError(
                f"objective: got {objective!r}, want one of {', '.join(OBJECTIVES)}"
            )
        self.interpolator = interpolator
        self.objective = objective

    def path(self, space: Space, max_count: int, *, fixed: Iterable[int] = ()) -> OptimalPath:
        """Find the best keyframes for every count at once.

        Parameters
        ----------
        space : PoseSpace
            The motion.
        max_count : int
            The largest count.
        fixed : iterable of int
            Frames that must be among the keyframes.

        Returns
        -------
        OptimalPath
            From 2 keyframes on, or as many as must be.

        Raises
        ------
        WorkbenchError
            If an argument is not valid, or the space is a table.
        """
        check_space(space)
        most = control_point_count(len(space), count=max_count)
        found = self._best(space, most, fixed_samples(fixed, len(space), most), only=False)
        keyframes, objectives = zip(*found, strict=True)
        counts = np.array([len(keys) for keys in keyframes], dtype=np.intp)
        return OptimalPath(counts, keyframes, np.array(objectives))

    def _select(self, space: Space, count: int, fixed: NDArray[np.intp]) -> NDArray[np.intp]:
        [(keys, _)] = self._best(space, count, fixed, only=True)
        return keys

    def _best(
        self, space: Space, count: int, fixed: NDArray[np.intp], only: bool
    ) -> list[tuple[NDArray[np.intp], float]]:
        track = pose_track(space, self.interpolator, "optimal")
        stops = with_ends(fixed, len(space), count)
        require_memory(
            32.0 * count * len(space),
            f"{space.name or 'motion'}: the best of all {count} keyframes of {len(space)} frames",
            "select fewer, or use the selector 'scs'",
        )
        return list(best_paths(track, stops, count, self.objective == "maximum", only))
