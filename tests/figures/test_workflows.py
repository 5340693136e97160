"""Workflows show the steps that a scheme has and no others."""

from __future__ import annotations

import pytest

from workbench.errors import WorkbenchError
from workbench.figures.diagrams import Arrow, Box, Diagram, draw_diagram
from workbench.figures.workflows import projection_workflow, workflow
from workbench.schemes import SpatialScheme, TemporalScheme
from workbench.selection.uniform import Uniform


def _texts(diagram):
    return " ".join(box.text for box in diagram.boxes)


def test_a_temporal_scheme_keeps_poses_and_timestamps():
    """What is stored is K and T, made by the selector and used by the interpolator."""
    diagram = workflow(TemporalScheme("hermite", "scs"))
    assert [box.key for box in diagram.boxes if box.kind == "kept"] == ["keyframes", "times"]
    assert diagram.sources("interpolate") == ["keyframes", "times"]
    assert "Hermite" in _texts(diagram)
    assert "SCS" in _texts(diagram)


def test_a_spatial_scheme_keeps_poses_and_positions_of_all():
    """Without an optimizer, positions come from the projection."""
    diagram = workflow(SpatialScheme("lle", "pb"))
    assert [box.key for box in diagram.boxes if box.kind == "kept"] == ["keyframes", "positions"]
    assert diagram.sources("positions") == ["project"]
    assert diagram.sources("back-project") == ["keyframes", "positions"]


def test_steps_stand_one_after_the_other():
    """Optimizer and marker search come between projection and positions, if there are any."""
    diagram = workflow(SpatialScheme("pca", optimizer="alg12", markers="move"))
    assert diagram.sources("optimize") == ["project", "select"]
    assert diagram.sources("markers") == ["optimize", "select"]
    assert diagram.sources("positions") == ["markers"]


def test_two_steps_project_a_subset_first():
    """The seed projector sees a subset with the control points, RBFP places the rest."""
    for diagram in (
        projection_workflow(SpatialScheme("lle", "rols", two_step="rbfp")),
        workflow(SpatialScheme("lle", "rols", two_step="rbfp")),
    ):
        assert diagram.sources("subset") == ["motion", "select"]
        assert diagram.sources("seed") == ["subset"]
        assert diagram.sources("project") == ["seed", "select", "motion"]


def test_a_method_that_is_an_object_is_called_by_its_class():
    """Own methods appear in the diagram too."""
    assert "Uniform" in _texts(workflow(TemporalScheme(selector=Uniform())))


def test_every_box_is_drawn_with_its_text():
    """The figure has a rectangle and a text for each box, none above another."""
    diagram = workflow(SpatialScheme("tsne", "rols", two_step="rbfp", optimizer="alg12"))
    figure = draw_diagram(diagram)
    texts = [note.text for note in figure.layout.annotations]
    assert all(box.text in texts for box in diagram.boxes)
    boxes = [s for s in figure.layout.shapes if s.line.dash is None]
    assert len(boxes) == len(diagram.boxes)
    for i, a in enumerate(boxes):
        for b in boxes[i + 1 :]:
            assert a.x1 < b.x0 or b.x1 < a.x0 or a.y1 < b.y0 or b.y1 < a.y0


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: workflow("tsne"), "scheme"),
        (lambda: projection_workflow(SpatialScheme("pca")), "two_step"),
        (lambda: Diagram((), ()), "boxes"),
        (lambda: Diagram((Box("a", "A", "step", 0, 0),), (Arrow("a", "b"),)), "arrows"),
        (lambda: Diagram((Box("a", "A", "idea", 0, 0),), ()), "kind"),
    ],
    ids=["no scheme", "one step", "empty", "arrow to nowhere", "unknown kind"],
)
def test_what_cannot_be_laid_out_is_refused(call, message):
    """The message names what is missing."""
    with pytest.raises(WorkbenchError, match=message):
        call()
