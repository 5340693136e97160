"""Grids of runs: in parallel, never twice, the same everywhere."""

from __future__ import annotations

from pathlib import Path

import pandas as pd
import pytest

from tests.experiments.small_grids import OPTIMIZED, PAIR, RAW, in_fresh_process, untimed
from workbench.errors import WorkbenchError
from workbench.experiments.grid import Advance, run_grid
from workbench.experiments.runs.schemes import SchemeRun
from workbench.schemes import SpatialScheme, TemporalScheme

SMALL_GRID = """
import sys
from workbench.experiments.grid import run_grid
from workbench.experiments.runs.schemes import SchemeRun
from workbench.schemes import SpatialScheme, TemporalScheme

if __name__ == "__main__":
    schemes = [SpatialScheme(p, optimizer=o) for p in ("pca", "tsne") for o in (None, "alg12")]
    runs = [SchemeRun("uci/wine", s, ratio=0.1) for s in schemes]
    others = (TemporalScheme("slerp"), schemes[1])
    runs += [SchemeRun("cmu/01_01-jump", s, ratio=0.03) for s in others]
    table = run_grid(runs, sys.argv[1], n_jobs=int(sys.argv[2]))
    table = table[[name for name in table.columns if not name.startswith("seconds")]]
    print(table.to_json(orient="records", double_precision=15))
    print([value.hex() for value in table["error"]])
"""


def test_finished_runs_are_not_computed_again(tmp_path: Path, counted: list[int]):
    """A second call reads everything and gives the same table to the last bit."""
    runs = [SchemeRun("uci/iris", SpatialScheme("counted", selector="random"), ratio=0.05)]
    first = run_grid(runs, tmp_path)
    pd.testing.assert_frame_equal(run_grid(runs, tmp_path), first)
    assert counted == [150]


def test_runs_in_processes_give_the_sameuntimed(tmp_path: Path):
    """Two worker processes give what this process gives, in the order asked for."""
    runs = [
        *PAIR,
        SchemeRun("uci/wine", RAW, ratio=0.05),
        SchemeRun("cmu/01_03-walk", OPTIMIZED, count=9),
    ]
    here = run_grid(runs, tmp_path / "here")
    there = run_grid(runs, tmp_path / "there", n_jobs=2)
    assert there["dataset"].tolist() == [run.dataset for run in runs]
    pd.testing.assert_frame_equal(untimed(there), untimed(here), check_exact=False, rtol=1e-9)


def test_repetitions_are_one_run(tmp_path: Path):
    """A run that is asked for twice has one row."""
    assert len(run_grid([PAIR[0], PAIR[0]], tmp_path)) == 1


def test_no_runs_give_a_table_without_rows(tmp_path: Path):
    """Readers of an empty grid still find the columns."""
    table = run_grid([], tmp_path)
    assert len(table) == 0
    assert {"status", "dataset", "error"} <= set(table.columns)


def test_progress_counts_up_to_all_runs(tmp_path: Path):
    """Progress starts with what is found and ends with all runs and all the work."""
    run_grid(PAIR[:1], tmp_path)
    seen: list[Advance] = []
    run_grid([*PAIR, SchemeRun("uci/wine", RAW, ratio=0.05)], tmp_path, progress=seen.append)
    assert (seen[0].finished, seen[0].total, seen[0].share) == (1, 3, 0.0)
    assert [advance.finished for advance in seen] == [1, 2, 3]
    assert seen[-1].share == pytest.approx(1.0)


def test_parquet_holds_the_results(tmp_path: Path):
    """The table on disk has the rows of the table returned."""
    table = run_grid(PAIR, tmp_path)
    stored = pd.read_parquet(tmp_path / "runs.parquet")
    assert sorted(stored["error"]) == sorted(table["error"])


def test_jobs_must_make_sense(tmp_path: Path):
    """Zero processes can run nothing."""
    with pytest.raises(WorkbenchError, match="n_jobs: got 0"):
        run_grid(PAIR, tmp_path, n_jobs=0)


def test_tables_are_the_same_to_the_last_bit_in_any_process(tmp_path: Path):
    """Fresh processes, one worker or two, and two grids in one folder at once: one table."""
    places = [("a", 1), ("b", 1), ("c", 2), ("together", 1), ("together", 2)]
    started = [in_fresh_process(SMALL_GRID, tmp_path / name, jobs) for name, jobs in places]
    printed = [process.communicate(timeout=280)[0] for process in started]
    assert all(process.returncode == 0 for process in started)
    assert "done" in printed[0]
    assert printed == [printed[0]] * len(places)
    arrays = [
        {file.name: file.read_bytes() for file in (tmp_path / name).glob("*.npz")}
        for name in ("a", "b", "c", "together")
    ]
    assert len(arrays[0]) == 6
    assert arrays == [arrays[0]] * 4


def test_the_share_of_the_work_follows_the_seconds(tmp_path: Path):
    """Of a slow run and many fast ones, the slow one is most of the work; found ones are none."""
    fast = [SchemeRun("cmu/01_01-jump", TemporalScheme("slerp"), count=n) for n in range(3, 13)]
    slow = SchemeRun("cmu/01_01-jump", SpatialScheme("tsne", optimizer="alg12"), ratio=0.1)
    run_grid(fast[:5], tmp_path)
    seen: list[Advance] = []
    run_grid([*fast, slow], tmp_path, progress=seen.append)
    assert (seen[0].finished, seen[0].share) == (5, 0.0)
    assert seen[-2].finished == 10
    assert seen[-2].share < 0.3
    assert seen[-1].share == 1.0
