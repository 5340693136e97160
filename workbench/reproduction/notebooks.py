"""Run notebooks with this interpreter, wherever they lie."""

from __future__ import annotations

import json
import os
import re
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import Any

from workbench.reproduction.kernels import CAN_FORK, PROVISIONER, forked_kernels
from workbench.reproduction.outputs import write_outcome

_ANSI = re.compile(r"\x1b\[[0-9;]*[A-Za-z]")
_TRACEBACK_LINES = 25

#: Starts a kernel by itself.
_START_KERNEL = "import sys, workbench.reproduction.kernels as k; k.run_kernel(sys.argv[1:])"


def run_notebook(
    notebook: Path,
    out: Path,
    parameters: Mapping[str, Any],
    progress: Callable[[str], None],
    *,
    items: Sequence[str],
) -> str:
    """Run one notebook and keep it, executed, in the output folder.

    Within :func:`this_interpreter` the kernel is this Python. Several threads may each run a
    notebook.

    Parameters
    ----------
    notebook : Path
        The notebook.
    out : Path
        The output folder; how the run ended is recorded there too.
    parameters : mapping
        What its ``parameters`` cell is to be overridden with; names that are not in it are
        left out.
    progress : callable
        Called with each line that the notebook prints on stderr.
    items : sequence of str
        Ids of what it is run for; only they count as failed if it fails.

    Returns
    -------
    str
        Empty if it ran to its end, else the last lines of its error.
    """
    import papermill

    executed = out / "notebooks" / notebook.name
    executed.parent.mkdir(parents=True, exist_ok=True)
    start = time.perf_counter()
    error = ""
    try:
        known = papermill.inspect_notebook(notebook)
        papermill.execute_notebook(
            notebook,
            executed,
            parameters={name: parameters[name] for name in known if name in parameters},
            kernel_name="python3",
            progress_bar=False,
            stderr_file=_Lines(progress),
        )
    except Exception as exception:  # whatever ends a notebook must not stop the others
        error = _last_lines(exception)
    seconds = time.perf_counter() - start
    write_outcome(out, notebook.stem, items=items, seconds=seconds, error=error)
    return error


@contextmanager
def this_interpreter() -> Iterator[None]:
    """Make "python3" the kernel of this interpreter, able to import this package.

    A user's own kernel of that name may be another Python, and a fresh environment may have
    none at all. The environment is put back afterwards.
    """
    package_folder = str(Path(__file__).resolve().parents[2])
    paths = [package_folder, os.environ.get("PYTHONPATH", "")]
    with tempfile.TemporaryDirectory() as folder:
        kernel = Path(folder) / "kernels" / "python3"
        kernel.mkdir(parents=True)
        # The kernel listens on the loopback only; its notice about that is not for our readers,
        # nor is the one that Jupyter interrupted it when its notebook was done.
        options = ["-f", "{connection_file}", "--IPKernelApp.log_level=CRITICAL"]
        specification: dict[str, Any] = {"display_name": "Python 3", "language": "python"}
        if CAN_FORK:
            specification["argv"] = options
            specification["metadata"] = {"kernel_provisioner": {"provisioner_name": PROVISIONER}}
        else:
            specification["argv"] = [sys.executable, "-c", _START_KERNEL, *options]
        (kernel / "kernel.json").write_text(json.dumps(specification), encoding="utf-8")
        changes = {
            "JUPYTER_PATH": os.pathsep.join(
                part for part in (folder, os.environ.get("JUPYTER_PATH", "")) if part
            ),
            "PYTHONPATH": os.pathsep.join(part for part in paths if part),
            # One copy of plotly.js lies beside the figures; notebooks need not carry more.
            "PLOTLY_RENDERER": "plotly_mimetype",
        }
        before = {name: os.environ.get(name) for name in changes}
        os.environ.update(changes)
        try:
            with forked_kernels() if CAN_FORK else nullcontext():
                yield
        finally:
            for name, value in before.items():
                if value is None:
                    os.environ.pop(name, None)
                else:
                    os.environ[name] = value


class _Lines:
    """A text stream that passes on whole lines, and the states of a line that is overwritten."""

    def __init__(self, receive: Callable[[str], None]) -> None:
        self._receive = receive

    def write(self, text: str) -> None:
        """Pass on the lines of a text."""
        for line in re.split(r"[\r\n]+", _ANSI.sub("", text)):
            if line.strip():
                self._receive(line.strip())

    def flush(self) -> None:
        """Do nothing: lines are passed on at once."""


def _last_lines(error: Exception) -> str:
    """Give the end of a cell's traceback, or of the error that kept it from running."""
    cell_traceback = getattr(error, "traceback", None)
    text = "\n".join(cell_traceback) if cell_traceback else f"{type(error).__name__}: {error}"
    return "\n".join(_ANSI.sub("", text).strip().splitlines()[-_TRACEBACK_LINES:])
