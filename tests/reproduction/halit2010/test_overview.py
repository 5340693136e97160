"""The pictures of the saliency method show what the selector does."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from workbench.figures.extraction import families_figure
from workbench.reproduction.halit2010 import overview

CLIP, SPACE = overview.shown_motion("quick")
STEPS = overview.measured_steps(SPACE)
FAMILIES = overview.families(SPACE)


def test_each_family_chooses_as_many_keyframes():
    """All three give eight frames of the clip, sorted, each once."""
    for keys in (
        FAMILIES.curve_keyframes,
        FAMILIES.cluster_keyframes,
        FAMILIES.matrix_keyframes,
    ):
        assert len(np.unique(keys)) == overview.N_KEYS
        assert np.all(np.diff(keys) > 0)
        assert keys.max() < len(SPACE)


def test_each_cluster_has_one_keyframe():
    """The frame nearest to the mean of a cluster belongs to it."""
    of_keys = FAMILIES.clusters[FAMILIES.cluster_keyframes]
    assert sorted(of_keys) == list(range(overview.N_KEYS))


def test_steps_are_those_of_the_selector():
    """As many clusters as keyframes, at least 7 curves and 90 % of the variance."""
    found = overview.SELECTOR.measure(SPACE.motion)
    assert STEPS.n_clusters == len(found.keyframes)
    assert STEPS.n_curves >= 7
    assert STEPS.variance >= 0.9
    assert STEPS.cluster_length == 40
    assert f"{STEPS.n_clusters} clusters" in STEPS.sentence


def test_the_outline_goes_from_motion_to_keyframes():
    """Each step follows from the one before."""
    diagram = overview.outline(STEPS)
    order = ["motion", "reduce", "saliency", "candidates", "cluster", "keyframes"]
    for before, after in pairwise(order):
        assert diagram.sources(after) == [before]


def test_the_algorithm_has_the_published_steps():
    """Six rows, the last with the keyframes that the outline ends in."""
    table = overview.algorithm(STEPS)
    assert [name[:2] for name in table.index] == ["1.", "2.", "3a", "3b", "4a", "4b"]
    assert table["result"].iloc[-1].startswith(f"{STEPS.n_clusters} keyframes")


def test_the_figure_marks_the_keyframes_of_each_family():
    """Curve, map and matrix each have eight marks."""
    figure = families_figure(FAMILIES)
    for axis in ("x", "x2", "x3"):
        scatters = [t for t in figure.data if t.type == "scatter" and t.xaxis == axis]
        (marks,) = [t for t in scatters if t.marker.size == 10 and t.x[0] is not None]
        assert len(marks.x) == overview.N_KEYS
    matrix = next(t for t in figure.data if t.type == "heatmap")
    assert len(matrix.x) <= 200
    assert np.diagonal(np.asarray(matrix.z)) == pytest.approx(0)
