"""Tests of workbench.quality.shepard_diagram."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.distance import cdist
from sklearn.isotonic import IsotonicRegression

from workbench.errors import WorkbenchError
from workbench.quality.shepard import monotone_fit, nonmetric_stress, shepard_pairs
from workbench.quality.shepard_diagram import shepard_diagram

DATA = np.random.default_rng(2).normal(size=(60, 4))
DISTANCES = cdist(DATA, DATA)
EMBEDDING = DATA[:, :2]


def test_the_line_agrees_with_scikit_learn():
    """Its values at the pairs are those of another isotonic regression."""
    pairs = shepard_pairs(DISTANCES, EMBEDDING)
    theirs = IsotonicRegression().fit(pairs.data, pairs.embedding)
    values, line = monotone_fit(pairs)
    np.testing.assert_allclose(line, theirs.predict(values), atol=1e-12)


def test_the_corners_tell_the_whole_line():
    """Straight lines between them give the stress that all values give."""
    diagram = shepard_diagram(DISTANCES, EMBEDDING)
    pairs = shepard_pairs(DISTANCES, EMBEDDING)
    drawn = np.interp(pairs.data, diagram.line_data, diagram.line_embedding)
    missed = np.sqrt(np.sum((pairs.embedding - drawn) ** 2) / np.sum(pairs.embedding**2))
    assert missed == pytest.approx(nonmetric_stress(pairs), rel=1e-9)
    assert len(diagram.line_data) < 0.2 * len(pairs.data)


def test_every_pair_is_counted_once():
    """The bins reach from 0 to the largest distances, whatever number is drawn."""
    assert shepard_diagram(DISTANCES, EMBEDDING).counts.sum() == 60 * 59 // 2
    drawn = shepard_diagram(DISTANCES, EMBEDDING, n_pairs=100, random_state=3)
    assert drawn.counts.sum() == drawn.n_pairs == 100
    assert drawn.correlation != shepard_diagram(DISTANCES, EMBEDDING, n_pairs=100).correlation


def test_a_faithful_embedding_lies_on_the_diagonal():
    """Only bins on the diagonal hold pairs, and the correlation is 1."""
    plane = EMBEDDING * 3
    diagram = shepard_diagram(cdist(EMBEDDING, EMBEDDING), plane, n_bins=10)
    off = diagram.counts - np.diag(np.diag(diagram.counts))
    assert off.sum() <= 0.01 * diagram.n_pairs  # rounding at the edges of bins
    assert diagram.correlation == pytest.approx(1)


def test_equal_distances_have_no_correlation():
    """The corners of a triangle are all alike, which is no failure."""
    triangle = np.array([[0, 0], [1, 0], [0.5, np.sqrt(0.75)]])
    assert np.isnan(shepard_diagram(1 - np.eye(3), triangle).correlation)


def test_wrong_settings_are_refused():
    """The message names them."""
    with pytest.raises(WorkbenchError, match="n_bins"):
        shepard_diagram(DISTANCES, EMBEDDING, n_bins=0)
