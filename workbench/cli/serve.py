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

#: Where JupyterLab begins: the notebook that leads to all others.
_START = "/lab/tree/start.ipynb"


def lab(
    jupyter_options: Annotated[
        list[str] | None, typer.Argument(help="Options for JupyterLab, after --.")
    ] = None,
    folder: Annotated[
        Path, typer.Option(help="Where to put the notebooks, if the package was installed.")
    ] = Path("workbench-notebooks"),
) -> int:
    """Open JupyterLab on a start page, reachable from this machine only."""
    command = [sys.executable, "-m", "jupyterlab", "--ServerApp.ip=127.0.0.1"]
    command += ["--notebook-dir", str(_notebooks(folder)), f"--LabApp.default_url={_START}"]
    return _run([*command, *(jupyter_options or [])])


def app(
    voila_options: Annotated[
        list[str] | None, typer.Argument(help="Options for Voila, after --.")
    ] = None,
) -> int:
    """Serve the dashboards without code, reachable from this machine only, with a token."""
    if find_spec("voila") is None:
        raise WorkbenchError("Voila is not installed: pip install 'workbench[app]'")
    from workbench.cli.dashboard_server import serve_dashboards

    serve_dashboards(voila_options or [])
    return 0


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
    added, kept = _add_missing(source, folder)
    text = f"workbench: notebooks are in {folder}"
    if added:
        text += f", {added} added"
    if kept:
        text += f", {kept} kept that differ from those of this version"
    typer.echo(text, err=True)
    return folder


def _add_missing(source: Path, folder: Path) -> tuple[int, int]:
    """Copy notebooks that are not there; count those copied, and those there that differ."""
    added = kept = 0
    for notebook in sorted(source.rglob("*.ipynb")):
        target = folder / notebook.relative_to(source)
        if not target.exists():
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(notebook, target)
            added += 1
        elif target.read_bytes() != notebook.read_bytes():
            kept += 1
    return added, kept
