"""Execute the runs of a grid on a Dask cluster.

The workers compute; what is stored, and which run comes next, is decided here. So workers need
not share a disk with this process, and a worker that is lost costs the run it was at.
"""

from __future__ import annotations

import queue
import threading
import warnings
from collections import Counter, deque
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from workbench.errors import AdjustmentWarning, WorkbenchError
from workbench.experiments.execution import Outcome, PlannedRun, Workspace, found, keep, one_thread
from workbench.experiments.planning import Task
from workbench.experiments.store import ResultStore

if TYPE_CHECKING:
    from distributed import Client, Future

#: Seconds to wait for the scheduler, and for its first worker.
_PATIENCE = 10
#: Seconds after which to look for new workers while none of the runs is finished.
_LOOK_AROUND = 2

#: Seconds for a result to arrive from a worker that has nothing else to do.
_GATHERING = 60
#: A run that has ended so many workers is not given to another.
_ALLOWED_ENDS = 3
#: Runs are parted for as many workers at least, since more may come than are there at first.
_WORKERS_TO_COME = 8

#: Of a worker, which outlives a run; its next run may be on the same data.
_workspace = Workspace()
#: Where a worker has several threads, runs still go one after the other: warnings, which runs
#: record, and the number of numerical threads belong to the whole process.
_one_at_a_time = threading.Lock()


class Cluster:
    """Workers of a Dask scheduler; a context that ends with the connection.

    Parameters
    ----------
    address : str
        Of the scheduler, such as ``"tcp://127.0.0.1:8786"``.

    Raises
    ------
    WorkbenchError
        If the package for it is not installed, the scheduler does not answer within ten
        seconds, or has no workers after ten more.
    """

    def __init__(self, address: str) -> None:
        self._address = address
        self._client = _connect(address)
        try:
            self._client.wait_for_workers(1, timeout=_PATIENCE)
        except TimeoutError:
            self._client.close()
            raise WorkbenchError(
                f"scheduler: {address} has no workers; start some by "
                f"`dask worker {address} --nworkers auto --nthreads 1` where workbench is installed"
            ) from None
        if max(self._client.nthreads().values(), default=1) > 1:
            warnings.warn(
                "each worker process executes one run at a time; start the workers with "
                "--nthreads 1, and one for each core",
                AdjustmentWarning,
                stacklevel=2,
            )

    def __enter__(self) -> Cluster:
        return self

    def __exit__(self, *error: object) -> None:
        self._client.close()

    def n_workers(self) -> int:
        """Tell for how many workers to part the runs: for some that come later too."""
        return max(_WORKERS_TO_COME, len(self._client.nthreads()))

    def execute(self, tasks: Sequence[Task], store: ResultStore) -> Iterator[Outcome]:
        """Execute tasks on the workers and store each run here as soon as it is finished.

        A run whose worker is lost is executed again on another one; if that is lost too, and
        the next, it fails, and the others go on. Workers that come later take part.

        Parameters
        ----------
        tasks : sequence of list of PlannedRun
            What to execute, in this order.
        store : ResultStore
            Where results are stored.

        Yields
        ------
        Outcome
            Of each run.

        Raises
        ------
        WorkbenchError
            If the scheduler is lost.
        """
        dispatch = _Dispatch(self._client, tasks, store)
        try:
            for outcome in dispatch.outcomes():
                yield keep(store, outcome)
        except _lost_connection() as error:
            raise WorkbenchError(
                f"scheduler: the connection to {self._address} was lost; finished runs are "
                "kept, so start it and run the grid again"
            ) from error
        finally:
            dispatch.cancel()


