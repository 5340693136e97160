"""Data that commands load, and files that they write."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import typer

from workbench.errors import DataError, WorkbenchError

if TYPE_CHECKING:
    from workbench.spaces import PoseSpace, Space


def load(source: str, label: str | None = None, standardize: bool = False) -> Space:
    """Load data, and say how a table was treated to become numbers."""
    from workbench.datasets import load_space

    space = load_space(source, label=label, standardize=standardize)
    for note in space.notes:
        typer.echo(f"workbench: note: {note}", err=True)
    return space


def load_motion(clip: str) -> PoseSpace:
    """Load a motion, refusing a table."""
    from workbench.spaces import PoseSpace

    space = load(clip)
    if not isinstance(space, PoseSpace):
        raise WorkbenchError(f"{clip}: got a table, want a motion")
    return space


def check_folder(out: Path | None, option: str = "--out") -> None:
    """Refuse an output file that has no place, before anything is computed."""
    if out is None:
        return
    if out.is_dir():
        raise WorkbenchError(f"{option}: got the folder {str(out)!r}, want the name of a file")
    if not out.resolve().parent.is_dir():
        raise WorkbenchError(f"{option}: there is no folder {str(out.resolve().parent)!r}")


def write(out: Path, content: bytes) -> None:
    """Write a result, naming the file that cannot be written."""
    from workbench.files import write_atomically

    try:
        write_atomically(out, content)
    except OSError as error:
        raise DataError(f"{out}: cannot be written ({error.strerror})") from None
