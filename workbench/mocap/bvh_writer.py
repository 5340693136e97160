"""Write BVH motion files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from workbench.errors import DataError, WorkbenchError
from workbench.files import write_atomically
from workbench.mocap.bvh import PositionRule, check_position_rule
from workbench.mocap.channels import motion_to_euler, rotation_columns
from workbench.mocap.motion import Motion, check_motion
from workbench.mocap.skeleton import POSITION_CHANNELS, Skeleton

# Nine decimals keep a round trip far below a millionth of a degree.
_NUMBER = "%.9f"


def write_bvh(motion: Motion, path: str | Path, *, positions: PositionRule = "replace") -> None:
    """Write a motion to a BVH file.

    The file holds the joints' channels in their own order, and angles that run on
    continuously from frame to frame. It appears under its name only when it is complete.

    Parameters
    ----------
    motion : Motion
        The motion.
    path : path-like
        The file; one that exists is replaced.
    positions : {"replace", "add"}, default "replace"
        What readers of the file do with position channels, see :func:`read_bvh`.

    Raises
    ------
    WorkbenchError
        If the motion has what its channels cannot express: a rotation about a missing
        axis, or a translation where there is no position channel; or a name or a number
        that no reader could take.
    DataError
        If the file cannot be written.

    Examples
    --------
    >>> write_bvh(motion, "walk.bvh")  # doctest: +SKIP
    """
    check_motion(motion)
    check_position_rule(positions)
    _check_names(motion.skeleton)
    rows = _rows(motion, positions)
    if not (np.isfinite(rows).all() and np.isfinite(motion.skeleton.offsets).all()):
        raise WorkbenchError(f"motion {motion.name!r}: got numbers that are not finite")
    row_format = " ".join([_NUMBER] * rows.shape[1])
    lines = [
        *_hierarchy(motion.skeleton),
        "MOTION",
        f"Frames: {len(motion)}",
        f"Frame Time: {_decimal(motion.frame_time)}",
        *(row_format % tuple(row) for row in rows.tolist()),
        "",
    ]
    _write_whole(Path(path), "\n".join(lines))


def _check_names(skeleton: Skeleton) -> None:
    for name in skeleton.names:
        if not name or name != " ".join(name.split()) or set(name) & set("{}\0"):
            raise WorkbenchError(f"joint name: got {name!r}, want text in one line without braces")
    for site in skeleton.end_sites:
        if site.name != " ".join(site.name.split()) or set(site.name) & set("{}\0"):
            raise WorkbenchError(
                f"end site name: got {site.name!r}, want text in one line without braces"
            )


def _rows(motion: Motion, positions: PositionRule) -> NDArray[np.float64]:
    """Arrange the channel values as (n_frames, n_channels)."""
    skeleton = motion.skeleton
    degrees = motion_to_euler(motion, unwrap=True)
    columns: list[NDArray[np.float64]] = []
    for joint, angles in enumerate(rotation_columns(skeleton)):
        translation = _translation(motion, joint)
        if positions == "add":
            translation = translation - skeleton.offsets[joint]
        remaining = iter(range(angles.start, angles.stop))
        for channel in skeleton.channels[joint]:
            if channel in POSITION_CHANNELS:
                columns.append(translation[:, POSITION_CHANNELS.index(channel)])
            else:
                columns.append(degrees[:, next(remaining)])
    if not columns:
        raise WorkbenchError(f"motion {motion.name!r}: got no channels, want at least one")
    # Rounded here so that tiny negative numbers do not become "-0.000000000".
    return np.stack(columns, axis=1).round(9) + 0.0


def _translation(motion: Motion, joint: int) -> NDArray[np.float64]:
    """Find a joint's position relative to its parent, refusing what no channel holds."""
    skeleton = motion.skeleton
    offset = skeleton.offsets[joint]
    if joint == 0:
        translation = motion.root_translation
    else:
        translation = motion.joint_translations.get(joint, np.tile(offset, (len(motion), 1)))
    for axis, channel in enumerate(POSITION_CHANNELS):
        moved = np.abs(translation[:, axis] - offset[axis]).max()
        if channel not in skeleton.channels[joint] and not moved <= 1e-9 * (1 + abs(offset[axis])):
            raise WorkbenchError(
                f"joint {joint} ({skeleton.names[joint]}): is moved by {moved:.3g} from its offset "
                f"but has no channel {channel}"
            )
    return translation


def _hierarchy(skeleton: Skeleton) -> list[str]:
    """Write the joints; a stack in place of recursion stands any depth."""
    children: list[list[int]] = [[] for _ in skeleton.names]
    for joint, parent in enumerate(skeleton.parents.tolist()):
        if parent >= 0:
            children[parent].append(joint)
    sites = [[s for s in skeleton.end_sites if s.joint == j] for j in range(skeleton.n_joints)]
    order: list[int] = []
    lines = ["HIERARCHY"]
    pending: list[tuple[int, str]] = [(0, "")]
    while pending:
        joint, indent = pending.pop()
        if joint < 0:
            lines.append(f"{indent}}}")
            continue
        order.append(joint)
        inner = indent + "\t"
        channels = skeleton.channels[joint]
        lines += [
            f"{indent}{'ROOT' if joint == 0 else 'JOINT'} {skeleton.names[joint]}",
            f"{indent}{{",
            f"{inner}OFFSET {_vector(skeleton.offsets[joint])}",
            f"{inner}CHANNELS {' '.join([str(len(channels)), *channels])}",
        ]
        for site in sites[joint]:
            lines += [
                f"{inner}End Site {site.name}".rstrip(),
                f"{inner}{{",
                f"{inner}\tOFFSET {_vector(site.offset)}",
                f"{inner}}}",
            ]
        pending.append((-1, indent))
        pending += [(child, inner) for child in reversed(children[joint])]
    if order != list(range(skeleton.n_joints)):
        raise WorkbenchError(
            "skeleton: got joints in another order than a BVH file nests them, "
            "want each joint directly followed by all that hangs on it"
        )
    return lines


def _vector(values: NDArray[np.float64]) -> str:
    return " ".join(_decimal(float(value)) for value in values)


def _decimal(value: float) -> str:
    """Write a number so that it reads back as the same one, without an exponent."""
    return np.format_float_positional(value + 0.0, trim="0")


def _write_whole(path: Path, text: str) -> None:
    if not path.name:
        raise DataError(f"{path}: is a folder, want the name of a file")
    if not path.parent.is_dir():
        raise DataError(f"{path}: cannot be written (there is no folder {path.parent})")
    try:
        write_atomically(path, text.encode())
    except OSError as error:
        raise DataError(f"{path}: cannot be written ({error.strerror})") from None
