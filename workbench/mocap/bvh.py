"""Read BVH motion files."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from workbench.errors import MotionFormatError, WorkbenchError
from workbench.mocap.bvh_hierarchy import HierarchyParser
from workbench.mocap.channels import compose_rows
from workbench.mocap.motion import Motion
from workbench.mocap.number_rows import read_number_rows
from workbench.mocap.skeleton import POSITION_CHANNELS, Skeleton
from workbench.mocap.textfile import lines_of, parse_number, quoted, read_text_bytes

#: What the position channels of a joint do to its OFFSET.
PositionRule = Literal["replace", "add"]

_FRAMES = re.compile(r"frames\s*:\s*(.*)", re.IGNORECASE)
_FRAME_TIME = re.compile(r"frame\s+time\s*:\s*(.*)", re.IGNORECASE)


def read_bvh(path: str | Path, *, positions: PositionRule = "replace") -> Motion:
    """Read a BVH file.

    Each joint's own channel order is honoured; joints may have any set of channels and any
    name, also one used before. What a file may not do is named in the error instead of
    being repaired: wrong numbers of rows or values, and values that are no finite numbers.
    A T-pose in front stays; see :func:`workbench.mocap.drop_tpose`.

    Joints other than the root may have position channels. Their OFFSET is often zero then, so
    their offset in the skeleton, and with it the weight of D_q, comes from the motion: it is
    their mean translation over all frames.

    Parameters
    ----------
    path : path-like
        The file.
    positions : {"replace", "add"}, default "replace"
        Whether position channels replace the joint's OFFSET, as most programs have it, or
        add to it.

    Returns
    -------
    Motion
        Named like the file without its ending, in the file's own unit of length.

    Raises
    ------
    DataError
        If the file cannot be read.
    MotionFormatError
        If it breaks the format; the message tells the line.

    Examples
    --------
    >>> motion = read_bvh("datasets/mocap/bvh/01_01.bvh")  # doctest: +SKIP
    >>> len(motion), motion.skeleton.n_joints  # doctest: +SKIP
    (2752, 31)
    """
    check_position_rule(positions)
    data = read_text_bytes(path, "a BVH file")
    lines = lines_of(data)
    skeleton, line, _ = HierarchyParser(path).parse(lines)
    n_columns = sum(len(channels) for channels in skeleton.channels)
    if n_columns == 0:
        raise MotionFormatError(path, line, "no channels in the hierarchy", "at least one")
    n_frames, line, _ = _header(path, lines, line, _FRAMES, "Frames: and their number")
    frame_time, line, start = _header(
        path, lines, line, _FRAME_TIME, "Frame Time: and a number of seconds above 0"
    )
    rows = read_number_rows(path, data, start, line, (int(n_frames), n_columns), "Frames:")
    translations, rotation_columns = _split(skeleton, rows, positions)
    root_translation = translations.pop(0, np.tile(skeleton.offsets[0], (len(rows), 1)))
    return Motion(
        skeleton=_resting_at_means(skeleton, translations),
        rotations=compose_rows(skeleton, rows, rotation_columns),
        root_translation=root_translation,
        frame_time=frame_time,
        joint_translations=translations,
        name=Path(path).stem,
    )


def check_position_rule(positions: str) -> None:
    """Refuse a rule for position channels that does not exist."""
    if positions not in ("replace", "add"):
        raise WorkbenchError(f"positions: got {positions!r}, want 'replace' or 'add'")


def _header(
    path: str | Path,
    lines: Iterator[tuple[str, int]],
    line: int,
    pattern: re.Pattern[str],
    expected: str,
) -> tuple[float, int, int]:
    """Read the next line that is not blank as a header with a positive number."""
    for text, end in lines:
        line += 1
        if not text:
            continue
        match = pattern.fullmatch(text)
        value = parse_number(match.group(1)) if match else None
        whole = pattern is not _FRAMES or (match is not None and match.group(1).isdigit())
        if value is None or not value > 0 or not whole:
            raise MotionFormatError(path, line, quoted(text), expected)
        return value, line, end
    raise MotionFormatError(path, line, "the end of the file", expected)


def _resting_at_means(skeleton: Skeleton, translations: dict[int, NDArray[np.float64]]) -> Skeleton:
    """Give joints that the file moves their mean translation as offset, for a true bone length."""
    offsets = skeleton.offsets.copy()
    for joint, translation in translations.items():
        # As a departure from OFFSET, so that a joint that stays there keeps it to the last digit.
        offsets[joint] += (translation - offsets[joint]).mean(axis=0)
    return replace(skeleton, offsets=offsets)


def _split(
    skeleton: Skeleton, rows: NDArray[np.float64], positions: PositionRule
) -> tuple[dict[int, NDArray[np.float64]], NDArray[np.intp]]:
    """Find the translations of joints, by joint, and the columns that are rotation angles."""
    translations: dict[int, NDArray[np.float64]] = {}
    rotation_columns = []
    column = 0
    for joint, channels in enumerate(skeleton.channels):
        offset = skeleton.offsets[joint]
        for channel in channels:
            if channel in POSITION_CHANNELS:
                place = translations.setdefault(joint, np.tile(offset, (len(rows), 1)))
                axis = POSITION_CHANNELS.index(channel)
                place[:, axis] = rows[:, column] + (offset[axis] if positions == "add" else 0.0)
            else:
                rotation_columns.append(column)
            column += 1
    return translations, np.array(rotation_columns, dtype=np.intp)
