"""Tests of workbench.quality."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.distance import cdist, pdist
from sklearn.datasets import load_iris
from sklearn.manifold import trustworthiness
from zadu.measures import (
    scale_normalized_stress as zadu_scale_normalized_stress,
)
from zadu.measures import (
    stress as zadu_stress,
)
from zadu.measures import (
    trustworthiness_continuity,
)

from workbench.errors import WorkbenchError
from workbench.mocap.rotations import axis_rotation
from workbench.projection import project
from workbench.quality.neighborhoods import default_neighborhood_size, neighborhood_quality
from workbench.quality.reconstruction import compression_ratio, position_error
from workbench.quality.stress import scale_normalized_stress, stress
from workbench.quality.summary import embedding_quality
from workbench.spaces import VectorSpace


@pytest.fixture(scope="module")
def wine_like():
    """Give 120 rows without ties, their distances and a PCA embedding."""
    values = load_iris().data[:120] + np.random.default_rng(0).normal(scale=0.05, size=(120, 4))
    space = VectorSpace(values)
    return values, space.distances, project(space, "pca")


def test_stress_is_the_printed_formula(wine_like):
    """Eq. 4.1 of Costa 2018, summed pair by pair."""
    values, distances, embedding = wine_like
    d, delta = pdist(values), pdist(embedding)
    expected = np.sum((delta - d) ** 2) / np.sum(delta**2)
    assert stress(distances, embedding) == pytest.approx(expected, rel=1e-12)


def test_scale_normalized_stress_is_the_minimum_over_scales(wine_like):
    """No scale of the embedding gives less, and the best one gives just this."""
    values, distances, embedding = wine_like
    d, delta = pdist(values), pdist(embedding)
    scales = np.linspace(0.5, 1.5, 2001) * (d @ delta) / (delta @ delta)
    values_at = np.sum((d - scales[:, None] * delta) ** 2, axis=1) / np.sum(d**2)
    assert scale_normalized_stress(distances, embedding) == pytest.approx(values_at.min(), rel=1e-6)


def test_stress_agrees_with_zadu(wine_like):
    """ZADU takes roots; its plain stress has the data's distances in the denominator."""
    values, distances, embedding = wine_like
    theirs = zadu_scale_normalized_stress.measure(values, embedding)["scale_normalized_stress"]
    assert scale_normalized_stress(distances, embedding) == pytest.approx(theirs**2, rel=1e-9)
    plain = zadu_stress.measure(values, embedding)["stress"]
    swapped = np.sum(pdist(embedding) ** 2) / np.sum(pdist(values) ** 2)
    assert stress(distances, embedding) * swapped == pytest.approx(plain**2, rel=1e-9)


@given(st.floats(1e-3, 1e3), st.floats(0, 6.28))
@settings(deadline=None, max_examples=30)
def test_scale_normalized_stress_ignores_scale_and_rotation(wine_like, size, angle):
    """Scaling, turning and shifting an embedding leave the value as it is."""
    _, distances, embedding = wine_like
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    changed = size * embedding @ turn + 5.0
    assert scale_normalized_stress(distances, changed) == pytest.approx(
        scale_normalized_stress(distances, embedding), rel=1e-6
    )


def test_faithful_embeddings_have_no_stress():
    """Distances kept exactly, or up to one factor."""
    plane = np.random.default_rng(0).random((30, 2))
    assert stress(cdist(plane, plane), plane) == pytest.approx(0, abs=1e-12)
    assert scale_normalized_stress(cdist(plane, plane), 9 * plane) == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("k", [1, 5, 10, 30, 59])
def test_trustworthiness_and_continuity_agree_with_scikit_learn(wine_like, k):
    """Continuity is trustworthiness with data and embedding exchanged."""
    values, distances, embedding = wine_like
    found = neighborhood_quality(distances, embedding, k)
    assert found.trustworthiness[0] == pytest.approx(
        trustworthiness(values, embedding, n_neighbors=k), abs=1e-12
    )
    assert found.continuity[0] == pytest.approx(
        trustworthiness(embedding, values, n_neighbors=k), abs=1e-12
    )


def test_trustworthiness_and_continuity_agree_with_zadu(wine_like):
    """ZADU's values at k = 15."""
    values, distances, embedding = wine_like
    theirs = trustworthiness_continuity.measure(values, embedding, k=15)
    found = neighborhood_quality(distances, embedding, 15)
    assert found.trustworthiness[0] == pytest.approx(theirs["trustworthiness"], abs=1e-9)
    assert found.continuity[0] == pytest.approx(theirs["continuity"], abs=1e-9)


def test_neighborhood_preservation_counts_common_neighbors(wine_like):
    """The mean share of common neighbours, counted sample by sample with sets."""
    _, distances, embedding = wine_like
    in_plane = cdist(embedding, embedding)
    sizes = [1, 7, 20]
    found = neighborhood_quality(distances, embedding, sizes).preservation
    for k, value in zip(sizes, found, strict=True):
        shares = [
            len(set(np.argsort(a)[1 : k + 1]) & set(np.argsort(b)[1 : k + 1])) / k
            for a, b in zip(distances, in_plane, strict=True)
        ]
        assert value == pytest.approx(np.mean(shares), abs=1e-12)


