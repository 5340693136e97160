"""Compile the hot loops, and say so when a first call has to wait for it."""

from __future__ import annotations

import hashlib
import os
import shutil
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba
from numba.core import event

#: numba's settings, which it makes when it is imported, unseen by a type checker.
_settings: Any = numba.config

#: Compiled versions of earlier states of the code are removed after so many days.
_KEPT_DAYS = 7


def kernel_folder(package: Path) -> Path:
    """Tell where compiled functions of a package are kept, one folder for each state of it.

    numba notices that a function's own file has changed, but not that one which it calls has:
    it would go on with the old one. So a change of any module beside one with compiled
    functions starts a new folder.

    Parameters
    ----------
    package : path-like
        Folder of the package's modules.

    Returns
    -------
    Path
        Within ``NUMBA_CACHE_DIR`` if that is set, else in the cache folder of the system.
    """
    contents = {path: path.read_bytes() for path in sorted(package.rglob("*.py"))}
    compiling = {path.parent for path, text in contents.items() if b"workbench.kernels" in text}
    digest = hashlib.sha256(str(package).encode())
    for path, text in contents.items():
        if path.parent in compiling:
            digest.update(path.name.encode() + hashlib.sha256(text).digest())
    if _settings.CACHE_DIR:
        base = Path(_settings.CACHE_DIR)
    else:
        import pooch

        base = Path(pooch.os_cache("workbench")) / "kernels"
    return base / digest.hexdigest()[:16]


def _prepare(folder: Path) -> str:
    """Make the folder, and remove those that no state of the code has used for days."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        os.utime(folder)
        for other in folder.parent.iterdir():
            old = time.time() - other.stat().st_mtime > 86400 * _KEPT_DAYS
            if old and len(other.name) == len(folder.name):
                shutil.rmtree(other, ignore_errors=True)
    except OSError:
        return ""  # numba then looks for a place of its own
    return str(folder)


_FOLDER = _prepare(kernel_folder(Path(__file__).parent))


def _compile(function: Callable[..., Any], **options: Any) -> Any:
    # numba takes the folder when a function is decorated; other packages keep theirs.
    theirs = _settings.CACHE_DIR
    _settings.CACHE_DIR = _FOLDER or theirs
    try:
        return numba.njit(cache=True, **options)(function)
    finally:
        _settings.CACHE_DIR = theirs


def compiled(function: Callable[..., Any]) -> Any:
    """Compile a function with numba and keep the result on disk for the next process."""
    return _compile(function)


def compiled_parallel(function: Callable[..., Any]) -> Any:
    """Compile a function with loops over :func:`numba.prange`, which use all cores.

    Iterations must be independent, so that the result does not depend on the number of
    threads.
    """
    return _compile(function, parallel=True)


def compiled_fused(function: Callable[..., Any]) -> Any:
    """Compile a function in which a product and the sum it enters may be rounded once.

    For polynomials: half as fast again and no less exact. No other liberty is taken with the
    order or the special values of floating-point numbers.
    """
    return _compile(function, fastmath={"contract"})


class _CompilationNotice(event.Listener):
    """Tell once per process that compiled kernels are being built.

    Loading a kernel from the disk cache raises no such event.
    """

    def __init__(self) -> None:
        self._said = False

    def on_start(self, event: Any) -> None:
        """Print the notice at the first compilation of a kernel of this package."""
        dispatcher = (event.data or {}).get("dispatcher")
        module = getattr(getattr(dispatcher, "py_func", None), "__module__", "") or ""
        if not self._said and module.startswith("workbench."):
            self._said = True
            print(  # noqa: T201 - stderr, so that --json output stays clean
                "workbench: compiling numerical kernels, up to a minute, only this once",
                file=sys.stderr,
            )

    def on_end(self, event: Any) -> None:
        """Do nothing when a compilation ends."""


event.register("numba:compile", _CompilationNotice())
