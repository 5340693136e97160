"""The commands ``lab`` and ``app``."""

from __future__ import annotations

import shutil
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Annotated

import typer

from workbench.errors import WorkbenchError
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
    return _run(command)


def app(
    voila_options: Annotated[
        list[str] | None, typer.Argument(help="Options for Voila, after --.")
    ] = None,
) -> int:
    """Serve the dashboards without code, reachable from this machine only, with a token."""
    if find_spec("voila") is None:
        raise WorkbenchError("Voila is not installed: pip install 'workbench[app]'")
    dashboard = bundled("notebooks") / "compare_projections.ipynb"
    command = [sys.executable, "-m", "voila", str(dashboard)]
    command += ["--Voila.ip=127.0.0.1", "--Voila.auto_token=True", *(voila_options or [])]
    return _run(command)


def _run(command: list[str]) -> int:
    """Run a server until it is interrupted."""
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
