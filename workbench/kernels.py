"""Compile the hot loops, and say so when a first call has to wait for it."""

from __future__ import annotations

import sys
from typing import Any

import numba
from numba.core import event

#: Compile a function with numba and keep the result on disk for the next process.
compiled = numba.njit(cache=True)

#: The same for a loop over :func:`numba.prange`, which uses all cores. Iterations must be
#: independent, so that the result does not depend on the number of threads.
compiled_parallel = numba.njit(cache=True, parallel=True)


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
                "workbench: compiling numerical kernels, some seconds, only this once",
                file=sys.stderr,
            )

    def on_end(self, event: Any) -> None:
        """Do nothing when a compilation ends."""


event.register("numba:compile", _CompilationNotice())
