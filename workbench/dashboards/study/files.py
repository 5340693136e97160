"""Where the files of user studies are."""

from __future__ import annotations

import os
from pathlib import Path
from urllib.parse import parse_qs

from workbench.errors import WorkbenchError

#: Ending of a study's file.
_ENDING = ".sqlite"


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
    if path.is_file():
        return path.absolute()
    return studies_folder() / (path if path.suffix else path.with_suffix(_ENDING))


def known_studies() -> list[str]:
    """List the names of the studies in the folder, the latest first."""
    files = [path for path in studies_folder().glob(f"*{_ENDING}") if path.is_file()]
    return [path.name for path in sorted(files, key=lambda path: -path.stat().st_mtime)]


def study_of_address() -> str:
    """Read which study a page's address asks for: ``…/take_part.ipynb?study=NAME``.

    Voila hands a kernel the query of its page's address; elsewhere there is none.
    """
    return parse_qs(os.environ.get("QUERY_STRING", "")).get("study", [""])[0]
