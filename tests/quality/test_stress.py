"""Tests of the named forms of stress and of Shepard data."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.distance import cdist, pdist
from scipy.stats import spearmanr
from sklearn.isotonic import IsotonicRegression
from zadu.measures import non_metric_stress, spearman_rho
from zadu.measures import stress as zadu_stress

from workbench.errors import DegenerateDataWarning, WorkbenchError
from workbench.quality.local_stress import local_stress
from workbench.quality.sammon import sammon_stress
from workbench.quality.shepard import nonmetric_stress, shepard_goodness, shepard_pairs
from workbench.quality.stress import (
    kruskal_stress,
    normalized_stress,
    raw_stress,
    scale_normalized_stress,
    stress,
)

VECTORS = np.random.default_rng(0).normal(size=(200, 5))
DISTANCES = cdist(VECTORS, VECTORS)
EMBEDDING = VECTORS[:, :2] * 0.7
D, DELTA = pdist(VECTORS), pdist(EMBEDDING)


@pytest.mark.parametrize(
    ("form", "expected"),
    [
        (raw_stress, np.sum((D - DELTA) ** 2)),
        (stress, np.sum((D - DELTA) ** 2) / np.sum(DELTA**2)),
        (normalized_stress, np.sum((D - DELTA) ** 2) / np.sum(D**2)),
        (kruskal_stress, np.sqrt(np.sum((D - DELTA) ** 2) / np.sum(DELTA**2))),
        (sammon_stress, np.sum((D - DELTA) ** 2 / D) / np.sum(D)),
    ],
    ids=["raw", "costa", "normalized", "kruskal", "sammon"],
)
def test_each_form_is_its_formula(form, expected):
    """Summed over pairs i < j."""
    assert form(DISTANCES, EMBEDDING) == pytest.approx(expected, rel=1e-12)


def test_tiny_stress_is_not_lost_in_rounding():
    """A billionth off, Kruskal's stress is a billionth; kept exactly, it is 0 to rounding."""
    distances = cdist(EMBEDDING, EMBEDDING)
    assert kruskal_stress(distances, EMBEDDING) < 1e-15
    assert kruskal_stress(distances, EMBEDDING * (1 + 1e-9)) == pytest.approx(1e-9, rel=1e-5)


def test_normalized_stress_agrees_with_zadu():
    """ZADU's stress is its root."""
    theirs = zadu_stress.measure(VECTORS, EMBEDDING)["stress"]
    assert normalized_stress(DISTANCES, EMBEDDING) == pytest.approx(theirs**2, rel=1e-12)


def test_nonmetric_stress_and_goodness_agree_with_zadu():
    """Isotonic regression and rank correlation over all pairs."""
    pairs = shepard_pairs(DISTANCES, EMBEDDING)
    theirs = non_metric_stress.measure(VECTORS, EMBEDDING)["non_metric_stress"]
    assert nonmetric_stress(pairs) == pytest.approx(theirs, rel=1e-9)
    theirs = spearman_rho.measure(VECTORS, EMBEDDING)["spearman_rho"]
    assert shepard_goodness(pairs) == pytest.approx(theirs, rel=1e-12)


def test_ties_in_the_data_have_one_disparity():
    """Equal distances in the data are fitted by one value, as scikit-learn does."""
    grid = np.random.default_rng(1).integers(0, 3, size=(40, 3)).astype(float)
    plane = grid[:, :2] + np.random.default_rng(2).normal(scale=0.4, size=(40, 2))
    d, delta = np.round(pdist(grid), 9), pdist(plane)
    fitted = IsotonicRegression().fit(d, delta).predict(d)
    expected = np.sqrt(np.sum((delta - fitted) ** 2) / np.sum(delta**2))
    pairs = shepard_pairs(np.round(cdist(grid, grid), 9), plane)
    assert nonmetric_stress(pairs) == pytest.approx(expected, rel=1e-9)


@settings(max_examples=20, deadline=None)
@given(st.floats(0.1, 5.0))
def test_order_is_all_that_counts(power):
    """Growing distances by any power leaves both measures of order as they are."""
    pairs = shepard_pairs(DISTANCES[:40, :40] ** power, EMBEDDING[:40])
    plain = shepard_pairs(DISTANCES[:40, :40], EMBEDDING[:40])
    assert nonmetric_stress(pairs) == pytest.approx(nonmetric_stress(plain), rel=1e-9)
    assert shepard_goodness(pairs) == pytest.approx(shepard_goodness(plain), rel=1e-9)


def test_all_pairs_are_listed():
    """Both distances of every pair, in the order of scipy's condensed matrices."""
    pairs = shepard_pairs(DISTANCES, EMBEDDING)
    np.testing.assert_allclose(pairs.data, D, rtol=1e-12)
    np.testing.assert_allclose(pairs.embedding, DELTA, rtol=1e-12)


