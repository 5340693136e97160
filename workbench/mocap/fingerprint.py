"""Telling whether a clip is the one that something was made with."""

from __future__ import annotations

import hashlib
import json

import numpy as np

from workbench.mocap.motion import Motion, check_motion


def clip_fingerprint(motion: Motion) -> str:
    """Make a checksum of a clip's skeleton, rotations and root path.

    Files that refer to a clip keep it, so that another clip of the same name is refused.

    Parameters
    ----------
    motion : Motion
        The clip.

    Returns
    -------
    str
        SHA-256 in hexadecimal digits. Numbers count to six decimals, as computers differ in
        the last ones.

    Raises
    ------
    WorkbenchError
        If it is no motion.

    Examples
    --------
    >>> from workbench.datasets import load
    >>> jump = load("cmu/01_01-jump")
    >>> clip_fingerprint(jump) == clip_fingerprint(jump[:-1])
    False
    """
    check_motion(motion)
    names = [len(motion), *motion.skeleton.names, *motion.skeleton.parents.tolist()]
    digest = hashlib.sha256(json.dumps(names).encode())
    for numbers in (motion.skeleton.offsets, motion.rotations, motion.root_translation):
        # Zeros may have a sign, which means nothing.
        digest.update((np.round(numbers, 6) + 0.0).astype("<f8").tobytes())
    return digest.hexdigest()
