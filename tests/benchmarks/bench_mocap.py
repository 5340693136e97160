"""Reading motion files, forward kinematics and distances of poses."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from tests.benchmarks.measuring import Measurement, compare
from tests.conftest import find_clip
from workbench.mocap import read_bvh
from workbench.mocap.channels import channels_from_rotations, rotations_from_channels
from workbench.mocap.distances import rotation_distance_matrix
from workbench.mocap.kinematics import forward_kinematics


def measurements() -> Iterator[Measurement]:
    """Compare on the clip 01_03 of 4511 frames with 31 joints."""
    # Imported here: it comes with the extra `bench` only.
    import pybvh

    path = find_clip("01_03")
    motion = read_bvh(path)
    theirs = pybvh.read_bvh_file(path)
    size = path.stat().st_size / 1e6

    yield compare(
        f"read 01_03.bvh ({size:.1f} MB), with rotation matrices",
        lambda: read_bvh(path),
        "pybvh.read_bvh_file, which ends with Euler angles",
        lambda: pybvh.read_bvh_file(path),
        at_least=3,
    )
    yield compare(
        f"read 01_03.bvh ({size:.1f} MB), with rotation matrices",
        lambda: read_bvh(path),
        "pybvh.read_bvh_file(…).to_rotmat(), the same result",
        lambda: pybvh.read_bvh_file(path).to_rotmat(),
        at_least=3,
    )

    degrees = channels_from_rotations(motion.skeleton, motion.rotations)
    yield compare(
        f"forward kinematics of {len(motion)} frames, from Euler angles",
        lambda: forward_kinematics(
            motion.skeleton,
            rotations_from_channels(motion.skeleton, degrees),
            motion.root_translation,
        ),
        "pybvh.spatial_coord.frames_to_node_positions",
        lambda: pybvh.spatial_coord.frames_to_node_positions(theirs),
        at_least=2,
    )

    poses, weights = motion.rotations[:1000].copy(), motion.skeleton.path_weights
    rotation_distance_matrix(poses, weights)
    row = compare(
        "D_q between all pairs of 1000 frames, 31 joints",
        lambda: rotation_distance_matrix(poses, weights),
        "numpy: one product of matrices and one arccos per joint, in place",
        lambda: _by_trace(poses, weights),
        at_least=3,
    )
    result = 8 * len(poses) ** 2 / 2**20
    fits = row.peak_mb - result < 2 * result
    yield Measurement(
        **{
            **row.__dict__,
            "met": row.met and fits,
            "note": f"the result is {result:.0f} MB of the peak; beside it less than twice that: "
            f"{'yes' if fits else 'no'}. numpy's arccos loses half the digits near 0",
        }
    )


def _by_trace(poses: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Compute D_q as printed, with as few temporaries as numpy allows."""
    entries = np.ascontiguousarray(poses.reshape(*poses.shape[:2], 9).swapaxes(0, 1))
    total = np.zeros((len(poses), len(poses)))
    angles = np.empty_like(total)
    for joint, weight in zip(entries, weights, strict=True):
        np.matmul(joint, joint.T, out=angles)
        angles -= 1.0
        angles *= 0.5
        np.clip(angles, -1.0, 1.0, out=angles)
        np.arccos(angles, out=angles)
        angles *= weight
        total += angles
    return total
