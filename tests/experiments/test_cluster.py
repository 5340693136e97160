"""The same grid on a Dask cluster: a real scheduler and worker processes on the loopback."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace

import pandas as pd
import pytest

from tests.experiments.logged_runs import LoggedRun, log_lines
from workbench.errors import AdjustmentWarning, WorkbenchError
from workbench.experiments import cluster as cluster_module
from workbench.experiments.grid import run_grid
from workbench.experiments.runs.schemes import SchemeRun
from workbench.experiments.store import ResultStore
from workbench.projection import projectors
from workbench.projection.pca import PCA
from workbench.schemes import SpatialScheme, TemporalScheme

ROOT = Path(__file__).parents[2]


def until(condition: Callable[[], bool], what: str) -> None:
    """Wait for something that another process does."""
    deadline = time.monotonic() + 120
    while not condition():
        assert time.monotonic() < deadline, f"waited in vain for {what}"
        time.sleep(0.05)


@contextmanager
def at_the_same_time(act: Callable[[], None]) -> Iterator[None]:
    """Do something in a thread while a grid runs, and raise what went wrong there."""
    with ThreadPoolExecutor(1) as pool:
        acting = pool.submit(act)
        yield
        acting.result()


class LoopbackCluster:
    """A scheduler and workers, each a process that is ended by its own id."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.file = folder / "scheduler.json"
        self.scheduler = self._start(
            "distributed.cli.dask_scheduler",
            *("--host", "127.0.0.1", "--port", "0", "--no-dashboard"),
        )
        self.workers: list[subprocess.Popen] = []
        until(self._address_is_there, "the scheduler")
        self.address = json.loads(self.file.read_text())["address"]

    def add_worker(self, threads: int = 1) -> subprocess.Popen:
        worker = self._start(
            "distributed.cli.dask_worker",
            *("--host", "127.0.0.1", "--no-dashboard", "--death-timeout", "60"),
            *("--local-directory", str(self.folder), "--no-nanny", "--nthreads", str(threads)),
        )
        self.workers.append(worker)
        return worker

    def end(self) -> None:
        # None of them has anything to keep, and saying goodbye to each other takes them seconds.
        for process in [*self.workers, self.scheduler]:
            process.kill()
        for process in [*self.workers, self.scheduler]:
            process.wait()

    def _start(self, module: str, *options: str) -> subprocess.Popen:
        return subprocess.Popen(
            [sys.executable, "-m", module, "--scheduler-file", str(self.file), *options],
            cwd=self.folder,
            env={**os.environ, "PYTHONPATH": str(ROOT)},
            stdout=subprocess.DEVNULL,
            stderr=(self.folder / "log of processes").open("a"),
        )

    def _address_is_there(self) -> bool:
        try:
            return bool(json.loads(self.file.read_text())["address"])
        except (OSError, ValueError, KeyError):
            return False


@pytest.fixture(autouse=True)
def _patient(monkeypatch) -> None:
    """Wait for workers as long as they take to start on a busy machine."""
    monkeypatch.setattr(cluster_module, "_PATIENCE", 60)


@pytest.fixture
def own_cluster(tmp_path: Path) -> Iterator[LoopbackCluster]:
    """Give a cluster without workers, which the test may damage."""
    cluster = LoopbackCluster(tmp_path)
    yield cluster
    cluster.end()


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LoopbackCluster]:
    """Give a cluster of two workers for tests that leave it whole."""
    cluster = LoopbackCluster(tmp_path_factory.mktemp("cluster"))
    cluster.add_worker()
    cluster.add_worker()
    yield cluster
    cluster.end()


def values(table: pd.DataFrame) -> pd.DataFrame:
    """Leave the times out of a table."""
    return table[[name for name in table.columns if not name.startswith("seconds")]]


def test_a_cluster_gives_the_same_values_to_the_last_bit(cluster: LoopbackCluster, tmp_path: Path):
    """Tables and arrays are those of this process, and stored by it."""
    schemes = [
        SpatialScheme("pca", selector="random", optimizer="alg12"),
        SpatialScheme("tsne", selector="random"),
    ]
    runs = [
        *(SchemeRun("uci/wine", scheme, ratio=0.1) for scheme in schemes),
        SchemeRun("uci/iris", schemes[0], ratio=0.05, standardize=True),
        SchemeRun("cmu/01_01-jump", TemporalScheme("slerp"), ratio=0.03),
    ]
    here = run_grid(runs, tmp_path / "here")
    there = run_grid(runs, tmp_path / "there", scheduler=cluster.address)
    assert there["status"].tolist() == ["done"] * 4
    pd.testing.assert_frame_equal(values(there), values(here), check_exact=True)
    for key in here["key"]:
        expected = ResultStore(tmp_path / "here").arrays(key)
        found = ResultStore(tmp_path / "there").arrays(key)
        assert {name: array.tobytes() for name, array in found.items()} == {
            name: array.tobytes() for name, array in expected.items()
        }


