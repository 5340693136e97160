"""The explained optimizer, driven from Python."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from sklearn.neighbors import KNeighborsRegressor
from sklearn.svm import SVR

from workbench.backprojection import register_back_projector
from workbench.backprojection.knn import KNN
from workbench.dashboards.explanation.explain import OptimizerExplanation, explain_optimizer
from workbench.dashboards.explanation.methods import namespace_regressors
from workbench.datasets import load_space
from workbench.errors import WorkbenchError
from workbench.optimization import optimizers, register_optimizer
from workbench.optimization.local_search import LocalSearch
from workbench.projection import projectors, register_projector
from workbench.schemes import SpatialScheme
from workbench.spaces import VectorSpace

PICKED = 101  # no control point


@pytest.fixture(scope="module")
def shared() -> Iterator[OptimizerExplanation]:
    explanation = explain_optimizer("uci/iris", ratio=0.06)
    yield explanation
    explanation.close()


@pytest.fixture
def iris(shared: OptimizerExplanation) -> OptimizerExplanation:
    """Give the dashboard as it was first, whatever the test before did to it."""
    shared.controls.projector.value = "pca"
    shared.back_projector = None
    shared.view.landscape.zoomed = False
    shared.view.landscape.place = []
    if shared.plane is None or shared.plane.name != "uci/iris":
        shared.open("uci/iris")
    shared.optimizer = "alg12"
    shared.sample = PICKED
    return shared


def text_of(explanation: OptimizerExplanation) -> str:
    return explanation.view.root.children[2].value


def test_the_worst_sample_of_new_data_is_picked(iris: OptimizerExplanation) -> None:
    """Without a wish, the free sample with the largest error is explained."""
    iris.open("uci/wine")
    result = SpatialScheme("pca").run(load_space("uci/wine"), ratio=0.06, random_state=0)
    assert iris.sample == result.errors.argmax()


def test_landscape_and_ways_are_those_of_the_package(iris: OptimizerExplanation) -> None:
    """Errors on the map, and the ends of the ways, equal what schemes give."""
    space = load_space("uci/iris")
    plain = SpatialScheme("pca").run(space, ratio=0.06, random_state=0)
    landscape = iris.landscape
    expected = np.linalg.norm(
        plain.back_projector.predict(landscape.grid.points) - space.samples[PICKED], axis=1
    )
    np.testing.assert_allclose(landscape.errors.ravel(), expected, atol=1e-12)
    assert landscape.errors.shape == (96, 96)
    assert set(iris.traces) == {"alg12", "local", "global"}
    for name, trace in iris.traces.items():
        scheme = SpatialScheme("pca", optimizer=name)
        result = scheme.run(space, ratio=0.06, random_state=0)
        assert np.array_equal(trace.positions[-1], result.embedding[PICKED])


def test_the_views_show_them(iris: OptimizerExplanation) -> None:
    """The browser gets the map, the steps with their words, and the row of the sample."""
    view = iris.view.landscape
    assert view.mapped == view.sample == iris.controls.sample.value == PICKED
    np.testing.assert_allclose(view.errors, iris.landscape.errors.ravel(), rtol=1e-6)
    assert [trace["title"] for trace in view.traces] == [
        "Alg. 12",
        "Local search",
        "Global search",
    ]
    steps = view.traces[0]["steps"]
    assert [step["error"] for step in steps] == iris.trace.errors.tolist()
    assert len(steps[1]["tries"]) == 5
    row = iris.view.reconstruction
    assert row.original.tolist() == load_space("uci/iris").samples[PICKED].tolist()
    assert row.kernel == "linear"
    assert "pca with back-projector rbf, 9 control points" in text_of(iris)


def test_a_sample_picked_in_the_browser_is_explained(iris: OptimizerExplanation) -> None:
    """The trait that a click sets, and the number, pick alike; the step begins anew."""
    iris.step = 2
    iris.view.landscape.sample = 77
    assert iris.sample == iris.controls.sample.value == iris.trace.sample == 77
    assert iris.step == 0
    iris.controls.sample.value = 78
    assert iris.sample == iris.view.landscape.mapped == 78


def test_a_control_point_has_a_landscape_but_no_way(iris: OptimizerExplanation) -> None:
    """It is said in words why nothing moves, and the error at its own place is 0."""
    iris.sample = int(iris.plane.control_points[0])
    assert iris.trace is None
    assert "A control point" in iris.view.landscape.traces[0]["message"]
    assert iris.landscape.minimum[1] < 0.3
    assert iris.message == ""


@pytest.mark.parametrize(
    ("method", "name"),
    [
        ("ilamp", "ilamp"),
        ("knn", "knn"),
        ("inverse", "inverse"),
        (KNeighborsRegressor(3), "KNeighborsRegressor(n_neighbors=3)"),
        (SVR(), "SVR()"),
    ],
    ids=["ilamp", "knn", "own inverse", "regressor", "regressor of one number"],
)
def test_other_back_projectors_change_landscape_and_ways(
    iris: OptimizerExplanation, method: Any, name: str
) -> None:
    """Each method gives another map, and Python rebuilds what the browser cannot."""
    before = iris.landscape.errors
    iris.back_projector = method
    assert iris.message == ""
    assert iris.back_projector == name
    assert not np.allclose(iris.landscape.errors, before)
    assert set(iris.traces) == set(optimizers.names())
    row = iris.view.reconstruction
    assert row.kernel == ""
    assert row.rebuilt_at == iris.plane.embedding[PICKED].tolist()
    error = np.linalg.norm(row.rebuilt - row.original)
    assert error == pytest.approx(iris.trace.errors[0], abs=1e-9)


def test_a_clicked_place_is_rebuilt_by_python(iris: OptimizerExplanation) -> None:
    """What only Python can evaluate follows a click."""
    iris.back_projector = "knn"
    iris.view.landscape.place = [0.9, 0.25]
    row = iris.view.reconstruction
    assert row.rebuilt_at == [0.9, 0.25]
    space, controls = load_space("uci/iris"), iris.plane.control_points
    model = KNN().fit(iris.plane.embedding[controls], space.samples[controls])
    np.testing.assert_allclose(row.rebuilt, model.predict([[0.9, 0.25]])[0])


def test_a_close_up_maps_the_surroundings_of_the_ways(iris: OptimizerExplanation) -> None:
    """The square shrinks to where the optimizers were, and comes back."""
    whole = list(iris.view.landscape.extent)
    iris.view.landscape.zoomed = True
    x0, x1, y0, y1 = iris.view.landscape.extent
    assert x1 - x0 < 0.5 * (whole[1] - whole[0])
    for trace in iris.traces.values():
        assert np.all((trace.positions >= [x0, y0]) & (trace.positions <= [x1, y1]))
    iris.view.landscape.zoomed = False
    assert list(iris.view.landscape.extent) == whole


def test_frames_are_explained_with_their_pose(iris: OptimizerExplanation) -> None:
    """A clip gets spatial keyframes, frames and a skeleton."""
    iris.open("cmu/01_01-jump")
    space = load_space("cmu/01_01-jump")
    row = iris.view.reconstruction
    assert iris.view.landscape.sample_word == "frame"
    assert row.original.tolist() == space.features[iris.sample].tolist()
    assert len(row.offsets) == len(row.parents) == len(row.sides)
    assert row.root.tolist() == space.motion.root_translation[iris.sample].tolist()
    assert row.kernel == "linear"
    assert "spatial-keyframes" in text_of(iris)


def test_what_cannot_be_had_is_told_and_loses_nothing(iris: OptimizerExplanation) -> None:
    """Unknown data, and an inverse that does not exist, leave what was shown."""
    iris.open("no/such")
    assert "no/such" in iris.message
    assert "still shown: uci/iris" in text_of(iris)
    assert iris.trace is not None
    iris.open("uci/iris")
    assert iris.message == ""
    iris.back_projector = "inverse"
    iris.controls.projector.value = "mds"
    assert "no inverse" in iris.message
    assert 'role="alert"' in text_of(iris)
    assert iris.landscape is not None


def test_registered_methods_appear(
    iris: OptimizerExplanation, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A projector, a back-projector and an optimizer of the user's own work by name."""

    class Flipped(projectors.factory("pca")):  # type: ignore[misc]  # a factory is a class here
        def fit_transform(self, X: Any, y: Any = None) -> Any:
            return -super().fit_transform(X, y)

    class Nearest(KNN):
        def __init__(self) -> None:
            super().__init__(n_neighbors=1)

    class Patient(LocalSearch):
        pass

    register_projector("flipped", Flipped)
    register_back_projector("nearest", Nearest)
    register_optimizer("patient", Patient)
    iris.recompute()
    for name, control in (("flipped", "projector"), ("nearest", "back_projector")):
        chooser = getattr(iris.controls, control)
        assert name in chooser.options
        chooser.value = name
    iris.optimizer = "patient"
    assert iris.message == ""
    assert iris.trace.iterations >= 0
    assert [trace["title"] for trace in iris.view.landscape.traces][-1] == "patient"


