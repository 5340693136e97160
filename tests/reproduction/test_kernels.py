"""Kernels: copies of one process, which end with who asked for them."""

from __future__ import annotations

import asyncio
import json
import os
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest

from workbench.errors import WorkbenchError
from workbench.reproduction import kernels, notebooks
from workbench.reproduction.notebooks import run_notebook, this_interpreter

STATE = """
import json, os, sys
json.dump({"pid": os.getpid(), "executable": sys.executable, "note": os.environ.get("NOTE"),
           "folder": os.getcwd(), "imported": "pandas" in sys.modules}, open(out, "w"))
"""
FORKS = pytest.mark.skipif(not kernels.CAN_FORK, reason="kernels are not forked on this system")
_ASK = """
import sys, time
from workbench.reproduction import kernels
with kernels.forked_kernels():
    print(kernels._server.fork(["-f", sys.argv[1]], "/", {}), flush=True)
    time.sleep(600)
"""


def notebook(folder: Path, *cells: str) -> Path:
    """Write a notebook with a parameter ``out``."""
    sources = ["out = None", *cells]
    nb = {
        "cells": [
            {
                "cell_type": "code",
                "execution_count": None,
                "id": f"cell-{index}",
                "metadata": {"tags": ["parameters"] if index == 0 else []},
                "outputs": [],
                "source": source,
            }
            for index, source in enumerate(sources)
        ],
        "metadata": {
            "kernelspec": {"display_name": "x", "language": "python", "name": "python3"},
            "language_info": {"name": "python"},
        },
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    path = folder / "notebook.ipynb"
    path.write_text(json.dumps(nb))
    return path


def state_of_kernel(path: Path, folder: Path) -> dict[str, Any]:
    folder.mkdir()
    parameters = {"out": str(folder / "state.json")}
    assert run_notebook(path, folder, parameters, lambda _: None, items=[]) == ""
    return json.loads((folder / "state.json").read_text())


def running(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def wait_until_ended(pid: int) -> None:
    deadline = time.monotonic() + 60
    while running(pid):
        assert time.monotonic() < deadline, f"process {pid} still runs"
        time.sleep(0.05)


@pytest.mark.parametrize("forked", [pytest.param(True, marks=FORKS), False], ids=["fork", "plain"])
def test_each_notebook_has_a_kernel_of_this_interpreter(tmp_path, monkeypatch, forked):
    """Two notebooks at once run in two processes, with this Python, variables and folder."""
    monkeypatch.setattr(notebooks, "CAN_FORK", forked)
    path = notebook(tmp_path, STATE)
    with this_interpreter(), ThreadPoolExecutor(2) as pool:
        monkeypatch.setenv("NOTE", "set after the kernels were prepared")
        monkeypatch.chdir(tmp_path)
        folders = [tmp_path / "a", tmp_path / "b"]
        one, other = pool.map(lambda folder: state_of_kernel(path, folder), folders)
    assert one["pid"] != other["pid"]
    assert os.getpid() not in (one["pid"], other["pid"])
    for state in (one, other):
        assert state["executable"] == sys.executable
        assert state["note"] == "set after the kernels were prepared"
        assert Path(state["folder"]) == tmp_path
        assert state["imported"] is forked
        wait_until_ended(state["pid"])


@FORKS
def test_a_kernel_that_dies_fails_its_notebook_only(tmp_path):
    """The notebook's error says that the kernel died, and the next one runs."""
    dying = notebook(tmp_path, "import os", "os._exit(3)")
    with this_interpreter():
        error = run_notebook(dying, tmp_path, {}, lambda _: None, items=[])
        assert "Kernel died" in error
        assert state_of_kernel(notebook(tmp_path, STATE), tmp_path / "next")["imported"]


@FORKS
def test_kernels_end_with_who_asked_for_them(tmp_path):
    """After kill -9 of the process that runs notebooks, no kernel stays behind."""
    asking = subprocess.Popen(
        [sys.executable, "-c", _ASK, str(tmp_path / "connection.json")],
        stdout=subprocess.PIPE,
        text=True,
    )
    assert asking.stdout is not None
    pid = int(asking.stdout.readline())
    assert running(pid)
    asking.kill()
    asking.communicate()
    wait_until_ended(pid)


@FORKS
def test_a_serving_process_that_ended_is_replaced(tmp_path):
    """It may end while runs are executed for hours; notebooks run all the same."""
    with this_interpreter():
        assert kernels._server is not None
        kernels._server._process.kill()
        assert state_of_kernel(notebook(tmp_path, STATE), tmp_path / "out")["imported"]


@FORKS
def test_without_the_serving_process_there_is_a_reason(tmp_path, monkeypatch):
    """A kernel that cannot be started is one sentence in the notebook's record."""
    with this_interpreter():
        assert kernels._server is not None
        kernels._server._process.kill()
        monkeypatch.setattr(kernels.sys, "executable", shutil.which("false"))
        error = run_notebook(notebook(tmp_path, "1"), tmp_path, {}, lambda _: None, items=[])
    assert "the process that starts kernels ended by itself" in error
    launch = kernels.ForkedKernel().launch_kernel([])
    with pytest.raises(WorkbenchError, match="run figures and tables only"):
        asyncio.run(launch)