def test_perfect_embeddings_have_quality_one():
    """Neighbourhood measures of the data itself are exactly 1 at every size."""
    plane = np.random.default_rng(0).random((40, 2))
    found = neighborhood_quality(cdist(plane, plane), plane, np.arange(1, 20))
    for values in (found.trustworthiness, found.continuity, found.preservation):
        assert np.array_equal(values, np.ones(19))


def test_equal_distances_are_ties_in_both():
    """Rows that repeat keep quality 1, although rounding ranks their copies differently."""
    places = np.repeat(np.random.default_rng(0).random((10, 2)), 4, axis=0)
    turn = np.array([[0.6, -0.8], [0.8, 0.6]])
    found = neighborhood_quality(cdist(places, places), places @ turn * 7 + 3, [1, 5, 12])
    for values in (found.trustworthiness, found.continuity, found.preservation):
        assert np.array_equal(values, np.ones(3))


@pytest.mark.parametrize("k", [2.5, [], "many", [[1]]], ids=str)
def test_neighborhood_sizes_are_whole_numbers(k):
    """Fractions, nothing and words are refused by the argument's name."""
    plane = np.random.default_rng(0).random((40, 2))
    with pytest.raises(WorkbenchError, match="k: got"):
        neighborhood_quality(cdist(plane, plane), plane, k)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda d: d * np.nan, "distances: got nan"),
        (lambda d: -d, "want none below 0"),
        (lambda d: d + np.arange(5), "not symmetric"),
        (lambda d: d[:4], r"distances: got shape \(4, 5\), want \(5, 5\)"),
    ],
    ids=["nan", "negative", "asymmetric", "shape"],
)
@pytest.mark.parametrize("measure", [stress, embedding_quality, scale_normalized_stress])
def test_what_are_no_distances_is_refused(measure, change, message):
    """The message says what is wrong with them."""
    plane = np.random.default_rng(0).random((5, 2))
    with pytest.raises(WorkbenchError, match=message):
        measure(change(cdist(plane, plane)), plane)


@pytest.mark.parametrize("k", [0, 20, 99])
def test_neighborhood_sizes_out_of_range_are_refused(k):
    """Sizes go from 1 to below half the samples."""
    plane = np.random.default_rng(0).random((40, 2))
    with pytest.raises(WorkbenchError, match="want sizes from 1 to 19"):
        neighborhood_quality(cdist(plane, plane), plane, k)


@pytest.mark.parametrize(("n", "k"), [(3, 1), (4, 1), (20, 9), (21, 10), (1000, 10)])
def test_default_neighborhood_size(n, k):
    """min(10, (n − 1) // 2), and at least 1."""
    assert default_neighborhood_size(n) == k


def test_three_samples_are_enough_for_all_values():
    """The smallest space has every quality value."""
    quality = embedding_quality(cdist(np.eye(3), np.eye(3)), [[0, 0], [1, 0], [0.4, 0.9]])
    assert quality.k == 1
    assert np.isfinite([quality.stress, quality.trustworthiness, quality.continuity]).all()


def test_unfit_input_is_refused():
    """Embeddings in one place and matrices of another size have no stress."""
    with pytest.raises(WorkbenchError, match="one place"):
        stress(np.ones((3, 3)) - np.eye(3), np.zeros((3, 2)))
    with pytest.raises(WorkbenchError, match="distances: got only zeros"):
        scale_normalized_stress(np.zeros((3, 3)), np.random.default_rng(0).random((3, 2)))


def test_compression_limits_of_the_thesis():
    """At 3 % of 31 joints a temporal scheme keeps 6.06 %, a spatial one 8.15 % (section 5.1)."""
    n = 10**6
    temporal = compression_ratio(n, 3 * n // 100, 31)
    spatial = compression_ratio(n, 3 * n // 100, 31, n_coordinates=2)
    assert 100 / temporal == pytest.approx(6.06, abs=0.005)
    assert 100 / spatial == pytest.approx(8.15, abs=0.005)


def test_position_error_of_a_turned_bone(waving):
    """Turning the last bone of 3 units moves no joint; turning its parent moves one."""
    rebuilt = waving.rotations.copy()
    rebuilt[:, 2] = rebuilt[:, 2] @ axis_rotation("X", 90)
    assert position_error(waving, rebuilt) == pytest.approx(0, abs=1e-12)
    rebuilt = waving.rotations.copy()
    rebuilt[:, 1] = rebuilt[:, 1] @ axis_rotation("X", 90)
    # The joint below sits 2 units away across the axis, so it moves by 2·√2; 4 joints in all.
    assert position_error(waving, rebuilt) == pytest.approx(2 * np.sqrt(2) / 4)
