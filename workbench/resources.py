"""Find the notebooks and data that travel with the package."""

from __future__ import annotations

from pathlib import Path

_PACKAGE = Path(__file__).resolve().parent


def bundled(folder: str) -> Path:
    """Locate a folder that is bundled with the package.

    An installed wheel carries it inside the package; a checkout has it beside the package.

    Parameters
    ----------
    folder : {"notebooks", "datasets"}
        Name of the folder.

    Returns
    -------
    Path
        The folder's place on this machine.
    """
    installed = _PACKAGE / "_bundled" / folder
    return installed if installed.is_dir() else _PACKAGE.parent / folder
