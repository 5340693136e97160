"""Entries of the catalogue: what is known of a data set and how its file is read."""

from __future__ import annotations

import hashlib
import re
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from copy import deepcopy
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from workbench.datasets.formats import Rows
from workbench.datasets.search import find
from workbench.datasets.tables import Table
from workbench.errors import DataError

if TYPE_CHECKING:
    from workbench.mocap.motion import Motion

# The database measures in units of 1/0.45 inch.
CMU_UNIT_CM = 2.54 / 0.45


@dataclass(frozen=True)
class Source:
    """A public address of a file.

    Attributes
    ----------
    address : str
        URL.
    member : str
        The file's name inside the archive at that address; empty if it is no archive.
    """

    address: str
    member: str = ""


@dataclass(frozen=True)
class Download:
    """A file that can be downloaded.

    Attributes
    ----------
    target : str
        Its place in a data folder, such as ``"uci/seeds.data"``.
    sources : tuple of Source
        Where to get it, best first.
    """

    target: str
    sources: tuple[Source, ...]


@dataclass(frozen=True, kw_only=True)
class Entry(ABC):
    """A data set that is known by name.

    Attributes
    ----------
    name : str
        Such as ``"uci/seeds"``.
    title : str
        What it is, in a few words.
    files : tuple of str
        Places in a data folder where a copy may lie, best first.
    page : str
        Public page that describes it.
    licence, citation : str
        Terms of use, and how to cite it.
    downloads : tuple of Download
        What to download, the main file last; empty if that is never needed.
    """

    kind: ClassVar[str]
    name: str
    title: str
    files: tuple[str, ...] = ()
    page: str = ""
    licence: str = ""
    citation: str = ""
    downloads: tuple[Download, ...] = ()

    @abstractmethod
    def read(self, path: Path) -> Table | Motion:
        """Read and check a copy of the data set.

        Raises
        ------
        DataError
            If the file is damaged or is not this data set.
        """


@dataclass(frozen=True, kw_only=True)
class TableEntry(Entry):
    """A table.

    Attributes
    ----------
    reader : callable
        Reads the file's format.
    columns : tuple of str
        Names of the columns.
    classes : mapping of str to str
        Name of each class code; a code without an entry is its own name.
    shape : tuple of int
        Numbers of rows and columns.
    class_counts : mapping of str to int
        Number of rows of each class; empty if there are none.
    checksum : str
        Checksum of the content, see :attr:`Table.checksum`.
    built_in : callable, optional
        Makes the rows from an installed package when no file is found.
    """

    kind: ClassVar[str] = "table"
    reader: Callable[[Path], Rows]
    columns: tuple[str, ...]
    shape: tuple[int, int]
    checksum: str
    classes: Mapping[str, str] = field(default_factory=dict)
    class_counts: Mapping[str, int] = field(default_factory=dict)
    built_in: Callable[[], Rows] | None = None

    def read(self, path: Path) -> Table:
        """Read and check a copy of the table."""
        return self._checked(self.reader(path), str(path))

    def build(self) -> Table:
        """Make the table from an installed package."""
        if self.built_in is None:
            raise DataError(f"{self.name}: no installed package has it")
        return self._checked(self.built_in(), "the installed scikit-learn")

    def _checked(self, rows: Rows, origin: str) -> Table:
        if rows.values.shape != self.shape:
            raise DataError(
                f"{origin} is not {self.name}: got {_size(rows.values.shape)}, "
                f"want {_size(self.shape)}"
            )
        labels = None
        if rows.codes is not None:
            labels = np.array([self.classes.get(code, code) for code in rows.codes])
        table = Table(
            self.name,
            rows.values,
            self.columns,
            labels,
            "class" if labels is not None else "",
        )
        if table.class_counts != dict(self.class_counts):
            raise DataError(
                f"{origin} is not {self.name}: got classes {table.class_counts}, "
                f"want {dict(self.class_counts)}"
            )
        if table.checksum != self.checksum:
            raise DataError(
                f"{origin} is not {self.name}: its numbers or labels were altered "
                "(checksum of the content)"
            )
        return table


