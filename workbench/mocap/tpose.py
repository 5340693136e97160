"""Find and drop the T-pose that some releases put in front of a motion."""

from __future__ import annotations

import numpy as np

from workbench.mocap.motion import Motion, check_motion
from workbench.mocap.rotations import geodesic_angles

# On 36 clips of the CMU conversion, at 120 frames a second, the jump out of the T-pose is 21
# to 76 times the median jump and 0.70 to 0.85 of the moving joints are at rest in it. Jumps
# alone do not tell, in the middle of a clip they reach 27 times the median. The factor leaves
# room for clips thinned to 30 frames a second, where the T-pose stands out four times less.
_JUMP_FACTOR = 4.0
_REST_FRACTION = 0.6
_REST_ANGLE = np.radians(0.05)


def has_tpose(motion: Motion) -> bool:
    """Tell whether a motion begins with a rest pose that is not part of it.

    Conversions of the CMU data put one such frame first, and it distorts everything that
    is computed from differences between frames. It is recognised by two signs together:
    the joints jump from the first frame to the second many times farther than they ever
    usually move, and most joints of the first frame are at rest, which a body in motion
    never is.

    Parameters
    ----------
    motion : Motion
        The motion; with fewer than three frames there is nothing to compare with.

    Returns
    -------
    bool
    """
    check_motion(motion)
    if len(motion) < 3:
        return False
    turns = geodesic_angles(motion.rotations[1:], motion.rotations[:-1]).mean(axis=1)
    jumps = turns[0] > _JUMP_FACTOR * np.median(turns[1:])
    # A joint that rests in the second frame too (the file does not move it) tells nothing.
    identity = np.eye(3)
    moving = geodesic_angles(motion.rotations[1], identity) > _REST_ANGLE
    resting = geodesic_angles(motion.rotations[0], identity) <= _REST_ANGLE
    return bool(jumps and moving.any() and resting[moving].mean() >= _REST_FRACTION)


def drop_tpose(motion: Motion) -> Motion:
    """Drop the first frame where it is a T-pose; leave every other motion as it is.

    Readers never do this by themselves: call it where the motion is analysed.

    Parameters
    ----------
    motion : Motion
        The motion.

    Returns
    -------
    Motion
        The motion from its second frame on if :func:`has_tpose`, else the motion itself.
    """
    return motion[1:] if has_tpose(motion) else motion
