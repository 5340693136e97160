"""Where the files of user studies are."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path
from urllib.parse import parse_qs

from workbench.errors import DataError, WorkbenchError
from workbench.study.database import study_settings

#: Ending of a study's file, and endings that are not taken for a part of its name.
_ENDING = ".sqlite"
_ENDINGS = (_ENDING, ".sqlite3", ".db", ".csv", ".tsv", ".txt", ".parquet")


def studies_folder() -> Path:
    """Give the folder in which studies lie that are called by a name only.

    The same one for the page on which a study is prepared and for the one on which it is taken
    part in, wherever their kernels run: ``WORKBENCH_STUDIES``, by default
    ``workbench-studies`` in the home folder.
    """
    return Path(os.environ.get("WORKBENCH_STUDIES") or Path.home() / "workbench-studies")


def study_path(name: str | Path) -> Path:
    """Find the file that a person means.

    Parameters
    ----------
    name : str or path-like
        A file that is there, a whole path, or a name, whose file is in :func:`studies_folder`.

    Raises
    ------
    WorkbenchError
        If it is empty.
    """
    text = str(name).strip()
    if not text:
        raise WorkbenchError("study: got no name, want that of a study's file")
    path = Path(text).expanduser()
    for there in (path.absolute(), studies_folder() / path):
        if there.is_file():
            return there
    known = path.suffix.lower() in _ENDINGS
    return studies_folder() / (path if known else f"{path}{_ENDING}")


def known_studies() -> list[str]:
    """List the names of the studies in the folder, the latest first."""
    files = [path for path in studies_folder().glob(f"*{_ENDING}") if path.is_file()]
    return [path.name for path in sorted(files, key=lambda path: -path.stat().st_mtime)]


def study_with_id(study_id: str) -> Path | None:
    """Find a study in the folder by its id, or tell by None that it is not there."""
    for name in known_studies():
        path = studies_folder() / name
        with suppress(DataError):  # another file that is damaged or no study
            if study_settings(path).get("id") == study_id:
                return path
    return None


def study_of_address() -> str:
    """Read which study a page's address asks for: ``…/take_part.ipynb?study=NAME``.

    Voila hands a kernel the query of its page's address; elsewhere there is none.
    """
    return parse_qs(os.environ.get("QUERY_STRING", "")).get("study", [""])[0]
