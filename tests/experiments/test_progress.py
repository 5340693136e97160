"""The progress line."""

from __future__ import annotations

import time

import pytest

from workbench.experiments.grid import Advance
from workbench.experiments.progress import ProgressLine


def test_the_estimate_follows_the_work_done(capsys: pytest.CaptureFixture, monkeypatch):
    """A quarter of the work took 20 s, so three quarters take a minute."""
    now = iter([100.0, 120.0, 180.0])
    monkeypatch.setattr(time, "monotonic", lambda: next(now))
    line = ProgressLine("Grid")
    line(Advance(0, 8, 0.0, "0 found finished"))
    line(Advance(1, 8, 0.25, "uci/yeast"))
    line(Advance(8, 8, 1.0, "uci/iris"))
    first, second, last = capsys.readouterr().err.strip("\r").split("\r")
    assert "left" not in first
    assert "1 of 8 runs, about 1 min 0 s left (uci/yeast)" in second
    assert last.startswith("Grid: 8 of 8 runs (uci/iris)")
    assert last.endswith("\n")


def test_what_ends_a_grid_stands_on_a_line_of_its_own(capsys: pytest.CaptureFixture):
    """A line that waits for more is ended once; one that is complete is left as it is."""
    with ProgressLine("Grid") as line:
        line(Advance(0, 8, 0.0, "0 found finished"))
    assert capsys.readouterr().err.count("\n") == 1
    with ProgressLine("Grid") as line:
        line(Advance(8, 8, 1.0, "uci/iris"))
    assert capsys.readouterr().err.count("\n") == 1
