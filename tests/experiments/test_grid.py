"""Grids of runs: in parallel, resumable, and never twice."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
import warnings
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

from tests.experiments import slow_grid
from tests.experiments.logged_runs import LoggedRun, log_lines
from workbench.datasets import load_space
from workbench.errors import WorkbenchError
from workbench.experiments.grid import Advance, describe_failures, run_grid
from workbench.experiments.runs.schemes import SchemeRun
from workbench.experiments.store import ResultStore
from workbench.optimization import optimizers
from workbench.optimization.local_search import LocalSearch
from workbench.projection import projectors
from workbench.projection.pca import PCA
from workbench.schemes import SpatialScheme, TemporalScheme

RAW = SpatialScheme("pca", selector="random")
OPTIMIZED = SpatialScheme("pca", selector="random", optimizer="alg12")
PAIR = [SchemeRun("uci/iris", RAW, ratio=0.05), SchemeRun("uci/iris", OPTIMIZED, ratio=0.05)]
TIMES = ("seconds_", "version_")


@pytest.fixture
def counted(monkeypatch) -> list[int]:
    """Register a projector "counted" and give the list to which each projection adds."""
    calls: list[int] = []

    class Counted(PCA):
        def _project(self, X):
            calls.append(len(X))
            return super()._project(X)

    monkeypatch.setitem(projectors._entries, "counted", Counted)
    return calls


def _values(table: pd.DataFrame) -> pd.DataFrame:
    return table[[name for name in table.columns if not name.startswith(TIMES)]]


def test_a_row_holds_what_the_scheme_gives(tmp_path: Path):
    """Error and stress of a row are those of the scheme run by hand."""
    row = run_grid(PAIR, tmp_path).iloc[1]
    result = OPTIMIZED.run(load_space("uci/iris"), ratio=0.05, random_state=0)
    assert row["status"] == "done"
    assert row["error"] == result.error
    assert row["relative_error"] == result.relative_error
    assert row["stress"] == result.quality.stress
    assert row["projected_stress"] == result.projected_quality.stress
    assert row["stress_ratio"] == result.quality.stress / result.projected_quality.stress
    assert row["evaluations"] == result.evaluations
    assert (row["n_samples"], row["n_control_points"]) == (150, 7)
    assert row["seconds_optimize"] > 0


@pytest.mark.parametrize("columns", [2, 3])
def test_a_perfect_embedding_has_no_stress_ratio(tmp_path: Path, columns: int):
    """A plane, in two columns or tilted in three, leaves nothing but rounding to divide by."""
    plane = np.random.default_rng(0).normal(size=(60, 2)) @ [[3.0, 0.5, 1.0], [0.2, 2.0, 1.0]]
    file = tmp_path / "plane.csv"
    frame = pd.DataFrame(plane[:, :columns], columns=list("xyz")[:columns])
    frame.to_csv(file, index=False)
    runs = [SchemeRun(str(file), scheme, ratio=0.1) for scheme in (RAW, OPTIMIZED)]
    table = run_grid(runs, tmp_path / "results")
    assert table["message"].tolist() == ["", ""]
    assert table["projected_scale_normalized_stress"].max() < 1e-14
    assert table["scale_normalized_stress_ratio"].isna().all()
    assert table["stress_ratio"].notna().all()


def test_embeddings_are_kept_with_the_result(tmp_path: Path):
    """The arrays of a run are the embeddings of the scheme."""
    row = run_grid(PAIR, tmp_path).iloc[1]
    result = OPTIMIZED.run(load_space("uci/iris"), ratio=0.05, random_state=0)
    arrays = ResultStore(tmp_path).arrays(row["key"])
    assert np.array_equal(arrays["projected"], result.projected)
    assert np.array_equal(arrays["embedding"], result.embedding)
    assert np.array_equal(arrays["control_points"], result.control_points)
    assert np.array_equal(arrays["errors"], result.errors)


def test_raw_and_optimized_share_one_projection(tmp_path: Path, counted: list[int]):
    """Two schemes of one projector project once."""
    schemes = [
        SpatialScheme("counted", selector="random", optimizer=optimizer)
        for optimizer in (None, "alg12")
    ]
    table = run_grid([SchemeRun("uci/iris", scheme, ratio=0.05) for scheme in schemes], tmp_path)
    assert table["status"].tolist() == ["done", "done"]
    assert counted == [150]


KINDS = {
    "one step": {},
    "two steps": {"two_step": "rbfp"},
    "two other steps": {"two_step": "lamp"},
    "three dimensions": {"dimensions": 3},
    "own inverse": {"back_projector": "inverse"},
    "markers": {"markers": "move"},
}


@pytest.mark.parametrize("count", [7, 12])
def test_every_kind_of_scheme_is_stored_as_run_by_hand(tmp_path: Path, count: int):
    """Runs side by side share nothing that is not theirs, and are found again afterwards."""
    schemes = [SpatialScheme("pca", selector="random", **kind) for kind in KINDS.values()]
    runs = [SchemeRun("uci/iris", scheme, count=count) for scheme in schemes]
    table = run_grid(runs, tmp_path)
    for scheme, (_, row) in zip(schemes, table.iterrows(), strict=True):
        result = scheme.run(load_space("uci/iris"), count=count, random_state=0)
        arrays = ResultStore(tmp_path).arrays(row["key"])
        assert row["error"] == result.error
        assert row["stress"] == result.quality.stress
        assert row["projected_stress"] == result.projected_quality.stress
        assert np.array_equal(arrays["projected"], result.projected)
        assert np.array_equal(arrays["embedding"], result.embedding)
    assert table["scheme"].is_unique
    assert table["two_step"].dropna().tolist() == ["rbfp", "lamp"]
    assert table["dimensions"].dropna().tolist() == [3]
    assert table["markers"].dropna().tolist() == ["move"]
    pd.testing.assert_frame_equal(run_grid(runs, tmp_path), table)


def test_only_one_step_projections_are_shared(tmp_path: Path, counted: list[int]):
    """Raw and optimized share one for each number of dimensions; two steps see half the data."""
    schemes = [
        SpatialScheme("counted", selector="random", optimizer=optimizer, **kind)
        for kind in ({}, {"dimensions": 3}, {"two_step": "rbfp"})
        for optimizer in (None, "local")
    ]
    table = run_grid([SchemeRun("uci/iris", scheme, ratio=0.05) for scheme in schemes], tmp_path)
    assert table["message"].tolist() == [""] * 6
    assert sorted(counted)[2:] == [150, 150]
    assert len(counted) == 4
    assert sorted(counted)[1] < 150


def test_a_row_counts_the_effort_of_all_searches(tmp_path: Path):
    """Derivatives and distances of the optimizer and of the search for markers, added up."""
    scheme = SpatialScheme("pca", selector="random", optimizer="local", markers="move")
    row = run_grid([PAIR[0], SchemeRun("uci/iris", scheme, ratio=0.05)], tmp_path)
    result = scheme.run(load_space("uci/iris"), ratio=0.05, random_state=0)
    effort = result.optimization.effort + result.marker_result.effort
    assert row["jacobians"].tolist() == [0, effort.jacobians]
    assert row["distances"].tolist() == [0, effort.distances]
    assert row["evaluations"].tolist() == [143, effort.evaluations + 143]


def test_the_effort_of_a_reticent_optimizer_is_unknown(tmp_path: Path, monkeypatch):
    """An optimizer of a user's own need not count; its run is stored all the same."""

    class Reticent(LocalSearch):
        def optimize(self, *arguments, **options):
            return replace(super().optimize(*arguments, **options), effort=None)

    monkeypatch.setitem(optimizers._entries, "reticent", Reticent)
    scheme = SpatialScheme("pca", selector="random", optimizer="reticent")
    row = run_grid([SchemeRun("uci/iris", scheme, ratio=0.05)], tmp_path).iloc[0]
    assert row["status"] == "done"
    assert row["jacobians"] is None
    assert row["distances"] is None


