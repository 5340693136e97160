"""What the comparison computes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from workbench.dashboards.comparison.jobs import Methods, Run
from workbench.dashboards.comparison.measuring import curve_sizes
from workbench.dashboards.comparison.panels import Panel
from workbench.dashboards.comparison.session import Session
from workbench.dashboards.comparison.summaries import summarize
from workbench.dashboards.shared.sources import MAX_SAMPLES, Source
from workbench.errors import DataError, WorkbenchError
from workbench.mocap.motion import Motion
from workbench.optimization import VISUALIZATION_OPTIMIZER
from workbench.projection import projectors
from workbench.registry import Registry
from workbench.schemes import SpatialScheme
from workbench.spaces import PoseSpace, VectorSpace


def quiet(text: str, done: float | None) -> None:
    assert text
    assert done is None or 0 <= done <= 1


@pytest.fixture
def table() -> VectorSpace:
    rng = np.random.default_rng(1)
    labels = np.repeat(["b", "a"], 30)
    return VectorSpace(rng.normal(size=(60, 4)), labels=labels, name="table")


@pytest.mark.parametrize("optimized", [False, True], ids=["raw", "optimized"])
def test_a_panel_shows_what_the_scheme_gives(table: VectorSpace, optimized: bool) -> None:
    """Embedding, error and quality are those of the same scheme run by hand."""
    run = Run(Source("table", space=table, token=1), Panel("mds", optimized=optimized), 0.1, 7)
    result = Session().run(run, Methods(), report=quiet)
    scheme = SpatialScheme("mds", optimizer=VISUALIZATION_OPTIMIZER if optimized else None)
    expected = scheme.run(table, ratio=0.1, random_state=7)
    np.testing.assert_array_equal(result.embedding, expected.embedding)
    np.testing.assert_array_equal(result.control_points, expected.control_points)
    assert result.error == expected.error
    assert result.quality == expected.quality
    at = result.k.tolist().index(10)
    assert result.preservation[at] == pytest.approx(result.quality.neighborhood_preservation)


def test_raw_and_optimized_share_one_projection(table: VectorSpace) -> None:
    """The projector runs once for both, and again for another seed or another projector."""
    calls = []

    class Counting(projectors.factory("pca")):  # type: ignore[misc]  # a factory is a class here
        def fit_transform(self, X: Any, y: Any = None) -> Any:
            calls.append(1)
            return super().fit_transform(X, y)

    class Another(Counting):
        pass

    session, source = Session(), Source("table", space=table, token=1)
    for factory, optimized, seed, expected in [
        (Counting, False, 0, 1),
        (Counting, True, 0, 1),
        (Counting, False, 1, 2),
        (Another, False, 0, 3),
    ]:
        registry = Registry("projector", {})
        registry.register("mine", factory)
        session.run(
            Run(source, Panel("mine", optimized=optimized), 0.1, seed),
            Methods(registry),
            report=quiet,
        )
        assert len(calls) == expected


def test_adjusted_parameters_are_told(table: VectorSpace) -> None:
    """t-SNE's perplexity does not fit 60 samples, and the panel's notes say so."""
    run = Run(Source("table", space=table, token=1), Panel("tsne"), 0.1, 0)
    assert any("perplexity" in note for note in Session().run(run, Methods(), report=quiet).notes)


def test_a_projector_with_three_dimensions_is_refused(table: VectorSpace) -> None:
    """A panel is a plane, and the message says so."""
    registry = Registry("projector", {})
    registry.register("solid", lambda: projectors.create("pca", n_components=3))
    run = Run(Source("table", space=table, token=1), Panel("solid"), 0.1, 0)
    with pytest.raises(WorkbenchError, match="'solid': got 3 dimensions, want 2"):
        Session().run(run, Methods(registry), report=quiet)


def test_too_many_samples_are_refused_before_memory_runs_out() -> None:
    """The message says how many there may be."""
    space = VectorSpace(np.random.default_rng(0).normal(size=(MAX_SAMPLES + 1, 2)))
    with pytest.raises(DataError, match=str(MAX_SAMPLES)):
        Session().load(Source("big", space=space, token=1), report=quiet)


def test_a_table_is_described_with_its_classes(table: VectorSpace) -> None:
    """Classes are numbered in the order of their names."""
    summary = summarize(table)
    assert summary.class_names == ["a", "b"]
    assert summary.classes.tolist() == [1] * 30 + [0] * 30
    assert summary.body is None
    np.testing.assert_allclose(summary.values, table.samples, rtol=1e-6)


def test_a_motion_is_described_with_its_body(waving: Motion) -> None:
    """End sites follow the joints, and each hangs on its joint."""
    summary = summarize(PoseSpace(waving))
    body = summary.body
    assert body is not None
    assert body.nodes.parents == [-1, 0, 1, 0, 2, 3]
    assert body.nodes.names[-2:] == ["lower", "other"]
    assert body.positions.shape == (60, 6, 3)
    starts = body.positions[:, body.nodes.parents[1:]]
    bones = np.linalg.norm(body.positions[:, 1:] - starts, axis=2)
    np.testing.assert_allclose(bones, np.broadcast_to([1, 2, 1, 3, 0], bones.shape), atol=1e-5)


def test_a_users_file_is_read_with_its_treatment(tmp_path: Path) -> None:
    """What was done to the table is among the notes."""
    path = tmp_path / "mine.csv"
    path.write_text("a,b,kind\n1,2,x\n2,,x\n3,5,y\n4,4,y\n9,1,y\n")
    summary = Session().load(Source(str(path), label="kind"), report=quiet)
    assert summary.n_samples == 4
    assert any("missing" in note for note in summary.notes)


@pytest.mark.parametrize("n", [3, 7, 150, 5000])
def test_curve_sizes_are_valid_neighbourhoods(n: int) -> None:
    """They rise from 1 and are all below half of the samples."""
    sizes = curve_sizes(n)
    assert sizes[0] == 1
    assert np.all(np.diff(sizes) > 0)
    assert 2 * sizes[-1] < n
