"""The projection comparison, driven from Python."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Iterator
from typing import Any

import numpy as np
import plotly.io
import pytest

from workbench.dashboards import Panel, ProjectionComparison, compare_projections
from workbench.datasets import load_space, register_dataset
from workbench.errors import WorkbenchError
from workbench.projection import projectors, register_projector
from workbench.spaces import VectorSpace


@pytest.fixture(scope="module")
def shared() -> Iterator[ProjectionComparison]:
    comparison = compare_projections("uci/iris", ["pca", "mds"], ratio=0.1)
    yield comparison
    comparison.close()


@pytest.fixture
def iris(shared: ProjectionComparison) -> ProjectionComparison:
    """Give the dashboard as it was first, whatever the test before did to it."""
    shared.open("uci/iris")
    controls = shared.controls
    controls.standardize.value = False
    controls.ratio.value = 0.1
    controls.count.value = 2
    for index, name in enumerate(("pca", "mds")):
        controls.choosers[index].panel = Panel(name)
    controls.color_by.value = "class"
    controls.back_projector.value = ""
    controls.repeat.value = False
    shared.selection = []
    shared.moved = {}
    return shared


@pytest.fixture
def own_projectors(monkeypatch: pytest.MonkeyPatch) -> None:
    """Forget afterwards what the test registers."""
    monkeypatch.setattr(projectors, "_entries", dict(projectors._entries))


def states(comparison: ProjectionComparison) -> list[str]:
    return [panel["state"] for panel in comparison.view.scatter.panels]


def messages(comparison: ProjectionComparison) -> str:
    return comparison.view.root.children[2].value


def register_slow(seconds: float) -> None:
    class Slow(projectors.factory("pca")):  # type: ignore[misc]  # a factory is a class here
        def fit_transform(self, X: Any, y: Any = None) -> Any:
            time.sleep(seconds)
            return super().fit_transform(X, y)

    register_projector("slow", Slow)


def test_each_control_is_named_for_its_panel(iris: ProjectionComparison) -> None:
    """A screen reader, which reads one control at a time, tells the panels apart."""
    controls = iris.controls
    for letter, chooser in zip("ABCDEF", controls.choosers, strict=True):
        parts = (chooser.projector, chooser.parameters, chooser.two_step, chooser.optimized)
        assert all(part.description.endswith(f" {letter}") for part in parts)


def test_panels_table_and_figure_show_the_same_results(iris: ProjectionComparison) -> None:
    """The browser gets the embeddings, classes and control points of the results."""
    scatter, results = iris.view.scatter, iris.results
    assert states(iris) == ["ready", "ready"]
    points = np.reshape(scatter.points, (2, 150, 2))
    figure = plotly.io.from_json(iris.view.quality.curves.figure)
    for index, letter in enumerate("AB"):
        np.testing.assert_allclose(points[index], results[letter].embedding, atol=1e-6)
        curve = figure.data[index]
        np.testing.assert_array_equal(curve.y, results[letter].preservation)
    assert len(figure.data) == 2
    assert scatter.class_names == ["setosa", "versicolor", "virginica"]
    assert scatter.control_points.tolist() == results["A"].control_points.tolist()
    assert len(scatter.control_points) == 15
    assert f"{results['A'].quality.trustworthiness:.3g}" in iris.view.quality.table.value


def test_a_missing_file_is_told_and_loses_nothing(iris: ProjectionComparison) -> None:
    """Panels, results and selection stay; the message is in plain words and escaped."""
    iris.selection = [1, 2]
    before = iris.results
    iris.controls.path.value = "/no/<b>such</b>.csv"
    iris.controls.open.click()
    assert "no such file" in iris.message
    assert "&lt;b&gt;such" in messages(iris)
    assert "still shown: uci/iris" in messages(iris)
    assert iris.results == before
    assert iris.selection.tolist() == [1, 2]
    assert states(iris) == ["ready", "ready"]
    iris.open("uci/iris")
    assert iris.message == ""
    assert "alert" not in messages(iris)


def test_a_file_of_ones_own_is_shown(iris: ProjectionComparison, tmp_path: Any) -> None:
    """Its class column colours the panels, and the drop-down no longer names a data set."""
    rows = np.random.default_rng(0).normal(size=(20, 3))
    path = tmp_path / "own.csv"
    lines = [f"{a},{b},{c},{'xy'[i % 2]}" for i, (a, b, c) in enumerate(rows)]
    path.write_text("\n".join(["a,b,c,kind", *lines]))
    iris.controls.path.value = str(path)
    iris.controls.label.value = "kind"
    iris.controls.open.click()
    assert iris.message == ""
    assert iris.view.scatter.class_names == ["x", "y"]
    assert iris.controls.data.value == ""
    assert iris.view.details.columns == ["a", "b", "c"]


def test_an_edited_file_is_read_again(iris: ProjectionComparison, tmp_path: Any) -> None:
    """Computing again and opening again show what is in the file now; the old panels stay."""
    path = tmp_path / "edited.csv"

    def write(n_rows: int) -> None:
        rows = np.random.default_rng(n_rows).normal(size=(n_rows, 3)).tolist()
        path.write_text("\n".join(["a,b,c", *(",".join(map(str, row)) for row in rows)]))

    def shown() -> tuple[str, int, int]:
        return iris.message, *(len(iris.results[letter].embedding) for letter in "AB")

    write(20)
    iris.open(path)
    assert shown() == ("", 20, 20)
    write(25)
    iris.recompute()
    assert shown() == ("", 25, 25)
    write(30)
    iris.open(path)
    assert shown() == ("", 30, 30)
    path.unlink()
    iris.recompute()
    assert "no such file" in iris.message
    assert shown()[1:] == (30, 30)
    write(35)
    iris.recompute()
    assert shown() == ("", 35, 35)


def test_panels_never_show_two_versions_of_a_file(
    iris: ProjectionComparison, tmp_path: Any
) -> None:
    """A process that has to read the file anew refuses one that was edited meanwhile."""
    path = tmp_path / "edited.csv"
    path.write_text("a,b\n" + "\n".join(f"{i},{i * i % 7}" for i in range(20)))
    iris.open(path)
    path.write_text("a,b\n" + "\n".join(f"{i},{i * i % 5}" for i in range(21)))
    iris.cancel()
    iris.controls.choosers[1].projector.value = "isomap"
    assert states(iris) == ["ready", "failed"]
    assert "the file has changed" in iris.view.scatter.panels[1]["message"]
    iris.recompute()
    assert states(iris) == ["ready", "ready"]
    assert len(iris.results["A"].embedding) == 21


def test_the_selection_is_kept_with_settings_and_cleared_with_data(
    iris: ProjectionComparison,
) -> None:
    """The same samples stay selected under another projector; other data have others."""
    iris.selection = [149, 3]
    iris.controls.choosers[1].projector.value = "lle"
    iris.controls.ratio.value = 0.2
    assert iris.selection.tolist() == [3, 149]
    iris.open("uci/wine")
    assert iris.selection.tolist() == []


def test_indices_beyond_the_data_cannot_be_selected(iris: ProjectionComparison) -> None:
    """The message says which indices there are."""
    with pytest.raises(WorkbenchError, match="index 150, want indices below 150"):
        iris.selection = [0, 150]
    assert iris.selection.tolist() == []


def test_optimizing_lowers_the_reconstruction_error(iris: ProjectionComparison) -> None:
    """The best value in the table is then the optimized panel's."""
    iris.controls.choosers[1].projector.value = "pca"
    iris.controls.choosers[1].optimized.value = True
    assert iris.results["B"].error < iris.results["A"].error
    assert iris.view.scatter.panels[1]["title"] == "B · pca, optimized"
    row = iris.view.quality.table.value.split("reconstruction error")[1]
    first, second = row.split("<td")[1:3]
    assert "best" not in first
    assert "best" in second


