"""Keeping the feet from sliding: the root is recomputed from the foot that stands.

Interpolated poses know nothing of the ground: feet slide over it, sink into it or hover. The
root is what can be moved without changing the pose (Costa 2018, chapter 6).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from workbench.authoring.upright import check_upright
from workbench.errors import WorkbenchError
from workbench.mocap.contacts import find_feet
from workbench.mocap.kinematics import end_site_positions, joint_positions
from workbench.mocap.motion import Motion, check_motion
from workbench.mocap.skeleton import Skeleton

#: Height above the ground, as a share of the leg's length, up to which the lowest foot stands.
STANDING = 0.04

#: Seconds without a foot on the ground up to which they are a leap, and on both sides of it in
#: which the speed of the body is measured.
LEAP, AROUND = 1.0, 0.06

_LOWEST = 10.0  # percentile of the lower foot's heights that is the ground
_UP = 1
_ACROSS = [0, 2]


@dataclass(frozen=True, eq=False)
class Support:
    """Which foot carries the body in each frame, if one does.

    Attributes
    ----------
    foot : ndarray of shape (n_frames,)
        The lower foot: a rank in what :func:`foot_points` gives.
    stands : ndarray of bool, of shape (n_frames,)
        Whether it is on the ground; else the body is in the air.
    ground : float
        Height of the ground at the feet, in file units.
    """

    foot: NDArray[np.intp]
    stands: NDArray[np.bool_]
    ground: float


def foot_points(motion: Motion, feet: Iterable[str] | None = None) -> NDArray[np.float64]:
    """Compute where the feet touch the ground: at their balls.

    The first joint below the foot's own is taken, else the foot's end, else the joint itself.
    This point rests while the heel rises: on 32 clips of the CMU database, a root that keeps
    it in place drifts from the one that was captured half as fast as with the tips of the toes.

    Parameters
    ----------
    motion : Motion
        The motion.
    feet : iterable of str, optional
        Names of the feet's joints; by default
        :func:`~workbench.mocap.contacts.find_feet` finds them.

    Returns
    -------
    ndarray of shape (n_frames, n_feet, 3)
        World positions, in file units.

    Raises
    ------
    WorkbenchError
        If no feet are found.
    """
    joints, ends = joint_positions(motion), end_site_positions(motion)
    nodes = np.concatenate([joints, ends], axis=1)
    return nodes[:, [_ball(motion.skeleton, foot) for foot in find_feet(motion, feet)]]


def ground_level(motion: Motion, feet: Iterable[str] | None = None) -> float:
    """Estimate the height of the ground: the lower foot's tenth percentile.

    Parameters
    ----------
    motion : Motion
        A clip in which the feet stand in some of the frames, y up.
    feet : iterable of str, optional
        As :func:`foot_points` takes them.

    Returns
    -------
    float
        Height of the balls of the feet on the ground, in file units.

    Raises
    ------
    WorkbenchError
        If no feet are found, or the root is not above them.
    """
    heights = foot_points(motion, feet)[:, :, _UP]
    check_upright(motion, find_feet(motion, feet), heights)
    return float(np.percentile(heights.min(axis=1), _LOWEST))


def find_support(
    motion: Motion, ground: float | None = None, feet: Iterable[str] | None = None
) -> Support:
    """Find the foot that carries the body, frame by frame.

    It is the lower one. It stands up to 4 % of the leg's length above the ground, and wherever
    it has sunk into it; else the body is in the air, so that a jump stays one.

    Parameters
    ----------
    motion : Motion
        The motion, y up.
    ground : float, optional
        Height of the ground at the feet, by default the motion's own :func:`ground_level`.
    feet : iterable of str, optional
        As :func:`foot_points` takes them.

    Returns
    -------
    Support

    Raises
    ------
    WorkbenchError
        If no feet are found or the ground is not finite; without a ground also if the root is
        not above the feet.
    """
    heights = foot_points(motion, feet)[:, :, _UP]
    level = ground_level(motion, feet) if ground is None else float(ground)
    if not np.isfinite(level):
        raise WorkbenchError(f"ground: got {ground!r}, want a height")
    lowest = heights.min(axis=1)
    leg = float(np.median(motion.root_translation[:, _UP] - lowest))
    leg = leg if leg > 0 else float(np.linalg.norm(motion.skeleton.offsets[1:], axis=1).sum())
    stands = lowest - level <= STANDING * (leg or 1.0)
    return Support(heights.argmin(axis=1), stands, level)


def keep_feet(
    motion: Motion, support: Support | None = None, feet: Iterable[str] | None = None
) -> Motion:
    """Move the root so that the foot that carries the body rests on the ground.

    From frame to frame the root goes by as much as the supporting foot would have slid, in the
    other direction; so its path has no jump where the other foot takes over. Its height puts
    the foot on the ground:

        x(t) = x(t − 1) + q(t − 1) − q(t),    y(t) = y₀(t) − h(t)

    with y₀ the height before, q the foot as seen from the root and h its height above the
    ground. Between the frames in which a foot stands, h is taken to change evenly, so that
    nothing jumps. In a leap of up to a second x goes on evenly too, from the speed that the
    body had before to that after it: root positions that were interpolated between spatial
    keyframes jump where a motion comes back to a pose at another place. Where no foot stands
    for longer, the root keeps the steps that it had.

    Parameters
    ----------
    motion : Motion
        The motion, y up.
    support : Support, optional
        Which foot carries; by default :func:`find_support` finds it in the motion itself.
    feet : iterable of str, optional
        As :func:`foot_points` takes them.

    Returns
    -------
    Motion
        With another path of the root and nothing else changed.

    Raises
    ------
    WorkbenchError
        If no feet are found, or the support is of another motion.

    References
    ----------
    Costa 2018, chapter 6: the lowest foot end effector keeps its place at ground level.

    Examples
    --------
    >>> from workbench import load_space
    >>> jump = load_space("cmu/01_01-jump").motion
    >>> support = find_support(jump)
    >>> before, after = foot_speeds(jump, support), foot_speeds(keep_feet(jump, support), support)
    >>> bool(before.max() > 1.0), bool(after.max() < 1e-9)
    (True, True)
    """
    check_motion(motion)
    points = foot_points(motion, feet)
    support = _fitting(motion, support, feet)
    root = np.array(motion.root_translation, dtype=np.float64)
    every = np.arange(len(motion))
    if support.stands.any():
        height = points[every, support.foot, _UP] - support.ground
        root[:, _UP] -= np.interp(every, every[support.stands], height[support.stands])
    seen = points - motion.root_translation[:, None]
    steps = -_steps(seen, support.foot)[:, _ACROSS]
    stands = _stands(support)
    steps[~stands] = np.diff(root[:, _ACROSS], axis=0)[~stands]
    _leap(steps, stands, motion.frame_time)
    root[1:, _ACROSS] = root[0, _ACROSS] + np.cumsum(steps, axis=0)
    return replace(motion, root_translation=root)


def foot_speeds(
    motion: Motion, support: Support | None = None, feet: Iterable[str] | None = None
) -> NDArray[np.float64]:
    """Measure how fast the supporting foot slides over the ground.

    Parameters
    ----------
    motion : Motion
        The motion, y up.
    support : Support, optional
        Which foot carries; by default :func:`find_support` finds it in the motion itself. To
        compare a motion before and after :func:`keep_feet`, give that from before to both.
    feet : iterable of str, optional
        As :func:`foot_points` takes them.

    Returns
    -------
    ndarray of shape (n_frames,)
        Horizontal speed on the way from the frame before, in file units per second; 0 for the
        first frame and where no foot stands.

    Raises
    ------
    WorkbenchError
        If no feet are found, or the support is of another motion.
    """
    check_motion(motion)
    support = _fitting(motion, support, feet)
    slid = _steps(foot_points(motion, feet), support.foot)[:, _ACROSS]
    speeds = np.linalg.norm(slid, axis=1) / motion.frame_time
    return np.concatenate([[0.0], np.where(_stands(support), speeds, 0.0)])


def _ball(skeleton: Skeleton, foot: int) -> int:
    """Find the node of a foot's ball; nodes beyond the last joint are end sites."""
    below = np.flatnonzero(skeleton.parents == foot)
    if len(below):
        return int(below[0])
    ends = [rank for rank, site in enumerate(skeleton.end_sites) if site.joint == foot]
    return skeleton.n_joints + ends[0] if ends else foot


