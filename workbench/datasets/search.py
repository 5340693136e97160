"""Find data files: the user's folders, the bundled data, the download cache."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from pathlib import Path

from workbench.resources import bundled


def user_folders() -> list[Path]:
    """List the folders that the environment variable ``WORKBENCH_DATA`` names.

    Several are separated like those of the system's search path (``:``, on Windows ``;``).
    """
    value = os.environ.get("WORKBENCH_DATA", "")
    return [Path(part).expanduser() for part in value.split(os.pathsep) if part.strip()]


def absent_folders() -> str:
    """Say which folders that ``WORKBENCH_DATA`` names do not exist, for use in a message."""
    absent = [str(folder) for folder in user_folders() if not folder.is_dir()]
    return f" (WORKBENCH_DATA names {', '.join(absent)}, which does not exist)" if absent else ""


def cache_folder() -> Path:
    """Tell where downloads are kept: ``WORKBENCH_CACHE``, or the system's cache folder."""
    chosen = os.environ.get("WORKBENCH_CACHE", "").strip()
    if chosen:
        return Path(chosen).expanduser()
    # Imported here because it is only needed when no earlier folder has the file.
    import pooch

    return Path(pooch.os_cache("workbench"))


def search_folders() -> Iterator[Path]:
    """Go through the folders where data may lie, in order of precedence."""
    yield from user_folders()
    yield bundled("datasets")
    yield cache_folder()


def find(files: Iterable[str]) -> Path | None:
    """Find a data file.

    Parameters
    ----------
    files : iterable of str
        Places in a data folder, best first, such as ``"uci/seeds.data"``. A file that lies
        in the folder itself rather than in its subfolder is found too.

    Returns
    -------
    Path or None
        The first copy in the order of the folders.
    """
    places = [place for file in files for place in (file, Path(file).name)]
    for folder in search_folders():
        for place in places:
            if (folder / place).is_file():
                return folder / place
    return None


def find_all(subfolder: str, pattern: str) -> list[Path]:
    """List the files of a subfolder in all data folders, one of each name."""
    found: dict[str, Path] = {}
    for folder in search_folders():
        for path in sorted((folder / subfolder).glob(pattern)):
            found.setdefault(path.name, path)
    return [found[name] for name in sorted(found)]
