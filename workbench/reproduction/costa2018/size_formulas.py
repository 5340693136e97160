"""Sizes of compacted motion by Eq. 5.1 to 5.3 of Costa 2018, counted in numbers.

They count what has to be stored and not how exactly: a number may take 4 bytes, or 2.
"""

from __future__ import annotations

#: Joints of the skeletons in the thesis.
N_JOINTS = 31
#: Numbers of the root's position, stored for every frame.
_ROOT = 3


def whole_size(n_frames: int, *, n_joints: int = N_JOINTS, header: float = 0.0) -> float:
    """Count the numbers of a whole motion: m(f) = h + f (3 dof + 3), Eq. 5.1.

    Parameters
    ----------
    n_frames : int
        f.
    n_joints : int
        dof: three angles for each joint.
    header : float
        h: the skeleton and other constants.

    Returns
    -------
    float

    Examples
    --------
    >>> whole_size(100)
    9600.0
    """
    return header + n_frames * (3 * n_joints + _ROOT)


def temporal_size(
    n_frames: int, ratio: float, *, n_joints: int = N_JOINTS, header: float = 0.0
) -> float:
    """Count the numbers that a temporal scheme stores: h + f (r (3 dof + 1) + 3), Eq. 5.2.

    Keyframes have angles and their time; the root's path is stored whole.

    Parameters
    ----------
    n_frames, n_joints, header
        As for :func:`whole_size`.
    ratio : float
        r, the share of the frames that are keyframes.

    Returns
    -------
    float

    Examples
    --------
    >>> round(100 * temporal_size(10**6, 0.03) / whole_size(10**6), 2)
    6.06
    """
    return header + n_frames * (ratio * (3 * n_joints + 1) + _ROOT)


def spatial_size(
    n_frames: int,
    ratio: float,
    *,
    dimensions: int = 2,
    n_joints: int = N_JOINTS,
    header: float = 0.0,
) -> float:
    """Count the numbers that a spatial scheme stores: h + f (r (3 dof + 1) + 5), Eq. 5.3.

    The position of every frame comes on top of what a temporal scheme stores; in three
    dimensions it is one number more.

    Parameters
    ----------
    n_frames, ratio, n_joints, header
        As for :func:`temporal_size`.
    dimensions : int
        Numbers of a position.

    Returns
    -------
    float

    Examples
    --------
    >>> round(100 * spatial_size(10**6, 0.03) / whole_size(10**6), 2)
    8.15
    """
    return temporal_size(n_frames, ratio, n_joints=n_joints, header=header) + n_frames * dimensions


def temporal_limit(ratio: float, n_joints: int = N_JOINTS) -> float:
    """Give the limit of Eq. 5.2 over Eq. 5.1 for many frames, where the header vanishes.

    Examples
    --------
    >>> round(temporal_limit(0.03), 4)
    0.0606
    """
    return temporal_size(1, ratio, n_joints=n_joints) / whole_size(1, n_joints=n_joints)


def spatial_limit(ratio: float, n_joints: int = N_JOINTS, dimensions: int = 2) -> float:
    """Give the limit of Eq. 5.3 over Eq. 5.1 for many frames.

    Examples
    --------
    >>> round(spatial_limit(0.03), 4)
    0.0815
    """
    size = spatial_size(1, ratio, dimensions=dimensions, n_joints=n_joints)
    return size / whole_size(1, n_joints=n_joints)


def equal_size_difference(n_joints: int = N_JOINTS, dimensions: int = 2) -> float:
    """Give the keyframe ratio that a temporal scheme has more at equal size: 2 / (3 dof + 1).

    Examples
    --------
    >>> round(100 * equal_size_difference(), 2)
    2.13
    """
    return dimensions / (3 * n_joints + 1)
