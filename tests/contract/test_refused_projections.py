"""What projectors and back-projectors refuse, at a glance."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import Any

import numpy as np

from tests.contract.refusals import (
    DISTANCES,
    INF,
    MAP,
    NAN,
    POSES,
    ROTATIONS,
    TABLE,
    VALUES,
    Case,
    Refused,
    check_refused,
    each_row,
    refused,
    spoiled,
)
from workbench.backprojection import back_projector_for, back_projectors
from workbench.projection import (
    control_point_projectors,
    fit_projection,
    project,
    projectors,
    scale_to_unit_square,
)
from workbench.projection.two_step import project_in_two_steps
from workbench.spaces import VectorSpace

#: On 12 rows of 4 numbers.
BY_EVERY_PROJECTOR: tuple[Case, ...] = (
    ("nan", lambda make: make().fit_transform(spoiled(VALUES)), "X contains NaN", "finite"),
    ("inf", lambda make: make().fit_transform(spoiled(VALUES, INF)), "X contains inf", "finite"),
    ("one row", lambda make: make().fit_transform(VALUES[:1]), "1 sample", "minimum of 2"),
    ("flat", lambda make: make().fit_transform(VALUES[0]), "Expected 2D", "got 1D"),
    ("0-D", lambda make: make(n_components=0).fit(VALUES), "n_components: got 0", "from 1"),
    ("2.5-D", lambda make: make(n_components=2.5).fit(VALUES), "n_components: got 2.5", "from 1"),
)

BY_PROJECTORS_OF_DISTANCES: tuple[Case, ...] = (
    ("not square", lambda far: far().fit(DISTANCES[:5]), "X: got shape (5, 12)", "square"),
    ("below 0", lambda far: far().fit(-DISTANCES), "X: got a distance of -", "none below 0"),
    ("not symmetric", lambda far: far().fit(np.triu(DISTANCES)), "X: got", "not symmetric"),
    ("metric", lambda far: far(metric="x").fit(VALUES), "metric: got 'x'", "euclidean, precomp"),
)

#: Applied where a projector has the parameter.
BY_PARAMETER: dict[str, tuple[Any, ...]] = {
    "n_neighbors": (0, 2.5, "many"),
    "perplexity": (0.0, NAN, "many"),
    "n_iterations": (0,),
    "step": (0.5, NAN),
    "order": ("sorted",),
    "random_state": ("lucky", -1, 0.5),
}

BY_PROJECT: tuple[Case, ...] = (
    ("an array", lambda call: call(MAP, "pca"), "space: got ndarray", "VectorSpace"),
    ("unknown", lambda call: call(TABLE, "som"), "projector: got 'som'", "want one of pca"),
    ("a class", lambda call: call(TABLE, VectorSpace), "got the class VectorSpace", "an object"),
    ("4-D", lambda call: call(TABLE, "pca", dimensions=4), "dimensions: got 4", "2 or 3"),
    ("seed", lambda call: call(TABLE, "tsne", random_state=-1), "random_state: got -1", "0 to"),
    ("equal rows", lambda call: call(VectorSpace(np.ones((5, 2))), "pca"), "all samples", "differ"),
)

BY_SCALING: tuple[Case, ...] = (
    ("one place", lambda scale: scale(np.ones((4, 2))), "embedding: got one place", "different"),
    ("nan", lambda scale: scale(spoiled(MAP)), "embedding: got nan", "want finite"),
    ("4-D", lambda scale: scale(VALUES), "embedding: got shape (12, 4)", "(n_points, 3)"),
    ("words", lambda scale: scale([["a", "b"]]), "embedding: got", "numbers"),
)


def of_projectors() -> Iterator[Refused]:
    for name in projectors:
        make = partial(projectors.create, name)
        yield from refused(name, make, BY_EVERY_PROJECTOR)
        if hasattr(make(), "metric"):
            far = partial(projectors.create, name, **{"metric": "precomputed"})
            yield from refused(name, far, BY_PROJECTORS_OF_DISTANCES)
        for parameter, values in BY_PARAMETER.items():
            for value in values if hasattr(make(), parameter) else ():
                made = make(**{parameter: value})
                case: Case = (parameter, lambda m: m.fit(VALUES), f"{parameter}: got", "want")
                yield from refused(f"{name} {value}", made, [case])
    yield from refused("project", project, BY_PROJECT)
    yield from refused("fit_projection", fit_projection, BY_PROJECT)
    yield from refused("scale_to_unit_square", scale_to_unit_square, BY_SCALING)


@each_row(of_projectors())
def test_projectors_refuse(row):
    """The message names the argument, what it got and what it wants."""
    check_refused(row)


#: Fitting maps of 12 samples.
BY_EVERY_CONTROL_POINT_PROJECTOR: tuple[Case, ...] = (
    ("an array", lambda p: p.fit(MAP, [0, 5], MAP[:2]), "space: got ndarray", "VectorSpace"),
    ("unsorted", lambda p: p.fit(TABLE, [5, 0], MAP[:2]), "points: got unsorted", "each once"),
    ("repeated", lambda p: p.fit(TABLE, [5, 5], MAP[:2]), "or repeated", "each once"),
    ("beyond", lambda p: p.fit(TABLE, [5, 12], MAP[:2]), "points: got 5…12", "from 0 to 11"),
    ("none", lambda p: p.fit(TABLE, [], MAP[:0]), "points: got", "at least 1"),
    (
        "many places",
        lambda p: p.fit(TABLE, [0, 5], MAP[:3]),
        "positions: got shape (3, 2)",
        "(2, 2)",
    ),
    ("4-D", lambda p: p.fit(TABLE, [0, 5], VALUES[:2]), "positions: got shape (2, 4)", "(2, 3)"),
    ("nan", lambda p: p.fit(TABLE, [0, 5], spoiled(MAP[:2])), "positions: got nan", "want finite"),
    ("words", lambda p: p.fit(TABLE, [0, 1], [["a", "b"]] * 2), "positions: got", "numbers"),
    ("before fit", lambda p: p.transform(VALUES), "call fit", "before transform"),
)

BY_FITTED_MAPS: tuple[Case, ...] = (
    ("new nan", lambda p: p.transform(spoiled(VALUES)), "samples: got nan", "want finite"),
    ("new shape", lambda p: p.transform(MAP), "samples: got shape (12, 2)", "(n_samples, 4)"),
    ("new words", lambda p: p.transform([["a"] * 4]), "samples: got", "numbers"),
)

BY_RBFP: tuple[Case, ...] = (
    ("kernel", lambda make: make("wave"), "kernel: got 'wave'", "multiquadric"),
    ("epsilon 0", lambda make: make(epsilon=0.0), "epsilon: got 0.0", "above 0"),
    ("epsilon nan", lambda make: make(epsilon=NAN), "epsilon: got nan", "above 0"),
    ("epsilon of words", lambda make: make(epsilon="wide"), "epsilon: got 'wide'", "above 0"),
    ("smoothing", lambda make: make(smoothing=-1.0), "smoothing: got -1.0", "from 0"),
)

BY_TWO_STEPS: tuple[Case, ...] = (
    ("share", lambda steps: steps([0, 5, 9], seed_share=2.0), "seed_share: got 2.0", "0 to 1"),
    ("two alone", lambda steps: steps([0, 5], seed_share=0.0), "indices: got", "at least 3"),
    ("beyond", lambda steps: steps([0, 5, 12]), "got 0…12", "from 0 to 11"),
)


def of_control_point_projectors() -> Iterator[Refused]:
    for name in control_point_projectors:
        make = partial(control_point_projectors.create, name)
        yield from refused(name, make(), BY_EVERY_CONTROL_POINT_PROJECTOR)
        yield from refused(name, make().fit(TABLE, [0, 5, 11], MAP[:3]), BY_FITTED_MAPS)
        steps = partial(project_in_two_steps, TABLE, "pca", name)
        yield from refused(f"two steps by {name}", steps, BY_TWO_STEPS)
    yield from refused("rbfp", partial(control_point_projectors.create, "rbfp"), BY_RBFP)


@each_row(of_control_point_projectors())
def test_control_point_projectors_refuse(row):
    """The message names the argument, what it got and what it wants."""
    check_refused(row)


#: A back-projector that was not fitted, and 12 samples.
BY_EVERY_BACK_PROJECTOR: tuple[Case, ...] = (
    ("nan", lambda b: b[0].fit(spoiled(MAP), b[1]), "X contains NaN", "want finite"),
    ("inf", lambda b: b[0].fit(spoiled(MAP, INF), b[1]), "X contains inf", "want finite"),
    ("sample nan", lambda b: b[0].fit(MAP, spoiled(b[1])), "nan", "want finite"),
    ("too few samples", lambda b: b[0].fit(MAP, b[1][:5]), "5", "12"),
    ("no points", lambda b: b[0].fit(MAP[:0], b[1][:0]), "shape", "(0,"),
    ("flat", lambda b: b[0].fit(MAP[0], b[1][:2]), "Expected 2D", "got 1D"),
    ("other dimension", lambda b: b[2].predict(np.ones((4, 3))), "3 features", "2 features"),
    ("predict nan", lambda b: b[2].predict(spoiled(MAP)), "X contains NaN", "want finite"),
    ("predict flat", lambda b: b[2].predict(MAP[0]), "Expected 2D", "got 1D"),
)

#: Applied where a back-projector has the parameter.
BY_BACK_PROJECTOR_PARAMETER: dict[str, tuple[Any, ...]] = {
    "kernel": ("wave", 3),
    "epsilon": (0.0, NAN),
    "smoothing": (-1.0, NAN),
    "centers": (0, 2.5),
    "n_neighbors": (0, 2.5),
    "weights": ("even",),
    "scaling": ("affine",),
}

BY_SOME_BACK_PROJECTORS: tuple[Case, ...] = (
    ("unknown", lambda make: make(TABLE, "magic"), "back-projector: got 'magic'", "one of rbf"),
    ("of poses", lambda make: make(TABLE, "spatial-keyframes"), "rebuilds poses", "for vectors"),
    (
        "poses of another shape",
        lambda make: make(POSES, "rbf").fit(MAP, ROTATIONS[:, :, 0]),
        "rotations: got shape (12, 3, 3)",
        "(12, n_joints, 3, 3)",
    ),
    (
        "roots",
        lambda make: make(POSES, None).fit(MAP, ROTATIONS, VALUES),
        "root_translations: got shape (12, 4)",
        "(12, 3)",
    ),
    (
        "no roots",
        lambda make: make(POSES, None).fit(MAP, ROTATIONS).predict_root(MAP),
        "root translations: none",
        "want fit(points",
    ),
    (
        "no projection",
        lambda make: make(TABLE, "inverse").fit(MAP, VALUES),
        "got no projector to invert",
        "pca or umap",
    ),
    (
        "no inverse",
        lambda make: make(TABLE, "inverse").use_projection(fit_projection(TABLE, "mds")),
        "got MDS",
        "pca or umap",
    ),
)


def of_back_projectors() -> Iterator[Refused]:
    for name in back_projectors:
        space = POSES if name == "spatial-keyframes" else TABLE
        ready = []
        for _ in range(2):
            built: Any = back_projector_for(space, name)
            if hasattr(built, "use_projection"):
                built.use_projection(fit_projection(space, "pca"))
            ready.append(built)
        fitted = ready[1].fit(MAP, space.samples)
        yield from refused(name, (ready[0], space.samples, fitted), BY_EVERY_BACK_PROJECTOR)
        for parameter, values in BY_BACK_PROJECTOR_PARAMETER.items():
            for value in values if hasattr(back_projectors.create(name), parameter) else ():
                made = (back_projectors.create(name, **{parameter: value}), space.samples)
                case: Case = (parameter, lambda b: b[0].fit(MAP, b[1]), f"{parameter}: got", "want")
                yield from refused(f"{name} {value}", made, [case])
    yield from refused("back_projector_for", back_projector_for, BY_SOME_BACK_PROJECTORS)


@each_row(of_back_projectors())
def test_back_projectors_refuse(row):
    """The message names the argument, what it got and what it wants."""
    check_refused(row)
