"""Tests of workbench.spaces."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from workbench.errors import DataError, WorkbenchError
from workbench.mocap.distances import rotation_distance_matrix
from workbench.spaces import PoseSpace, VectorSpace


def test_vector_distances_are_euclidean():
    """Matrix, pairs and errors give the lengths of a 3-4-5 triangle."""
    space = VectorSpace([[0, 0], [3, 0], [0, 4]])
    assert np.array_equal(space.distances, [[0, 3, 4], [3, 0, 5], [4, 5, 0]])
    assert np.array_equal(space.pair_distances([0, 1], [1, 2]), [3, 5])
    assert np.array_equal(space.errors([2, 2], [[0, 0], [0, 4]]), [4, 0])


def test_vector_neighbors_are_the_two_nearest_others():
    """A row's neighbours exclude itself, also when rows are equal."""
    space = VectorSpace([[0.0], [0.0], [1.0], [5.0]])
    assert {tuple(sorted(pair)) for pair in space.neighbors[[0, 1]].tolist()} == {(1, 2), (0, 2)}


def test_standardizing_gives_unit_variance_and_zero_for_constants():
    """Each column has mean 0 and variance 1; a constant one becomes 0."""
    values = np.random.default_rng(0).normal(5, 3, (50, 3))
    values[:, 1] = 0.1  # its mean differs from it by rounding
    samples = VectorSpace(values, standardize=True).samples
    assert np.allclose(samples.mean(axis=0), 0)
    assert np.allclose(samples.std(axis=0), [1, 0, 1])


def test_mean_prediction_error_of_vectors():
    """Two rows 2 apart and their middle are 1, 1 and 0 from the mean."""
    assert VectorSpace([[0.0], [2.0], [1.0]]).mean_prediction_error() == pytest.approx(2 / 3)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ([[1, 2], [3, 4]], r"got shape \(2, 2\)"),
        ([1, 2, 3], r"got shape \(3,\)"),
        (np.empty((5, 0)), r"got shape \(5, 0\)"),
        ([[1], [np.nan], [3]], r"got nan at \[1, 0\]"),
        ([[1], [2], [np.inf]], r"got inf at \[2, 0\]"),
    ],
    ids=["two rows", "one-dimensional", "no columns", "missing", "infinite"],
)
def test_unfit_tables_are_refused(values, message):
    """The message says what was got and where."""
    with pytest.raises(WorkbenchError, match=message):
        VectorSpace(values)


def test_labels_must_match_the_rows():
    """A label for each row, no fewer."""
    with pytest.raises(WorkbenchError, match="labels"):
        VectorSpace([[1], [2], [3]], labels=["a", "b"])


def test_path_weights_are_the_longest_paths_to_an_end(arm):
    """Bones of 1 + 2 + 3 on one chain and 1 on the other weigh 6, 5, 3 and 0."""
    assert np.array_equal(arm.path_weights, [6, 5, 3, 0])


def test_pose_distances_are_d_q_with_path_weights(waving):
    """The matrix is Eq. 3.2 of Costa 2018 with the skeleton's weights."""
    space = PoseSpace(waving)
    expected = rotation_distance_matrix(waving.rotations, waving.skeleton.path_weights)
    assert np.array_equal(space.distances, expected)
    assert np.allclose(space.pair_distances([3, 5], [9, 5]), [expected[3, 9], 0])


def test_pose_errors_are_per_joint(waving):
    """The error of a frame rebuilt by another is their D_q over the number of joints."""
    space = PoseSpace(waving)
    assert space.errors([3], waving.rotations[[9]])[0] == pytest.approx(space.distances[3, 9] / 4)


def test_position_distances_are_squared_lengths(waving):
    """D_p between two frames is the sum of squared distances between their joints."""
    space = PoseSpace(waving)
    expected = np.sum((space.positions[3] - space.positions[9]) ** 2)
    assert space.pair_position_distances([3], [9])[0] == pytest.approx(expected)
    assert space.position_distances[3, 9] == pytest.approx(expected)


def test_pose_neighbors_are_the_frames_beside(waving):
    """The first and the last frame have one neighbour, given twice."""
    neighbors = PoseSpace(waving).neighbors
    assert neighbors[0].tolist() == [1, 1]
    assert neighbors[7].tolist() == [6, 8]
    assert neighbors[-1].tolist() == [58, 58]


def test_the_mean_pose_is_about_as_good_as_the_best_single_frame(waving):
    """Rebuilding all by the mean pose is not 5 % worse than by the most central frame."""
    space = PoseSpace(waving)
    best = space.distances.mean(axis=1).min() / 4
    assert 0 < space.mean_prediction_error() < 1.05 * best


def test_reconstructions_must_match_the_samples(waving):
    """Too few poses or joints are refused; the kernel would read beyond them."""
    space = PoseSpace(waving)
    for wrong in (waving.rotations[:1], waving.rotations[:2, :3]):
        with pytest.raises(WorkbenchError, match="reconstructions: got shape"):
            space.errors([3, 4], wrong)


def test_skeletons_without_any_bone_are_refused(waving, arm):
    """If no bone has a length, no rotation counts and every error would be 0."""
    boneless = replace(arm, offsets=np.zeros((4, 3)), end_sites=())
    with pytest.raises(WorkbenchError, match="no bone of its skeleton has a length"):
        PoseSpace(replace(waving, skeleton=boneless))


def test_distances_that_do_not_fit_into_memory_are_refused(monkeypatch):
    """Before they start, with the size and what to do instead."""
    space = VectorSpace(np.zeros((3, 1)) + np.arange(3)[:, None], name="long")
    space.samples = np.zeros((10_000_000, 1))
    with pytest.raises(DataError, match=r"long: .* needs 1600000\.0 GB.* take a sample"):
        _ = space.distances


@pytest.mark.parametrize("values", [[["a"], ["b"], ["c"]], [[1], [1, 2], [3]]], ids=str)
def test_tables_of_other_things_are_refused(values):
    """Text and ragged rows are no numbers; the message says where such files are read."""
    with pytest.raises(WorkbenchError, match=r"no numbers.*load_space"):
        VectorSpace(values)


def test_motions_of_two_frames_are_refused(waving):
    """A space needs three frames."""
    with pytest.raises(WorkbenchError, match="got 2 frames"):
        PoseSpace(waving[:2])


@pytest.mark.parametrize("factor", [1.1, -1.0], ids=["scaled", "mirrored"])
def test_matrices_that_are_no_rotations_are_refused(waving, factor):
    """Scaled and mirrored matrices are named as such."""
    with pytest.raises(WorkbenchError, match="want rotations"):
        PoseSpace(replace(waving, rotations=waving.rotations * factor))
