"""Tests of the measures of neighbourhoods against their definitions."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.distance import cdist
from zadu.measures import local_continuity_meta_criteria, trustworthiness_continuity
from zadu.measures import neighborhood_hit as zadu_neighborhood_hit

from workbench.errors import WorkbenchError
from workbench.quality.labels import neighborhood_hit
from workbench.quality.neighborhoods import (
    local_neighborhood_quality,
    neighborhood_quality,
    vector_neighborhood_quality,
)


def ranks(distances):
    """Rank each row's other samples from 1, ties in their order."""
    own = distances.copy()
    np.fill_diagonal(own, -1)
    order = np.argsort(own, axis=1, kind="stable")
    found = np.empty_like(order)
    np.put_along_axis(found, order, np.arange(len(own))[None], axis=1)
    return found


def by_definition(distances, embedding, k):
    """Evaluate all measures for one size on full matrices of ranks."""
    r, rho = ranks(distances), ranks(cdist(embedding, embedding))
    n = len(r)
    near_r, near_rho = (r >= 1) & (r <= k), (rho >= 1) & (rho <= k)
    scale = 2 / (n * k * (2 * n - 3 * k - 1))
    both = near_r & near_rho
    return {
        "trustworthiness": 1 - scale * (r - k)[near_rho & ~near_r].sum(),
        "continuity": 1 - scale * (rho - k)[near_r & ~near_rho].sum(),
        "preservation": both.sum() / (n * k),
        "intrusiveness": ((rho < r) & both).sum() / (n * k) - ((rho > r) & both).sum() / (n * k),
        "lcmc": both.sum() / (n * k) - k / (n - 1),
        "rescaled_preservation": ((n - 1) * both.sum() / (n * k) - k) / (n - 1 - k),
    }


def sample(n, seed):
    """Give vectors on a coarse grid, so that many distances are equal, and a poor embedding."""
    generator = np.random.default_rng(seed)
    vectors = generator.integers(0, 4, size=(n, 3)).astype(float)
    return vectors, vectors[:, :2] + generator.integers(0, 3, size=(n, 2))


