"""Grids that meet kill -9, lost workers, damaged files and full disks."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
import warnings
from dataclasses import replace
from pathlib import Path

import pandas as pd
import pytest

from tests.experiments import slow_grid
from tests.experiments.logged_runs import LoggedRun, log_lines
from tests.experiments.small_grids import PAIR, RAW, in_fresh_process, untimed
from workbench.errors import WorkbenchError
from workbench.experiments.grid import describe_failures, run_grid
from workbench.experiments.runs.schemes import SchemeRun
from workbench.schemes import SpatialScheme, TemporalScheme

FULL_DISK = """
import resource, sys
from workbench.errors import WorkbenchError
from workbench.experiments.grid import run_grid
from tests.experiments.logged_runs import LoggedRun, log_lines

if __name__ == "__main__":
    runs = [LoggedRun("uci/iris", 0, sys.argv[1]), LoggedRun("uci/yeast", 0, sys.argv[1])]
    resource.setrlimit(resource.RLIMIT_FSIZE, (8000, 8000))
    try:
        run_grid(runs, sys.argv[1] + "/results")
    except WorkbenchError as error:
        print(error)
"""


def test_a_damaged_result_is_computed_again(tmp_path: Path, counted: list[int]):
    """Damage to one file costs one run, and leaves the same values."""
    runs = [
        SchemeRun("uci/iris", SpatialScheme("counted", selector="random"), ratio=0.05, seed=seed)
        for seed in range(3)
    ]
    first = run_grid(runs, tmp_path)
    damaged = tmp_path / f"{first['key'][1]}.json"
    damaged.write_bytes(damaged.read_bytes()[:100])
    with pytest.warns(UserWarning, match="damaged"):
        again = run_grid(runs, tmp_path)
    assert len(counted) == 4
    pd.testing.assert_frame_equal(untimed(again), untimed(first))


def test_a_failing_run_is_named_and_leaves_the_others(tmp_path: Path):
    """A table has no time and a name no data; the run between them finishes."""
    runs = [
        SchemeRun("uci/iris", TemporalScheme("slerp"), ratio=0.05),
        PAIR[0],
        SchemeRun("no/data", RAW, count=3),
    ]
    table = run_grid(runs, tmp_path)
    assert table["status"].tolist() == ["failed", "done", "failed"]
    assert table["message"][0].startswith("uci/iris, slerp, uniform, 5 %, seed 0: ")
    assert "no time" in table["message"][0]
    assert "no/data" in table["message"][2]
    assert describe_failures(table).startswith("2 of 3 runs failed; the first: uci/iris, slerp")
    assert describe_failures(table[1:2]) == ""


def test_a_worker_that_dies_costs_its_own_run_only(tmp_path: Path):
    """A run that ends its process fails by name, whatever ran beside and behind it is done."""
    runs = [
        LoggedRun(f"uci/{name}", number, str(tmp_path))
        for name in ("iris", "wine")
        for number in range(4)
    ]
    runs[1] = replace(runs[1], act="dies")
    with pytest.warns(UserWarning, match="a worker process ended"):
        table = run_grid(runs, tmp_path / "results", n_jobs=2)
    assert table["status"].tolist() == ["done", "failed", *["done"] * 6]
    assert table["message"][1] == "run 1: the process that ran it ended (out of memory?)"
    for run, (_, row) in zip(runs, table.iterrows(), strict=True):
        assert (tmp_path / "results" / f"{row['key']}.json").exists() == (run is not runs[1])


class _Interrupted:
    """A grid in a process of its own that waits in its third run."""

    def __init__(self, folder: Path) -> None:
        self.results, self.log, self.go = folder / "results", folder / "log", folder / "go"
        self.process = subprocess.Popen(
            [
                sys.executable,
                "-m",
                slow_grid.__name__,
                str(self.results),
                str(self.log),
                str(self.go),
            ],
            cwd=Path(__file__).parents[2],
        )

    def lines(self) -> list[str]:
        return self.log.read_text().splitlines() if self.log.exists() else []

    def wait_for_third_run(self) -> None:
        deadline = time.monotonic() + 120
        while len(self.lines()) < 3:
            assert self.process.poll() is None, "the grid ended by itself"
            assert time.monotonic() < deadline, "the grid did not get to its third run"
            time.sleep(0.05)


def test_a_killed_grid_goes_on_where_it_was(tmp_path: Path):
    """After kill -9 in the third of five runs, the first two are not computed again."""
    interrupted = _Interrupted(tmp_path)
    interrupted.wait_for_third_run()
    interrupted.process.send_signal(signal.SIGKILL)
    interrupted.process.wait()
    before = {path: path.stat().st_mtime_ns for path in interrupted.results.glob("*.json")}
    assert len(before) == 2

    interrupted.go.touch()
    table = slow_grid.run(interrupted.results, interrupted.log, interrupted.go)
    assert table["status"].tolist() == ["done"] * 5
    # Three runs before the end, of which the third was lost, and three after it.
    assert len(interrupted.lines()) == 6
    assert {path: path.stat().st_mtime_ns for path in before} == before


def test_two_processes_share_a_folder(tmp_path: Path):
    """While one process waits in a run another finishes the rest; both end with all results."""
    first = _Interrupted(tmp_path)
    first.wait_for_third_run()
    # The line of the run that waits is there, so the runs of this process go through.
    table = slow_grid.run(first.results, first.log, first.go)
    assert table["status"].tolist() == ["done"] * 5
    # Found finished: 2. Computed here: 3, of which the first process still holds one.
    assert len(first.lines()) == 6
    first.go.touch()
    assert first.process.wait(timeout=60) == 0
    # The waiting process found the last two finished.
    assert len(first.lines()) == 6
    stored = [json.loads(path.read_text()) for path in first.results.glob("*.json")]
    assert {record["key"] for record in stored} == set(table["key"])


def test_a_full_disk_costs_what_was_not_stored(tmp_path: Path):
    """Where a file ends for want of space no result is taken for whole; with space it goes on."""
    process = in_fresh_process(FULL_DISK, tmp_path)
    said, _ = process.communicate(timeout=280)
    assert process.returncode == 0
    assert "a result could not be stored (File too large)" in said
    assert "run the grid again" in said
    results = tmp_path / "results"
    assert [path.suffix for path in results.iterdir() if path.suffix != ".json"] in ([], [".npz"])
    runs = [LoggedRun(name, 0, str(tmp_path)) for name in ("uci/iris", "uci/yeast")]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert run_grid(runs, results)["status"].tolist() == ["done"] * 2
    # Yeast, the larger one, was begun first and is the one that was too large.
    assert len(log_lines(tmp_path)) == 3


def test_a_folder_that_takes_nothing_is_refused_at_once(tmp_path: Path):
    """Nothing is computed that could not be stored."""
    (tmp_path / "file").write_text("")
    runs = [LoggedRun("uci/iris", 0, str(tmp_path))]
    with pytest.raises(WorkbenchError, match="cannot be made"):
        run_grid(runs, tmp_path / "file" / "results")
    assert log_lines(tmp_path) == []
