"""Tests of workbench.selection.saliency."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from workbench.datasets import load_space
from workbench.errors import DegenerateDataWarning, WorkbenchError
from workbench.mocap.channels import motion_to_euler
from workbench.mocap.kinematics import body_positions
from workbench.mocap.motion_saliency import motion_saliency
from workbench.mocap.rotations import axis_rotation
from workbench.schemes import TemporalScheme, choose_control_points
from workbench.selection import selectors
from workbench.selection.saliency import Saliency
from workbench.spaces import PoseSpace, VectorSpace


@pytest.fixture(scope="module")
def jump():
    """Give the bundled jump."""
    return load_space("cmu/01_01-jump")


@pytest.fixture
def still(waving):
    """Give a motion in which nothing moves."""
    return PoseSpace(replace(waving, rotations=np.repeat(waving.rotations[:1], 60, axis=0)))


def test_its_own_rule_adds_the_ends_to_the_keyframes_of_the_clusters(jump):
    """Without a count, schemes get the clusters' keyframes and what the clip needs at its ends."""
    found = choose_control_points(jump, "saliency")
    expected = motion_saliency(motion_to_euler(jump.motion, unwrap=True)).keyframes
    assert found.tolist() == sorted({0, len(jump) - 1, *expected.tolist()})
    assert 3 < len(found) < 0.2 * len(jump)


def test_a_scheme_runs_without_a_count(jump):
    """Keyframes by the method's own rule rebuild the clip."""
    result = TemporalScheme("slerp", Saliency(sigma=5)).run(jump)
    assert np.all(result.errors[result.control_points] == 0)
    assert result.error < 0.2


