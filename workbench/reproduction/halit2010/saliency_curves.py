"""Figures 3.3 and 3.4 of Halit 2010: saliency and candidates on curves of a walk."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from workbench.datasets import load
from workbench.errors import WorkbenchError
from workbench.mocap.channels import motion_to_euler, rotation_columns
from workbench.mocap.curve_saliency import curve_saliency
from workbench.mocap.motion import Motion
from workbench.mocap.motion_saliency import MotionSaliency
from workbench.reproduction.halit2010.motions import CALM, PARAMETERS
from workbench.reproduction.profiles import motion_clips
from workbench.selection.saliency import Saliency

#: The joint whose curve is shown: the knee bends twice in each stride.
JOINT = "RightLeg"

_BUNDLED_WALK, _WALK = "cmu/01_03-walk", "cmu/05_01"


@dataclass(frozen=True, eq=False)
class JointCurve:
    """The curve of one joint angle, and how salient its frames are.

    Attributes
    ----------
    seconds : ndarray of shape (n_frames,)
        Time of each frame.
    degrees : ndarray of shape (n_frames,)
        The angle.
    saliency : ndarray of shape (n_frames,)
        In units of its mean, above which a frame is a candidate.
    """

    seconds: NDArray[np.float64]
    degrees: NDArray[np.float64]
    saliency: NDArray[np.float64]

    @property
    def candidates(self) -> NDArray[np.bool_]:
        """Frames more salient than the mean, as an array of shape (n_frames,)."""
        return self.saliency > 1.0


def walk_of(profile: str) -> str:
    """Choose the walk that a profile shows: a bundled one, or a longer one where it is found."""
    return _WALK if profile == "full" and _WALK in motion_clips(profile) else _BUNDLED_WALK


def joint_curve(clip: str, joint: str = JOINT) -> JointCurve:
    """Compute the saliency of the frames of one joint's curve.

    Parameters
    ----------
    clip : str
        Name of a motion.
    joint : str
        Name of a joint, of whose angles the one that varies most is taken; standardised, as
        the method does with columns.

    Returns
    -------
    JointCurve

    Raises
    ------
    WorkbenchError
        If the motion has no such joint, or it does not turn.
    """
    motion = _motion(clip)
    names = list(motion.skeleton.names)
    if joint not in names:
        raise WorkbenchError(f"joint: got {joint!r}, want one of {', '.join(names)}")
    angles = motion_to_euler(motion, unwrap=True)
    angles = angles[:, rotation_columns(motion.skeleton)[names.index(joint)]]
    spreads = angles.std(axis=0)
    if not spreads.size or spreads.max() == 0.0:
        raise WorkbenchError(f"joint: {joint!r} does not turn in {clip}")
    degrees = angles[:, int(np.argmax(spreads))]
    standardized = (degrees - degrees.mean()) / degrees.std()
    saliency = curve_saliency(standardized[:, None], PARAMETERS[CALM][0])[:, 0]
    seconds = np.arange(len(degrees), dtype=np.float64) * float(motion.frame_time)
    return JointCurve(seconds, degrees, saliency / saliency.mean())


def walk_saliency(clip: str) -> MotionSaliency:
    """Compute the saliency of a walk with the parameters of Tables 4.1 and 4.2."""
    sigma, n_components = PARAMETERS[CALM]
    return Saliency(sigma, n_components).measure(_motion(clip))


def _motion(clip: str) -> Motion:
    motion = load(clip)
    if not isinstance(motion, Motion):
        raise WorkbenchError(f"clip: {clip} is a table, want a motion")
    return motion
