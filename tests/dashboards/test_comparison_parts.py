"""Several clips, moved control points, local qualities, seeds, code and files."""

from __future__ import annotations

import asyncio
import io
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import plotly.io
import pytest

from workbench.backprojection import back_projectors, register_back_projector
from workbench.dashboards import Panel, ProjectionComparison, compare_projections
from workbench.datasets import load_space
from workbench.errors import WorkbenchError
from workbench.projection.two_step import project_in_two_steps
from workbench.quality.local_stress import local_stress
from workbench.quality.summary import embedding_quality
from workbench.spaces import PoseSpace, VectorSpace

JUMP, TURN = "cmu/01_01-jump", "cmu/01_01-turn"


@pytest.fixture(scope="module")
def shared() -> Iterator[ProjectionComparison]:
    comparison = compare_projections("uci/iris", ["pca", Panel("pca", optimized=True)], ratio=0.1)
    yield comparison
    comparison.close()


@pytest.fixture
def iris(shared: ProjectionComparison) -> ProjectionComparison:
    """Give the dashboard as it was first, whatever the test before did to it."""
    controls = shared.controls
    controls.repeat.value = False
    controls.count.value = 2
    controls.back_projector.value = ""
    shared.open("uci/iris")
    controls.ratio.value = 0.1
    for chooser, optimized in zip(controls.choosers, (False, True), strict=False):
        chooser.panel = Panel("pca", optimized=optimized)
    controls.color_by.value = "class"
    shared.selection = []
    shared.moved = {}
    return shared


def states(comparison: ProjectionComparison) -> list[str]:
    return [panel["state"] for panel in comparison.view.scatter.panels]


def test_several_clips_share_a_map(iris: ProjectionComparison) -> None:
    """Frames are coloured by clip, have their own pose each, and can be chosen by a control."""
    iris.open([JUMP, TURN])
    scatter, n_jump = iris.view.scatter, len(load_space(JUMP))
    assert iris.message == ""
    assert scatter.class_names == [JUMP, TURN]
    assert scatter.color_by == "class"
    assert np.flatnonzero(scatter.classes)[0] == n_jump
    turn = load_space(TURN).positions
    pose = np.reshape(iris.view.pose.positions, (len(scatter.classes), -1, 3))
    np.testing.assert_allclose(pose[n_jump + 3, : turn.shape[1]], turn[3], atol=1e-3)
    controls = iris.controls
    assert controls.data.value == JUMP
    assert controls.further.value == (TURN,)
    controls.further.value = ()
    assert len(iris.results["A"].embedding) == n_jump
    controls.further.value = (TURN,)
    assert len(iris.results["A"].embedding) == len(scatter.classes) > n_jump


def test_further_clips_join_a_motion_in_memory(iris: ProjectionComparison) -> None:
    """A clip without a name in the list is kept beside those that are chosen there."""
    motion = load_space(JUMP).motion[:40]
    iris.open(PoseSpace(replace(motion, name="cut")))
    iris.controls.further.value = (TURN,)
    assert iris.message == ""
    assert iris.view.scatter.class_names == [TURN, "cut"]
    assert np.bincount(iris.view.scatter.classes)[1] == 40


def test_clips_that_do_not_fit_lose_nothing(iris: ProjectionComparison) -> None:
    """A table among clips is told in plain words, and the panels stay."""
    iris.open([JUMP, "uci/iris"])
    assert "uci/iris: got a table, want clips of one skeleton" in iris.message
    assert states(iris) == ["ready", "ready"]
    assert iris.view.scatter.sample_word == "sample"


def test_panels_of_one_projector_differ_by_parameters(iris: ProjectionComparison) -> None:
    """The parameters are the projector's, and a wrong one is told in the panel."""
    chooser = iris.controls.choosers
    for index, count in enumerate((5, 40)):
        chooser[index].panel = Panel("lle", {"n_neighbors": count})
    first, second = iris.results["A"].embedding, iris.results["B"].embedding
    assert np.abs(first - second).max() > 0.1
    assert iris.view.scatter.panels[1]["title"] == "B · lle (n_neighbors=40)"
    assert "usual: n_neighbors=15" in chooser[1].hint.value
    chooser[1].parameters.value = "neighbours=3"
    assert "it has" in chooser[1].problem
    assert states(iris) == ["ready", "ready"]
    chooser[1].parameters.value = "n_neighbors='many'"
    assert states(iris) == ["ready", "failed"]
    assert "n_neighbors" in iris.view.scatter.panels[1]["message"]


