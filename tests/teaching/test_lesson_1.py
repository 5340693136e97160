"""Lesson 1: right answers computed another way, and the hints for wrong ones."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.distance import cityblock, euclidean, sqeuclidean
from sklearn.neighbors import NearestNeighbors

from workbench.quality.neighborhoods import neighborhood_quality
from workbench.teaching import Lesson


def _nearest(distances):
    """Find each sample's nearest other one, by scikit-learn."""
    search = NearestNeighbors(n_neighbors=1, metric="precomputed").fit(distances)
    return search.kneighbors(return_distance=False)[:, 0]


def _deceived(distances, plane_distances):
    nearest = _nearest(plane_distances)
    return max(range(len(nearest)), key=lambda i: distances[i, nearest[i]])


def _sets(distances, k, itself):
    rows = [[j for j in np.argsort(row, kind="stable") if itself or j != i]
            for i, row in enumerate(distances)]  # fmt: skip
    return [set(row[:k]) for row in rows]


def _kept(distances, plane_distances, k, itself=False):
    pairs = zip(_sets(distances, k, itself), _sets(plane_distances, k, itself), strict=True)
    return np.mean([len(a & b) / k for a, b in pairs])


def _jaccard(distances, plane_distances, k):
    pairs = zip(_sets(distances, k, False), _sets(plane_distances, k, False), strict=True)
    return np.mean([len(a & b) / len(a | b) for a, b in pairs])


RIGHT = {
    "distance": lambda samples, pair: euclidean(samples[pair[0]], samples[pair[1]]),
    "false-neighbor": _deceived,
    "kept-neighbors": lambda **_: _kept,
    "by-chance": lambda n_samples, k: k / (n_samples - 1),
    "cut-ring": lambda **_: "continuity",
    "largest-share": lambda samples: (
        np.cov(samples.T).diagonal().max() / np.trace(np.cov(samples.T))
    ),
}

WRONG = {
    "no root": ("distance", lambda samples, pair: sqeuclidean(*samples[list(pair)]), "root"),
    "Manhattan": ("distance", lambda samples, pair: cityblock(*samples[list(pair)]), "Manhattan"),
    "not squared": (
        "distance",
        lambda samples, pair: np.subtract(*samples[list(pair)]).sum(),
        "cancel",
    ),
    "rows from 1": (
        "distance",
        lambda samples, pair: euclidean(samples[-1], samples[pair[1] - 1]),
        "count from 0",
    ),
    "any other distance": ("distance", lambda **_: 1.0, "Take the difference"),
    "its own nearest": ("false-neighbor", lambda **_: 0, "own nearest"),
    "the neighbour": (
        "false-neighbor",
        lambda distances, plane_distances: _nearest(plane_distances)[
            _deceived(distances, plane_distances)
        ],
        "neighbour of",
    ),
    "roles exchanged": (
        "false-neighbor",
        lambda distances, plane_distances: _deceived(plane_distances, distances),
        "the other way round",
    ),
    "counts itself": (
        "kept-neighbors",
        lambda **_: lambda d, p, k: _kept(d, p, k, itself=True),
        "one of k is a gift",
    ),
    "counts itself beside k": (
        "kept-neighbors",
        lambda **_: lambda d, p, k: (k * _kept(d, p, k) + 1) / k,
        "beside k others",
    ),
    "not divided by k": (
        "kept-neighbors",
        lambda **_: lambda d, p, k: k * _kept(d, p, k),
        "Divide it by k",
    ),
    "no mean": (
        "kept-neighbors",
        lambda **_: lambda d, p, k: len(d) * _kept(d, p, k),
        "Take the mean",
    ),
    "Jaccard": ("kept-neighbors", lambda **_: _jaccard, "Jaccard"),
    "k from elsewhere": (
        "kept-neighbors",
        lambda **_: lambda d, p, k: _kept(d, p, 10),
        "count what both contain",
    ),
    "counts itself by chance": (
        "by-chance",
        lambda n_samples, k: k / n_samples,
        "how many others",
    ),
    "nothing by chance": ("by-chance", lambda **_: 0.0, "by luck"),
    "a percentage by chance": (
        "by-chance",
        lambda n_samples, k: 100 * k / (n_samples - 1),
        "percentage",
    ),
    "the other measure": ("cut-ring", lambda **_: "trustworthiness", "beside the cut"),
    "share of deviations": (
        "largest-share",
        lambda samples: samples.std(axis=0).max() / samples.std(axis=0).sum(),
        "standard deviations",
    ),
    "variance itself": (
        "largest-share",
        lambda samples: samples.var(axis=0).max(),
        "variance itself",
    ),
    "a percentage": (
        "largest-share",
        lambda samples: 100 * samples.var(axis=0).max() / samples.var(axis=0).sum(),
        "percentage",
    ),
}  # fmt: skip


@pytest.mark.parametrize("key", RIGHT)
def test_right_answers_are_accepted(key, given):
    """What another implementation gives is right."""
    arguments = given(1)[key]
    assert Lesson(1).check(key, RIGHT[key](**arguments), **arguments).state == "solved"


@pytest.mark.parametrize(("key", "answer", "told"), WRONG.values(), ids=WRONG)
def test_wrong_answers_get_their_hint(key, answer, told, given):
    """Each typical mistake is told from the others."""
    arguments = given(1)[key]
    feedback = Lesson(1).check(key, answer(**arguments), **arguments)
    assert feedback.state == "wrong"
    assert told in feedback.verdict.text


def test_the_lesson_measures_as_the_package_does(given):
    """What the student computes is neighbourhood preservation of the quality table."""
    arguments = given(1)["kept-neighbors"]
    distances, plane_distances = arguments["distances"], arguments["plane_distances"]
    embedding = _classical(plane_distances)
    ours = neighborhood_quality(distances, embedding, 10).preservation[0]
    assert _kept(distances, plane_distances, 10) == pytest.approx(ours)


def _classical(distances):
    """Find places in the plane with these distances, by classical scaling."""
    n = len(distances)
    center = np.eye(n) - 1.0 / n
    values, vectors = np.linalg.eigh(-0.5 * center @ distances**2 @ center)
    return vectors[:, -2:] * np.sqrt(values[-2:])