def _steps(points: NDArray[np.float64], foot: NDArray[np.intp]) -> NDArray[np.float64]:
    """Measure how far the foot that carries has come since the frame before: (n_frames − 1, 3)."""
    steps = np.diff(points, axis=0)
    moved: NDArray[np.float64] = steps[np.arange(len(steps)), foot[1:]]
    return moved


def _stands(support: Support) -> NDArray[np.bool_]:
    """Tell on which ways from frame to frame a foot stands: (n_frames − 1,)."""
    return support.stands[1:] & support.stands[:-1]


def _leap(steps: NDArray[np.float64], stands: NDArray[np.bool_], frame_time: float) -> None:
    """Replace the steps of short spans in the air by even ones: (n_frames − 1, 2)."""
    reach = max(1, round(AROUND / frame_time))
    edges = np.flatnonzero(np.diff(np.concatenate([[True], stands, [True]]).astype(np.int8)))
    for first, last in edges.reshape(-1, 2).tolist():
        around = [
            span
            for ways in (slice(max(0, first - reach), first), slice(last, last + reach))
            if len(span := steps[ways][stands[ways]])
        ]
        if around and (last - first) * frame_time <= LEAP:
            rise = np.arange(1, last - first + 1)[:, None] / (last - first + 1)
            start, end = around[0].mean(axis=0), around[-1].mean(axis=0)
            steps[first:last] = (1.0 - rise) * start + rise * end


def _fitting(motion: Motion, support: Support | None, feet: Iterable[str] | None) -> Support:
    if support is None:
        return find_support(motion, feet=feet)
    if support.foot.shape != (len(motion),):
        raise WorkbenchError(
            f"support: got {len(support.foot)} frames, want the {len(motion)} of the motion"
        )
    return support
