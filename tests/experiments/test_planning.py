"""What runs cost, and how they are put into tasks."""

from __future__ import annotations

import heapq
from collections.abc import Sequence

import pytest

from workbench.experiments.costs import Costs
from workbench.experiments.execution import PlannedRun
from workbench.experiments.planning import plan_tasks
from workbench.experiments.runs.base import Run
from workbench.experiments.runs.schemes import SchemeRun
from workbench.schemes import SpatialScheme, TemporalScheme

SCHEMES = [
    TemporalScheme("slerp"),
    TemporalScheme("slerp", selector="scs"),
    *(SpatialScheme(p, optimizer=o) for p in ("pca", "mds", "isomap", "lle", "tsne")
      for o in (None, "alg12")),
]  # fmt: skip
#: Frames of six clips, one of which is as much work as all others.
FRAMES = {"huge": 1143, "a": 540, "b": 525, "c": 517, "d": 494, "e": 434}


def planned(names: Sequence[str], schemes: Sequence = SCHEMES) -> list[PlannedRun]:
    return [
        PlannedRun(SchemeRun(name, scheme, ratio=0.03), f"{name} {number}", "", {})
        for name in names
        for number, scheme in enumerate(schemes)
    ]


def sizes(names: Sequence[str]) -> dict[tuple[str, bool], int]:
    return {(name, False): FRAMES[name] for name in names}


def makespan(durations: Sequence[float], n_processes: int) -> float:
    """Simulate processes that take one task after the other, in the order given."""
    free = [0.0] * n_processes
    for duration in durations:
        heapq.heapreplace(free, free[0] + duration)
    return max(free)


@pytest.mark.parametrize("n_processes", [2, 3, 4])
@pytest.mark.parametrize("names", [list(FRAMES), ["huge", "a"], ["huge"]], ids=len)
def test_processes_end_at_nearly_the_same_time(names: list[str], n_processes: int):
    """A data set that is most of the work does not keep one process busy and the others idle."""
    costs = Costs()
    tasks = plan_tasks(planned(names), sizes(names), costs, n_processes)
    spent = [sum(costs.expected(p.run, FRAMES[p.run.dataset]) for p in task) for task in tasks]
    # A projection and what starts from it are not parted.
    indivisible = costs.expected(SchemeRun("", SCHEMES[-1], ratio=0.03), FRAMES[names[0]]) + (
        costs.expected(SchemeRun("", SCHEMES[-2], ratio=0.03), FRAMES[names[0]])
    )
    ideal = max(sum(spent) / n_processes, indivisible)
    assert makespan(spent, n_processes) <= 1.15 * ideal


@pytest.mark.parametrize("n_processes", [1, 2, 8])
def test_every_run_is_in_one_task_with_those_that_share_its_projection(n_processes: int):
    """Nothing is lost or done twice, a task has one data set and a projection one task."""
    runs = planned(list(FRAMES))
    tasks = plan_tasks(runs, sizes(list(FRAMES)), Costs(), n_processes)
    assert sorted(p.key for task in tasks for p in task) == sorted(p.key for p in runs)
    place = {}
    for number, task in enumerate(tasks):
        assert len({p.run.dataset for p in task}) == 1
        for p in task:
            scheme = p.run.scheme
            if isinstance(scheme, SpatialScheme):
                assert place.setdefault((p.run.dataset, scheme.projector), number) == number


def test_one_process_takes_each_data_set_as_a_whole():
    """Alone, there is nobody to share with; distances are computed once."""
    tasks = plan_tasks(planned(list(FRAMES)), sizes(list(FRAMES)), Costs(), 1)
    assert tasks[0][0].run.dataset == "huge"
    assert len(tasks) == len(FRAMES)


def test_small_data_sets_are_not_parted():
    """Of many data sets that are alike, each is one task, whose distances are computed once."""
    names = [f"clip {number}" for number in range(40)]
    runs = planned(names)
    tasks = plan_tasks(runs, {(name, False): 500 for name in names}, Costs(), 2)
    assert len(tasks) == 40


def test_the_rate_of_a_method_is_that_of_its_runs():
    """Twice the samples take four times as long; other methods are judged by all of their kind."""
    costs = Costs()
    slow, fast = (SchemeRun("x", scheme, ratio=0.03) for scheme in SCHEMES[2:4])
    before = costs.expected(fast, 100) / costs.expected(slow, 100)
    costs.learn(slow, 100, 3.0)
    assert costs.expected(slow, 200) == pytest.approx(12.0)
    assert costs.expected(fast, 100) == pytest.approx(3.0 * before)
    costs.learn(fast, 100, 1.0)
    assert costs.expected(fast, 100) == pytest.approx(1.0)
    other: Run = SchemeRun("y", SCHEMES[2], ratio=0.03, seed=5)
    assert costs.expected(other, 100) == pytest.approx(3.0)
