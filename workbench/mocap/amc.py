"""Read the motion files of the Acclaim format (AMC), with and without a skeleton."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from workbench.errors import MotionFormatError
from workbench.mocap.asf import AcclaimSkeleton, fixed_axis_rotations, read_asf
from workbench.mocap.motion import Motion
from workbench.mocap.number_rows import scan_numbers
from workbench.mocap.textfile import lines_of, parse_number, quoted, read_text_bytes, words_of

#: AMC files do not tell their rate; the CMU database was published at 120 frames a second.
CMU_FRAME_TIME = 1.0 / 120.0

_ROOT_DOFS = ("tx", "ty", "tz", "rx", "ry", "rz")


@dataclass(frozen=True, eq=False)
class JointAngles:
    """The curves of an AMC file, which mean joint angles even where no skeleton is known.

    Attributes
    ----------
    columns : tuple of str
        Bone and degree of freedom of each column, such as ``"lfoot.rz"``; without a
        skeleton the degrees of freedom of a bone are numbered, ``"lfoot.2"``.
    values : ndarray of shape (n_frames, n_columns)
        Angles in degrees; the root's translation in file units.
    frame_numbers : ndarray of shape (n_frames,)
        As the file counts them.
    name : str
        What to call the clip in messages and figures.
    """

    columns: tuple[str, ...]
    values: NDArray[np.float64]
    frame_numbers: NDArray[np.intp]
    name: str = ""

    def __len__(self) -> int:
        return len(self.values)

    @property
    def is_angle(self) -> NDArray[np.bool_]:
        """Which columns are angles, as an array of shape (n_columns,)."""
        return np.array([column not in _ROOT_TRANSLATION for column in self.columns])

    @property
    def degrees(self) -> NDArray[np.float64]:
        """The angles alone, of shape (n_frames, n_columns - 3)."""
        return self.values[:, self.is_angle]


_ROOT_TRANSLATION = ("root.tx", "root.ty", "root.tz")


@dataclass
class _Frame:
    number: int
    bones: dict[str, tuple[int, list[str]]]
    last_line: int


def read_amc(path: str | Path, skeleton: AcclaimSkeleton | None = None) -> JointAngles:
    """Read the curves of an AMC motion.

    Without a skeleton the first frame settles which bones there are and how many values
    each has, every further frame must have the same, and the root is taken to have its
    translation before its rotation, as all files of the CMU database have.

    Parameters
    ----------
    path : path-like
        The file.
    skeleton : AcclaimSkeleton, optional
        The skeleton, which then settles the bones and their degrees of freedom.

    Returns
    -------
    JointAngles
        Columns in the order of the skeleton, else in that of the first frame.

    Raises
    ------
    DataError
        If the file cannot be read.
    MotionFormatError
        If it breaks the format or does not fit the skeleton; the message tells the line.

    Examples
    --------
    >>> read_amc("13_29.amc").values.shape  # doctest: +SKIP
    (4592, 62)
    """
    reader = _AmcReader(path, skeleton)
    frames = list(reader.frames(read_text_bytes(path, "an AMC file")))
    if not frames:
        raise MotionFormatError(path, reader.line, "no frame", "frame number 1 and its bones")
    dofs = _dofs(frames[0], skeleton, path)
    for frame in frames:
        _check_frame(frame, dofs, path)
    values = _values(frames, dofs, path)
    columns = [f"{bone}.{dof}" for bone, names in dofs.items() for dof in names]
    angles = JointAngles(
        tuple(columns), values, np.array([frame.number for frame in frames]), Path(path).stem
    )
    values[:, angles.is_angle] *= reader.degrees_per_unit
    return angles


def read_asf_amc(
    asf_path: str | Path, amc_path: str | Path, *, frame_time: float = CMU_FRAME_TIME
) -> Motion:
    """Read a motion from a pair of Acclaim files.

    A bone with pre-rotation C and angles M has the local rotation C · M · Cᵀ, M turning
    about the fixed axes of C in the order of the bone's ``dof`` list; the root has C · M.
    Bones without degrees of freedom do not turn.

    Parameters
    ----------
    asf_path, amc_path : path-like
        Skeleton and motion.
    frame_time : float, default 1/120
        Time between frames, in seconds; the files do not tell it.

    Returns
    -------
    Motion
        Named like the AMC file without its ending, in the file's unit of length.

    Raises
    ------
    DataError
        If a file cannot be read.
    MotionFormatError
        If one breaks the format or they do not fit each other; the message tells the line.

    Examples
    --------
    >>> motion = read_asf_amc("05.asf", "05_10.amc")  # doctest: +SKIP
    """
    acclaim = read_asf(asf_path)
    angles = read_amc(amc_path, acclaim)
    n_frames = len(angles)
    rotations = np.tile(np.eye(3), (n_frames, acclaim.skeleton.n_joints, 1, 1))
    translation = np.tile(acclaim.root_position, (n_frames, 1))
    column = 0
    for joint, dofs in enumerate(acclaim.dofs):
        values = dict(zip(dofs, angles.values.T[column : column + len(dofs)], strict=True))
        column += len(dofs)
        turns = [dof for dof in dofs if dof[0] == "r"]
        if turns:
            order = "".join(dof[1].upper() for dof in turns)
            turned = fixed_axis_rotations(order, np.stack([values[dof] for dof in turns], axis=-1))
            axes = acclaim.axes[joint]
            rotations[:, joint] = axes @ turned if joint == 0 else axes @ turned @ axes.T
        if joint == 0:
            translation += np.stack([values[dof] for dof in ("tx", "ty", "tz")], axis=-1)
    return Motion(
        skeleton=acclaim.skeleton,
        rotations=rotations,
        root_translation=translation,
        frame_time=frame_time,
        name=angles.name,
    )


class _AmcReader:
    """Cut a file into frames."""

    def __init__(self, path: str | Path, skeleton: AcclaimSkeleton | None) -> None:
        self.path = path
        self.line = 0
        self.degrees_per_unit = skeleton.degrees_per_unit if skeleton else 1.0

    def frames(self, data: bytes) -> Iterator[_Frame]:
        frame: _Frame | None = None
        for text, _ in lines_of(data):
            self.line += 1
            words = words_of(text)
            if not words:
                continue
            name = words[0]
            if name[0] == ":" and frame is None:
                self._keyword(name.lower())
            elif len(words) == 1 and name.isascii() and name.isdigit():
                if frame is not None:
                    yield frame
                frame = self._begin(int(name[:18]), frame)
            elif frame is None:
                raise self._fault(quoted(text), "a frame number before the first bone")
            elif name in frame.bones:
                raise self._fault(f"bone {quoted(name)} again", "each bone once in a frame")
            else:
                frame.bones[name] = (self.line, words[1:])
                frame.last_line = self.line
        if frame is not None:
            yield frame

    def _keyword(self, keyword: str) -> None:
        if keyword == ":degrees":
            self.degrees_per_unit = 1.0
        elif keyword == ":radians":
            self.degrees_per_unit = 180.0 / np.pi
        elif keyword != ":fully-specified":
            raise self._fault(quoted(keyword), ":FULLY-SPECIFIED, :DEGREES or :RADIANS")

    def _begin(self, number: int, before: _Frame | None) -> _Frame:
        if before is not None and number != before.number + 1:
            raise self._fault(f"frame number {number}", f"frame number {before.number + 1}")
        return _Frame(number, {}, self.line)

    def _fault(self, found: str, expected: str) -> MotionFormatError:
        return MotionFormatError(self.path, max(self.line, 1), found, expected)


def _dofs(
    first: _Frame, acclaim: AcclaimSkeleton | None, path: str | Path
) -> dict[str, tuple[str, ...]]:
    """Settle the bones of every frame and the degrees of freedom of each."""
    if acclaim is not None:
        bones = zip(acclaim.skeleton.names, acclaim.dofs, strict=True)
        return {name: dofs for name, dofs in bones if dofs}
    dofs = {
        name: tuple(str(i + 1) for i in range(len(words)))
        for name, (_, words) in first.bones.items()
    }
    if len(dofs.get("root", ())) != 6:
        line = first.bones["root"][0] if "root" in dofs else first.last_line
        found = f"{len(dofs['root'])} values of root" if "root" in dofs else "no root"
        raise MotionFormatError(path, line, found, "root and six values in each frame")
    return {**dofs, "root": _ROOT_DOFS}


def _check_frame(frame: _Frame, dofs: dict[str, tuple[str, ...]], path: str | Path) -> None:
    for name, (line, words) in frame.bones.items():
        if name not in dofs:
            raise MotionFormatError(
                path,
                line,
                f"bone {quoted(name)}",
                f"one of {len(dofs)} bones such as {next(iter(dofs))}",
            )
        if len(words) != len(dofs[name]):
            raise MotionFormatError(
                path, line, f"{len(words)} values of {name}", f"{len(dofs[name])}"
            )
    if len(frame.bones) < len(dofs):
        missing = ", ".join(name for name in dofs if name not in frame.bones)
        raise MotionFormatError(
            path,
            frame.last_line,
            f"frame {frame.number} without {missing}",
            "all bones in each frame",
        )


def _values(
    frames: list[_Frame], dofs: dict[str, tuple[str, ...]], path: str | Path
) -> NDArray[np.float64]:
    """Read the numbers of frames whose bones have been checked."""
    rows = [" ".join([" ".join(frame.bones[name][1]) for name in dofs]) for frame in frames]
    text = "\n".join(rows)
    shape = (len(frames), sum(len(names) for names in dofs.values()))
    values = scan_numbers(text.encode(), 0, shape)
    if values is None:
        for frame in frames:
            for line, words in frame.bones.values():
                for word in words:
                    if parse_number(word) is None:
                        raise MotionFormatError(path, line, quoted(word), "a finite decimal number")
    assert values is not None  # counts were checked before, so only a word can be at fault
    return values