def test_standardizing_is_another_space(iris: ProjectionComparison) -> None:
    """The check box brings what the same space by hand brings, and back."""
    raw = iris.results["A"].quality.stress
    iris.controls.standardize.value = True
    by_hand = load_space("uci/iris", standardize=True)
    from workbench.projection import project

    embedding = project(by_hand, "pca", random_state=0)
    np.testing.assert_allclose(iris.results["A"].embedding, embedding, atol=1e-12)
    iris.controls.standardize.value = False
    assert iris.results["A"].quality.stress == raw


def test_a_motion_shows_its_pose_and_is_coloured_by_time(iris: ProjectionComparison) -> None:
    """Frames have a stick figure in place of a row of values, and no classes."""
    iris.open("cmu/01_01-jump")
    view = iris.view
    assert view.pose.layout.display is None
    assert view.details.layout.display == "none"
    n_frames = len(load_space("cmu/01_01-jump"))
    assert view.pose.positions.size == n_frames * len(view.pose.parents) * 3
    assert {"left", "right"} <= set(view.pose.sides)
    assert view.scatter.color_by == "time"
    assert view.scatter.sample_word == "frame"
    assert iris.controls.standardize.disabled
    iris.open("uci/iris")
    assert view.pose.layout.display == "none"
    assert view.scatter.color_by == "class"