class _Dispatch:
    """Give each worker one run at a time, from a task that it alone goes through.

    A run that was handed out before its turn would be suspected, too, of having ended its
    worker; and one that is handed to the worker of the run before it finds the steps that
    they share.
    """

    def __init__(self, client: Client, tasks: Sequence[Task], store: ResultStore) -> None:
        self._client = client
        self._store = store
        self._waiting = deque(deque(task) for task in tasks)
        self._begun: dict[str, deque[PlannedRun]] = {}
        self._running: dict[Future, tuple[PlannedRun, str]] = {}
        self._ends: Counter[str] = Counter()
        self._ended: queue.SimpleQueue[Future] = queue.SimpleQueue()
        self._alone = False

    def outcomes(self) -> Iterator[Outcome]:
        """Hand out runs and give what became of each, until none is left."""
        while True:
            yield from self._hand_out()
            if not (self._waiting or self._begun or self._running):
                return
            try:
                future = self._ended.get(timeout=_LOOK_AROUND)
            except queue.Empty:
                continue
            if future not in self._running:
                continue  # its worker was lost, and the run is handed out again
            planned, _ = self._running.pop(future)
            try:
                outcome = _outcome(future, planned)
            except TimeoutError:
                yield from self._again(planned)
            else:
                yield outcome
            # Or the scheduler would compute it once more when that worker is lost later.
            future.release()

    def cancel(self) -> None:
        """Forget what was handed out and is not finished."""
        if self._running and self._client.status == "running":
            self._client.cancel(list(self._running))
        self._running.clear()

    def _hand_out(self) -> Iterator[Outcome]:
        """Give each idle worker its next run; pass on what is found finished meanwhile."""
        workers = list(self._client.nthreads())
        self._notice_absence(workers)
        for lost in self._begun.keys() - workers:
            rest = self._begun.pop(lost)
            if rest:
                self._waiting.appendleft(rest)
        for future, (planned, worker) in list(self._running.items()):
            if worker not in workers:
                del self._running[future]
                future.release()
                yield from self._again(planned)
        busy = {worker for _, worker in self._running.values()}
        for worker in workers:
            while worker not in busy and (task := self._task_of(worker)):
                planned = task.popleft()
                outcome = found(self._store, planned)
                if outcome is None:
                    self._submit(planned, worker)
                    break
                yield outcome

    def _again(self, planned: PlannedRun) -> Iterator[Outcome]:
        """Let a run whose worker was lost be the next to be handed out, or give it up."""
        self._ends[planned.key] += 1
        ends = self._ends[planned.key]
        if ends < _ALLOWED_ENDS:
            self._waiting.appendleft(deque([planned]))
        else:
            message = f"the workers that ran it ended, {ends} times (out of memory?)"
            yield Outcome(planned, None, message=message)

    def _task_of(self, worker: str) -> deque[PlannedRun] | None:
        """Give the task that a worker is at, or the next one, if there is any."""
        if not self._begun.get(worker):
            self._begun.pop(worker, None)
            if not self._waiting:
                return None
            self._begun[worker] = self._waiting.popleft()
        return self._begun[worker]

    def _submit(self, planned: PlannedRun, worker: str) -> None:
        future = self._client.submit(execute_on_worker, planned, workers=[worker], pure=False)
        self._running[future] = (planned, worker)
        future.add_done_callback(self._ended.put)

    def _notice_absence(self, workers: Sequence[str]) -> None:
        if not workers and not self._alone:
            warnings.warn("no worker is left; waiting for one", stacklevel=2)
        self._alone = not workers


def execute_on_worker(planned: PlannedRun) -> Outcome:
    """Execute a run on a worker of a cluster.

    Parameters
    ----------
    planned : PlannedRun
        The run; refused if data, code or versions of the worker are not those that it was
        planned with.

    Returns
    -------
    Outcome
    """
    with _one_at_a_time, one_thread(kernels=True):
        return _workspace.execute(planned)


def _outcome(future: Future, planned: PlannedRun) -> Outcome:
    from distributed import KilledWorker

    try:
        outcome: Outcome = future.result(timeout=_GATHERING)
    except KilledWorker:  # one that was started again and again under the same address
        message = "the worker that ran it ended, several times (out of memory?)"
        return Outcome(planned, None, message=message)
    except _lost_connection():
        raise
    except TimeoutError:  # the worker was lost with the result
        raise
    except Exception as error:  # the worker has no such module, say
        return Outcome(planned, None, message=f"on a worker: {type(error).__name__}: {error}")
    if outcome.row is None:
        return Outcome(planned, None, message=f"on a worker: {outcome.message}")
    return Outcome(planned, outcome.row, outcome.arrays)


def _lost_connection() -> tuple[type[BaseException], ...]:
    from concurrent.futures import CancelledError

    from distributed.comm.core import CommClosedError

    return CancelledError, CommClosedError


def _connect(address: str) -> Client:
    try:
        from distributed import Client
    except ImportError:
        raise WorkbenchError(
            "scheduler: a Dask cluster needs the extra 'cluster'; install workbench[cluster]"
        ) from None
    options: dict[str, Any] = {"timeout": _PATIENCE, "set_as_default": False}
    try:
        return Client(address, **options)
    except Exception as error:  # each kind of address fails in a way of its own
        reason = str(error).partition("\n")[0] or type(error).__name__
        raise WorkbenchError(
            f"scheduler: no Dask scheduler answers at {address!r} ({reason})"
        ) from None