def test_a_failing_method_is_told_in_words(iris: OptimizerExplanation) -> None:
    """An optimizer that raises says so in its place; the others still show their ways."""

    class Broken(LocalSearch):
        def optimize(self, *args: Any, **kwargs: Any) -> Any:
            raise ValueError("out of order")

    register_optimizer("broken", Broken)
    iris.recompute()
    told = {trace["name"]: trace for trace in iris.view.landscape.traces}
    assert told["broken"]["message"] == "ValueError: out of order"
    assert told["alg12"]["steps"]


def test_regressors_of_a_namespace_are_found() -> None:
    """Variables that hold a regressor are on offer by their names; nothing else is."""
    namespace = {"model": SVR(), "Class": SVR, "_hidden": SVR(), "number": 3}
    assert list(namespace_regressors(namespace)) == ["model (SVR)"]


def test_samples_in_memory_are_explained() -> None:
    """A space of the user's own works, also after a computation was cancelled."""
    rng = np.random.default_rng(2)
    space = VectorSpace(rng.normal(size=(40, 5)), name="mine")
    explanation = explain_optimizer(space, sample=7, ratio=0.1)
    try:
        assert explanation.plane.name == "mine"
        assert explanation.sample in (7, *explanation.plane.free.tolist())
        explanation.cancel()
        explanation.sample = int(explanation.plane.free[3])
        assert explanation.message == ""
        assert explanation.trace is not None
    finally:
        explanation.close()


