"""What measures of quality refuse, at a glance."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from tests.contract.refusals import (
    DISTANCES,
    INF,
    MAP,
    MOTION,
    ROTATIONS,
    SKELETON,
    VALUES,
    Case,
    Refused,
    check_refused,
    each_row,
    refused,
    spoiled,
)
from workbench.quality import animation, reconstruction
from workbench.quality.labels import neighborhood_hit
from workbench.quality.local_stress import local_stress
from workbench.quality.neighborhoods import (
    local_neighborhood_quality,
    neighborhood_quality,
    vector_neighborhood_quality,
)
from workbench.quality.sammon import sammon_stress
from workbench.quality.shepard import nonmetric_stress, shepard_goodness, shepard_pairs
from workbench.quality.shepard_diagram import shepard_diagram
from workbench.quality.stress import (
    kruskal_stress,
    normalized_stress,
    raw_stress,
    scale_normalized_stress,
    stress,
)
from workbench.quality.summary import embedding_quality

#: Distances of 12 samples and their positions.
BY_EVERY_MEASURE: tuple[Case, ...] = (
    ("other sizes", lambda m: m(DISTANCES[:5, :5], MAP), "distances: got shape (5, 5)", "(12, 12)"),
    ("not square", lambda m: m(VALUES, MAP), "distances: got shape (12, 4)", "(12, 12)"),
    ("below 0", lambda m: m(-DISTANCES, MAP), "distances: got -", "none below 0"),
    ("not symmetric", lambda m: m(np.triu(DISTANCES), MAP), "distances: got", "not symmetric"),
    ("nan", lambda m: m(spoiled(DISTANCES), MAP), "distances: got nan", "want finite"),
    ("nan place", lambda m: m(DISTANCES, spoiled(MAP)), "embedding: got nan", "want finite"),
    ("inf place", lambda m: m(DISTANCES, spoiled(MAP, INF)), "embedding: got inf", "want finite"),
    ("4-D", lambda m: m(DISTANCES, VALUES), "embedding: got shape (12, 4)", "(n_points, 3)"),
    ("flat", lambda m: m(DISTANCES, MAP[:, 0]), "embedding: got shape (12,)", "(n_points, 2)"),
    ("two", lambda m: m(DISTANCES[:2, :2], MAP[:2]), "embedding: got 2 samples", "at least 3"),
    ("words", lambda m: m(DISTANCES, [["a", "b"]] * 12), "embedding: got", "numbers"),
    ("word distances", lambda m: m([["a", "b"]] * 12, MAP), "distances: got", "numbers"),
)

BY_STRESSES: tuple[Case, ...] = (
    (
        "one place",
        lambda m: m(DISTANCES, np.ones((12, 2))),
        "embedding: got one place",
        "different",
    ),
)

#: Neighbourhoods of 12 samples.
BY_NEIGHBORHOODS: tuple[Case, ...] = (
    ("k = 0", lambda m: m(DISTANCES, MAP, 0), "k: got 0", "from 1 to 5"),
    ("k = n / 2", lambda m: m(DISTANCES, MAP, 6), "k: got 6", "from 1 to 5"),
    ("k = 2.5", lambda m: m(DISTANCES, MAP, 2.5), "k: got 2.5", "whole number"),
    ("k of words", lambda m: m(DISTANCES, MAP, "all"), "k: got 'all'", "whole number"),
)

#: Samples that are all as far from each other, and positions in one place.
EQUAL_PAIRS = shepard_pairs(1.0 - np.eye(12), MAP)
ONE_PLACE = shepard_pairs(DISTANCES, np.ones((12, 2)))

BY_OTHER_MEASURES: tuple[Case, ...] = (
    ("hit k", lambda _: neighborhood_hit(MAP, np.ones(12), 12), "k: got 12", "from 1 to 11"),
    ("hit labels", lambda _: neighborhood_hit(MAP, [1, 2], 3), "labels: got shape (2,)", "(12,)"),
    (
        "vectors",
        lambda _: vector_neighborhood_quality(VALUES[:5], MAP, 3),
        "got shape (5, 4)",
        "12",
    ),
    (
        "vector nan",
        lambda _: vector_neighborhood_quality(spoiled(VALUES), MAP, 3),
        "got nan",
        "finite",
    ),
    (
        "vector words",
        lambda _: vector_neighborhood_quality([["a"]] * 12, MAP, 3),
        "features",
        "numbers",
    ),
    ("pairs", lambda _: shepard_pairs(DISTANCES, MAP, 0), "n_pairs: got 0", "above 0"),
    ("bins", lambda _: shepard_diagram(DISTANCES, MAP, n_bins=0), "n_bins: got 0", "above 0"),
    ("goodness", lambda _: shepard_goodness(EQUAL_PAIRS), "distances: got pairs", "different"),
    ("order", lambda _: nonmetric_stress(ONE_PLACE), "embedding: got one place", "different"),
    (
        "angle errors",
        lambda _: animation.joint_angle_errors(MOTION, ROTATIONS[:3]),
        "rotations: got shape (3,",
        "want (12,",
    ),
    ("psnr", lambda _: animation.psnr(MOTION, ROTATIONS[:3]), "got shape (3,", "want (12,"),
    ("psnr nan", lambda _: animation.psnr(MOTION, spoiled(ROTATIONS)), "got nan", "finite"),
    ("no error", lambda _: animation.psnr_of_error(-1.0), "mean_squared_error: got", "0 or more"),
    (
        "error of words",
        lambda _: animation.psnr_of_error("a"),
        "mean_squared_error: got",
        "numbers",
    ),
    ("angle shapes", lambda _: animation.angle_errors(MAP, VALUES), "got shapes (12, 2)", "equal"),
    ("angle words", lambda _: animation.angle_errors([["a"]], [["b"]]), "original: got", "numbers"),
    (
        "femur",
        lambda _: animation.body_coordinate_error(MOTION, ROTATIONS, femur=0.0),
        "femur: got 0.0",
        "above 0",
    ),
    ("no femur", lambda _: animation.femur_length(SKELETON), "femur: found no leg", "its length"),
    (
        "D_p shape",
        lambda _: reconstruction.position_distances(MOTION, ROTATIONS[:3]),
        "rotations: got shape (3,",
        "want (12,",
    ),
    (
        "D_p weights",
        lambda _: reconstruction.position_distances(MOTION, ROTATIONS, [1.0]),
        "weights: got shapes",
        "(n_joints,)",
    ),
    (
        "positions",
        lambda _: reconstruction.position_error(MOTION, ROTATIONS[:3]),
        "rotations: got shape (3,",
        "want (12,",
    ),
    (
        "positions nan",
        lambda _: reconstruction.position_error(MOTION, spoiled(ROTATIONS)),
        "rotations: got nan",
        "want finite",
    ),
    ("k > n", lambda _: reconstruction.compression_ratio(5, 6, 3), "n_keyframes: got 6", "1 to 5"),
    ("joints", lambda _: reconstruction.compression_ratio(5, 3, 0), "n_joints", "at least 1"),
)


def of_measures() -> Iterator[Refused]:
    stresses = (
        stress,
        raw_stress,
        normalized_stress,
        scale_normalized_stress,
        kruskal_stress,
        local_stress,
        embedding_quality,
    )
    for measure in (*stresses, sammon_stress, shepard_pairs, shepard_diagram):
        yield from refused(measure.__name__, measure, BY_EVERY_MEASURE)
    for measure in stresses:
        yield from refused(measure.__name__, measure, BY_STRESSES)
    for of_size in (neighborhood_quality, local_neighborhood_quality):
        name = of_size.__name__
        yield from refused(name, lambda d, e, f=of_size: f(d, e, 1), BY_EVERY_MEASURE)
        yield from refused(name, of_size, BY_NEIGHBORHOODS)
    yield from refused("quality", None, BY_OTHER_MEASURES)


@each_row(of_measures())
def test_measures_refuse(row):
    """The message names the argument, what it got and what it wants."""
    check_refused(row)