def test_two_steps_place_the_rest_by_rbfp(iris: ProjectionComparison) -> None:
    """Positions are those of the core's two-step projection, and the title says so."""
    iris.controls.choosers[0].two_step.value = True
    result = iris.results["A"]
    expected = project_in_two_steps(
        load_space("uci/iris"), "pca", "rbfp", result.control_points, random_state=0
    )
    np.testing.assert_array_equal(result.embedding, expected)
    assert iris.view.scatter.panels[0]["title"] == "A · pca, two-step"


def test_optimized_panels_know_where_samples_were(iris: ProjectionComparison) -> None:
    """The browser can go back to the raw embedding of the same projector."""
    raw = np.reshape(iris.view.scatter.raw_points, (2, 150, 2))
    assert np.isnan(raw[0]).all()
    np.testing.assert_allclose(raw[1], iris.results["A"].embedding, atol=1e-6)


def test_captions_tell_the_quality_before_the_optimization(iris: ProjectionComparison) -> None:
    """It is that of the same projector without one, and the caption of where samples were."""
    plain, optimized = iris.results["A"], iris.results["B"]
    assert plain.before is None
    assert optimized.before is not None
    assert optimized.before.error == pytest.approx(plain.error, abs=1e-9)
    assert optimized.before.quality.trustworthiness == plain.quality.trustworthiness
    assert optimized.error < optimized.before.error
    captions = iris.view.scatter.panels
    assert captions[1]["raw_detail"] == captions[0]["detail"] != captions[1]["detail"]
    assert "raw_detail" not in captions[0]


@pytest.mark.parametrize("name", ["stress", "trustworthiness", "reconstruction error"])
def test_colours_stand_for_local_qualities(iris: ProjectionComparison, name: str) -> None:
    """Each panel has its own values, and they go with those that the core measures."""
    iris.controls.color_by.value = name
    scatter, result = iris.view.scatter, iris.results["B"]
    assert (scatter.color_by, scatter.value_name) == ("value", name)
    assert scatter.value_best == ("high" if name == "trustworthiness" else "low")
    values = np.reshape(scatter.values, (2, 150))[1]
    np.testing.assert_array_equal(values, result.local[name])
    expected = {
        "stress": lambda: local_stress(load_space("uci/iris").distances, result.embedding),
        "trustworthiness": lambda: np.full(150, result.quality.trustworthiness),
        "reconstruction error": lambda: result.errors,
    }[name]()
    assert values.mean() == pytest.approx(expected.mean(), rel=1e-5)


def move_first(comparison: ProjectionComparison, panel: int) -> np.ndarray:
    """Do what the browser does when a control point is dropped; give all positions."""
    scatter = comparison.view.scatter
    points = np.reshape(scatter.points, (2, -1, 2))
    moved = np.full((2, len(scatter.control_points), 2), np.nan, dtype=np.float32)
    moved[panel] = points[panel][scatter.control_points]
    moved[panel, 0] += 0.5
    scatter.moved = moved.ravel()
    return moved[panel]


def test_moved_control_points_are_measured(iris: ProjectionComparison) -> None:
    """The panel's quality is that of RBFP's places; a reset brings the old back."""
    before = iris.results
    places = move_first(iris, 1)
    scatter = iris.view.scatter
    assert scatter.movable
    influence = np.reshape(scatter.influence, (150, len(scatter.control_points)))
    result = iris.results["B"]
    np.testing.assert_allclose(result.embedding, influence @ places, atol=1e-4)
    expected = embedding_quality(load_space("uci/iris").distances, result.embedding)
    assert result.quality == expected
    assert result.quality != before["B"].quality
    assert iris.results["A"] is before["A"]
    detail = iris.view.scatter.panels[1]["detail"]
    assert detail.endswith(f"error {result.error:.3g}")
    assert "B · pca, optimized (moved)" in iris.view.quality.table.value
    np.testing.assert_array_equal(iris.moved["B"], places)
    scatter.moved = []
    assert iris.moved == {}
    assert iris.results["B"] is before["B"]


