"""Which way is up: what keeps feet on the ground takes y for it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from workbench.errors import WorkbenchError
from workbench.mocap.motion import Motion
from workbench.mocap.skeleton import Skeleton

#: Height of the root above the feet, as a share of the way to them along the bones, from which
#: on y is up. It is 0.9 where a body stands, and about 0 where y is a horizontal axis.
UPRIGHT = 0.25


def check_upright(motion: Motion, feet: Sequence[int], heights: NDArray[np.float64]) -> None:
    """Refuse a motion whose feet are not below its root.

    Parameters
    ----------
    motion : Motion
        The motion.
    feet : sequence of int
        The joints of its feet.
    heights : ndarray of shape (n_frames, n_feet)
        Their heights, in file units.

    Raises
    ------
    WorkbenchError
        If the root is not clearly above them in half of the frames: y is not up.
    """
    # Both feet: the hind one alone is far behind the root in a walk along a horizontal y.
    above = float(np.median(motion.root_translation[:, 1] - heights.mean(axis=1)))
    way = max(_way(motion.skeleton, foot) for foot in feet)
    if above <= UPRIGHT * way:
        raise WorkbenchError(
            f"motion: got a root {above:.3g} above the feet, which are {way:.3g} away along the "
            "bones: want y up"
        )


def _way(skeleton: Skeleton, joint: int) -> float:
    """Measure the way from the root to a joint."""
    way = 0.0
    while joint > 0:
        way += float(np.linalg.norm(skeleton.offsets[joint]))
        joint = int(skeleton.parents[joint])
    return way
