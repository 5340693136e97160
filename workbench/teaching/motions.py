"""What lesson 5 measures of motions."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from workbench.spaces import PoseSpace


def facing_one_way(space: PoseSpace) -> PoseSpace:
    """Take the rotation of the root out of a motion, so that the body always faces one way.

    Parameters
    ----------
    space : PoseSpace
        The motion.

    Returns
    -------
    PoseSpace
        The same frames; all joints but the root are as they were.

    Examples
    --------
    >>> from workbench import load_space
    >>> turned = facing_one_way(load_space("cmu/01_03-walk"))
    >>> bool((turned.samples[:, 0] == np.eye(3)).all())
    True
    """
    rotations = space.motion.rotations.copy()
    rotations[:, 0] = np.eye(3)
    return PoseSpace(replace(space.motion, rotations=rotations))


def return_curve(distances: NDArray[np.float64], lags: Iterable[int]) -> dict[int, float]:
    """Measure how alike frames are that lie some number of frames apart.

    Parameters
    ----------
    distances : ndarray of shape (n_frames, n_frames)
        Between all frames.
    lags : iterable of int
        Numbers of frames, 1 to n_frames − 1.

    Returns
    -------
    dict of int to float
        Mean distance of frames i and i + lag, by the lag.

    Examples
    --------
    >>> circle = np.exp(2j * np.pi * np.arange(40) / 10)
    >>> curve = return_curve(np.abs(circle[:, None] - circle), range(5, 16))
    >>> min(curve, key=curve.get)
    10
    """
    return {lag: float(np.diagonal(distances, lag).mean()) for lag in lags}