@dataclass(frozen=True, kw_only=True)
class ClipEntry(Entry):
    """A motion capture clip of the CMU database as BVH.

    Attributes
    ----------
    frames : int, optional
        Number of frames without the T-pose, where known.
    checksum : str
        Content of the released file, see :func:`clip_checksum`; empty where copies differ.
    """

    kind: ClassVar[str] = "motion"
    frames: int | None = None
    checksum: str = ""

    def read(self, path: Path) -> Motion:
        """Read and check a copy of the clip, without its T-pose."""
        from workbench.mocap import drop_tpose, read_bvh

        motion = drop_tpose(read_bvh(path))
        self._check(motion, path)
        skeleton = replace(motion.skeleton, unit_cm=CMU_UNIT_CM)
        return replace(motion, skeleton=skeleton, name=self.name)

    def _check(self, motion: Motion, path: Path) -> None:
        if self.frames is not None and len(motion) != self.frames:
            raise DataError(
                f"{path} is not {self.name}: got {len(motion)} frames, want {self.frames}"
            )
        if self.checksum and clip_checksum(path) != self.checksum:
            raise DataError(
                f"{path} is not {self.name}: it differs from the released file (checksum of the "
                "content); to use it all the same, give its path instead of the name"
            )


@dataclass(frozen=True, kw_only=True)
class AcclaimEntry(Entry):
    """A motion capture clip of the CMU database as ASF/AMC.

    Attributes
    ----------
    skeleton : str
        Place of the subject's skeleton in a data folder. Only this one fits, however many lie
        beside the clip: subjects differ in their bones, not in the names of these.
    frames : int, optional
        Number of frames, where known.
    """

    kind: ClassVar[str] = "motion"
    skeleton: str
    frames: int | None = None

    def read(self, path: Path) -> Table | Motion:
        """Read and check a copy: a motion, or joint angles where the skeleton is missing."""
        from workbench.mocap.amc import read_asf_amc

        data: Table | Motion
        beside = path.parent / Path(self.skeleton).name
        skeleton = beside if beside.is_file() else find((self.skeleton,))
        data = read_joint_angles(path) if skeleton is None else read_asf_amc(skeleton, path)
        if self.frames is not None and len(data) != self.frames:
            raise DataError(
                f"{path} is not {self.name}: got {len(data)} frames, want {self.frames}"
            )
        return replace(data, name=self.name)


@dataclass(frozen=True, kw_only=True)
class ExcerptEntry(Entry):
    """A short motion cut out of a clip.

    Attributes
    ----------
    clip : ClipEntry
        The whole clip.
    start, stop : int
        First frame and frame after the last, counted without the T-pose.
    """

    kind: ClassVar[str] = "excerpt"
    clip: ClipEntry
    start: int
    stop: int

    def read(self, path: Path) -> Motion:
        """Read and check the whole clip and cut the excerpt out."""
        status = path.stat()
        whole = _last_clip(self.clip, path, (status.st_mtime_ns, status.st_size))
        # A copy: who changes an excerpt does not change those that are cut out next.
        return replace(deepcopy(whole[self.start : self.stop]), name=self.name)


@lru_cache(maxsize=1)
def _last_clip(
    clip: ClipEntry,
    path: Path,
    version: tuple[int, int],  # noqa: ARG001 - a file that has changed is read again
) -> Motion:
    """Read a clip; once for all of its excerpts that are asked for one after the other."""
    return clip.read(path)


def read_joint_angles(path: Path) -> Table:
    """Read an AMC file without a skeleton as a table of joint angles.

    Parameters
    ----------
    path : Path
        The AMC file.

    Returns
    -------
    Table
        One row per frame, unwrapped angles in degrees; the root's translation, which is no
        angle, is left out.
    """
    from workbench.mocap.amc import read_amc
    from workbench.mocap.rotations import unwrap_degrees

    angles = read_amc(path)
    return Table(
        path.stem,
        unwrap_degrees(angles.degrees),
        tuple(np.array(angles.columns)[angles.is_angle].tolist()),
        notes=(
            "no skeleton was found, so the rows are joint angles in degrees, unwrapped and "
            "without the root's translation",
        ),
    )


def clip_checksum(path: Path) -> str:
    """Compute a checksum of a BVH file's content, the same however it is formatted.

    Parameters
    ----------
    path : Path
        A file that reads as BVH.

    Returns
    -------
    str
        SHA-256 in hexadecimal digits, over the words of the file and its numbers.
    """
    text = path.read_text(encoding="utf-8-sig", errors="replace")
    header, _, data = re.split(r"(Frame\s+Time:\s*\S+)", text, maxsplit=1, flags=re.IGNORECASE)
    numbers = np.array(data.split(), dtype="<f8") + 0.0
    digest = hashlib.sha256()
    for word in header.split():
        try:
            word = repr(float(word) + 0.0)
        except ValueError:
            word = word.upper()
        digest.update(word.encode() + b" ")
    digest.update(numbers.tobytes())
    return digest.hexdigest()


def _size(shape: tuple[int, ...]) -> str:
    return f"{shape[0]} rows of {shape[1]} numbers"
