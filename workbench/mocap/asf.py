"""Read the skeleton files of the Acclaim format (ASF)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from workbench.errors import MotionFormatError
from workbench.mocap.rotations import rotations_from_euler
from workbench.mocap.skeleton import POSITION_CHANNELS, EndSite, Skeleton
from workbench.mocap.textfile import lines_of, parse_number, quoted, read_text_bytes, words_of

_CM_PER_INCH = 2.54
_ROOT_DOFS = ("tx", "ty", "tz", "rx", "ry", "rz")
_IGNORED_OF_BONE = ("id", "bodymass", "cofmass")
_JOINT_CHANNELS = ("Zrotation", "Yrotation", "Xrotation")


@dataclass(frozen=True, eq=False)
class AcclaimSkeleton:
    """A skeleton together with what its motion files need to be understood.

    Attributes
    ----------
    skeleton : Skeleton
        One joint per bone, at the bone's start and named like it, after the root.
    axes : ndarray of shape (n_joints, 3, 3)
        Frame in which each bone's angles are given: R = C · M · Cᵀ with C from here.
    dofs : tuple of tuple of str
        Degrees of freedom of each joint in the order of the file, such as ``("rx", "rz")``.
    root_position : ndarray of shape (3,)
        Added to the root's translation, in file units.
    degrees_per_unit : float
        1 where the file's angles are in degrees, 180/π where they are in radians.
    """

    skeleton: Skeleton
    axes: NDArray[np.float64]
    dofs: tuple[tuple[str, ...], ...]
    root_position: NDArray[np.float64]
    degrees_per_unit: float


@dataclass
class _Bone:
    line: int
    name: str = ""
    vector: dict[str, list[float]] = field(default_factory=dict)
    axis_order: str = "XYZ"
    dofs: tuple[str, ...] = ()


def read_asf(path: str | Path) -> AcclaimSkeleton:
    """Read an ASF skeleton.

    An ASF file has bones with a direction and a length, a BVH file has joints with an
    offset. Here a joint sits where its bone starts, at the end of the parent's bone, and
    the outermost bones end in end sites; so positions agree with those of BVH conversions.
    Lengths stay in file units. Where the file tells its scale L by ``length``, a unit is
    1/L inch, as in the CMU database.

    Parameters
    ----------
    path : path-like
        The file.

    Returns
    -------
    AcclaimSkeleton

    Raises
    ------
    DataError
        If the file cannot be read.
    MotionFormatError
        If it breaks the format; the message tells the line.

    Examples
    --------
    >>> read_asf("05.asf").skeleton.n_joints  # doctest: +SKIP
    31
    """
    return _AsfParser(path).parse(read_text_bytes(path, "an ASF file"))


class _AsfParser:
    """Collect the sections of one file."""

    def __init__(self, path: str | Path) -> None:
        self.path = path
        self.line = 0
        self.length_unit = 1.0
        self.degrees_per_unit = 1.0
        self.root = _Bone(0, "root", {"position": [0.0] * 3, "orientation": [0.0] * 3})
        self.root.dofs = _ROOT_DOFS
        self.bones: dict[str, _Bone] = {}
        self.children: dict[str, list[str]] = {}

    def parse(self, data: bytes) -> AcclaimSkeleton:
        lines = self._lines(data)
        sections = {
            ":units": self._units,
            ":root": self._root,
            ":bonedata": self._bone_data,
            ":hierarchy": self._hierarchy,
        }
        section, seen = "", set()
        for words in lines:
            if words[0].startswith(":"):
                section = words[0].lower()
                seen.add(section)
            elif not section:
                raise self._fault(quoted(" ".join(words)), "a keyword such as :version")
            elif section in sections:
                sections[section](words, lines)
        for section in sections:
            if section != ":units" and section not in seen:
                raise self._fault("the end of the file", section)
        return self._skeleton()

    def _lines(self, data: bytes) -> Iterator[list[str]]:
        """Yield the words of each line that is neither blank nor a comment."""
        for text, _ in lines_of(data):
            self.line += 1
            words = words_of(text)
            if words:
                yield words

    def _units(self, words: list[str], _: Iterator[list[str]]) -> None:
        keyword = words[0].lower()
        if keyword == "angle":
            if len(words) != 2 or words[1].lower() not in ("deg", "rad"):
                raise self._fault(quoted(" ".join(words)), "angle deg or angle rad")
            self.degrees_per_unit = 1.0 if words[1].lower() == "deg" else 180.0 / np.pi
        elif keyword == "length":
            self.length_unit = self._numbers(words, 1)[0]
            if not self.length_unit > 0:
                raise self._fault(quoted(" ".join(words)), "a length above 0")

    def _root(self, words: list[str], _: Iterator[list[str]]) -> None:
        keyword = words[0].lower()
        if keyword == "order":
            dofs = tuple(word.lower() for word in words[1:])
            if sorted(dofs) != sorted(_ROOT_DOFS):
                raise self._fault(
                    quoted(" ".join(words)), "order and TX TY TZ RX RY RZ in any order"
                )
            self.root.dofs = dofs
        elif keyword == "axis":
            self.root.axis_order = self._axis_order(words[1:])
        elif keyword in ("position", "orientation"):
            self.root.vector[keyword] = self._numbers(words, 3)
        else:
            raise self._fault(quoted(words[0]), "order, axis, position or orientation")

    def _bone_data(self, words: list[str], lines: Iterator[list[str]]) -> None:
        if [word.lower() for word in words] != ["begin"]:
            raise self._fault(quoted(" ".join(words)), "begin of a bone")
        bone = _Bone(self.line)
        for words in lines:
            keyword = words[0].lower()
            if keyword == "end":
                break
            if keyword == "name":
                if len(words) != 2:
                    raise self._fault(quoted(" ".join(words)), "name and one word")
                bone.name = words[1]
            elif keyword in ("direction", "length"):
                bone.vector[keyword] = self._numbers(words, 3 if keyword == "direction" else 1)
            elif keyword == "axis":
                bone.axis_order = self._axis_order(words[4:])
                bone.vector["axis"] = self._numbers(words[:4], 3)
            elif keyword == "dof":
                bone.dofs = tuple(word.lower() for word in words[1:])
                if len(set(bone.dofs)) < len(bone.dofs) or not set(bone.dofs) <= set(
                    _ROOT_DOFS[3:]
                ):
                    raise self._fault(
                        quoted(" ".join(words)), "dof and some of rx, ry, rz, once each"
                    )
            # Joint limits restrict animators, not recorded motion; they go over several lines.
            elif keyword not in ("limits", *_IGNORED_OF_BONE) and not keyword.startswith("("):
                raise self._fault(
                    quoted(words[0]),
                    "a property of a bone (name, direction, length, axis, dof) or end",
                )
        else:
            raise self._fault("the end of the file", f"end of the bone begun in line {bone.line}")
        for wanted in ("direction", "length", "axis"):
            if wanted not in bone.vector:
                raise self._fault("end", f"{wanted} of bone {quoted(bone.name)} before it")
        if not bone.name or bone.name == "root" or bone.name in self.bones:
            raise self._fault(f"bone name {quoted(bone.name)}", "a name of its own for each bone")
        self.bones[bone.name] = bone

    def _hierarchy(self, words: list[str], lines: Iterator[list[str]]) -> None:
        if [word.lower() for word in words] != ["begin"]:
            raise self._fault(quoted(" ".join(words)), "begin of the hierarchy")
        placed = {"root"}
        for words in lines:
            if [word.lower() for word in words] == ["end"]:
                break
            parent, *children = words
            for name in words:
                if name != "root" and name not in self.bones:
                    raise self._fault(f"bone {quoted(name)}", "a bone defined in :bonedata")
            if parent not in placed:
                raise self._fault(
                    f"children of {quoted(parent)}", "the line that gives this bone a parent first"
                )
            for child in children:
                if child in placed:
                    raise self._fault(f"bone {quoted(child)} again", "one parent for each bone")
                placed.add(child)
            self.children.setdefault(parent, []).extend(children)
        else:
            raise self._fault("the end of the file", "end of the hierarchy")
        missing = [name for name in self.bones if name not in placed]
        if missing:
            raise self._fault("end", f"a parent for bone {quoted(missing[0])} before it")

    def _numbers(self, words: list[str], count: int) -> list[float]:
        values = [parse_number(word) for word in words[1:]]
        numbers = [value for value in values if value is not None]
        if len(values) != count or len(numbers) != count:
            raise self._fault(
                quoted(" ".join(words)), f"{words[0]} and {count} finite decimal number(s)"
            )
        return numbers

    def _axis_order(self, words: list[str]) -> str:
        order = words[0].upper() if len(words) == 1 else ""
        if sorted(order) != ["X", "Y", "Z"]:
            raise self._fault(quoted(" ".join(words)), "an axis order such as XYZ")
        return order

    def _skeleton(self) -> AcclaimSkeleton:
        names, parents = ["root"], [-1]
        pending = [(child, 0) for child in reversed(self.children.get("root", []))]
        while pending:
            name, parent = pending.pop()
            pending += [(child, len(names)) for child in reversed(self.children.get(name, []))]
            names.append(name)
            parents.append(parent)
        bones = [self.root, *(self.bones[name] for name in names[1:])]
        ends = [np.zeros(3), *(self._end(bone) for bone in bones[1:])]
        angles = [self.root.vector["orientation"], *(bone.vector["axis"] for bone in bones[1:])]
        skeleton = Skeleton(
            names=tuple(names),
            parents=np.array(parents, dtype=np.intp),
            offsets=np.array([np.zeros(3), *(ends[parent] for parent in parents[1:])]),
            end_sites=tuple(
                EndSite(joint, ends[joint])
                for joint, name in enumerate(names)
                if joint and not self.children.get(name)
            ),
            channels=(
                (*POSITION_CHANNELS, *_JOINT_CHANNELS),
                *[_JOINT_CHANNELS] * (len(names) - 1),
            ),
            # A length of 1 is what files have that know no scale.
            unit_cm=_CM_PER_INCH / self.length_unit if self.length_unit != 1.0 else None,
        )
        axes = [
            fixed_axis_rotations(bone.axis_order, np.array(angle) * self.degrees_per_unit)
            for bone, angle in zip(bones, angles, strict=True)
        ]
        return AcclaimSkeleton(
            skeleton=skeleton,
            axes=np.array(axes),
            dofs=tuple(bone.dofs for bone in bones),
            root_position=np.array(self.root.vector["position"]),
            degrees_per_unit=self.degrees_per_unit,
        )

    def _end(self, bone: _Bone) -> NDArray[np.float64]:
        direction = np.array(bone.vector["direction"])
        return direction * bone.vector["length"][0]

    def _fault(self, found: str, expected: str) -> MotionFormatError:
        return MotionFormatError(self.path, max(self.line, 1), found, expected)


def fixed_axis_rotations(order: str, degrees: NDArray[np.float64]) -> NDArray[np.float64]:
    """Compose rotations made one after the other about axes that do not turn along.

    Parameters
    ----------
    order : str
        Axes in the order of the turns, up to three, such as ``"XYZ"``.
    degrees : ndarray of shape (..., len(order))
        Angles in that order.

    Returns
    -------
    ndarray of shape (..., 3, 3)
        R_last · … · R_first.
    """
    return rotations_from_euler(order[::-1], degrees[..., ::-1])