@pytest.mark.usefixtures("own_projectors")
def test_a_projector_of_ones_own_is_offered_and_used(iris: ProjectionComparison) -> None:
    """A class registered in a cell reaches the process that computes."""

    class FirstTwo(projectors.factory("pca")):  # type: ignore[misc]  # a factory is a class here
        def fit_transform(self, X: Any, y: Any = None) -> Any:
            return np.asarray(X)[:, :2]

    register_projector("first two", FirstTwo)
    iris._repr_mimebundle_()
    assert "first two" in iris.controls.choosers[0].projector.options
    iris.controls.choosers[0].projector.value = "first two"
    measured = load_space("uci/iris").samples[:, :2]
    shown = iris.results["A"].embedding
    assert np.corrcoef(shown.ravel(), (measured - measured.min(axis=0)).ravel())[0, 1] > 0.999


@pytest.mark.usefixtures("own_projectors")
def test_a_failing_projector_says_so_in_its_panel_only(iris: ProjectionComparison) -> None:
    """The other panel stays, and there is no traceback."""

    class Broken(projectors.factory("pca")):  # type: ignore[misc]  # a factory is a class here
        def fit_transform(self, X: Any, y: Any = None) -> Any:
            raise RuntimeError("out of luck")

    register_projector("broken", Broken)
    iris.recompute()
    iris.controls.choosers[1].projector.value = "broken"
    assert states(iris) == ["ready", "failed"]
    assert iris.view.scatter.panels[1]["message"] == "RuntimeError: out of luck"
    assert list(iris.results) == ["A"]


def test_registered_data_are_found_by_name(iris: ProjectionComparison) -> None:
    """What only this kernel can load is loaded here, also with standardised columns."""
    rows = np.random.default_rng(3).normal(size=(30, 3)) * [1, 10, 100]
    register_dataset("mine/rows", lambda: rows)
    iris.open("mine/rows")
    assert iris.message == ""
    raw = iris.results["A"].quality.scale_normalized_stress
    iris.controls.standardize.value = True
    assert iris.results["A"].quality.scale_normalized_stress > raw
    assert "30 samples" in messages(iris)


def test_registered_data_are_offered() -> None:
    """A data set registered before the dashboard is made stands first in its list."""
    rows = np.random.default_rng(3).normal(size=(30, 3))
    register_dataset("mine/offered", lambda: rows)
    comparison = compare_projections("mine/offered", ["pca", "mds"], ratio=0.1)
    try:
        assert "mine/offered" in [name for _, name in comparison.controls.data.options]
        assert comparison.controls.data.value == "mine/offered"
    finally:
        comparison.close()


def test_a_failing_loader_is_told_in_plain_words(iris: ProjectionComparison) -> None:
    """An error of the user's own loader loses nothing either."""

    def load() -> Any:
        raise OSError("disk on fire")

    register_dataset("mine/lost", load)
    iris.open("mine/lost")
    assert iris.message == "OSError: disk on fire"
    assert states(iris) == ["ready", "ready"]


