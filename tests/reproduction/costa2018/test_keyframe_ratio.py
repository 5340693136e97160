"""Figure 5.1: the error against the share of keyframes."""

from __future__ import annotations

import pytest

from tests.reproduction.costa2018.synthetic import results_of
from workbench.errors import WorkbenchError
from workbench.experiments.runs.schemes import SchemeRun
from workbench.reproduction.costa2018 import keyframe_ratio
from workbench.reproduction.costa2018.keyframe_ratio import ActionPanel

WALK = ActionPanel("f", "walk", ("cmu/a",), ())
CLIPS = {WALK: "cmu/a"}


def _runs(percents=(1, 3, 4, 10), clip="cmu/a"):
    schemes = keyframe_ratio.SCHEMES.values()
    return [SchemeRun(clip, scheme, ratio=p / 100) for p in percents for scheme in schemes]


def _hyperbola(run):
    """Give an error of 12 over the share in per cent: 12, 4, 3 and 1.2."""
    return {"error": 0.12 / run["ratio"]}


TABLE = results_of(_runs(), _hyperbola)


def test_errors_are_arranged_by_share():
    """Shares are in per cent, in order, one column per interpolator."""
    errors = keyframe_ratio.errors_by_ratio(TABLE, "cmu/a")
    assert errors.index.tolist() == [1, 3, 4, 10]
    assert list(errors) == ["Linear", "Slerp", "1D-RBF", "MDS", "t-SNE"]
    assert errors["MDS"].tolist() == pytest.approx([12.0, 4.0, 3.0, 1.2])


def test_the_bend_compares_falls_per_per_cent():
    """From 12 to 4 in two steps, from 3 to 1.2 in six: 0.3 over 4."""
    row = keyframe_ratio.errors_at(TABLE, CLIPS).loc["walk, a"]
    assert row["late / early"] == pytest.approx(0.3 / 4.0)
    found = keyframe_ratio.flattening(TABLE, CLIPS)
    assert found.estimate is not None
    assert found.estimate.value == pytest.approx(0.075)
    assert "12.00 at 1 %, 4.00 at 3 %, 1.20 at 10 %" in keyframe_ratio.describe_errors(
        keyframe_ratio.errors_at(TABLE, CLIPS)
    )


def test_an_error_that_does_not_fall_has_no_bend():
    """A constant error counts as falling alike before and after."""
    flat = results_of(_runs(), lambda run: {"error": 1.0})
    assert keyframe_ratio.errors_at(flat, CLIPS)["late / early"].tolist() == [1.0]


def test_a_clip_too_short_for_one_per_cent_says_nothing_of_the_bend():
    """It has a chart, but no part in the claim."""
    short = results_of(_runs((3, 4, 10)), _hyperbola)
    (chart,) = keyframe_ratio.charts(short, CLIPS)
    assert list(chart.lines["Slerp"]) == [3, 4, 10]
    found = keyframe_ratio.flattening(short, CLIPS)
    assert found.estimate is None
    assert "1 of 1 clips lack" in found.note


def test_a_failed_run_leaves_a_gap_in_its_line():
    """The other lines are whole; if all fail there is no figure."""
    failing = results_of(
        _runs(),
        lambda run: "lost" if run["ratio"] == 0.04 and "mds" in run["scheme"] else {"error": 1.0},
    )
    (chart,) = keyframe_ratio.charts(failing, CLIPS)
    assert list(chart.lines["MDS"]) == [1, 3, 10]
    assert list(chart.lines["t-SNE"]) == [1, 3, 4, 10]
    with pytest.raises(WorkbenchError, match="all runs failed; the first: lost"):
        keyframe_ratio.charts(results_of(_runs(), lambda run: "lost"), CLIPS)


def test_shares_are_really_run_with_that_many_keyframes():
    """No run is rounded up to three keyframes."""
    planned = keyframe_ratio.planned_runs("quick", 0)
    assert len(planned) == len(set(planned))
    # The excerpts of the quick profile have at least 300 frames.
    assert min(run.ratio for run in planned) == 0.01
    assert {run.dataset for run in planned} == {
        "cmu/01_03-climb-down",
        "cmu/01_01-two-jumps",
        "cmu/01_03-walk",
    }


def test_a_clip_of_the_thesis_comes_before_its_stand_ins(monkeypatch):
    """Where it is missing the nearest takes its place, and the caption says so."""
    present = ["cmu/01_14", "cmu/01_03-swing", "cmu/05_02"]
    monkeypatch.setattr(keyframe_ratio, "motion_clips", lambda profile: present)
    monkeypatch.setattr(keyframe_ratio, "excerpts", list)
    chosen = keyframe_ratio.clips_by_panel("full")
    assert {panel.letter: clip for panel, clip in chosen.items()} == {
        "a": "cmu/01_14",
        "b": "cmu/05_02",
    }
    text = keyframe_ratio.describe_stand_ins(chosen)
    assert text == "Stand-ins: 05_02 (dance - expressive arms, pirouette) for swordplay."
