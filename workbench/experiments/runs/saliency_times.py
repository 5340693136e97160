"""Runs that time the saliency method on long motions."""

from __future__ import annotations

import time
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.experiments.runs.keyframes import motion_curves
from workbench.experiments.runs.shared import SharedSteps
from workbench.experiments.store import Arrays, Row
from workbench.mocap.motion_saliency import motion_saliency

#: Enough frames to load the compiled kernels, which is no part of the method.
_WARM_UP_FRAMES = 500


@dataclass(frozen=True)
class SaliencyTimeRun:
    """The time of the saliency method on a motion of any length.

    The motion is a clip played forth and back, again and again, so that its curves have no
    jump. Timed is everything from joint angles to keyframes.

    Parameters
    ----------
    dataset : str
        Name that :func:`workbench.load_space` knows, or the path of a file; a clip, or a table
        of joint angles.
    n_frames : int
        Length of the motion.
    sigma : float
        σ in frames.
    n_components : int
        k.
    repetition : int
        Tells apart runs that measure the same again.

    Examples
    --------
    >>> print(SaliencyTimeRun("cmu/01_01", 10_000, repetition=2))
    cmu/01_01, 10000 frames, repetition 2
    """

    dataset: str
    n_frames: int
    sigma: float = 10.0
    n_components: int = 7
    repetition: int = 0

    @property
    def standardize(self) -> bool:
        """The columns are standardised by the method itself."""
        return False

    def __str__(self) -> str:
        return f"{self.dataset}, {self.n_frames} frames, repetition {self.repetition}"

    def specification(self) -> dict[str, Any]:
        """Describe the run by plain values, as stored with its result."""
        return asdict(self)

    def execute(self, shared: SharedSteps) -> tuple[Row, Arrays]:
        """Execute the run.

        Parameters
        ----------
        shared : SharedSteps
            The motion.

        Returns
        -------
        row : dict
            ``n_control_points`` and ``seconds_total``.
        arrays : dict of str to ndarray
            None.
        """
        values = played_forth_and_back(motion_curves(shared.space), self.n_frames)
        motion_saliency(values[:_WARM_UP_FRAMES], self.sigma, self.n_components)
        start = time.perf_counter()
        keyframes = motion_saliency(values, self.sigma, self.n_components).keyframes
        seconds = time.perf_counter() - start
        row: Row = {
            "n_samples": len(shared.space),
            "n_control_points": len(keyframes),
            "seconds_total": seconds,
        }
        return row, {}


def played_forth_and_back(values: NDArray[np.float64], n_frames: int) -> NDArray[np.float64]:
    """Lengthen curves without a jump, or cut them.

    Parameters
    ----------
    values : ndarray of shape (n_values, n_curves)
        At least 2 rows.
    n_frames : int
        Rows wanted.

    Returns
    -------
    ndarray of shape (n_frames, n_curves)

    Examples
    --------
    >>> played_forth_and_back(np.array([[0.0], [1.0], [2.0]]), 7).ravel()
    array([0., 1., 2., 1., 0., 1., 2.])
    """
    last = len(values) - 1
    return values[last - np.abs(np.arange(n_frames) % (2 * last) - last)]
