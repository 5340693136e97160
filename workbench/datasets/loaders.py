"""Load data sets by name, and a user's own files by path."""

from __future__ import annotations

import difflib
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from workbench.datasets.catalogue import entries, lookup
from workbench.datasets.download import download
from workbench.datasets.entries import Entry, TableEntry, read_joint_angles
from workbench.datasets.files import read_table
from workbench.datasets.search import absent_folders, cache_folder, find, find_all
from workbench.datasets.tables import Table
from workbench.errors import DataError
from workbench.registry import Registry

if TYPE_CHECKING:
    from workbench.mocap.motion import Motion
    from workbench.spaces import PoseSpace, VectorSpace

_MOTION_ENDINGS = {".bvh", ".amc", ".asf"}
_registered = Registry("data set", {})


@dataclass(frozen=True)
class Status:
    """Where a data set is.

    Attributes
    ----------
    entry : Entry
        The data set.
    state : {"available", "built in", "downloadable", "missing"}
        Whether a file was found, an installed package has it, or it can be downloaded.
    path : Path or None
        The file that was found.
    """

    entry: Entry
    state: str
    path: Path | None = None


def register_dataset(name: str, loader: Callable[[], Any]) -> None:
    """Make your own data available by name in this kernel.

    Parameters
    ----------
    name : str
        The name; it takes precedence over the catalogue.
    loader : callable
        Called without arguments each time the data are loaded; gives a Table, a Motion, a
        DataFrame, or an array of shape (n_rows, n_columns).

    Raises
    ------
    WorkbenchError
        If the name is empty or the loader cannot be called.

    Examples
    --------
    >>> import numpy as np
    >>> register_dataset("mine/cube", lambda: np.eye(3))
    >>> load("mine/cube").values.shape
    (3, 3)
    """
    _registered.register(name, loader)


def registered_datasets() -> list[str]:
    """List the names registered in this kernel, which take precedence over the catalogue."""
    return _registered.names()


def load(source: str | Path, *, label: str | None = None) -> Table | Motion:
    """Load a data set by name or a file by path.

    A data set that is found nowhere is downloaded from its public address.

    Parameters
    ----------
    source : str or path-like
        A name, such as ``"uci/iris"``, ``"cmu/05_10"`` (BVH), ``"cmu-amc/05_10"`` (ASF/AMC) or
        ``"cmu/01_01-jump"`` (an excerpt); or the path of a delimited text file, an ARFF,
        Parquet, BVH or AMC file.
    label : str, optional
        The column of a user's table that holds each row's class.

    Returns
    -------
    Table or Motion
        Motions of the CMU database come without the T-pose that conversions prepend, a user's
        motions as they are. An AMC file without its skeleton gives a table of joint angles in
        degrees.

    Raises
    ------
    DataError
        If there is no such data set or file, or it is damaged.
    """
    if isinstance(source, str):
        if source in _registered:
            return _as_data(source, _registered.create(source), label)
        entry = lookup(source)
        if entry is not None:
            _refuse_label(label, source)
            return load_entry(entry)
        if not _exists(source):
            raise DataError(_unknown(source))
    elif not isinstance(source, Path):
        raise DataError(f"source: got {type(source).__name__}, want a name or a path")
    return _load_file(Path(source).expanduser(), label)


def load_space(
    source: str | Path, *, label: str | None = None, standardize: bool = False
) -> VectorSpace | PoseSpace:
    """Load data as a space of samples, ready to be projected.

    Parameters
    ----------
    source, label
        As for :func:`load`.
    standardize : bool
        Whether to bring each column of a table to zero mean and unit variance.

    Returns
    -------
    VectorSpace or PoseSpace

    Raises
    ------
    DataError
        As :func:`load`, and if a motion is to be standardised.
    """
    data = load(source, label=label)
    if isinstance(data, Table):
        return data.space(standardize=standardize)
    if standardize:
        raise DataError(f"{source}: is a motion, and only tables can be standardised")
    from workbench.spaces import PoseSpace

    return PoseSpace(data)


def list_datasets() -> list[Status]:
    """List the data sets of the catalogue, and all CMU clips that are found, with their state.

    Returns
    -------
    list of Status
        Tables first, then BVH clips, excerpts and AMC clips.
    """
    listed = dict(entries())
    for path in find_all("mocap/bvh", "*.bvh"):
        entry = lookup(f"cmu/{path.stem}")
        if entry is not None:
            listed.setdefault(entry.name, entry)
    for path in find_all("mocap/asf_amc", "*.amc"):
        entry = lookup(f"cmu-amc/{path.stem}")
        if entry is not None:
            listed.setdefault(entry.name, entry)
    return [status(entry) for entry in listed.values()]