def test_moves_belong_to_what_a_panel_shows(iris: ProjectionComparison) -> None:
    """Another projector is not moved; going back brings the move back."""
    places = move_first(iris, 0)
    iris.controls.choosers[0].projector.value = "mds"
    assert iris.moved == {}
    assert iris.view.scatter.moved.size == 0
    iris.controls.choosers[0].projector.value = "pca"
    np.testing.assert_array_equal(iris.moved["A"], places)
    rows = np.reshape(iris.view.scatter.moved, (2, -1, 2))
    np.testing.assert_array_equal(rows[0], places)
    assert np.isnan(rows[1]).all()


def test_moves_are_set_from_python(iris: ProjectionComparison) -> None:
    """They reach the page; what are no positions is refused."""
    places = np.random.default_rng(0).random((15, 2))
    iris.moved = {"B": places}
    np.testing.assert_allclose(np.reshape(iris.view.scatter.moved, (2, 15, 2))[1], places)
    with pytest.raises(WorkbenchError, match=r"moved: got shape \(15,\) for 'B'"):
        iris.moved = {"B": places[:, 0]}
    with pytest.raises(WorkbenchError, match="for 'G'"):
        iris.moved = {"G": places}


def test_quality_is_repeated_over_seeds(iris: ProjectionComparison) -> None:
    """Each value has the mean and deviation of the seeds beside it, until that is enough."""
    controls = iris.controls
    controls.n_seeds.value = 3
    assert "±" not in iris.view.quality.table.value
    controls.repeat.value = True
    table = iris.view.quality.table.value
    assert "mean ± standard deviation of 3 seeds" in table
    errors = []
    for seed in range(3):
        controls.seed.value = seed
        errors.append(iris.results["A"].error)
    controls.seed.value = 0
    row = iris.view.quality.table.value.split("reconstruction error")[1]
    assert f"{np.mean(errors):.3g} ± {np.std(errors, ddof=1):.2g}" in row
    # A projection that no seed changes has no spread.
    assert "± 0</small>" in table.split("trustworthiness")[1].split("</tr>")[0]
    controls.repeat.value = False
    assert "±" not in iris.view.quality.table.value


def test_repeating_can_be_cancelled(iris: ProjectionComparison) -> None:
    """What was measured stays, and the panels too."""
    iris.controls.n_seeds.value = 100

    async def main() -> None:
        iris.controls.repeat.value = True
        while "seed" not in iris.view.progress.text:
            await asyncio.sleep(0.01)
        iris.view.progress.cancel.click()
        await asyncio.wait_for(iris.finished(), 20)

    asyncio.run(main())
    assert states(iris) == ["ready", "ready"]
    iris.controls.repeat.value = False
    iris.controls.n_seeds.value = 4
    iris.controls.repeat.value = True
    assert "standard deviation of 4 seeds" in iris.view.quality.table.value


def test_a_back_projector_of_ones_own_is_offered_and_used(iris: ProjectionComparison) -> None:
    """What a cell registers rebuilds the samples of every panel."""

    class First(back_projectors.factory("knn")):  # type: ignore[misc]  # a factory is a class here
        def predict(self, X: Any) -> Any:
            return np.zeros((len(X), 4))

    register_back_projector("zeros", First)
    iris._repr_mimebundle_()
    iris.controls.back_projector.value = "zeros"
    samples = load_space("uci/iris").samples
    result = iris.results["A"]
    free = np.setdiff1d(np.arange(150), result.control_points)
    np.testing.assert_allclose(result.errors[free], np.linalg.norm(samples[free], axis=1))


def test_the_projectors_own_inverse_rebuilds(iris: ProjectionComparison) -> None:
    """PCA has one; in two steps there is none, which the panel says."""
    iris.controls.back_projector.value = "inverse"
    assert states(iris) == ["ready", "ready"]
    iris.controls.choosers[0].two_step.value = True
    assert states(iris) == ["failed", "ready"]
    assert "in two steps" in iris.view.scatter.panels[0]["message"]


def test_the_figure_can_be_a_shepard_diagram(iris: ProjectionComparison) -> None:
    """Each panel has its density and its line."""
    iris.view.quality.choice.value = "Shepard diagram"
    figure = plotly.io.from_json(iris.view.quality.curves.figure)
    assert [trace.type for trace in figure.data] == ["scatter", "scatter", "heatmap", "heatmap"]
    diagram = iris.results["B"].shepard
    np.testing.assert_array_equal(figure.data[1].y, diagram.line_embedding)
    assert np.sum(figure.data[3].text) == diagram.n_pairs
    words = [note.text for note in figure.layout.annotations]
    assert words[1] == f"B: ρ = {diagram.correlation:.2f}"
    iris.view.quality.choice.value = "Neighbourhoods"
    assert "Neighbourhood preservation" in iris.view.quality.curves.description


