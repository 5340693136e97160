"""Compute beside the kernel, so that it answers meanwhile and any computation can be ended.

A process and not a thread: compiled code holds the interpreter for seconds, numba's loops
must not be entered from two threads at once, and a projection that is under way can only be
ended together with its process.
"""

from __future__ import annotations

import asyncio
import multiprocessing
import os
import signal
import weakref
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from typing import Any

from workbench.errors import WorkbenchError

#: Takes what is going on in words, and how much of it is done (0 to 1, None if unknown).
Report = Callable[[str, float | None], None]

_PAUSE = 0.03  # seconds between two looks at the pipe

#: The variable that keeps threads from spinning, and its value.
_PATIENT = ("OMP_WAIT_POLICY", "PASSIVE")

#: What computations need; nothing of it may start a thread that a copy would lose.
_PRELOADED = [
    "cloudpickle",
    "sklearn.decomposition",
    "sklearn.manifold",
    "workbench.dashboards.comparison.session",
    "workbench.datasets",
    "workbench.projection",
    "workbench.schemes",
]


class Stopped(Exception):  # noqa: N818 - no error: someone wanted it
    """Signal that the computation was ended on purpose."""


class Background:
    """An object that lives in a process of its own.

    Its methods are called with ``report=``, a :data:`Report`, beside their arguments. The
    process starts with the first call and ends with the kernel at the latest.

    Parameters
    ----------
    factory : callable
        Makes the object there; an importable class or function.
    """

    def __init__(self, factory: Callable[[], Any]) -> None:
        self._factory = factory
        self._process: BaseProcess | None = None
        self._connection: Connection | None = None

    async def call(self, method: str, *args: Any, report: Report) -> Any:
        """Call a method of the object and wait without blocking the kernel.

        Parameters
        ----------
        method : str
            Name of the method.
        *args : object
            Its arguments; classes and functions of a notebook's cells travel too.
        report : callable
            Gets what the method reports.

        Returns
        -------
        object
            What the method returns.

        Raises
        ------
        Stopped
            If :meth:`stop` was called meanwhile.
        WorkbenchError
            If the method failed, or its process ended by itself.
        """
        # Unlike pickle it can send what a notebook's cell defines.
        import cloudpickle  # type: ignore[import-untyped]  # it has no type information

        try:
            request = cloudpickle.dumps((method, args))
        except Exception as error:  # any object may refuse to be sent, in its own way
            raise WorkbenchError(f"cannot be computed beside the kernel: {error}") from error
        process, connection = self._started()
        try:
            kind, value = await self._answer(request, process, connection, report)
        except BaseException:
            # Its answer would otherwise be taken for that of the next call.
            if process is self._process:
                self.stop()
            raise
        if kind == "failed":
            raise WorkbenchError(value)
        return value

    def stop(self) -> None:
        """End the process with whatever it is doing; the next call starts another."""
        process, self._process, self._connection = self._process, None, None
        if process is not None:
            process.kill()

    async def _answer(
        self, request: bytes, process: BaseProcess, connection: Connection, report: Report
    ) -> tuple[str, Any]:
        """Send a request, pass on what is reported, and give the answer with its kind."""
        while True:
            try:
                if request:
                    connection.send_bytes(request)
                while not connection.poll():
                    await asyncio.sleep(_PAUSE)
                kind, value = connection.recv()
            except (EOFError, OSError) as error:
                if process is not self._process:
                    raise Stopped from None
                raise WorkbenchError(
                    "the computation ended by itself; the data may need more memory than there is"
                ) from error
            if process is not self._process:
                raise Stopped
            if kind != "report":
                return kind, value
            # Not within the try: what fails in the kernel is not the process's end.
            report(*value)
            request = b""

    def _started(self) -> tuple[BaseProcess, Connection]:
        if self._process is None or self._connection is None or not self._process.is_alive():
            context = _context()
            ours, theirs = context.Pipe()
            environment = dict(os.environ)
            process = context.Process(
                target=_serve, args=(theirs, self._factory, environment), daemon=True
            )
            with _patient_threads():
                process.start()
            theirs.close()
            self._process, self._connection = process, ours
            weakref.finalize(self, process.kill)
        return self._process, self._connection


def _context() -> Any:
    """Choose how processes start; never as copies of the kernel, whose locks would hang.

    Where it can be, they are copies of a process that has imported what computations need and
    done nothing else: one that was cancelled is back within a blink.
    """
    if "forkserver" not in multiprocessing.get_all_start_methods():
        return multiprocessing.get_context("spawn")
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(_PRELOADED)
    return context


@contextmanager
def _patient_threads() -> Iterator[None]:
    """Let processes that start now have threads that do not spin while they wait.

    Those make t-SNE seven times slower as soon as something else wants a core. The choice is
    read when the first compiled loop is loaded.
    """
    chosen = _PATIENT[0] in os.environ
    os.environ.setdefault(*_PATIENT)
    try:
        yield
    finally:
        if not chosen:
            del os.environ[_PATIENT[0]]


def _serve(connection: Connection, factory: Callable[[], Any], environment: dict[str, str]) -> None:
    """Answer calls until the other end is gone."""
    # Interrupting the kernel signals its whole process group, and ends no computation here.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # The process that this one is a copy of has the variables of its own start.
    os.environ.clear()
    os.environ.update(environment)
    os.environ.setdefault(*_PATIENT)
    import cloudpickle

    served: Any = None

    def report(text: str, done: float | None = None) -> None:
        connection.send(("report", (text, done)))

    while True:
        try:
            request = connection.recv_bytes()
        except EOFError:
            return
        try:
            method, args = cloudpickle.loads(request)
            served = served or factory()
            # Pickled here, where a result that cannot be is a failure like any other.
            answer = cloudpickle.dumps(("done", getattr(served, method)(*args, report=report)))
        except BrokenPipeError:
            return
        except WorkbenchError as error:
            answer = cloudpickle.dumps(("failed", str(error)))
        except Exception as error:  # a user's own method may fail in any way
            answer = cloudpickle.dumps(("failed", f"{type(error).__name__}: {error}"))
        try:
            connection.send_bytes(answer)
        except BrokenPipeError:
            return
