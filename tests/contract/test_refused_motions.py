"""What spaces, motions and rotations refuse, at a glance."""

from __future__ import annotations

import inspect
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from tests.contract.refusals import (
    INF,
    MAP,
    MOTION,
    NAN,
    POSES,
    ROTATIONS,
    SKELETON,
    TABLE,
    Case,
    Refused,
    check_refused,
    each_row,
    refused,
    spoiled,
)
from workbench.datasets import load, load_space
from workbench.mocap import (
    Motion,
    Skeleton,
    body_positions,
    channels_from_rotations,
    end_site_positions,
    forward_kinematics,
    has_tpose,
    joint_positions,
    motion_to_euler,
    read_bvh,
    read_motion,
    resample,
    root_relative_positions,
    rotations_from_channels,
    write_bvh,
)
from workbench.mocap import distances as pose_distances
from workbench.mocap.contacts import feet_by_height, find_feet, foot_heights
from workbench.mocap.curve_saliency import curve_curvature, curve_saliency, saliency_maps
from workbench.mocap.fingerprint import clip_fingerprint
from workbench.mocap.foot_contacts import foot_contacts
from workbench.mocap.joining import join
from workbench.mocap.motion_saliency import motion_saliency
from workbench.mocap.nearest_rotation import nearest_rotations
from workbench.mocap.rotations import (
    axis_rotation,
    euler_from_rotations,
    geodesic_angles,
    rotation_vectors,
    rotations_from_euler,
    rotations_from_vectors,
    unwrap_degrees,
)
from workbench.mocap.slerp import slerp
from workbench.quality import animation, reconstruction
from workbench.spaces import PoseSpace, VectorSpace

WEIGHTS = SKELETON.path_weights


def changed(**parts: Any) -> Motion:
    return replace(MOTION, **parts)


OF_SPACES: tuple[Case, ...] = (
    ("two rows", lambda _: VectorSpace(MAP[:2]), "values: got shape (2, 2)", "at least 3 rows"),
    ("flat", lambda _: VectorSpace([1, 2, 3]), "values: got shape (3,)", "at least 3 rows"),
    ("nan", lambda _: VectorSpace(spoiled(MAP)), "values: got nan at [0, 0]", "want finite"),
    ("inf", lambda _: VectorSpace(spoiled(MAP, INF)), "values: got inf at [0, 0]", "want finite"),
    ("words", lambda _: VectorSpace([["a"]] * 3), "values: got entries", "table of numbers"),
    ("ragged", lambda _: VectorSpace([[1], [2, 3], [4]]), "rows of different", "of numbers"),
    ("columns", lambda _: VectorSpace(MAP, columns=["x"]), "columns: got 1", "want 2"),
    ("labels", lambda _: VectorSpace(MAP, labels=[1]), "labels: got shape (1,)", "want (12,)"),
    ("no motion", lambda _: PoseSpace(ROTATIONS), "motion: got ndarray", "want a Motion"),
    ("two frames", lambda _: PoseSpace(MOTION[:2]), "got 2 frames", "want 3 or more"),
    ("nan pose", lambda _: PoseSpace(changed(rotations=spoiled(ROTATIONS))), "got nan", "finite"),
    ("scaled", lambda _: PoseSpace(changed(rotations=2 * ROTATIONS)), "3 from", "want rotations"),
    ("mirrored", lambda _: PoseSpace(changed(rotations=-ROTATIONS)), "mirrored", "want rotations"),
    ("unknown table", lambda _: load_space("uci/beans"), "uci/beans", ""),
    ("unknown clip", lambda _: load("cmu/99_99"), "cmu/99_99", ""),
)

OF_ITS_SAMPLES: tuple[Case, ...] = (
    ("subset of two", lambda s: s.subset([0, 1]), "indices: got", "at least 3"),
    ("subset unsorted", lambda s: s.subset([2, 1, 0]), "indices: got unsorted", "each once"),
    ("subset beyond", lambda s: s.subset([0, 1, 12]), "indices: got 0…12", "from 0 to 11"),
    ("too few rebuilt", lambda s: s.errors([0, 1], s.samples[:1]), "got shape (1, ", "want (2, "),
    ("nan rebuilt", lambda s: s.errors([0], spoiled(s.samples[:1])), "got nan", "want finite"),
)


def of_spaces() -> Iterator[Refused]:
    yield from refused("spaces", None, OF_SPACES)
    yield from refused("VectorSpace", TABLE, OF_ITS_SAMPLES)
    yield from refused("PoseSpace", POSES, OF_ITS_SAMPLES)


@each_row(of_spaces())
def test_spaces_refuse(row):
    """The message names the argument, what it got and what it wants."""
    check_refused(row)


ROOT = np.zeros((12, 3))
BONES = ("a", "b")