def test_finished_runs_are_not_sent(cluster: LoopbackCluster, tmp_path: Path):
    """What is stored here is not computed there again, and a repeated call computes nothing."""
    runs = [LoggedRun("uci/iris", number, str(tmp_path)) for number in range(4)]
    run_grid(runs[:2], tmp_path / "results")
    for _ in range(2):
        table = run_grid(runs, tmp_path / "results", scheduler=cluster.address)
        assert table["status"].tolist() == ["done"] * 4
    lines = log_lines(tmp_path)
    assert sorted(number for number, _ in lines) == [0, 1, 2, 3]
    processes = {process for number, process in lines if number > 1}
    assert processes <= {worker.pid for worker in cluster.workers}


def test_workers_do_not_wait_for_each_other(cluster: LoopbackCluster, tmp_path: Path):
    """While one worker waits in its run the other does all the rest."""
    runs = [LoggedRun(f"uci/{name}", n, str(tmp_path)) for name in ("iris", "wine") for n in (0, 1)]
    first = LoggedRun("uci/wine", 7, str(tmp_path), "waits")

    def go() -> None:
        until(lambda: len(log_lines(tmp_path)) == 5, "the other worker")
        (tmp_path / "go").touch()

    with at_the_same_time(go):
        table = run_grid([first, *runs], tmp_path / "results", scheduler=cluster.address)
    assert table["status"].tolist() == ["done"] * 5
    by_process = Counter(process for _, process in log_lines(tmp_path))
    assert sorted(by_process.values()) == [1, 4]


def test_the_run_of_a_killed_worker_is_run_again_elsewhere(
    own_cluster: LoopbackCluster, tmp_path: Path
):
    """SIGKILL in the middle of a run costs that run alone: all others are computed once."""
    workers = [own_cluster.add_worker(), own_cluster.add_worker()]
    runs = [LoggedRun(f"uci/{name}", n, str(tmp_path)) for name in ("iris", "wine") for n in (0, 1)]
    runs.insert(1, LoggedRun("uci/iris", 7, str(tmp_path), "waits"))

    def kill() -> None:
        until(lambda: 7 in dict(log_lines(tmp_path)), "the run that waits")
        until(lambda: len(list((tmp_path / "results").glob("*.json"))) == 4, "the others")
        process = dict(log_lines(tmp_path))[7]
        next(worker for worker in workers if worker.pid == process).send_signal(signal.SIGKILL)
        (tmp_path / "go").touch()

    with at_the_same_time(kill):
        table = run_grid(runs, tmp_path / "results", scheduler=own_cluster.address)
    assert table["status"].tolist() == ["done"] * 5
    lines = log_lines(tmp_path)
    assert Counter(number for number, _ in lines) == {0: 2, 1: 2, 7: 2}  # 0 and 1 on two data sets
    assert {process for number, process in lines if number == 7} == {w.pid for w in workers}


def test_a_late_worker_goes_on_for_a_lost_one(
    own_cluster: LoopbackCluster, tmp_path: Path, monkeypatch
):
    """The results of a worker are stored before it gets its next run, so they survive it."""
    warned: list[str] = []
    warner = SimpleNamespace(warn=lambda message, **_: warned.append(message))
    monkeypatch.setattr(cluster_module, "warnings", warner)
    first = own_cluster.add_worker()
    runs = [
        LoggedRun("uci/iris", 0, str(tmp_path)),
        LoggedRun("uci/iris", 2, str(tmp_path), "waits"),
        LoggedRun("uci/iris", 4, str(tmp_path)),
    ]

    def replace() -> None:
        until(lambda: 2 in dict(log_lines(tmp_path)), "the run that waits")
        first.send_signal(signal.SIGKILL)
        first.wait()
        (tmp_path / "go").touch()
        until(lambda: "no worker is left; waiting for one" in warned, "the warning")
        own_cluster.add_worker()

    with at_the_same_time(replace):
        table = run_grid(runs, tmp_path / "results", scheduler=own_cluster.address)
    assert table["status"].tolist() == ["done"] * 3
    assert [number for number, _ in log_lines(tmp_path)] == [0, 2, 2, 4]


def test_a_run_that_ends_its_workers_fails_alone(
    own_cluster: LoopbackCluster, tmp_path: Path, monkeypatch
):
    """After as many workers as it may end the run fails by name, and the others are done."""
    monkeypatch.setattr(cluster_module, "_ALLOWED_ENDS", 2)
    for _ in range(3):
        own_cluster.add_worker()
    runs = [LoggedRun("uci/iris", number, str(tmp_path)) for number in range(4)]
    runs[1] = LoggedRun("uci/iris", 1, str(tmp_path), "dies")
    table = run_grid(runs, tmp_path / "results", scheduler=own_cluster.address)
    assert table["status"].tolist() == ["done", "failed", "done", "done"]
    assert table["message"][1] == "run 1: the workers that ran it ended, 2 times (out of memory?)"
    assert Counter(number for number, _ in log_lines(tmp_path)) == {0: 1, 1: 2, 2: 1, 3: 1}


