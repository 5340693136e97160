"""Originals against their conversion: AMC frame f is BVH frame f + 1."""

from __future__ import annotations

import numpy as np
import pytest

from workbench.mocap import (
    end_site_positions,
    joint_positions,
    read_amc,
    read_asf,
    read_bvh,
    read_motion,
    write_bvh,
)
from workbench.mocap.rotations import geodesic_angles

# The names of the BVH conversion, whose joints hang together like the bones of the ASF files.
_BVH_NAMES = {
    "root": "Hips", "lhipjoint": "LHipJoint", "lfemur": "LeftUpLeg", "ltibia": "LeftLeg",
    "lfoot": "LeftFoot", "ltoes": "LeftToeBase", "rhipjoint": "RHipJoint", "rfemur": "RightUpLeg",
    "rtibia": "RightLeg", "rfoot": "RightFoot", "rtoes": "RightToeBase", "lowerback": "LowerBack",
    "upperback": "Spine", "thorax": "Spine1", "lowerneck": "Neck", "upperneck": "Neck1",
    "head": "Head", "lclavicle": "LeftShoulder", "lhumerus": "LeftArm", "lradius": "LeftForeArm",
    "lwrist": "LeftHand", "lhand": "LeftFingerBase", "lfingers": "LeftHandIndex1",
    "lthumb": "LThumb", "rclavicle": "RightShoulder", "rhumerus": "RightArm",
    "rradius": "RightForeArm", "rwrist": "RightHand", "rhand": "RightFingerBase",
    "rfingers": "RightHandIndex1", "rthumb": "RThumb",
}  # fmt: skip
_OTHER_RELEASE = {"LFingers": "LeftHandIndex1", "RFingers": "RightHandIndex1"}
# The conversion gives the bones that branch no length, so all that hangs on them is displaced.
_SHORTENED = ("thorax", "lwrist", "rwrist")
# Half of the last of the four decimals of a BVH file, over a chain of up to seven joints.
_DEGREES, _UNITS = 2e-4, 2e-4


@pytest.mark.parametrize("clip", ["01_01", "05_09", "05_10", "05_13", "07_05", "09_06"])
def test_original_and_conversion_agree(real_mocap, clip):
    """Frame f of an AMC file is frame f + 1 of its BVH conversion, joint by joint."""
    original = read_motion(real_mocap / "asf_amc" / f"{clip}.amc")
    converted = read_bvh(real_mocap / "bvh" / f"{clip}.bvh")[1:]
    bones = original.skeleton
    names = [_OTHER_RELEASE.get(name, name) for name in converted.skeleton.names]
    order = [names.index(_BVH_NAMES[name]) for name in bones.names]
    assert len(original) == len(converted)
    assert sorted(order) == list(range(31))
    parents = np.array([-1 if p < 0 else order.index(p) for p in converted.skeleton.parents[order]])
    np.testing.assert_array_equal(parents, bones.parents)

    rotations = converted.rotations[:, order]
    assert np.degrees(geodesic_angles(original.rotations, rotations).max()) < _DEGREES
    positions = joint_positions(converted)[:, order]
    offsets = converted.skeleton.offsets[order]
    displaced = np.array([p >= 0 and bones.names[p] in _SHORTENED for p in bones.parents])
    np.testing.assert_allclose(offsets[~displaced], bones.offsets[~displaced], atol=1e-5)
    np.testing.assert_array_equal(offsets[displaced], np.zeros((7, 3)))

    below = displaced.copy()
    for joint, parent in enumerate(bones.parents):
        below[joint] |= parent >= 0 and below[parent]
    world = joint_positions(original)
    np.testing.assert_allclose(world[:, ~below], positions[:, ~below], atol=_UNITS)
    # With the same bones the positions of all joints agree.
    bones.offsets[displaced] = 0.0
    np.testing.assert_allclose(joint_positions(original), positions, atol=_UNITS)
    np.testing.assert_allclose(
        end_site_positions(original), end_site_positions(converted), atol=_UNITS
    )


def test_branching_bones_keep_their_length(real_mocap):
    """Heads and arms sit a thorax above the spine, as the original skeleton has it."""
    bones = read_asf(real_mocap / "asf_amc" / "05.asf").skeleton
    lengths = np.linalg.norm(bones.offsets, axis=1)
    assert lengths[bones.names.index("lowerneck")] == pytest.approx(2.11046, abs=1e-3)
    assert bones.unit_cm == pytest.approx(5.6444, abs=1e-4)


@pytest.mark.parametrize(("clip", "n_frames"), [("13_29", 4592), ("13_31", 3017), ("14_14", 4653)])
def test_motions_without_skeleton(real_mocap, clip, n_frames):
    """The angles of an AMC file can be used when its skeleton is missing."""
    angles = read_amc(real_mocap / "asf_amc" / f"{clip}.amc")
    assert angles.values.shape == (n_frames, 62)
    assert angles.degrees.shape == (n_frames, 59)
    assert (angles.columns[0], angles.columns[5], angles.columns[6]) == (
        "root.tx",
        "root.rz",
        "lowerback.1",
    )
    assert angles.frame_numbers[[0, -1]].tolist() == [1, n_frames]


def test_converted_pair_can_be_written_as_bvh(real_mocap, tmp_path):
    """A motion from ASF/AMC goes to BVH and back with the same positions."""
    motion = read_motion(real_mocap / "asf_amc" / "09_06.amc")
    write_bvh(motion, tmp_path / "clip.bvh")
    np.testing.assert_allclose(
        joint_positions(read_bvh(tmp_path / "clip.bvh")), joint_positions(motion), atol=1e-7
    )
