"""Pictures say which clip stands in for which."""

from __future__ import annotations

import pytest

from workbench.errors import WorkbenchError
from workbench.reproduction.clips import BUNDLED, picture_clip, titles_of


def test_a_clip_that_is_not_bundled_is_replaced_and_the_note_says_so():
    """The quick profile shows an excerpt in place of the published clip."""
    clip = picture_clip("cmu/05_10", "quick", published="cmu/05_10")
    assert clip.name == BUNDLED
    assert clip.note == f"{BUNDLED} stands in for cmu/05_10, which is not bundled."


def test_the_published_clip_needs_no_note():
    """Where the clip is there, nothing stands in for it."""
    clip = picture_clip("two jumps", "quick", published=BUNDLED)
    assert (clip.name, clip.note) == (BUNDLED, "")
    assert "jump" in clip.title


def test_the_best_stand_in_that_is_there_is_taken():
    """Clips that are not there are passed over; the order of the others counts."""
    clip = picture_clip("a walk", "quick", instead=("cmu/02_01", "cmu/01_03-walk", BUNDLED))
    assert clip.name == "cmu/01_03-walk"
    assert clip.note == "cmu/01_03-walk stands in for a walk."


def test_titles_are_those_of_the_profile():
    """All excerpts have titles, and nothing else is among them."""
    assert titles_of("quick")["cmu/01_03-walk"] == "walk along a curve"
    assert "cmu/01_01" not in titles_of("quick")


@pytest.mark.parametrize("profile", ["quick", "short"])
def test_nothing_to_show_is_refused(profile):
    """A profile that is unknown and a clip that is missing are told."""
    with pytest.raises(WorkbenchError, match=r"profile|picture of a flip"):
        picture_clip("a flip", profile, instead=("cmu/00_00",))