#: A motion of a single joint, whose feet nobody can tell.
ONE_BONE = Motion(
    Skeleton(("a",), [-1], np.zeros((1, 3)), (), (("Xrotation",),)), ROTATIONS[:, :1], ROOT, 0.1
)

OF_MOTIONS: tuple[Case, ...] = (
    (
        "joints",
        lambda _: changed(rotations=ROTATIONS[:, :2]),
        "rotations: got shape (12, 2",
        "3, 3)",
    ),
    ("no frames", lambda _: changed(rotations=ROTATIONS[:0]), "got shape (0,", "at least one"),
    ("root", lambda _: changed(root_translation=MAP), "root_translation: got shape", "(12, 3)"),
    ("time 0", lambda _: changed(frame_time=0.0), "frame_time: got 0.0", "above 0"),
    ("time nan", lambda _: changed(frame_time=NAN), "frame_time: got nan", "above 0"),
    ("moved", lambda _: changed(joint_translations={9: ROOT}), "for joint 9", "from 1 to 2"),
    ("no clips", lambda _: join([]), "motions: got none", "at least one"),
    ("clips", lambda _: join([MOTION, POSES]), "motion: got PoseSpace", "want a Motion"),
    ("rates", lambda _: join([MOTION, MOTION[::2]]), "per second and", "one frame rate"),
    ("one frame", lambda _: MOTION[3], "frames: got 3", "want a slice"),
    ("backwards", lambda _: MOTION[5:2], "frames: got slice(5, 2", "at least one"),
    ("no joints", lambda _: Skeleton((), [], [], (), ()), "names: got none", "at least one"),
    (
        "child first",
        lambda _: Skeleton(BONES, [1, -1], np.zeros((2, 3)), (), ((), ())),
        "parents: got [1, -1]",
        "-1 for joint 0",
    ),
    (
        "channels",
        lambda _: Skeleton(BONES, [-1, 0], np.zeros((2, 3)), (), (("W",), ())),
        "channels of joint 'a': got ('W',)",
        "Xposition",
    ),
    (
        "offsets",
        lambda _: Skeleton(BONES, [-1, 0], np.zeros((3, 3)), (), ((), ())),
        "offsets of shape (3, 3)",
        "(2, 3)",
    ),
    ("no file", lambda _: read_bvh("nowhere.bvh"), "nowhere.bvh", ""),
    ("no motion file", lambda _: read_motion("nowhere.c3d"), "nowhere.c3d", ""),
    ("write", lambda _: write_bvh(MOTION, "no/such/folder/x.bvh"), "x.bvh", "folder"),
    (
        "write nan",
        lambda _: write_bvh(changed(root_translation=ROOT * NAN), "x.bvh"),
        "root): is moved by nan",
        "has no channel Xposition",
    ),
    ("slow", lambda _: resample(MOTION, 0.0), "frame_time: got 0.0", "above 0"),
    ("angles", lambda _: rotations_from_channels(SKELETON, MAP), "got shape (12, 2)", "9"),
    ("poses", lambda _: channels_from_rotations(SKELETON, MAP), "got shape (12, 2)", "3, 3, 3)"),
    ("bent", lambda _: motion_to_euler(changed(rotations=2 * ROTATIONS)), "rotations: joint 0", ""),
    ("kinematics", lambda _: forward_kinematics(SKELETON, MAP), "rotations: got shape", "3, 3, 3)"),
    (
        "kinematics at",
        lambda _: forward_kinematics(SKELETON, ROTATIONS, MAP),
        "root_translation: got shape (12, 2)",
        "(12, 3)",
    ),
    (
        "feet up",
        lambda _: foot_heights(MOTION, ["upper"], up="w"),
        "up: got 'w'",
        "'x', 'y' or 'z'",
    ),
    ("no limbs", lambda _: feet_by_height(ONE_BONE), "feet of", "want the names of the feet"),
    ("feet", lambda _: find_feet(MOTION, ["hoof"]), "feet: got 'hoof'", "names of joints"),
    ("standing", lambda _: foot_contacts(MOTION, ["hoof"]), "feet: got 'hoof'", "names of joints"),
)

OF_MOTION_FUNCTIONS: tuple[Case, ...] = (
    ("an array", lambda call: call(ROTATIONS), "motion: got ndarray", "want a Motion"),
)

TAKE_A_MOTION = (
    joint_positions,
    end_site_positions,
    root_relative_positions,
    body_positions,
    motion_to_euler,
    has_tpose,
    lambda motion: resample(motion, 0.1),
    lambda motion: write_bvh(motion, "x.bvh"),
    lambda motion: find_feet(motion),
    clip_fingerprint,
    lambda motion: foot_contacts(motion),
    lambda motion: animation.psnr(motion, ROTATIONS),
    lambda motion: animation.body_coordinate_error(motion, ROTATIONS, femur=1.0),
    lambda motion: reconstruction.position_error(motion, ROTATIONS),
    lambda motion: reconstruction.position_distances(motion, ROTATIONS),
)

