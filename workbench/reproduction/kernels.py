"""Start kernels within a blink, by copying one process that has imported everything already.

A kernel of its own takes three seconds of processor time to import what all notebooks need,
which for the notebooks of a whole reproduction adds up to a minute. Where processes can be
copied without danger, one process imports it once and forks for each notebook.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from importlib import import_module
from typing import Any

from jupyter_client.connect import KernelConnectionInfo
from jupyter_client.provisioning.local_provisioner import LocalProvisioner

from workbench.errors import WorkbenchError

#: The name under which Jupyter finds :class:`ForkedKernel`; see pyproject.toml.
PROVISIONER = "workbench-forked"

#: Whether kernels can be forked: elsewhere it is impossible or, with system libraries that
#: run threads of their own, unsafe.
CAN_FORK = sys.platform == "linux"

#: What notebooks import. Nothing of it may start threads that a fork would lose; those of
#: OpenBLAS and of pyarrow's allocator are made anew in the copy.
_PRELOADED = (
    "ipykernel.kernelapp",
    "nbformat",
    "pandas",
    "plotly.graph_objects",
    "plotly.io",
    "plotly.subplots",
    "pyarrow.parquet",
    "scipy.stats",
    "sklearn.datasets",
    "workbench.experiments.grid",
    "workbench.reproduction.claims",
    "workbench.reproduction.outputs",
    "workbench.reproduction.costa2018.results",
    "workbench.schemes",
)

# Showing a plotly figure imports, by way of nbformat and jsonschema, a grammar of
# internationalised addresses, which takes 2.4 s to compile and which nobody reads.
_UNREAD = "rfc3987_syntax"


class _Server:
    """The process that forks kernels, as the process that wants them sees it."""

    def __init__(self) -> None:
        self._process = _start_server()
        self._turn = threading.Lock()

    def fork(self, arguments: list[str], folder: str, environment: dict[str, str]) -> int:
        """Start a kernel as a process would be started with these; give its process id."""
        line = json.dumps([arguments, folder, environment]) + "\n"
        with self._turn:
            try:
                return self._answer(line)
            except (OSError, ValueError):
                # It waited for hours maybe, and ended for want of memory, say.
                self.close()
                self._process = _start_server()
            try:
                return self._answer(line)
            except (OSError, ValueError):
                raise WorkbenchError("the process that starts kernels ended by itself") from None

    def _answer(self, line: str) -> int:
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.write(line)
        self._process.stdin.flush()
        return int(self._process.stdout.readline())

    def close(self) -> None:
        """End it; kernels that still run end too, because they look after it."""
        self._process.kill()
        with suppress(BrokenPipeError):
            self._process.communicate()


def _start_server() -> subprocess.Popen[str]:
    # A session of its own, so that Ctrl-C reaches who asked for kernels, and not these.
    return subprocess.Popen(  # noqa: S603 - this interpreter on our own module
        [sys.executable, "-m", __name__],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


_server: _Server | None = None


@contextmanager
def forked_kernels() -> Iterator[None]:
    """Let kernels of :data:`PROVISIONER` be started."""
    global _server  # Jupyter makes the provisioners and hands them nothing of ours
    _server = _Server()
    try:
        yield
    finally:
        _server.close()
        _server = None


class ForkedKernel(LocalProvisioner):
    """Start a kernel by way of the process of :func:`forked_kernels`."""

    async def launch_kernel(self, cmd: list[str], **kwargs: Any) -> KernelConnectionInfo:
        """Fork a kernel.

        Parameters
        ----------
        cmd : list of str
            The command line of the kernel's specification: its options only.
        **kwargs : object
            What a process would be started with, of which ``cwd`` and ``env`` count.

        Raises
        ------
        WorkbenchError
            If this is not within :func:`forked_kernels`, or its process has ended.
        """
        if _server is None:
            raise WorkbenchError(f"kernels of {PROVISIONER} run figures and tables only")
        self.cwd = str(kwargs.get("cwd") or os.getcwd())
        environment = dict(kwargs.get("env") or os.environ)
        # Its own group, as soon as it is there.
        self.pid = self.pgid = _server.fork(cmd, self.cwd, environment)
        self.process = _Forked(self.pid)  # type: ignore[assignment]  # as far as it is used
        return self.connection_info


class _Forked:
    """A process that is no child of this one, with what Jupyter asks of a child."""

    stdin = stdout = stderr = None

    def __init__(self, pid: int) -> None:
        self.pid = pid

    def poll(self) -> int | None:
        """Give None while it runs, and 0 when it has ended, however it did."""
        try:
            os.kill(self.pid, 0)
        except ProcessLookupError:
            return 0
        return None

    wait = poll

    def send_signal(self, number: int) -> None:
        """Send a signal."""
        os.kill(self.pid, number)

    def kill(self) -> None:
        """End it at once."""
        self.send_signal(signal.SIGKILL)

    def terminate(self) -> None:
        """Ask it to end."""
        self.send_signal(signal.SIGTERM)


def run_kernel(arguments: list[str]) -> None:
    """Be a kernel, until it is told to end."""
    sys.modules[_UNREAD] = None  # type: ignore[assignment]  # which makes importing it an error
    from ipykernel.kernelapp import launch_new_instance

    launch_new_instance(argv=arguments)


def _serve() -> None:
    """Fork a kernel for each line of arguments, until there is nobody left to send any."""
    sys.modules[_UNREAD] = None  # type: ignore[assignment]  # as in run_kernel
    for module in _PRELOADED:
        import_module(module)
    import numba

    # The first function of a process that numba compiles or loads waits for what numba knows
    # about all types. A trivial one, which runs in no threads, has that wait done here.
    numba.njit(lambda: None)()  # type: ignore[call-arg]  # numba's types know no calls
    # The system then clears kernels away that have ended.
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)
    for line in sys.stdin:
        pid = os.fork()
        if pid == 0:
            _become_kernel(*json.loads(line))
        print(pid, flush=True)  # noqa: T201 - read by fork


def _become_kernel(arguments: list[str], folder: str, environment: dict[str, str]) -> None:
    """Turn a copy of the serving process into a kernel."""
    os.setsid()
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(environment)
    signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    with open(os.devnull) as nothing:
        os.dup2(nothing.fileno(), 0)
    os.dup2(2, 1)
    # It ends when the process that serves does, which ends with the one that asked for kernels.
    run_kernel([*arguments, f"--IPKernelApp.parent_handle={os.getppid()}"])
    os._exit(0)


if __name__ == "__main__":
    _serve()