@given(n_pairs=st.integers(1, 780), seed=st.integers(0, 100))
@settings(max_examples=30, deadline=None)
def test_drawn_pairs_are_different_pairs(n_pairs, seed):
    """A sample has each pair at most once, with its own distances."""
    pairs = shepard_pairs(DISTANCES[:40, :40], EMBEDDING[:40], n_pairs, seed)
    assert len(set(zip(pairs.first.tolist(), pairs.second.tolist(), strict=True))) == n_pairs
    assert np.all(pairs.first < pairs.second)
    assert np.array_equal(pairs.data, DISTANCES[pairs.first, pairs.second])
    apart = np.linalg.norm(EMBEDDING[pairs.first] - EMBEDDING[pairs.second], axis=1)
    np.testing.assert_allclose(pairs.embedding, apart, rtol=1e-12)


def test_drawn_pairs_stand_for_all():
    """The goodness of 4000 pairs is near that of 19 900, and repeats with its seed."""
    drawn = shepard_pairs(DISTANCES, EMBEDDING, 4000, random_state=3)
    again = shepard_pairs(DISTANCES, EMBEDDING, 4000, random_state=3)
    assert np.array_equal(drawn.first, again.first)
    assert shepard_goodness(drawn) == pytest.approx(spearmanr(D, DELTA).statistic, abs=0.03)


def test_local_stress_is_a_share_of_the_whole():
    """Weighted by each sample's squared distances, the mean is the scale-normalised stress."""
    found = local_stress(DISTANCES, EMBEDDING)
    weights = np.sum(DISTANCES**2, axis=1)
    whole = scale_normalized_stress(DISTANCES, EMBEDDING)
    assert np.average(found, weights=weights) == pytest.approx(whole, rel=1e-9)


def test_local_stress_finds_the_misplaced_sample():
    """One sample put elsewhere has the largest stress of all."""
    plane = np.random.default_rng(4).random((30, 2))
    moved = plane.copy()
    moved[17] += 3
    assert np.argmax(local_stress(cdist(plane, plane), moved)) == 17


def test_sammon_leaves_out_what_coincides():
    """Repeated samples are told of; the rest is summed as ever."""
    vectors = np.vstack([VECTORS[:20], VECTORS[:2]])
    embedding = np.vstack([EMBEDDING[:20], EMBEDDING[:2] + 1])
    d, delta = pdist(vectors), pdist(embedding)
    apart = d > 0
    expected = np.sum((d - delta)[apart] ** 2 / d[apart]) / np.sum(d)
    with pytest.warns(DegenerateDataWarning, match="2 pairs of samples coincide"):
        found = sammon_stress(cdist(vectors, vectors), embedding)
    assert found == pytest.approx(expected, rel=1e-12)


_FORMS = [
    raw_stress, stress, normalized_stress, kruskal_stress, scale_normalized_stress,
    sammon_stress, local_stress, shepard_pairs,
]  # fmt: skip


@pytest.mark.parametrize("form", _FORMS, ids=lambda form: form.__name__)
@pytest.mark.parametrize(
    ("distances", "embedding", "message"),
    [
        (DISTANCES[:2, :2], EMBEDDING[:2], "embedding: got 2 samples, want at least 3"),
        (DISTANCES, EMBEDDING[:9], r"distances: got shape \(200, 200\), want \(9, 9\)"),
        (DISTANCES, EMBEDDING * np.nan, "embedding: got nan"),
        (DISTANCES + np.inf, EMBEDDING, "distances: got inf"),
        (DISTANCES, EMBEDDING[:, 0], r"embedding: got shape \(200,\)"),
    ],
    ids=["two-samples", "another-length", "nan", "infinite", "no-plane"],
)
def test_unfit_input_is_refused(form, distances, embedding, message):
    """The message names the argument."""
    with pytest.raises(WorkbenchError, match=message):
        form(distances, embedding)


@pytest.mark.parametrize("form", [sammon_stress, local_stress, normalized_stress])
def test_data_in_one_place_have_no_stress(form):
    """Nothing to divide by."""
    with pytest.raises(WorkbenchError, match="distances: got only zeros"):
        form(np.zeros((5, 5)), EMBEDDING[:5])


@pytest.mark.parametrize("n_pairs", [0, -1, 2.5, "all", True], ids=repr)
def test_numbers_of_pairs_are_whole(n_pairs):
    """Fractions, nothing and words are refused."""
    with pytest.raises(WorkbenchError, match="n_pairs: got"):
        shepard_pairs(DISTANCES, EMBEDDING, n_pairs)


def test_equal_distances_have_no_order():
    """A triangle of equal sides has no rank correlation; points in one place no stress."""
    triangle = np.ones((3, 3)) - np.eye(3)
    with pytest.raises(WorkbenchError, match="distances: got pairs that are all 1 apart"):
        shepard_goodness(shepard_pairs(triangle, [[0, 0], [1, 0], [3, 0]]))
    with pytest.raises(WorkbenchError, match="embedding: got one place"):
        nonmetric_stress(shepard_pairs(triangle, np.zeros((3, 2))))