def test_finished_runs_are_not_computed_again(tmp_path: Path, counted: list[int]):
    """A second call reads everything and gives the same table to the last bit."""
    runs = [SchemeRun("uci/iris", SpatialScheme("counted", selector="random"), ratio=0.05)]
    first = run_grid(runs, tmp_path)
    pd.testing.assert_frame_equal(run_grid(runs, tmp_path), first)
    assert counted == [150]


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
    pd.testing.assert_frame_equal(_values(again), _values(first))


def test_runs_in_processes_give_the_same_values(tmp_path: Path):
    """Two worker processes give what this process gives, in the order asked for."""
    runs = [
        *PAIR,
        SchemeRun("uci/wine", RAW, ratio=0.05),
        SchemeRun("cmu/01_03-walk", OPTIMIZED, count=9),
    ]
    here = run_grid(runs, tmp_path / "here")
    there = run_grid(runs, tmp_path / "there", n_jobs=2)
    assert there["dataset"].tolist() == [run.dataset for run in runs]
    pd.testing.assert_frame_equal(_values(there), _values(here), check_exact=False, rtol=1e-9)


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


def test_warnings_are_kept_with_the_result(tmp_path: Path):
    """What the methods warn of is in the rows of all runs that share the projection."""
    runs = [
        SchemeRun("uci/iris", SpatialScheme("isomap", optimizer=o), ratio=0.05)
        for o in (None, "alg12")
    ]
    with warnings.catch_warnings(record=True) as printed:
        table = run_grid(runs, tmp_path)
    assert printed == []
    assert all("falls into 2 parts" in text for text in table["warnings"])


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


def _in_fresh_process(code: str, *arguments: object, **options: Any) -> subprocess.Popen:
    """Start Python with the tests' helpers at hand."""
    return subprocess.Popen(
        [sys.executable, "-c", code, *map(str, arguments)],
        cwd=Path(__file__).parents[2],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        **options,
    )


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


def test_tables_are_the_same_to_the_last_bit_in_any_process(tmp_path: Path):
    """Fresh processes, one worker or two, and two grids in one folder at once: one table."""
    places = [("a", 1), ("b", 1), ("c", 2), ("together", 1), ("together", 2)]
    started = [_in_fresh_process(SMALL_GRID, tmp_path / name, jobs) for name, jobs in places]
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


def test_a_full_disk_costs_what_was_not_stored(tmp_path: Path):
    """Where a file ends for want of space no result is taken for whole; with space it goes on."""
    process = _in_fresh_process(FULL_DISK, tmp_path)
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
