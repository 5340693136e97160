"""Curves in the plane and the poses at their points have the same letters."""

from __future__ import annotations

import numpy as np
import pytest

from workbench import load_space
from workbench.errors import WorkbenchError
from workbench.figures.authoring import plane_with_poses
from workbench.figures.embeddings import Panel
from workbench.figures.stick_figures import stick_figures

JUMP = load_space("cmu/01_01-jump").motion
POINTS = np.random.default_rng(0).random((300, 2))
PANEL = Panel("MDS", POINTS, np.array([0, 299]))
POSES = stick_figures(JUMP, [10, 150, 290], in_place=True)


def test_probes_and_poses_have_the_same_letters():
    """A to C in the plane, and below the poses of both rows."""
    figure = plane_with_poses(PANEL, POINTS[[10, 150, 290]], {"before": POSES, "after": POSES})
    (probes,) = [trace for trace in figure.data if trace.mode == "markers+text"]
    assert [text.strip("</b>") for text in probes.text] == ["A", "B", "C"]
    assert np.array_equal(np.stack([probes.x, probes.y], axis=1), POINTS[[10, 150, 290]])
    below = [note.text for note in figure.layout.annotations]
    letters = ["<b>A</b>", "<b>B</b>", "<b>C</b>"]
    assert below == [*letters, "before", *letters, "after"]


def test_the_curve_before_is_dotted():
    """What was changed can be compared with what it was."""
    figure = plane_with_poses(PANEL, POINTS[[10, 150, 290]], {"": POSES}, before=2 * POINTS)
    (dotted,) = [trace for trace in figure.data if trace.line.dash == "dot"]
    assert np.array_equal(np.stack([dotted.x, dotted.y], axis=1), 2 * POINTS)


@pytest.mark.parametrize(
    ("probes", "poses"),
    [(POINTS[:3], {}), (POINTS[:2], {"": POSES}), (POINTS[:0], {"": POSES})],
    ids=["no row", "too few probes", "no probe"],
)
def test_what_does_not_fit_is_refused(probes, poses):
    """Each probe has one pose in each row."""
    with pytest.raises(WorkbenchError, match="poses"):
        plane_with_poses(PANEL, probes, poses)
