"""Which data a profile uses."""

from __future__ import annotations

import os

import pytest

from workbench.datasets import Status, list_datasets, load
from workbench.errors import DataError, WorkbenchError
from workbench.reproduction import profiles
from workbench.reproduction.profiles import (
    absent_tables,
    fetch_tables,
    motion_clips,
    some_clips,
)

PAGE_BLOCKS = "uci/page-blocks"


def _found(name: str) -> Status:
    return next(status for status in list_datasets() if status.entry.name == name)


def test_quick_uses_short_excerpts_of_the_bundled_clips():
    """At least six different motions, each in the thesis's range of lengths."""
    clips = motion_clips("quick")
    assert len(clips) >= 6
    assert all(name.startswith(("cmu/01_01-", "cmu/01_03-")) for name in clips)
    assert all(129 <= len(load(name)) <= 1146 for name in clips)


def test_some_clips_of_the_quick_profile_are_its_shortest():
    """They keep their order, and no clip that is left out is shorter."""
    clips, few = motion_clips("quick"), some_clips("quick", 3)
    assert [clip for clip in clips if clip in few] == few
    lengths = {clip: len(load(clip)) for clip in clips}
    assert sorted(lengths[clip] for clip in few) == sorted(lengths.values())[:3]


@pytest.mark.skipif(
    not os.environ.get("WORKBENCH_DATA"), reason="needs CMU clips in a folder in WORKBENCH_DATA"
)
def test_full_uses_the_clips_in_the_range_of_the_thesis():
    """Whole clips of 129 to 1146 frames: the named 05_10, not 01_01 with 2751."""
    clips = motion_clips("full")
    assert some_clips("full", 3) == clips
    assert "cmu/05_10" in clips
    assert "cmu/01_01" not in clips
    assert all("-" not in name for name in clips)


def test_full_without_such_clips_says_what_to_do(monkeypatch):
    """The bundled clips are too long, so the message names WORKBENCH_DATA."""
    monkeypatch.delenv("WORKBENCH_DATA", raising=False)
    monkeypatch.setenv("WORKBENCH_CACHE", "/nonexistent")
    with pytest.raises(WorkbenchError, match="WORKBENCH_DATA, or take the quick profile"):
        motion_clips("full")


def test_tables_that_are_not_used_have_a_reason(monkeypatch, tmp_path):
    """Bundled tables are used; missing ones are left out with a reason each."""
    monkeypatch.delenv("WORKBENCH_DATA", raising=False)
    monkeypatch.setenv("WORKBENCH_CACHE", str(tmp_path))
    names = ["uci/iris", "uci/wine", "uci/yeast", "uci/ionosphere", "uci/seeds", "uci/page-blocks"]
    reasons = absent_tables(names)
    assert set(reasons) == {"uci/seeds", "uci/page-blocks"}
    assert "`workbench datasets fetch uci/seeds`" in reasons["uci/seeds"]
    assert "`workbench datasets fetch uci/page-blocks`" in reasons["uci/page-blocks"]


def test_every_table_that_is_found_is_used(monkeypatch):
    """Cloud and Page blocks, which are not bundled, are used when they are here."""
    monkeypatch.setattr(profiles, "_present", lambda: [_found("uci/cloud"), _found(PAGE_BLOCKS)])
    assert absent_tables(["uci/cloud", PAGE_BLOCKS]) == {}


def test_an_unknown_profile_is_refused():
    """A misspelt profile does not silently mean another one."""
    with pytest.raises(WorkbenchError, match="profile: got 'quik', want 'quick' or 'full'"):
        motion_clips("quik")


def test_tables_are_fetched_and_failures_are_told() -> None:
    """Only tables that are missing are asked for; one that fails is named."""
    asked = []

    def fetch(name: str) -> None:
        asked.append(name)
        raise DataError("no network")

    missed = fetch_tables(["uci/iris", "uci/unheard-of"], fetch=fetch)
    assert asked == missed == ["uci/unheard-of"]
