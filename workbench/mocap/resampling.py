"""Change the frame rate of a motion."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from workbench.errors import WorkbenchError
from workbench.mocap.motion import Motion, check_motion
from workbench.mocap.slerp import slerp


def resample(motion: Motion, frame_time: float) -> Motion:
    """Sample a motion anew at equal steps of time.

    Rotations between two frames are interpolated by slerp, translations linearly. The
    first frame is kept; the last one is where a step meets it. Nothing is smoothed, so
    thinning a motion with fast vibrations folds them into slow ones.

    Parameters
    ----------
    motion : Motion
        The motion.
    frame_time : float
        Time between the new frames, in seconds.

    Returns
    -------
    Motion
        With ``floor(duration / frame_time) + 1`` frames.

    Raises
    ------
    WorkbenchError
        If the frame time is not a positive number.
    """
    check_motion(motion)
    if not 0 < frame_time < np.inf:
        raise WorkbenchError(f"frame_time: got {frame_time}, want seconds above 0")
    last = len(motion) - 1
    step = frame_time / motion.frame_time
    # The allowance keeps the last frame when the quotient is an integer up to rounding.
    count = int(np.floor(last / step * (1.0 + 1e-9))) + 1
    time = np.minimum(np.arange(count) * step, last)
    nearest = np.round(time)
    time = np.where(np.abs(time - nearest) < 1e-9 * max(last, 1), nearest, time)
    before = np.floor(time).astype(np.intp)
    after = np.minimum(before + 1, last)
    fraction = time - before

    def between(values: NDArray[np.float64]) -> NDArray[np.float64]:
        return values[before] + fraction[:, None] * (values[after] - values[before])

    return replace(
        motion,
        rotations=slerp(motion.rotations[before], motion.rotations[after], fraction[:, None]),
        root_translation=between(motion.root_translation),
        frame_time=frame_time,
        joint_translations={j: between(t) for j, t in motion.joint_translations.items()},
    )
