"""Frames in which the feet stand on the ground."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from workbench.datasets import load_space
from workbench.errors import WorkbenchError
from workbench.mocap.foot_contacts import foot_contacts, steady_spans
from workbench.mocap.motion import Motion


@pytest.fixture(scope="module")
def walk() -> Motion:
    return load_space("cmu/01_03-walk").motion


@pytest.fixture(scope="module")
def jump() -> Motion:
    return load_space("cmu/01_01-jump").motion


def stands(motion: Motion) -> np.ndarray:
    """Whether each foot stands: (n_feet, n_frames)."""
    frames = np.arange(len(motion))
    return np.array(
        [
            np.any((foot.spans[:, :1] <= frames) & (frames <= foot.spans[:, 1:]), axis=0)
            for foot in foot_contacts(motion)
        ]
    )


def still(motion: Motion, lifted: slice) -> Motion:
    """Hold the first pose, and lift the whole body by its height for a while."""
    place = np.repeat(motion.root_translation[:1], len(motion), axis=0)
    place[lifted, 1] += 30.0
    rotations = np.broadcast_to(motion.rotations[:1], motion.rotations.shape)
    return replace(motion, rotations=rotations, root_translation=place, joint_translations={})


def test_a_lifted_body_touches_the_ground_before_and_after(jump: Motion) -> None:
    """The contacts are exactly the frames at rest on the ground."""
    # The frames beside the leaps are fast by central differences.
    for foot in foot_contacts(still(jump, slice(100, 150))):
        assert foot.spans.tolist() == [[0, 98], [151, len(jump) - 1]]


def test_someone_who_walks_changes_feet_and_never_flies(walk: Motion) -> None:
    """Each foot lifts off and lands, and at nearly all times one of them stands."""
    left, right = stands(walk)
    assert 0.2 < left.mean() < 0.9
    assert 0.2 < right.mean() < 0.9
    assert (left | right).mean() > 0.85
    assert (left & right).mean() < 0.5


def test_someone_who_jumps_flies(jump: Motion) -> None:
    """When the root is highest, no foot stands."""
    assert not stands(jump)[:, int(np.argmax(jump.root_translation[:, 1]))].any()


def test_size_and_place_do_not_matter(walk: Motion) -> None:
    """A motion that is larger and elsewhere has the same contacts."""
    skeleton = walk.skeleton
    sites = tuple(
        replace(site, offset=2.0 * np.asarray(site.offset)) for site in skeleton.end_sites
    )
    larger = replace(
        walk,
        skeleton=replace(skeleton, offsets=2.0 * skeleton.offsets, end_sites=sites),
        root_translation=2.0 * walk.root_translation + [500.0, -70.0, 20.0],
        joint_translations={j: 2.0 * t for j, t in walk.joint_translations.items()},
    )
    for own, other in zip(foot_contacts(walk), foot_contacts(larger), strict=True):
        np.testing.assert_array_equal(own.spans, other.spans)


@pytest.mark.parametrize(
    ("holds", "spans"),
    [
        ([0, 0, 0], []),
        ([1, 1, 1], [[0, 2]]),
        ([1, 0, 0, 1], []),
        ([1, 1, 0, 1, 1], [[0, 4]]),
        ([1, 1, 0, 0, 1, 1, 0], [[0, 1], [4, 5]]),
    ],
    ids=["never", "always", "too short", "joined", "apart"],
)
def test_spans_are_steady(holds: list[int], spans: list[list[int]]) -> None:
    """Short interruptions join spans, and short spans are none."""
    assert steady_spans(np.array(holds, dtype=bool), 2).tolist() == spans


def test_feet_that_are_not_there_are_named(walk: Motion) -> None:
    """The message says which joint was looked for."""
    with pytest.raises(WorkbenchError, match="'Paw'"):
        foot_contacts(walk, ["Paw"])
