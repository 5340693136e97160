"""What selectors and interpolators refuse, at a glance."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import numpy as np

from tests.contract.refusals import (
    MAP,
    MOTION,
    NAN,
    POSES,
    ROTATIONS,
    TABLE,
    Case,
    Refused,
    check_refused,
    each_row,
    refused,
    spoiled,
)
from workbench.interpolation import interpolators
from workbench.schemes import SpatialScheme, TemporalScheme, choose_control_points
from workbench.selection import selectors
from workbench.selection.chord import chord_keyframes
from workbench.selection.optimal import Optimal
from workbench.selection.pb import decimated_keyframes

CURVES = np.arange(24.0).reshape(12, 2)

#: Of 12 frames, by the selector itself and by its name.
BY_EVERY_SELECTOR: tuple[Case, ...] = (
    ("k = n", lambda select: select(POSES, count=12), "count: got 12", "from 2 to 11"),
    ("k = 1", lambda select: select(POSES, count=1), "count: got 1 ", "from 2 to 11"),
    ("k = 2.5", lambda select: select(POSES, count=2.5), "count: got 2.5", "from 2 to 11"),
    ("k of words", lambda select: select(POSES, count="all"), "count: got 'all'", "from 2 to 11"),
    ("ratio 0", lambda select: select(POSES, ratio=0.0), "ratio: got 0.0", "between 0 and 1"),
    ("ratio 1", lambda select: select(POSES, ratio=1.0), "ratio: got 1.0", "between 0 and 1"),
    ("ratio nan", lambda select: select(POSES, ratio=NAN), "ratio: got nan", "between 0 and 1"),
    ("both", lambda select: select(POSES, count=4, ratio=0.5), "count and ratio", "exactly one"),
    (
        "fixed out of range",
        lambda select: select(POSES, count=4, fixed=[12]),
        "fixed: got 12",
        "indices from 0 to 11",
    ),
    (
        "fixed twice",
        lambda select: select(POSES, count=4, fixed=[3, 3]),
        "fixed: got unsorted or repeated",
        "want each once",
    ),
    (
        "fixed between frames",
        lambda select: select(POSES, count=4, fixed=[1.5]),
        "fixed: got float64",
        "sample indices",
    ),
    (
        "too many fixed",
        lambda select: select(POSES, count=3, fixed=[1, 2, 3, 4]),
        "fixed: got 4 samples",
        "at most count=3",
    ),
    (
        "an array",
        lambda select: select(CURVES, count=3),
        "space: got ndarray",
        "want a VectorSpace",
    ),
)

BY_CURVE_SELECTORS: tuple[Case, ...] = (
    ("k = n", lambda keys: keys(CURVES, 12), "count: got 12", "from 2 to 11"),
    ("nan", lambda keys: keys(spoiled(CURVES), 3), "values: got nan", "want finite"),
    ("one curve flat", lambda keys: keys(CURVES[:, 0], 3), "values: got shape (12,)", "1 column"),
    ("two frames", lambda keys: keys(CURVES[:2], 2), "values: got", "3"),
    ("words", lambda keys: keys([["a"]] * 5, 3), "values: got", "numbers"),
)

#: Parameters of selectors, refused when they are made or when they select.
BY_SOME_SELECTORS: tuple[Case, ...] = (
    ("k = n", lambda _: Optimal().path(POSES, 12), "count: got 12", "from 2 to 11"),
    ("objective", lambda _: Optimal(objective="mean"), "objective: got 'mean'", "sum, maximum"),
    ("scs by", lambda make: make("scs", "cubic"), "interpolator: got 'cubic'", "slerp, linear"),
    ("pb by", lambda make: make("pb", "cubic"), "interpolator: got 'cubic'", "slerp, linear"),
    ("subset", lambda make: make("rols", subset=1.5), "subset: got 1.5", "at most 1"),
    ("r = 0", lambda make: make("rols", 0.0), "regularization: got 0.0", "a number above 0"),
    ("outputs", lambda make: make("rols", outputs="map"), "outputs: got 'map'", "'pca'"),
    (
        "outputs of 5",
        lambda make: make("rols", outputs=MAP[:5]).select(TABLE, 3),
        "outputs: got shape (5, 2)",
        "want (12, n_outputs)",
    ),
    # The seed of all that draw, by random_generator.
    (
        "seed",
        lambda make: make("random", random_state="lucky").select(TABLE, 3),
        "random_state: got 'lucky'",
        "a whole number from 0",
    ),
    (
        "seed below 0",
        lambda make: make("rols", random_state=-1).select(TABLE, 3),
        "random_state: got -1",
        "a whole number from 0",
    ),
    ("unknown", lambda make: make("best"), "selector: got 'best'", "want one of uniform"),
)

BY_SALIENCY: tuple[Case, ...] = (
    ("sigma", lambda make: make(sigma=0.5).select(POSES), "sigma: got 0.5", "1"),
    ("sigma nan", lambda make: make(sigma=NAN).select(POSES), "sigma: got nan", "1"),
    ("k", lambda make: make(n_components=0).select(POSES), "n_components: got 0", "at least 1"),
    ("curves", lambda make: make(curves="up").select(POSES), "curves: got 'up'", "angles"),
    ("variance", lambda make: make(variance=0.0).select(POSES), "variance: got 0.0", "above 0"),
    ("bends", lambda make: make(curvature="x").select(POSES), "curvature: got 'x'", "slope"),
    ("width", lambda make: make(cluster_width=0).select(POSES), "cluster_width: got 0", "above 0"),
    ("feet", lambda make: make(feet=["hoof"]).select(POSES), "feet: got 'hoof'", "names of joints"),
    ("no feet", lambda make: make(feet=[]).select(POSES), "feet: got no names", "at least one"),
    ("up", lambda make: make(feet=["upper"], up="w").select(POSES), "up: got 'w'", "'y'"),
)


def of_selectors() -> Iterator[Refused]:
    for name in selectors:
        yield from refused(name, selectors.create(name).select, BY_EVERY_SELECTOR)

        def by_name(space, name=name, **wanted):
            return choose_control_points(space, name, **wanted)

        yield from refused(f"{name} by name", by_name, BY_EVERY_SELECTOR)
    yield from refused("selectors", selectors.create, BY_SOME_SELECTORS)
    yield from refused("saliency", partial(selectors.create, "saliency"), BY_SALIENCY)
    yield from refused("chord_keyframes", chord_keyframes, BY_CURVE_SELECTORS)
    yield from refused("decimated_keyframes", decimated_keyframes, BY_CURVE_SELECTORS)


@each_row(of_selectors())
def test_selectors_refuse(row):
    """The message names the argument, what it got and what it wants."""
    check_refused(row)


#: Keys of 12 frames.
BY_EVERY_INTERPOLATOR: tuple[Case, ...] = (
    ("no keys", lambda between: between(MOTION, []), "points: got", "at least 2"),
    ("one key", lambda between: between(MOTION, [3]), "points: got int64", "at least 2"),
    ("unsorted keys", lambda between: between(MOTION, [5, 2]), "got unsorted", "each once"),
    ("repeated keys", lambda between: between(MOTION, [2, 2, 7]), "repeated", "each once"),
    ("key beyond the end", lambda between: between(MOTION, [0, 12]), "got 0…12", "from 0 to 11"),
    ("negative key", lambda between: between(MOTION, [-1, 5]), "got -1…5", "from 0 to 11"),
    ("key in between", lambda between: between(MOTION, [0.5, 5]), "got float64", "indices"),
    (
        "nan",
        lambda between: between(replace(MOTION, rotations=spoiled(ROTATIONS)), [0, 11]),
        "rotations: got nan",
        "want finite",
    ),
    (
        "no rotations",
        lambda between: between(replace(MOTION, rotations=2 * ROTATIONS), [0, 11]),
        "rotations: got matrices that are 3 from orthogonal",
        "want rotations",
    ),
    (
        "mirrored",
        lambda between: between(replace(MOTION, rotations=-ROTATIONS), [0, 11]),
        "mirrored",
        "want rotations",
    ),
    ("an array", lambda between: between(ROTATIONS, [0, 11]), "motion: got ndarray", "a Motion"),
)

BY_SOME_INTERPOLATORS: tuple[Case, ...] = (
    ("kernel", lambda make: make("rbf", "wave"), "kernel: got 'wave'", "linear, cubic"),
    ("unknown", lambda make: make("best"), "interpolator: got 'best'", "want one of linear"),
)


def of_interpolators() -> Iterator[Refused]:
    for name in interpolators:
        yield from refused(name, interpolators.create(name).interpolate, BY_EVERY_INTERPOLATOR)
    yield from refused("interpolators", interpolators.create, BY_SOME_INTERPOLATORS)


@each_row(of_interpolators())
def test_interpolators_refuse(row):
    """The message names the argument, what it got and what it wants."""
    check_refused(row)


BY_BOTH_SCHEMES: tuple[Case, ...] = (
    ("k = n", lambda scheme: scheme.run(POSES, count=12), "count: got 12", "from 2 to 11"),
    ("ratio 2", lambda scheme: scheme.run(POSES, ratio=2), "ratio: got 2", "between 0 and 1"),
    ("neither", lambda scheme: scheme.run(POSES), "count and ratio", "exactly one"),
)

BY_SPATIAL_SCHEMES: tuple[Case, ...] = (
    ("an array", lambda make: make("pca").run(MAP, count=3), "space: got ndarray", "VectorSpace"),
    (
        "optimizer",
        lambda make: make("pca", optimizer="luck").run(TABLE, count=3),
        "'luck'",
        "alg12",
    ),
    ("two_step", lambda make: make("pca", two_step="x").run(TABLE, count=3), "got 'x'", "rbfp"),
    ("1-D", lambda make: make("pca", dimensions=1).run(TABLE, count=3), "dimensions: got 1", "2"),
    (
        "projected",
        lambda make: make("pca").run(TABLE, count=3, projected=MAP[:5]),
        "projected: got shape (5, 2)",
        "(12, 2)",
    ),
)


def of_schemes() -> Iterator[Refused]:
    yield from refused("SpatialScheme", SpatialScheme("pca"), BY_BOTH_SCHEMES)
    yield from refused("TemporalScheme", TemporalScheme(), BY_BOTH_SCHEMES)
    yield from refused("SpatialScheme", SpatialScheme, BY_SPATIAL_SCHEMES)
    table = ("a table", lambda scheme: scheme.run(TABLE, count=3), "got the table", "want a motion")
    yield from refused("TemporalScheme", TemporalScheme(), [table])


@each_row(of_schemes())
def test_schemes_refuse(row):
    """The message names the argument, what it got and what it wants."""
    check_refused(row)