@pytest.mark.parametrize("options", [{}, {"sigma": 3.5, "contacts": True}, {"curves": "positions"}])
def test_every_count_is_met_and_rises_from_rank_to_rank(jump, options):
    """From 2 to nearly all frames, and below the method's own number one more adds one."""
    selector = Saliency(**options)
    own = selector.select(jump)
    n = len(jump)
    before = set(selector.select(jump, 2).tolist())
    assert before == {0, n - 1}
    for count in range(3, len(own) + 1):
        found = set(selector.select(jump, count).tolist())
        assert len(found) == count
        assert before < found
        before = found
    assert before == set(own.tolist())
    for count in (len(own) + 1, 3 * len(own), n // 2, n - 1):
        found = selector.select(jump, count)
        assert len(np.unique(found)) == count
        assert np.all(np.diff(found) > 0)


def test_the_most_salient_clusters_come_first(jump):
    """Of the keyframes left out, none is more salient than one that is taken."""
    saliency = Saliency().measure(jump.motion)
    taken = Saliency().select(jump, len(saliency.keyframes) // 2)
    ranks = saliency.frame_saliency
    left_out = np.setdiff1d(saliency.keyframes, taken)
    assert ranks[left_out].max() <= ranks[taken[1:-1]].min()


def test_more_keyframes_than_clusters_come_from_shorter_clusters(jump):
    """They are candidates, as long as there are enough of those."""
    saliency = Saliency().measure(jump.motion)
    n_wanted = 3 * len(saliency.keyframes)
    found = Saliency().select(jump, n_wanted)
    salient = saliency.candidates.any(axis=1)
    assert salient[found[1:-1]].all()
    gaps = np.diff(found[salient[found]])
    assert gaps.max() <= np.diff(np.flatnonzero(salient)).max() + saliency.cluster_length


def test_ratio_and_fixed_frames(jump):
    """The share is met, and fixed frames stay, with a count and without."""
    fixed = [7, 8, 9, 100]
    n = len(jump)
    assert len(Saliency().select(jump, ratio=0.03)) == int(0.03 * n)
    assert set(fixed) <= set(Saliency().select(jump, ratio=0.03, fixed=fixed).tolist())
    assert Saliency().select(jump, 4, fixed=fixed).tolist() == fixed
    assert Saliency().select(jump, 6, fixed=fixed).tolist() == [0, *fixed, n - 1]
    own = set(Saliency().select(jump).tolist())
    assert set(Saliency().select(jump, fixed=fixed).tolist()) == own | set(fixed)


def test_curves_are_what_was_asked_for(jump):
    """Angles or body coordinates, with or without the root's path."""
    motion = jump.motion
    positions = body_positions(motion).reshape(len(motion), -1)
    found = Saliency(sigma=6, curves="positions").measure(motion)
    assert np.array_equal(found.saliency, motion_saliency(positions, 6).saliency)
    with_path = np.hstack([motion_to_euler(motion, unwrap=True), motion.root_translation])
    found = Saliency(root_translation=True, n_components=9).measure(motion)
    assert np.array_equal(found.curves, motion_saliency(with_path, n_components=9).curves)


def test_body_coordinates_do_not_know_where_the_body_is(jump):
    """Turned and carried elsewhere, the motion has the same keyframes in body coordinates."""
    motion = jump.motion
    rotations = motion.rotations.copy()
    rotations[:, 0] = axis_rotation("Y", np.linspace(0, 300, len(motion))) @ rotations[:, 0]
    moved = replace(motion, rotations=rotations, root_translation=3 * motion.root_translation)
    selector = Saliency(curves="positions")
    assert np.array_equal(selector.select(PoseSpace(moved)), selector.select(jump))


def test_feet_are_curves_of_their_own(jump):
    """Two of the k curves are the heights of the feet, found or named."""
    found = Saliency(contacts=True, n_components=8).measure(jump.motion)
    assert found.is_foot.tolist() == [False] * 6 + [True] * 2
    named = Saliency(feet=("LeftFoot", "RightFoot"), n_components=8).measure(jump.motion)
    assert np.array_equal(named.curves, found.curves)
    with pytest.raises(WorkbenchError, match=r"feet: got 'Hoof', want"):
        Saliency(feet=("Hoof",)).select(jump)


def test_a_motion_that_stands_still_keeps_its_ends(still):
    """It is said that nothing is salient; a count is met by even spacing."""
    with pytest.warns(DegenerateDataWarning, match="no frame is salient"):
        assert Saliency().select(still).tolist() == [0, 59]
    with pytest.warns(DegenerateDataWarning):
        found = Saliency().select(still, 7)
    assert len(found) == 7
    assert np.ptp(np.diff(found)) <= 1


@pytest.mark.filterwarnings(
    "ignore::workbench.errors.DegenerateDataWarning"  # within a huge window all is alike
)
def test_short_motions_can_be_selected_from(waving):
    """Three frames are enough, with any σ."""
    short = PoseSpace(waving[10:13])
    for sigma in (1, 10, 1e200):
        keys = Saliency(sigma=sigma).select(short).tolist()
        assert keys[0] == 0
        assert keys[-1] == 2


def test_tables_have_no_time():
    """A table is refused by name, by the method's own rule and with a count."""
    table = VectorSpace(np.random.default_rng(0).random((20, 3)), name="sheet")
    for options in ({}, {"count": 4}):
        with pytest.raises(WorkbenchError, match="got the table 'sheet', want a motion"):
            choose_control_points(table, "saliency", **options)


@pytest.mark.parametrize(
    ("options", "arguments", "message"),
    [
        ({"sigma": 0}, {}, "sigma: got 0"),
        ({"n_components": -1}, {}, "n_components: got -1"),
        ({"curves": "quaternions"}, {}, "curves: got 'quaternions', want one of angles, positions"),
        ({"up": "north"}, {}, "up: got 'north'"),
        ({}, {"count": 10**6}, "count: got 1000000"),
        ({}, {"count": 5, "ratio": 0.1}, "count and ratio"),
        ({}, {"ratio": 1.0}, "ratio: got 1.0"),
        ({}, {"fixed": [-1]}, "fixed: got -1"),
        ({}, {"fixed": [2, 2]}, "fixed: .*repeated"),
        ({}, {"count": 3, "fixed": [1, 2, 3, 4]}, "at most count=3"),
    ],
    ids=["sigma", "k", "curves", "up", "count", "both", "ratio", "fixed", "twice", "too many"],
)
def test_bad_input_is_refused(jump, options, arguments, message):
    """The message names the argument."""
    selector = Saliency(**options) if "up" not in options else Saliency(contacts=True, **options)
    with pytest.raises(WorkbenchError, match=message):
        selector.select(jump, **arguments)


def test_the_registry_knows_it():
    """By name, with its parameters."""
    assert selectors.create("saliency", sigma=3).sigma == 3