def test_a_long_computation_can_be_cancelled() -> None:
    """Cancelling ends it, says so, and Compute again does it."""

    class Slow(projectors.factory("pca")):  # type: ignore[misc]  # a factory is a class here
        def fit_transform(self, X: Any, y: Any = None) -> Any:
            time.sleep(self.delay)
            return super().fit_transform(X, y)

        delay = 60.0

    register_projector("slow", Slow)

    async def cancelled() -> OptimizerExplanation:
        explanation = explain_optimizer("uci/iris", "slow")
        await asyncio.sleep(0)
        assert explanation.view.progress.cancel.layout.visibility == "visible"
        explanation.cancel()
        await explanation.finished()
        return explanation

    explanation = asyncio.run(cancelled())
    assert explanation.message == "cancelled"
    assert explanation.view.progress.cancel.layout.visibility == "hidden"
    Slow.delay = 0.0
    explanation.recompute()
    explanation.close()
    assert explanation.trace is not None


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"projector": "none"}, "projector: got 'none', want one of pca"),
        ({"back_projector": "none"}, "back_projector: got 'none', want one of usual for the data"),
        ({"back_projector": KNN}, "got the class KNN"),
        ({"back_projector": 3}, "an object with fit and predict"),
        ({"ratio": 0.9}, "ratio: got 0.9, want 0.01 to 0.5"),
        ({"sample": -1}, "sample: got -1, want an index from 0"),
    ],
    ids=["projector", "back-projector", "class", "number", "ratio", "sample"],
)
def test_wrong_arguments_are_refused_in_words(arguments: dict[str, Any], words: str) -> None:
    """The message names the argument and what it wants."""
    with pytest.raises(WorkbenchError, match=words):
        explain_optimizer("uci/iris", **arguments)


def test_wrong_settings_are_refused_in_words(iris: OptimizerExplanation) -> None:
    """Samples, steps and optimizers that do not exist are refused; nothing changes."""
    with pytest.raises(WorkbenchError, match="sample: got 150, want an index below 150"):
        iris.sample = 150
    with pytest.raises(WorkbenchError, match="step: got 999"):
        iris.step = 999
    with pytest.raises(WorkbenchError, match="optimizer: got 'none', want one of alg12"):
        iris.optimizer = "none"
    assert iris.sample == PICKED


def test_the_package_offers_it() -> None:
    """The name in the package is the function, however often it is imported."""
    import workbench.dashboards

    for _ in range(2):
        assert workbench.dashboards.explain_optimizer is explain_optimizer
