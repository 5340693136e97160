"""Put runs into tasks: together what shares steps, apart what keeps processes waiting."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from workbench.experiments.costs import Costs
from workbench.experiments.execution import PlannedRun

#: Runs that one process executes one after the other.
Task = list[PlannedRun]
#: Name of a data set and whether it is standardized.
Data = tuple[str, bool]

#: A task takes no longer than this share of what each process has to do in all, unless it
#: cannot be parted: the last one to end then keeps the others waiting for no longer, and the
#: progress, which is told by task, moves as often.
_LARGEST_SHARE = 1 / 16


def plan_tasks(
    runs: Sequence[PlannedRun], sizes: Mapping[Data, int], costs: Costs, n_processes: int
) -> list[Task]:
    """Put runs into tasks, those that take longest first.

    Runs that start from one projection stay together. All runs of a data set do, so that its
    distances are computed once, as long as they are a small part of the whole; a data set
    that would keep one process busy while the others have nothing left to do is parted, and
    its distances are computed again, which takes a hundredth of the time of its runs.

    Parameters
    ----------
    runs : sequence of PlannedRun
        What to execute.
    sizes : mapping of (str, bool) to int
        Number of samples of each data set, raw or standardized.
    costs : Costs
        What runs are expected to take.
    n_processes : int
        Number of processes that the tasks are for.

    Returns
    -------
    list of list of PlannedRun
    """
    expected = {planned.key: costs.expected(planned.run, sizes[_data(planned)]) for planned in runs}
    parts: dict[Data, dict[str, Task]] = {}
    for planned in runs:
        parts.setdefault(_data(planned), {}).setdefault(_start(planned), []).append(planned)
    largest = float("inf")
    if n_processes > 1:
        largest = _LARGEST_SHARE * sum(expected.values()) / n_processes
    tasks: list[tuple[float, Task]] = []
    for by_start in parts.values():
        tasks += _join(list(by_start.values()), expected, largest)
    return [task for _, task in sorted(tasks, key=lambda item: -item[0])]


def _join(
    parts: Sequence[Task], expected: Mapping[str, float], largest: float
) -> list[tuple[float, Task]]:
    """Join the parts of one data set, in their order, into tasks no larger than allowed."""
    tasks: list[tuple[float, Task]] = []
    for part in parts:
        cost = sum(expected[planned.key] for planned in part)
        if tasks and tasks[-1][0] + cost <= largest:
            before, joined = tasks[-1]
            tasks[-1] = (before + cost, joined + part)
        else:
            tasks.append((cost, part))
    return tasks


def _data(planned: PlannedRun) -> Data:
    return planned.run.dataset, planned.run.standardize


def _start(planned: PlannedRun) -> str:
    """Name the projection that a run starts from; a run that shares none stands for itself."""
    values = planned.run.specification()
    if not values.get("projector") or values.get("two_step"):
        return planned.key
    return f"{values['projector']} {values.get('dimensions')} {values.get('seed')}"