@pytest.mark.parametrize("n", [3, 7, 64, 65, 300])
def test_all_sizes_agree_with_the_definitions(n):
    """Every measure at every size, for few and many neighbours, within and across blocks."""
    vectors, embedding = sample(n, n)
    distances = cdist(vectors, vectors)
    every = np.arange(1, (n - 1) // 2 + 1)
    for sizes in (every, every[:5], every[-1:]):
        found = neighborhood_quality(distances, embedding, sizes)
        for index in {0, len(sizes) // 2, len(sizes) - 1}:
            expected = by_definition(distances, embedding, sizes[index])
            for name, value in expected.items():
                assert getattr(found, name)[index] == pytest.approx(value, abs=1e-12), name


@settings(max_examples=40, deadline=None)
@given(n=st.integers(3, 40), seed=st.integers(0, 10**6), data=st.data())
def test_random_tables_agree_with_the_definitions(n, seed, data):
    """Any table and any one size."""
    vectors, embedding = sample(n, seed)
    distances = cdist(vectors, vectors)
    k = data.draw(st.integers(1, (n - 1) // 2))
    found = neighborhood_quality(distances, embedding, k)
    for name, value in by_definition(distances, embedding, k).items():
        assert getattr(found, name)[0] == pytest.approx(value, abs=1e-12), name


@pytest.mark.parametrize("n", [50, 300])
def test_vectors_give_what_their_distances_give(n):
    """No matrix of distances is needed for the same values."""
    vectors, embedding = sample(n, 1)
    sizes = np.arange(1, 21)
    expected = neighborhood_quality(cdist(vectors, vectors), embedding, sizes)
    found = vector_neighborhood_quality(vectors, embedding, sizes)
    for name in ("trustworthiness", "continuity", "preservation", "intrusiveness"):
        assert np.array_equal(getattr(found, name), getattr(expected, name))


def test_order_of_sizes_does_not_matter():
    """Sizes may come unsorted and twice."""
    vectors, embedding = sample(60, 2)
    distances = cdist(vectors, vectors)
    found = neighborhood_quality(distances, embedding, [9, 2, 9])
    assert np.array_equal(found.continuity[[0, 2]], found.continuity[[2, 0]])
    assert found.continuity[1] == neighborhood_quality(distances, embedding, 2).continuity[0]


def test_lcmc_agrees_with_zadu():
    """ZADU's local continuity meta-criterion at k = 12."""
    vectors = np.random.default_rng(0).normal(size=(80, 5))
    theirs = local_continuity_meta_criteria.measure(vectors, vectors[:, :2], k=12)["lcmc"]
    found = vector_neighborhood_quality(vectors, vectors[:, :2], 12)
    assert found.lcmc[0] == pytest.approx(theirs, abs=1e-12)


def test_local_values_agree_with_zadu_and_with_the_global_ones():
    """Each sample's values are ZADU's; their means are the values of the embedding."""
    vectors = np.random.default_rng(0).normal(size=(150, 5))
    embedding = vectors[:, :2]
    distances = cdist(vectors, vectors)
    _, theirs = trustworthiness_continuity.measure(vectors, embedding, k=12, return_local=True)
    found = local_neighborhood_quality(distances, embedding, 12)
    whole = neighborhood_quality(distances, embedding, 12)
    np.testing.assert_allclose(found.trustworthiness, theirs["local_trustworthiness"], atol=1e-12)
    np.testing.assert_allclose(found.continuity, theirs["local_continuity"], atol=1e-12)
    for name in ("trustworthiness", "continuity", "preservation"):
        assert np.mean(getattr(found, name)) == pytest.approx(getattr(whole, name)[0], abs=1e-12)


@pytest.mark.parametrize("k", [1, 10, 149])
def test_neighborhood_hit_agrees_with_zadu(k):
    """Shares of equal labels, sample by sample."""
    generator = np.random.default_rng(0)
    embedding, labels = generator.normal(size=(150, 2)), generator.integers(0, 3, 150)
    _, theirs = zadu_neighborhood_hit.measure(embedding, labels, k=k, return_local=True)
    found = neighborhood_hit(embedding, [f"class {label}" for label in labels], k)
    np.testing.assert_allclose(found, theirs["local_neighborhood_hit"], atol=1e-12)


def test_separate_classes_are_hit_entirely():
    """Classes far apart have no foreign neighbours, and each lone sample has only such."""
    embedding = np.array([[0, 0], [1, 0], [2, 0], [90, 0], [91, 0], [92, 0]], dtype=float)
    assert np.array_equal(neighborhood_hit(embedding, [0, 0, 0, 1, 1, 1], 2), np.ones(6))
    assert np.array_equal(neighborhood_hit(embedding, range(6), 2), np.zeros(6))


_PLANE = np.random.default_rng(0).random((10, 2))
_DISTANCES = cdist(_PLANE, _PLANE)
_HOLED = np.where(np.arange(20).reshape(10, 2) == 5, np.nan, _PLANE)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: neighborhood_quality(_DISTANCES[:2, :2], _PLANE[:2], 1), "embedding: got 2 samp"),
        (lambda: neighborhood_quality(_DISTANCES, _HOLED, 1), "embedding: got nan"),
        (lambda: neighborhood_quality(_DISTANCES, _PLANE[:, :1], 1), r"embedding: got shape"),
        (lambda: vector_neighborhood_quality(_PLANE[:9], _PLANE, 1), r"features: got shape"),
        (lambda: vector_neighborhood_quality(_HOLED, _PLANE, 1), "features: got nan"),
        (lambda: local_neighborhood_quality(_DISTANCES, _PLANE, [1, 2]), "k: got 2 sizes"),
        (lambda: local_neighborhood_quality(_DISTANCES, _PLANE, 5), "want sizes from 1 to 4"),
        (lambda: neighborhood_hit(_PLANE, range(9), 1), r"labels: got shape \(9,\), want \(10,\)"),
        (lambda: neighborhood_hit(_PLANE, range(10), 10), "want sizes from 1 to 9"),
        (lambda: neighborhood_hit(_PLANE, range(10), 0), "want sizes from 1 to 9"),
        (lambda: neighborhood_hit(_HOLED, range(10), 2), "embedding: got nan"),
    ],
    ids=[
        "two-samples", "nan", "one-dimension", "fewer-vectors", "nan-vectors", "several-sizes",
        "local-too-large", "fewer-labels", "hit-too-large", "hit-zero", "hit-nan",
    ],
)  # fmt: skip
def test_unfit_input_is_refused(call, message):
    """The message names the argument."""
    with pytest.raises(WorkbenchError, match=message):
        call()


def test_labels_of_different_kinds_are_refused():
    """A word and a missing value have no order, and no traceback."""
    with pytest.raises(WorkbenchError, match="labels: got labels of different kinds"):
        neighborhood_hit([[0, 0], [1, 0], [9, 0]], ["a", None, "b"], 1)
