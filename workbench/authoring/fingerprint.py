"""Telling whether a clip is the one that a session was made with."""

from __future__ import annotations

import hashlib
import json

import numpy as np

from workbench.mocap.motion import Motion, check_motion


def clip_fingerprint(motion: Motion) -> str:
    """Make a checksum of a clip's joint names and rotations.

    Parameters
    ----------
    motion : Motion
        The clip.

    Returns
    -------
    str
        SHA-256 in hexadecimal digits. Rotations count to six decimals, as computers differ in
        the last ones.
    """
    check_motion(motion)
    names = json.dumps([len(motion), *motion.skeleton.names])
    millionths = np.rint(np.asarray(motion.rotations) * 1e6).astype("<i4")
    return hashlib.sha256(names.encode() + millionths.tobytes()).hexdigest()
