"""Tests of workbench.spaces.clips."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from workbench.schemes import SpatialScheme
from workbench.spaces import ClipSpace, PoseSpace


@pytest.fixture
def clips(waving):
    return [waving[:20], replace(waving[25:50], name="rest")]


def test_distances_are_those_of_the_frames_whatever_their_clip(waving, clips):
    """Frames 0 to 19 and 25 to 49 are as far apart as in the clip that they were cut from."""
    chosen = np.r_[0:20, 25:50]
    whole = PoseSpace(waving).distances[np.ix_(chosen, chosen)]
    np.testing.assert_allclose(ClipSpace(clips).distances, whole, atol=1e-12)


def test_frames_are_classed_by_clip_and_are_neighbours_within_it_only(clips):
    """The last frame of a clip does not lead to the first one of the next."""
    space = ClipSpace(clips)
    assert space.labels.tolist() == ["waving"] * 20 + ["rest"] * 25
    ends = space.neighbors[[0, 19, 20, 44]].tolist()
    assert ends == [[1, 1], [18, 18], [21, 21], [43, 43]]
    assert np.array_equal(space.neighbors[7], [6, 8])


def test_a_subset_keeps_the_clips(clips):
    """A single frame of a clip is left with itself as neighbour."""
    part = ClipSpace(clips).subset([3, 5, 30])
    assert part.labels.tolist() == ["waving", "waving", "rest"]
    assert part.neighbors.tolist() == [[1, 1], [0, 0], [2, 2]]


def test_one_clip_is_the_motion_itself(waving):
    """With a single clip all results are those of a pose space."""
    scheme = SpatialScheme("pca", optimizer="alg12")
    one, plain = (
        s.run(s_, ratio=0.1)
        for s, s_ in ((scheme, ClipSpace([waving])), (scheme, PoseSpace(waving)))
    )
    np.testing.assert_array_equal(one.embedding, plain.embedding)


def test_several_clips_run_through_a_scheme(clips):
    """Two steps and the optimizer work on clips, and lower the error."""
    space = ClipSpace(clips)
    raw = SpatialScheme("pca", two_step="rbfp").run(space, ratio=0.2, random_state=0)
    better = SpatialScheme("pca", two_step="rbfp", optimizer="alg12").run(
        space, ratio=0.2, random_state=0
    )
    assert better.error < raw.error