def status(entry: Entry) -> Status:
    """Tell where a data set is, without reading it."""
    path = find(entry.files)
    if path is not None:
        return Status(entry, "available", path)
    if isinstance(entry, TableEntry) and entry.built_in is not None:
        return Status(entry, "built in")
    return Status(entry, "downloadable" if entry.downloads else "missing")


def fetch(name: str) -> Status:
    """Make a data set available, downloading it if it is found nowhere.

    A damaged copy in the download cache is replaced.

    Parameters
    ----------
    name : str
        A name of the catalogue.

    Returns
    -------
    Status

    Raises
    ------
    DataError
        If it cannot be downloaded, or a copy in another folder is damaged.
    """
    return fetch_entry(_entry(name))


def fetch_entry(entry: Entry) -> Status:
    """Make the data set of an entry available, see :func:`fetch`."""
    found = status(entry)
    if found.state in ("available", "built in"):
        try:
            return check_entry(entry)
        except DataError:
            if found.path is None or not found.path.is_relative_to(cache_folder()):
                raise
    return Status(entry, "available", download(entry, cache_folder()))


def check(name: str) -> Status:
    """Read a data set and compare it with what the catalogue knows of it.

    Parameters
    ----------
    name : str
        A name of the catalogue.

    Returns
    -------
    Status

    Raises
    ------
    DataError
        If it is damaged or altered, or is not there.
    """
    return check_entry(_entry(name))


def check_entry(entry: Entry) -> Status:
    """Read and compare the data set of an entry, see :func:`check`."""
    found = status(entry)
    if found.state not in ("available", "built in"):
        raise DataError(
            f"{entry.name}: not found{absent_folders()}; "
            f"`workbench datasets fetch {entry.name}` downloads it"
        )
    _read(found)
    return found


def load_entry(entry: Entry) -> Table | Motion:
    """Load the data set of an entry, downloading it if it is found nowhere."""
    found = status(entry)
    if found.state in ("available", "built in"):
        return _read(found)
    return entry.read(download(entry, cache_folder()))


def _read(found: Status) -> Table | Motion:
    if found.path is not None:
        return found.entry.read(found.path)
    assert isinstance(found.entry, TableEntry)  # nothing else is built in
    return found.entry.build()


def _load_file(path: Path, label: str | None) -> Table | Motion:
    ending = path.suffix.lower()
    if ending not in _MOTION_ENDINGS:
        return read_table(path, label)
    from workbench.mocap.reading import find_skeleton, read_motion

    _refuse_label(label, path)
    if ending == ".amc" and find_skeleton(path) is None:
        return read_joint_angles(path)
    return read_motion(path)


def _as_data(name: str, data: Any, label: str | None) -> Table | Motion:
    """Make what a registered loader gives a table or a motion."""
    from workbench.mocap.motion import Motion

    if isinstance(data, (Table, Motion)):
        _refuse_label(label, name)
        return data if data.name else replace(data, name=name)
    import pandas as pd

    from workbench.datasets.treatment import table_from_frame

    try:
        frame = data if isinstance(data, pd.DataFrame) else pd.DataFrame(data)
    except (TypeError, ValueError):
        raise DataError(
            f"the loader of {name} gave {type(data).__name__}, "
            "want a Table, a Motion, a DataFrame or an array of rows"
        ) from None
    return table_from_frame(frame, name, label)


def _entry(name: str) -> Entry:
    entry = lookup(name)
    if entry is None:
        raise DataError(_unknown(name))
    return entry


def _refuse_label(label: str | None, source: str | Path) -> None:
    if label is not None:
        raise DataError(
            f"label: got {label!r} for {source}, want none: a label column can be chosen in a "
            "table of your own only"
        )


def _exists(source: str) -> bool:
    if not source:  # which Path takes for the current folder
        return False
    try:
        return Path(source).expanduser().exists()
    except (OSError, RuntimeError):  # too long for a path, or a home folder of nobody
        return False


def _unknown(source: str) -> str:
    """Say that there is no such data set or file, and what may have been meant."""
    if len(Path(source).suffix) > 1:
        return f"{source}: there is no such file"
    names = {name.lower(): name for name in (*_registered.names(), *entries())}
    meant = source.lower()
    close = difflib.get_close_matches(meant, names, n=3, cutoff=0.6)
    close += [name for name in names if meant and name.endswith(f"/{meant}")]
    offered = " or ".join(dict.fromkeys(names[name] for name in close))
    hint = f"did you mean {offered}? " if offered else ""
    return (
        f"no data set or file is called {source!r}; {hint}`workbench datasets list` shows all names"
    )
