"""One run, executed on the data and the code that it was planned with."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from tests.experiments.logged_runs import LoggedRun, log_lines
from workbench.datasets import load_space
from workbench.errors import WorkbenchError
from workbench.experiments.execution import PlannedRun, Workspace, keep
from workbench.experiments.runs import base
from workbench.experiments.runs.base import content_key, space_checksum
from workbench.experiments.store import ResultStore
from workbench.spaces import VectorSpace


@pytest.fixture
def planned(tmp_path: Path) -> PlannedRun:
    """Give a planned run that logs."""
    run = LoggedRun("uci/iris", 0, str(tmp_path))
    checksum = space_checksum(load_space("uci/iris"))
    return PlannedRun(run, content_key(run, checksum), checksum)


def test_steps_are_shared_by_runs_that_follow_each_other(planned: PlannedRun, monkeypatch):
    """Distances are computed once for two runs on a data set, and once more after another one."""
    computed = []
    original = VectorSpace.distances
    monkeypatch.setattr(
        VectorSpace, "distances",
        property(lambda space: computed.append(len(space)) or original.__get__(space)),
    )  # fmt: skip
    workspace = Workspace()
    first, second = workspace.execute(planned), workspace.execute(planned)
    assert first.row is not None
    assert first.row["stress"] == second.row["stress"]
    assert second.row["seconds_spent"] >= 0
    once = len(computed)
    workspace.execute(planned)
    assert len(computed) == once


def test_other_code_is_refused(planned: PlannedRun, monkeypatch, tmp_path: Path):
    """A process with other code in the same version gives no result, and computes nothing."""
    monkeypatch.setattr(base, "code_digest", lambda: "other")
    outcome = Workspace().execute(planned)
    assert outcome.row is None
    assert "other code of workbench, under the same version" in outcome.message
    assert log_lines(tmp_path) == []


def test_other_versions_are_named(planned: PlannedRun):
    """The message says which package differs, and which version is wanted."""
    versions = {**planned.versions, "numpy": "1.0"}
    outcome = Workspace().execute(replace(planned, key="of numpy 1.0", versions=versions))
    assert outcome.row is None
    assert "instead of 1.0; install there what it was planned with" in outcome.message


def test_other_data_are_refused(planned: PlannedRun):
    """A result is not stored under a key that promises other data."""
    outcome = Workspace().execute(replace(planned, key="of other data", checksum="other"))
    assert outcome.row is None
    assert "the data found where the run was executed are not those" in outcome.message


def test_what_cannot_be_stored_ends_the_grid(planned: PlannedRun, tmp_path: Path, monkeypatch):
    """A folder that takes no results is an error at once, a row that is none fails its run."""
    outcome = Workspace().execute(planned)
    store = ResultStore(tmp_path / "results")
    wrong = replace(outcome, row={**outcome.row, "stress": float("nan")})
    assert keep(store, wrong).message.startswith("ValueError")
    (tmp_path / "file").write_text("")
    with pytest.raises(WorkbenchError, match="make room there and run the grid again"):
        keep(ResultStore(tmp_path / "file" / "results"), outcome)