def test_a_lost_scheduler_is_told_and_results_are_kept(
    own_cluster: LoopbackCluster, tmp_path: Path
):
    """A run in progress is lost with the scheduler, the one before it is stored."""
    own_cluster.add_worker()
    runs = [
        LoggedRun("uci/iris", 0, str(tmp_path)),
        LoggedRun("uci/iris", 2, str(tmp_path), "waits"),
    ]

    def kill() -> None:
        until(lambda: len(log_lines(tmp_path)) == 2, "the run that waits")
        own_cluster.scheduler.send_signal(signal.SIGKILL)

    lost = pytest.raises(WorkbenchError, match=r"the connection to tcp://127.* was lost")
    with at_the_same_time(kill), lost:
        run_grid(runs, tmp_path / "results", scheduler=own_cluster.address)
    (tmp_path / "go").touch()
    assert len(list((tmp_path / "results").glob("*.json"))) == 1
    assert run_grid(runs, tmp_path / "results")["status"].tolist() == ["done"] * 2
    assert [number for number, _ in log_lines(tmp_path)] == [0, 2, 2]


def test_other_data_of_a_worker_are_refused(cluster: LoopbackCluster, tmp_path: Path, monkeypatch):
    """A file of the same name that a worker finds does not pass for the one that is meant."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "table.csv").write_text("x,y\n" + "\n".join(f"{i},{i * i}" for i in range(20)))
    (cluster.folder / "table.csv").write_text("x,y\n" + "\n".join(f"{i},{-i}" for i in range(20)))
    (tmp_path / "only here.csv").write_text((tmp_path / "table.csv").read_text())
    names = ("table.csv", "only here.csv", "uci/iris")
    runs = [SchemeRun(name, SpatialScheme("pca", selector="random"), count=5) for name in names]
    table = run_grid(runs, tmp_path / "results", scheduler=cluster.address)
    assert table["status"].tolist() == ["failed", "failed", "done"]
    assert "on a worker: WorkbenchError: table.csv: the data found where" in table["message"][0]
    assert "only here.csv: there is no such file" in table["message"][1]


def test_methods_of_this_process_are_unknown_there(
    cluster: LoopbackCluster, tmp_path: Path, monkeypatch
):
    """A method that a notebook registers fails by name; the other run is done."""
    monkeypatch.setitem(projectors._entries, "mine", PCA)
    runs = [
        SchemeRun("uci/iris", SpatialScheme(name, selector="random"), ratio=0.05)
        for name in ("mine", "pca")
    ]
    table = run_grid(runs, tmp_path, scheduler=cluster.address)
    assert table["status"].tolist() == ["failed", "done"]
    assert "on a worker: WorkbenchError: projector: got 'mine'" in table["message"][0]


@pytest.mark.parametrize(
    "address",
    [
        "tcp://127.0.0.1:1",
        "127.0.0.1:1",
        "tcp://127.0.0.1",
        "carrier-pigeon://home",
        "",
        "tls://127.0.0.1:1",
    ],
    ids=["nobody there", "no protocol", "no port", "unknown protocol", "empty", "no certificate"],
)
def test_an_unreachable_scheduler_is_one_line(tmp_path: Path, monkeypatch, address: str):
    """Whatever is wrong with an address, the error names it in one line."""
    monkeypatch.setattr(cluster_module, "_PATIENCE", 1)
    runs = [LoggedRun("uci/iris", 0, str(tmp_path))]
    with pytest.raises(WorkbenchError, match="no Dask scheduler answers") as error:
        run_grid(runs, tmp_path / "results", scheduler=address)
    assert "\n" not in str(error.value)


def test_workers_are_asked_for_as_they_should_be(
    own_cluster: LoopbackCluster, tmp_path: Path, monkeypatch
):
    """A grid does not wait for ever for workers, and says that it wants one thread in each."""
    runs = [LoggedRun("uci/iris", number, str(tmp_path)) for number in range(3)]
    with monkeypatch.context() as patch:
        patch.setattr(cluster_module, "_PATIENCE", 1)
        with pytest.raises(WorkbenchError, match="has no workers; start some by `dask worker"):
            run_grid(runs, tmp_path / "results", scheduler=own_cluster.address)
    own_cluster.add_worker(threads=3)
    with pytest.warns(AdjustmentWarning, match="--nthreads 1"):
        table = run_grid(runs, tmp_path / "results", scheduler=own_cluster.address)
    assert table["status"].tolist() == ["done"] * 3


def test_the_missing_package_is_named(tmp_path: Path, monkeypatch):
    """Without Dask the message says which extra brings it."""
    monkeypatch.setitem(sys.modules, "distributed", None)
    runs = [LoggedRun("uci/iris", 0, str(tmp_path))]
    with pytest.raises(WorkbenchError, match=r"install workbench\[cluster\]"):
        run_grid(runs, tmp_path / "results", scheduler="tcp://127.0.0.1:8786")
