"""Summaries show the most salient frames of a clip and say which clip it is."""

from __future__ import annotations

import pytest

from workbench.reproduction.halit2010 import summaries
from workbench.reproduction.items import select_items
from workbench.reproduction.profiles import excerpts


@pytest.mark.parametrize("figure", [summaries.FLIP, *summaries.SUMMARIES], ids=lambda f: f.id)
def test_every_figure_can_be_made_of_bundled_clips(figure):
    """The quick profile needs no data, and the caption says what stands in for what."""
    found = summaries.summary(figure, "quick")
    assert found.clip.name in excerpts()
    assert len(found.keyframes) == figure.count
    assert found.keyframes[0] == 0
    assert found.keyframes[-1] == len(found.motion) - 1
    assert f"stands in for {figure.action}" in found.caption
    assert str(found.keyframes[1]) in found.alt


def test_the_figures_are_items():
    """Their ids are those of the report."""
    ids = [summaries.FLIP.id, *(figure.id for figure in summaries.SUMMARIES)]
    assert [item.id for item in select_items(ids)] == ids
