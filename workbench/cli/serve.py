"""The command ``lab``."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path
from typing import Annotated

import typer

from workbench.resources import bundled


def lab(
    jupyter_options: Annotated[
        list[str] | None, typer.Argument(help="Options for JupyterLab, after --.")
    ] = None,
    folder: Annotated[
        Path, typer.Option(help="Where to put the notebooks, if the package was installed.")
    ] = Path("workbench-notebooks"),
) -> int:
    """Open the notebooks in JupyterLab, reachable from this machine only."""
    command = [sys.executable, "-m", "jupyterlab", "--ServerApp.ip=127.0.0.1"]
    command += ["--notebook-dir", str(_notebooks(folder)), *(jupyter_options or [])]
    try:
        return subprocess.call(command)  # noqa: S603 - runs this interpreter
    except KeyboardInterrupt:
        return 0


def _notebooks(folder: Path) -> Path:
    """Find the notebooks to open: the checkout's own, or a copy that may be edited."""
    source = bundled("notebooks")
    if source.parent.joinpath("pyproject.toml").is_file():
        return source
    for notebook in source.glob("*.ipynb"):
        target = folder / notebook.name
        if not target.exists():
            folder.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(notebook, target)
    typer.echo(f"workbench: notebooks are in {folder}", err=True)
    return folder
