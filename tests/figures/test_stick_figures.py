"""Stick figures are the projections of the joints."""

from __future__ import annotations

import numpy as np
import pytest

from workbench import load_space
from workbench.errors import WorkbenchError
from workbench.figures.stick_drawing import body_traces, stick_figure
from workbench.figures.stick_figures import stick_figures
from workbench.figures.views import View
from workbench.mocap.kinematics import end_site_positions, joint_positions

JUMP = load_space("cmu/01_01-jump").motion
FRAMES = [0, 150, 299]
VIEW = View(30.0, 10.0)
FIGURES = stick_figures(JUMP, FRAMES, VIEW)


def test_bones_end_where_joints_are():
    """Every end of a bone is a joint or an end site, seen from the view."""
    nodes = np.concatenate([joint_positions(JUMP), end_site_positions(JUMP)], axis=1)[FRAMES]
    seen = VIEW.project(nodes)
    for pose in range(3):
        ends = FIGURES.segments[pose].reshape(-1, 2)
        apart = np.linalg.norm(ends[:, None] - seen[pose][None], axis=2)
        assert apart.min(axis=1).max() < 1e-9


def test_a_body_has_as_many_bones_on_the_left_as_on_the_right():
    """Sides come from the names of joints, and the head is a circle instead of a bone."""
    assert FIGURES.sides.count("left") == FIGURES.sides.count("right") > 5
    assert FIGURES.heads.shape == (3, 1, 2)
    assert 0.05 < FIGURES.head_radius / FIGURES.body_height < 0.075
    # A grown-up whose legs are apart at rest.
    assert 140 < FIGURES.body_height * JUMP.skeleton.unit_cm < 200


def test_in_place_leaves_out_the_path_and_keeps_the_height():
    """Roots stand on one spot of the ground, and a jump still goes up."""
    fixed = stick_figures(JUMP, FRAMES, VIEW, in_place=True)
    assert np.allclose(fixed.roots, fixed.roots[0])
    assert np.allclose(fixed.segments - fixed.roots[:, None, None],
                       FIGURES.segments - FIGURES.roots[:, None, None])  # fmt: skip


def test_shadows_lie_on_the_ground():
    """Seen from the ground's level, all shadows are one line below all bones."""
    level = stick_figures(JUMP, FRAMES, View(30.0, 0.0))
    ground = level.shadows[..., 1]
    assert np.allclose(ground, ground[0, 0, 0])
    assert level.segments[..., 1].min() >= ground.min() - 1e-9


def test_the_nearer_side_turns_with_the_view():
    """From the other side the other limbs are nearer."""
    front = stick_figures(JUMP, FRAMES, View(60.0))
    back = stick_figures(JUMP, FRAMES, View(240.0))
    assert all(a != b for a, b in zip(front.nearer, back.nearer, strict=True))


def test_each_bone_is_drawn_once():
    """Far limbs, trunks and near limbs together are all bones of all poses."""
    names = ("left", "right", "trunk")
    drawn = [trace for trace in body_traces(FIGURES) if trace.name in names]
    assert sum(len(trace.x) for trace in drawn) == 3 * FIGURES.segments[..., 0, 0].size


@pytest.mark.parametrize(
    ("width", "dashed", "opened"), [(2.0, True, False), (5.0, False, True)], ids=["thin", "wide"]
)
def test_colour_is_not_all_that_tells_right_from_left(width, dashed, opened):
    """Right limbs are dashed, or open where they are wide enough; left ones are solid."""
    traces = body_traces(FIGURES, width=width)
    for trace in traces:
        if trace.name in ("left", "trunk"):
            assert trace.line.dash is None
        if trace.name == "right":
            assert bool(trace.line.dash) == dashed
    inside = [trace for trace in traces if trace.name == "open"]
    assert bool(inside) == opened
    for trace in inside:
        # What is left of the limb on either side is at least a pixel.
        assert (width - trace.line.width) / 2 >= 1.0
        assert trace.x in [t.x for t in traces if t.name == "right"]


def test_moving_shifts_all_of_a_pose():
    """Bones, head, shadow, root and bounds move together."""
    shifts = np.array([[1.0, 2.0], [0.0, 0.0], [-3.0, 1.0]])
    moved = FIGURES.moved(shifts)
    assert np.allclose(moved.bounds() - FIGURES.bounds(), shifts[:, None])
    assert np.allclose(moved.roots - FIGURES.roots, shifts)


def test_one_pose_stands_on_a_grid_in_one_scale():
    """The still picture has the ground, both sides in the legend and no axes."""
    figure = stick_figure(JUMP, 150)
    assert figure.data[0].name == "ground"
    assert [t.name for t in figure.data if t.showlegend] == ["left limbs", "right limbs (open)"]
    assert figure.layout.yaxis.scaleanchor == "x"


@pytest.mark.parametrize("frames", [[300], [2, 1], []], ids=["beyond", "unsorted", "none"])
def test_frames_that_are_not_there_are_refused(frames):
    """The message names the frames."""
    with pytest.raises(WorkbenchError, match="frames"):
        stick_figures(JUMP, frames)
