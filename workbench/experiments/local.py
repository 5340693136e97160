"""Execute the runs of a grid on this machine, in this process or in several."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Sequence
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path

from workbench.experiments.execution import Outcome, PlannedRun, Workspace, found, keep, one_thread
from workbench.experiments.planning import Task
from workbench.experiments.store import ResultStore

#: Of a worker process, which outlives a task; its next task may be on the same data.
_workspace = Workspace()


def execute_here(tasks: Sequence[Task], folder: Path) -> Iterator[Outcome]:
    """Execute runs in this process and store each as soon as it is finished.

    Parameters
    ----------
    tasks : sequence of list of PlannedRun
        What to execute, in this order.
    folder : Path
        Where results are stored.

    Yields
    ------
    Outcome
        Of each run.
    """
    workspace = Workspace()
    with one_thread(kernels=False):
        for task in tasks:
            for planned in task:
                yield _execute_and_keep(planned, workspace, folder)


def execute_in_processes(
    tasks: Sequence[Task], folder: Path, n_processes: int
) -> Iterator[Outcome]:
    """Execute tasks in worker processes, which store each run as soon as it is finished.

    The end of one worker, for want of memory say, ends all that work beside it. What they
    were at is then executed again, one run at a time, so that a run that ends its process
    fails alone; the rest goes on in parallel.

    Parameters
    ----------
    tasks : sequence of list of PlannedRun
        What to execute, in this order.
    folder : Path
        Where results are stored.
    n_processes : int
        Number of processes.

    Yields
    ------
    Outcome
        Of each run.
    """
    waiting = {id(task): task for task in tasks}
    while waiting:
        try:
            for key, outcomes in _in_pool(dict(waiting), folder, n_processes):
                del waiting[key]
                yield from outcomes
        except BrokenProcessPool:
            warnings.warn(
                "a worker process ended; what it was at is run again, one run at a time",
                stacklevel=2,
            )
        else:
            return
        # Tasks are begun in their order, so it was one of the first that are not finished.
        for key in list(waiting)[:n_processes]:
            for planned in waiting.pop(key):
                yield _execute_alone(planned, folder, n_processes)


def _execute_alone(planned: PlannedRun, folder: Path, n_processes: int) -> Outcome:
    try:
        for _, outcomes in _in_pool({0: [planned]}, folder, n_processes):
            return outcomes[0]
    except BrokenProcessPool:
        pass
    return Outcome(planned, None, message="the process that ran it ended (out of memory?)")


def _in_pool(
    tasks: dict[int, Task], folder: Path, n_processes: int
) -> Iterator[tuple[int, list[Outcome]]]:
    from joblib import Parallel, delayed, parallel_config

    with parallel_config("loky", n_jobs=n_processes, inner_max_num_threads=1):
        pool = Parallel(return_as="generator_unordered", batch_size=1)
        yield from pool(delayed(_execute_task)(key, task, folder) for key, task in tasks.items())


def _execute_task(key: int, task: Task, folder: Path) -> tuple[int, list[Outcome]]:
    return key, [_execute_and_keep(planned, _workspace, folder) for planned in task]


def _execute_and_keep(planned: PlannedRun, workspace: Workspace, folder: Path) -> Outcome:
    store = ResultStore(folder)
    return found(store, planned) or keep(store, workspace.execute(planned))