FRAMES = np.arange(12.0)[:, None]

OF_CURVES: tuple[Case, ...] = (
    ("two frames", lambda call: call(FRAMES[:2], 2.0), "got", "3"),
    ("flat", lambda call: call(FRAMES[:, 0], 2.0), "got shape (12,)", "want"),
    ("nan", lambda call: call(spoiled(FRAMES), 2.0), "got nan", "want finite"),
    ("words", lambda call: call([["a"]] * 5, 2.0), "got", "numbers"),
    ("sigma", lambda call: call(FRAMES, 0.5), "sigma: got 0.5", "1"),
    ("sigma of words", lambda call: call(FRAMES, "x"), "sigma: got 'x'", "1"),
)

EYE = np.eye(3)

OF_ROTATIONS: tuple[Case, ...] = (
    ("axis", lambda _: axis_rotation("W", 1.0), "axis: got 'W'", "'X', 'Y' or 'Z'"),
    ("degrees", lambda _: axis_rotation("X", "a"), "degrees: got", "numbers"),
    ("order", lambda _: rotations_from_euler("ZW", [1, 2]), "order: got 'ZW'", "axes"),
    ("angles", lambda _: rotations_from_euler("ZX", [1, 2, 3]), "got shape (3,)", "(..., 2)"),
    ("euler order", lambda _: euler_from_rotations("ZZX", EYE), "order: got 'ZZX'", "different"),
    ("euler shape", lambda _: euler_from_rotations("ZYX", MAP), "got shape (12, 2)", "3, 3)"),
    ("vectors of", lambda _: rotation_vectors(-EYE), "singular or mirrored", "want rotations"),
    ("nan", lambda _: rotation_vectors(spoiled(EYE)), "rotations: got nan", "want finite"),
    ("vectors", lambda _: rotations_from_vectors(MAP), "vectors: got shape (12, 2)", "(..., 3)"),
    ("unwrap", lambda _: unwrap_degrees(3.0), "angles: got a single number", "n_frames"),
    ("pairs", lambda _: geodesic_angles(ROTATIONS, ROTATIONS[:5]), "got shapes (12", "equal ones"),
    ("nearest", lambda _: nearest_rotations(MAP), "matrices: got shape (12, 2)", "(..., 3, 3)"),
    ("nearest nan", lambda _: nearest_rotations(spoiled(EYE)), "matrices: got", "finite"),
    ("slerp", lambda _: slerp(EYE, MAP, 0.5), "a, b: got shapes", "(..., 3, 3)"),
    ("slerp at", lambda _: slerp(ROTATIONS, ROTATIONS, np.ones(5)), "t: got shape (5,)", "want"),
    ("slerp words", lambda _: slerp("a", EYE, 0.5), "a: got", "numbers"),
    (
        "D_q",
        lambda _: pose_distances.rotation_distance_matrix(ROTATIONS, WEIGHTS[:2]),
        "rotations and weights: got shapes",
        "(n_joints,)",
    ),
    (
        "D_q of pairs",
        lambda _: pose_distances.rotation_distance_pairs(ROTATIONS, ROTATIONS[:2], WEIGHTS),
        "a and b: got shapes",
        "same shape",
    ),
    (
        "D_q of sets",
        lambda _: pose_distances.rotation_distance_table(MAP, ROTATIONS, WEIGHTS),
        "a and weights: got shapes (12, 2)",
        "(n_joints,)",
    ),
    (
        "D_p of pairs",
        lambda _: pose_distances.position_distance_pairs(ROOT[:, None], ROOT[:5, None], [1.0]),
        "a and b: got shapes",
        "same shape",
    ),
    (
        "D_p",
        lambda _: pose_distances.position_distance_matrix(ROTATIONS, WEIGHTS),
        "positions and weights: got shapes",
        "(n_joints,)",
    ),
)


def of_motions() -> Iterator[Refused]:
    yield from refused("motions", None, OF_MOTIONS)
    for call in TAKE_A_MOTION:
        name = call.__name__
        if name == "<lambda>":
            name = inspect.getsource(call).split(":")[1].split("(")[0].strip()
        yield from refused(name, call, OF_MOTION_FUNCTIONS)
    yield from refused("curve_saliency", curve_saliency, OF_CURVES)
    yield from refused("saliency_maps", saliency_maps, OF_CURVES)
    yield from refused("motion_saliency", motion_saliency, OF_CURVES)
    yield from refused("curve_curvature", lambda curves, _: curve_curvature(curves), OF_CURVES[:4])
    yield from refused("rotations", None, OF_ROTATIONS)


@each_row(of_motions())
def test_motions_refuse(row):
    """The message names the argument, what it got and what it wants."""
    check_refused(row)
