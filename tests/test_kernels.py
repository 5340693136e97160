"""Tests of workbench.kernels."""

from __future__ import annotations

import os
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

import workbench

CALLEE = """
from workbench.kernels import compiled

@compiled
def step(x):
    return x + {}
"""
CALLER = """
from package.callee import step
from workbench.kernels import compiled

@compiled
def twice(x):
    return step(step(x))
"""


@pytest.fixture
def copy(tmp_path):
    """Make a package with two kernels beside a copy of the module that compiles them."""
    home = tmp_path / "home"
    (home / "workbench").mkdir(parents=True)
    (home / "package").mkdir()
    source = Path(workbench.__file__).parent / "kernels.py"
    (home / "workbench" / "__init__.py").touch()
    (home / "package" / "__init__.py").touch()
    text = source.read_text().replace("Path(__file__).parent", "Path(__file__).parents[1]")
    (home / "workbench" / "kernels.py").write_text(text)
    (home / "package" / "callee.py").write_text(textwrap.dedent(CALLEE.format(1)))
    (home / "package" / "caller.py").write_text(textwrap.dedent(CALLER))
    return home


def run(home, cache):
    """Call the kernel in a new process; give its result and whether something was compiled."""
    code = (
        "from numba.core import event\n"
        "from package.caller import twice\n"
        "with event.install_recorder('numba:compile') as recorder:\n"
        "    print(twice(10), len(recorder.buffer))"
    )
    environment = {**os.environ, "PYTHONPATH": str(home), "NUMBA_CACHE_DIR": str(cache)}
    done = subprocess.run(
        [sys.executable, "-c", code],
        env=environment,
        cwd=home,
        check=True,
        capture_output=True,
        text=True,
    )
    result, compilations = done.stdout.split()
    return float(result), int(compilations)


def test_a_changed_callee_is_noticed(copy, tmp_path):
    """A kernel whose callee, in another file, has changed gives the new result."""
    cache = tmp_path / "cache"
    assert run(copy, cache)[0] == 12
    assert run(copy, cache) == (12, 0)
    (copy / "package" / "callee.py").write_text(CALLEE.format(5))
    assert run(copy, cache)[0] == 20


def test_old_kernels_are_removed(copy, tmp_path):
    """Kernels of a state of the code that was not used for days leave the disk."""
    cache = tmp_path / "cache"
    run(copy, cache)
    (before,) = cache.iterdir()
    (cache / "notes of somebody").mkdir()
    for folder in cache.iterdir():
        os.utime(folder, (0, 0))
    (copy / "package" / "callee.py").write_text(CALLEE.format(5))
    run(copy, cache)
    assert not before.exists()
    assert (cache / "notes of somebody").exists()
    assert len(list(cache.iterdir())) == 2