def test_samples_in_memory_are_shown(iris: ProjectionComparison) -> None:
    """A space made in the notebook works in place of a name, and so does the next one."""
    rng = np.random.default_rng(5)
    iris.open(VectorSpace(rng.normal(size=(12, 3)), name="first"))
    assert len(iris.results["A"].embedding) == 12
    iris.open(VectorSpace(rng.normal(size=(15, 3)), name="first"))
    assert len(iris.results["A"].embedding) == 15


@pytest.mark.usefixtures("own_projectors")
def test_cancelling_keeps_what_is_complete_and_can_be_resumed(
    iris: ProjectionComparison,
) -> None:
    """A projection of a minute ends at once; computing again completes the panel."""
    register_slow(60)
    iris.recompute()

    async def main() -> None:
        iris.controls.choosers[1].projector.value = "slow"
        while "projecting" not in iris.view.progress.text:
            await asyncio.sleep(0.02)
        assert iris.view.progress.cancel.layout.visibility == "visible"
        start = time.monotonic()
        iris.view.progress.cancel.click()
        await asyncio.wait_for(iris.finished(), 5)
        assert time.monotonic() - start < 5
        assert states(iris) == ["ready", "failed"]
        assert iris.view.scatter.panels[1]["message"] == "cancelled"
        assert iris.view.progress.cancel.layout.visibility == "hidden"
        register_slow(0)
        iris.view.progress.again.click()
        await asyncio.wait_for(iris.finished(), 60)

    asyncio.run(main())
    assert states(iris) == ["ready", "ready"]


@pytest.mark.usefixtures("own_projectors")
def test_another_choice_replaces_what_is_being_computed(iris: ProjectionComparison) -> None:
    """Nobody waits for a projection that is no longer wanted."""
    register_slow(60)
    iris.recompute()

    async def main() -> None:
        iris.controls.choosers[1].projector.value = "slow"
        while "projecting" not in iris.view.progress.text:
            await asyncio.sleep(0.02)
        iris.controls.choosers[1].projector.value = "isomap"
        await asyncio.wait_for(iris.finished(), 50)

    asyncio.run(main())
    assert states(iris) == ["ready", "ready"]


@pytest.mark.parametrize("part", ["data", "panel"])
def test_any_error_is_told_in_its_place(
    iris: ProjectionComparison, monkeypatch: pytest.MonkeyPatch, part: str
) -> None:
    """No panel stays "computing" when, for instance, no process can be started."""
    iris.cancel()

    def refuse() -> Any:
        raise OSError("too many processes")

    async def main() -> None:
        if part == "data":
            iris.open("uci/wine")
        else:
            iris.controls.ratio.value = 0.07
        await asyncio.wait_for(iris.finished(), 60)

    with monkeypatch.context() as patch:
        patch.setattr(iris._live.background, "_started", refuse)
        asyncio.run(main())
    told = iris.message if part == "data" else iris.view.scatter.panels[1]["message"]
    assert told == "OSError: too many processes"
    iris.recompute()
    assert iris.message == ""
    assert states(iris) == ["ready", "ready"]


def test_adding_panels_keeps_the_others(iris: ProjectionComparison) -> None:
    """The first two results are not computed again for four panels."""
    before = iris.results
    iris.controls.choosers[2].projector.value = "lle"
    iris.controls.choosers[3].optimized.value = False
    iris.controls.choosers[3].projector.value = "pca"
    iris.controls.count.value = 4
    assert states(iris) == ["ready"] * 4
    assert iris.results["A"] is before["A"]
    assert iris.results["D"] is before["A"]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"panels": []}, "panels: got 0, want 1 to 6"),
        ({"panels": ["pca", "pcb"]}, "'pcb', want one of pca"),
        ({"panels": ["pca", Panel("pcb", optimized=True)]}, "'pcb', want one of pca"),
        ({"ratio": 0.9}, "ratio: got 0.9"),
    ],
    ids=["no panel", "unknown", "unknown optimized", "ratio"],
)
def test_wrong_arguments_are_refused(arguments: dict[str, Any], words: str) -> None:
    """The message names the argument and says what it may be."""
    with pytest.raises(WorkbenchError, match=words):
        compare_projections("uci/iris", **arguments)
