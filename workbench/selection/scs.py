"""Simple curve simplification."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from workbench.selection.base import Selector
from workbench.selection.splitting import split_at_worst
from workbench.selection.tracks import check_interpolator, pose_track, with_ends
from workbench.selection.worst_frames import WorstFrames
from workbench.spaces import Space


class SimpleCurveSimplification(Selector):
    """Select, one after the other, the frame that the keys so far rebuild worst.

    The keys start as the first, the last and the fixed frames; each further one is the frame
    with the largest D_q(frame, interpolated frame). (Costa 2018, Alg. 1, "SCS"; the
    "reconstructed frame set" read as slerp between the keys, so that all schemes are compared
    on the same keys.) Of equal errors, that of the earlier frame counts. Keys are nested: a
    larger count adds keys and keeps the others. Most frames are known not to be the worst
    without computing their errors (:mod:`workbench.selection.worst_frames`).

    Only for motions, because the rows of a table have no order in time.

    Parameters
    ----------
    interpolator : {"slerp", "linear"}
        How poses between keys are rebuilt: joint rotations by slerp, or unwrapped Euler
        angles linearly, as the interpolators of these names do.

    Raises
    ------
    WorkbenchError
        If the interpolator is another; when selecting, if the space is a table, or ``count``
        leaves no room for the first and the last frame.

    Examples
    --------
    >>> from workbench import load_space
    >>> space = load_space("cmu/01_01-jump")
    >>> keys = SimpleCurveSimplification().select(space, 6)
    >>> set(keys) < set(SimpleCurveSimplification().select(space, 9))
    True
    """

    def __init__(self, interpolator: str = "slerp") -> None:
        check_interpolator(interpolator)
        self.interpolator = interpolator

    def _select(self, space: Space, count: int, fixed: NDArray[np.intp]) -> NDArray[np.intp]:
        track = pose_track(space, self.interpolator, "scs")
        keys = with_ends(fixed, len(space), count)
        return np.sort(split_at_worst(WorstFrames(track).between, keys, count))
