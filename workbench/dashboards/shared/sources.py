"""Where the samples of a dashboard come from."""

from __future__ import annotations

import itertools
import os
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from workbench.errors import DataError, WorkbenchError
from workbench.spaces import ClipSpace, PoseSpace, Space

#: The matrix of all distances takes 8 bytes for each pair: 1.2 GB at this size.
MAX_SAMPLES = 12_000

_tokens = itertools.count(1)


@dataclass(frozen=True)
class Source:
    """Where samples come from.

    Attributes
    ----------
    name : str
        A data set's name, a file's path, or what to call ``space``.
    label : str or None
        The column of a user's table that holds the classes.
    standardize : bool
        Whether to standardise the columns of a table; motions stay as they are.
    space : Space or None
        Samples that are in memory already.
    token : int
        Tells samples in memory apart, because a copy in another process is another object.
    registered : bool
        Whether a loader that the user registered in the kernel gives the samples.
    version : tuple of int
        Tells a file of the user's apart from itself before it was edited, see
        :func:`file_version`; empty for samples from elsewhere.
    parts : tuple of Source
        The clips, if there are several on one map.
    """

    name: str
    label: str | None = None
    standardize: bool = False
    space: Space | None = field(default=None, compare=False)
    token: int = 0
    registered: bool = False
    version: tuple[int, ...] = ()
    parts: tuple[Source, ...] = ()

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the clips, or of the only source."""
        return tuple(part.name for part in self.parts) or (self.name,)


def source_of(data: Any, label: str | None = None, standardize: bool = False) -> Source:
    """Say where samples come from, in words that another process understands.

    Parameters
    ----------
    data : str, path-like, Space, or a sequence of them
        A data set's name, a file's path, samples in memory, or several clips.
    label : str, optional
        The column of a table of the user's own that holds the classes.
    standardize : bool
        Whether to standardise the columns of a table.

    Returns
    -------
    Source

    Raises
    ------
    WorkbenchError
        If it is an empty sequence or something else.
    """
    if isinstance(data, Space):
        return Source(data.name or "samples", space=data, token=next(_tokens))
    if isinstance(data, (str, os.PathLike)):
        return _named(str(data).strip(), label, standardize)
    if not isinstance(data, Sequence) or not data:
        raise WorkbenchError(
            f"data: got {data!r}, want a data set's name, a file's path, samples in memory, or a "
            "list of clips"
        )
    parts = tuple(source_of(part) for part in data)
    if len(parts) == 1:
        return source_of(data[0], label, standardize)
    return on_one_map(parts)


def on_one_map(clips: Sequence[Source]) -> Source:
    """Ask for several clips on one map; one is asked for as it is."""
    if len(clips) == 1:
        return clips[0]
    return Source(" + ".join(clip.name for clip in clips), parts=tuple(clips))


def _named(name: str, label: str | None, standardize: bool) -> Source:
    from workbench.datasets import registered_datasets
    from workbench.datasets.catalogue import lookup

    if name not in registered_datasets() and lookup(name) is not None:
        return Source(name, label, standardize)
    path = Path(name).expanduser()
    try:
        if path.exists():
            name = str(path.absolute())
            return Source(name, label, standardize, version=file_version(name))
    except OSError:  # too long for a path, for instance
        pass
    return Source(name, label, standardize, token=next(_tokens), registered=True)


def standardized(source: Source, standardize: bool) -> Source:
    """Ask for the same samples with their columns standardised or not."""
    if source.registered:
        source = replace(source, space=None, token=next(_tokens))
    return replace(source, standardize=standardize)


def reread(source: Source) -> Source:
    """Take notice of files that were edited."""
    if source.parts:
        return replace(source, parts=tuple(reread(part) for part in source.parts))
    return replace(source, version=file_version(source.name)) if source.version else source


def loaded_here(source: Source) -> Source:
    """Load what only this kernel can: data registered by its user.

    Raises
    ------
    WorkbenchError
        If the user's loader fails, in whatever way.
    """
    if source.parts:
        return replace(source, parts=tuple(loaded_here(part) for part in source.parts))
    if source.space is not None or not source.registered:
        return source
    from workbench.datasets import load_space

    try:
        space = load_space(source.name, label=source.label, standardize=source.standardize)
    except WorkbenchError:
        raise
    except Exception as error:  # a user's loader may fail in any way
        raise WorkbenchError(f"{type(error).__name__}: {error}") from error
    return replace(source, space=space)


def load_source(source: Source) -> tuple[Space, tuple[str, ...]]:
    """Load samples and how they were treated.

    Raises
    ------
    WorkbenchError
        If several sources are not clips of one skeleton.
    DataError
        If they cannot be loaded, there are too many of them, or their file was edited since it
        was opened: panels would show different samples side by side.
    """
    space, notes = _joined(source) if source.parts else _single(source)
    if len(space) > MAX_SAMPLES:
        raise DataError(
            f"{source.name}: got {len(space)} samples, want at most {MAX_SAMPLES}: the distances "
            "between all of them must fit into memory"
        )
    return space, notes


def _single(source: Source) -> tuple[Space, tuple[str, ...]]:
    from workbench.datasets import Table, load

    if source.version and source.version != file_version(source.name):
        raise DataError(f"{source.name}: the file has changed; compute again to read it anew")
    if source.space is not None:
        return source.space, ()
    data = load(source.name, label=source.label)
    if isinstance(data, Table):
        return data.space(standardize=source.standardize), data.notes
    return PoseSpace(data), ()


def _joined(source: Source) -> tuple[Space, tuple[str, ...]]:
    motions = []
    for part in source.parts:
        space, _ = _single(part)
        if not isinstance(space, PoseSpace):
            raise WorkbenchError(
                f"{part.name}: got a table, want clips of one skeleton to show on one map"
            )
        motions.append(replace(space.motion, name=part.name))
    return ClipSpace(motions), ()


def file_version(path: str) -> tuple[int, int]:
    """Give the time of a file's last change, in nanoseconds, and its size; zeros if missing."""
    try:
        status = os.stat(path)
    except OSError:
        return 0, 0
    return status.st_mtime_ns, status.st_size


@dataclass(frozen=True)
class Choice:
    """A data set that needs no download.

    Attributes
    ----------
    name : str
        Its name.
    text : str
        What to show for it.
    clip : bool
        Whether it is a motion, as far as that is known before it is loaded.
    """

    name: str
    text: str
    clip: bool


def available() -> list[Choice]:
    """List the user's own data sets, and those that need no download."""
    from workbench.datasets import list_datasets, registered_datasets

    own = registered_datasets()
    return [Choice(name, name, clip=False) for name in own] + [
        Choice(entry.name, f"{entry.name}: {entry.title}", clip=entry.kind != "table")
        for entry in (found.entry for found in list_datasets() if _is_here(found.state))
        if entry.name not in own
    ]


def _is_here(state: str) -> bool:
    return state in ("available", "built in")
