"""Feet: which joints they are, and how high above the ground."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from difflib import get_close_matches
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.errors import WorkbenchError
from workbench.mocap.kinematics import joint_positions
from workbench.mocap.motion import Motion, check_motion
from workbench.mocap.skeleton import Skeleton

#: Names that a foot goes by, the best first: the toes turn and rise while the foot stands.
PARTS = ("foot", "feet", "ankle", "toe", "toes", "toebase", "ball")
_SIDES = {"left": "left", "l": "left", "right": "right", "r": "right"}
_WORD = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+")
_JOINED = re.compile(rf"(left|right|l|r)({'|'.join(PARTS)})")

_AXES = ("x", "y", "z")


def find_feet(
    motion: Motion, feet: Iterable[str] | None = None, *, up: str = "y"
) -> tuple[int, ...]:
    """Find the joints of the feet: as named, else by common names, else by height.

    Parameters
    ----------
    motion : Motion
        The clip.
    feet : iterable of str, optional
        Names of the feet's joints, as the file writes them; of joints with one name the
        first is meant. By default :func:`feet_by_name` looks for both feet, and where names
        do not tell, :func:`feet_by_height` takes the lowest ends of the body.
    up : {"x", "y", "z"}
        The axis that points up, y in BVH and ASF files.

    Returns
    -------
    tuple of int
        Indices of joints.

    Raises
    ------
    WorkbenchError
        If there is no joint of a name, or neither names nor heights tell.
    """
    check_motion(motion)
    if feet is not None:
        single = isinstance(feet, str) or not isinstance(feet, Iterable)
        return _named(motion.skeleton, [feet] if single else list(feet))
    return feet_by_name(motion.skeleton) or feet_by_height(motion, up=up)


def feet_by_name(skeleton: Skeleton, parts: Sequence[str] = PARTS) -> tuple[int, ...]:
    """Find the left and the right foot by their names.

    Understands what motion files call them: ``LeftFoot``, ``lfoot``, ``L_Foot``, ``foot.R``,
    ``mixamorig:LeftFoot``, ``Bip01 L Foot``, ``RightAnkle``, ``ltoes``.

    Parameters
    ----------
    skeleton : Skeleton
        The joints.
    parts : sequence of str
        Parts of the body that count as feet, out of ``PARTS``, the best first.

    Returns
    -------
    tuple of int
        Indices of the left and the right foot, else of the ankles, else of the toes, of
        several that of the first joint; empty where a side has none.

    Examples
    --------
    >>> names = ("Hips", "mixamorig:LeftToe_End", "mixamorig:LeftFoot", "foot.R")
    >>> feet_by_name(Skeleton(names, [-1, 0, 0, 0], np.zeros((4, 3)), (), ((),) * 4))
    (2, 3)
    """
    best: dict[str, tuple[int, int]] = {}
    for joint, name in enumerate(skeleton.names):
        side, part = _side_and_part(name)
        if side and part in parts:
            rank = (parts.index(part), joint)
            best[side] = min(best.get(side, rank), rank)
    if len(best) < 2:
        return ()
    return best["left"][1], best["right"][1]


def feet_by_height(motion: Motion, *, up: str = "y") -> tuple[int, ...]:
    """Find the feet as the two lowest ends of the body, on average over the clip.

    Two ends are on different limbs, and not toes of one foot, if less than half of the way
    from the root to the second is common to both.

    Parameters
    ----------
    motion : Motion
        The clip.
    up : {"x", "y", "z"}
        The axis that points up.

    Returns
    -------
    tuple of int
        Two joints that carry no others, in the order of the skeleton.

    Raises
    ------
    WorkbenchError
        If the body has no two limbs.
    """
    skeleton = motion.skeleton
    leaves = np.setdiff1d(np.arange(skeleton.n_joints), skeleton.parents)
    heights = joint_positions(motion)[:, leaves, _axis(up)].mean(axis=0)
    lengths = np.linalg.norm(skeleton.offsets, axis=1)
    lengths[0] = 0.0  # where the root stands is no bone
    first, *others = leaves[np.argsort(heights, kind="stable")].tolist()
    first_path = _path(skeleton, first)
    for second in others:
        second_path = _path(skeleton, second)
        common = [joint for joint in second_path if joint in first_path]
        if lengths[common].sum() < 0.5 * lengths[second_path].sum():
            return tuple(sorted((first, second)))
    raise WorkbenchError(
        f"feet of {motion.name!r}: found by neither name nor height, want the names of the feet, "
        f"some of {', '.join(skeleton.names[:40])}"
    )


def foot_heights(
    motion: Motion, feet: Iterable[str] | None = None, *, up: str = "y"
) -> NDArray[np.float64]:
    """Compute how high the feet are in each frame.

    Parameters
    ----------
    motion : Motion
        The clip.
    feet : iterable of str, optional
        Names of the feet's joints; by default :func:`find_feet` finds them.
    up : {"x", "y", "z"}
        The axis that points up, y in BVH and ASF files.

    Returns
    -------
    ndarray of shape (n_frames, n_feet)
        World positions along that axis, in file units.

    Raises
    ------
    WorkbenchError
        If there are no joints of these names, or none are found.
    """
    axis = _axis(up)
    return joint_positions(motion)[:, list(find_feet(motion, feet, up=up)), axis]


def _named(skeleton: Skeleton, names: list[Any]) -> tuple[int, ...]:
    if not names:
        raise WorkbenchError("feet: got no names, want at least one")
    for name in names:
        if name not in skeleton.names:
            near = get_close_matches(str(name), skeleton.names, n=5, cutoff=0.3)
            raise WorkbenchError(
                f"feet: got {name!r}, want names of joints such as "
                f"{', '.join(near or skeleton.names[:5])}"
            )
    return tuple(skeleton.names.index(name) for name in names)


def _side_and_part(name: str) -> tuple[str, str]:
    """Read the side and the part of the body off a joint's name; empty where it tells none."""
    words = [word.lower() for word in _WORD.findall(name.rpartition(":")[2])]
    joined = next((match for word in words if (match := _JOINED.fullmatch(word))), None)
    if joined:
        return _SIDES[joined[1]], joined[2]
    side = next((_SIDES[word] for word in words if word in _SIDES), "")
    part = next((word for word in words if word in PARTS), "")
    return side, part


def _path(skeleton: Skeleton, joint: int) -> list[int]:
    """List the joints from the root to a joint."""
    path = [joint]
    while path[-1] > 0:
        path.append(int(skeleton.parents[path[-1]]))
    return path[::-1]


def _axis(up: str) -> int:
    if up not in _AXES:
        raise WorkbenchError(f"up: got {up!r}, want 'x', 'y' or 'z'")
    return _AXES.index(up)