def test_the_code_makes_the_same_view_again(iris: ProjectionComparison) -> None:
    """A new dashboard from the code has the same panels, settings, selection and moves."""
    controls = iris.controls
    controls.count.value = 3
    controls.choosers[2].panel = Panel("lle", {"n_neighbors": 9}, two_step=True)
    controls.color_by.value = "stress"
    controls.standardize.value = True
    controls.seed.value = 4
    controls.back_projector.value = "ilamp"
    iris.selection = [3, 1, 4]
    iris.moved = {"A": np.random.default_rng(0).random((15, 2)).round(6)}
    names: dict[str, Any] = {}
    exec(iris.code, names)
    again = names["comparison"]
    try:
        assert again.code == iris.code
        assert again.controls.panels == controls.panels
        for name in ("points", "control_points", "selection", "moved", "values"):
            shown = (getattr(c.view.scatter, name) for c in (again, iris))
            np.testing.assert_array_equal(*shown, err_msg=name)
        assert again.results["A"].quality == iris.results["A"].quality
    finally:
        again.close()
        controls.standardize.value = False
        controls.seed.value = 0
    assert iris.code != again.code


def test_code_of_samples_in_memory_says_what_it_lacks(iris: ProjectionComparison) -> None:
    """They are called data, and a remark says which they are."""
    iris.open(VectorSpace(np.random.default_rng(0).normal(size=(20, 3)), name="mine"))
    assert "# data: samples that were in memory as 'mine'" in iris.code
    assert "compare_projections(\n    data,\n" in iris.code
    iris.open([JUMP, TURN])
    assert f"    ['{JUMP}', '{TURN}'],\n" in iris.code


def test_the_table_of_samples_tells_what_is_shown(
    iris: ProjectionComparison, tmp_path: Path
) -> None:
    """The file holds positions, marks and qualities of every sample."""
    iris.selection = [5, 7]
    path = iris.save_csv(tmp_path / "out" / "samples.csv")
    read = pd.read_csv(io.StringIO(path.read_text()))
    assert len(read) == 150
    assert np.flatnonzero(read["selected"]).tolist() == [5, 7]
    assert read["class"].nunique() == 3
    np.testing.assert_allclose(read[["B x", "B y"]], iris.results["B"].embedding)
    np.testing.assert_allclose(read["A reconstruction error"], iris.results["A"].errors, rtol=1e-5)
    control = iris.results["A"].control_points
    assert np.flatnonzero(read["control point"]).tolist() == control.tolist()


def test_the_page_answers_who_wants_a_file(
    iris: ProjectionComparison, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The browser gets the same page that is saved, or why there is none."""
    path = iris.save_html(tmp_path / "page.html")
    sent: list[Any] = []
    scatter = iris.view.scatter
    monkeypatch.setattr(
        scatter, "send", lambda content, buffers=(): sent.append((content, buffers))
    )
    scatter._handle_custom_msg({"want": "html"}, [])
    content, (page,) = sent.pop()
    assert content == {"kind": "html", "name": "comparison.html"}
    assert page == path.read_bytes()
    assert b"Projections of uci/iris" in page
    monkeypatch.setattr(
        "workbench.dashboards.comparison.live.comparison_page",
        lambda *_: (_ for _ in ()).throw(OSError("full")),
    )
    scatter._handle_custom_msg({"want": "html"}, [])
    assert sent.pop()[0] == {"kind": "failure", "text": "OSError: full"}


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"back_projector": "rbff"}, "'rbff', want one of rbf"),
        ({"color_by": "beauty"}, "color_by: got 'beauty', want one of class"),
        ({"selection": [-1]}, "selection: got index -1"),
        ({"repeat": 0}, "repeat: got 0"),
        ({"data": []}, r"data: got \[\], want a data set's name"),
        ({"data": 7}, "data: got 7"),
    ],
    ids=["back-projector", "colour", "selection", "repeat", "no data", "number"],
)
def test_wrong_settings_are_refused(arguments: dict[str, Any], words: str) -> None:
    """The message names the argument and says what it may be."""
    with pytest.raises(WorkbenchError, match=words):
        compare_projections(**{"data": "uci/iris", **arguments})
