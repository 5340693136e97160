"""When the feet stand on the ground."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from workbench.mocap.contacts import find_feet
from workbench.mocap.kinematics import joint_positions
from workbench.mocap.motion import Motion
from workbench.mocap.sides import joint_sides

#: How far above its lowest a standing foot may be, and how fast it may move in a second, as
#: shares of the leg's length: heels rise before toes do, and a swinging foot is five times as fast.
NEAR, SLOW = 0.08, 0.6

#: Seconds that a contact lasts at least, and that one is not interrupted by.
SHORTEST = 0.05

_LOWEST = 5.0  # percentile that stands for a foot's lowest height, whatever single frames say
_HEIGHT = 1  # the axis that points up


@dataclass(frozen=True, eq=False)
class FootContacts:
    """When one foot stands on the ground.

    Attributes
    ----------
    joint : str
        Name of the foot's joint.
    side : {"left", "right", "middle"}
        Side of the body.
    spans : ndarray of shape (n_contacts, 2)
        First and last frame of each contact, in order of time.
    """

    joint: str
    side: str
    spans: NDArray[np.intp]


def foot_contacts(motion: Motion, feet: Iterable[str] | None = None) -> list[FootContacts]:
    """Find the frames in which the feet stand on the ground.

    A foot stands where it is near its lowest height and hardly moves; both are measured by the
    leg, the median height of the root above the lower foot. Contacts that are interrupted for
    less than 0.05 s are joined, shorter ones left out.

    Parameters
    ----------
    motion : Motion
        The clip, y up.
    feet : iterable of str, optional
        Names of the feet's joints; by default
        :func:`~workbench.mocap.contacts.find_feet` finds them.

    Returns
    -------
    list of FootContacts
        One for each foot.

    Raises
    ------
    WorkbenchError
        If there are no joints of these names, or no feet are found.

    Examples
    --------
    >>> from workbench.datasets import load_space
    >>> left, right = foot_contacts(load_space("cmu/01_01-jump").motion)
    >>> left.joint, right.side
    ('LeftFoot', 'right')
    """
    joints = find_feet(motion, feet)
    positions = joint_positions(motion)
    heights = positions[:, list(joints), _HEIGHT]
    leg = float(np.median(positions[:, 0, _HEIGHT] - heights.min(axis=1)))
    ground = np.percentile(heights, _LOWEST, axis=0)
    speeds = np.zeros_like(heights)
    if len(motion) > 1:
        velocities = np.gradient(positions[:, list(joints)], motion.frame_time, axis=0)
        speeds = np.linalg.norm(velocities, axis=2)
    stands = (heights <= ground + NEAR * leg) & (speeds <= SLOW * leg)
    shortest = max(1, round(SHORTEST / motion.frame_time))
    names, sides = motion.skeleton.names, joint_sides(motion.skeleton.names)
    return [
        FootContacts(names[joint], sides[joint], steady_spans(stands[:, foot], shortest))
        for foot, joint in enumerate(joints)
    ]


def steady_spans(holds: NDArray[np.bool_], shortest: int) -> NDArray[np.intp]:
    """Find where something holds for a while.

    Parameters
    ----------
    holds : ndarray of bool, of shape (n_frames,)
        Whether it does.
    shortest : int
        Frames that a span has at least, and that an interruption has at least.

    Returns
    -------
    ndarray of shape (n_spans, 2)
        First and last frame of each.

    Examples
    --------
    >>> steady_spans(np.array([1, 1, 0, 1, 0, 0, 0, 1, 0, 0], dtype=bool), 2)
    array([[0, 3]])
    """
    edges = np.flatnonzero(np.diff(np.concatenate([[False], holds, [False]]).astype(np.int8)))
    spans = edges.reshape(-1, 2)
    if len(spans):
        apart = spans[1:, 0] - spans[:-1, 1] >= shortest
        first = np.concatenate([[True], apart])
        last = np.concatenate([apart, [True]])
        spans = np.stack([spans[first, 0], spans[last, 1]], axis=1)
        spans = spans[spans[:, 1] - spans[:, 0] >= shortest]
    return (spans - [0, 1]).astype(np.intp)
