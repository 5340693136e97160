"""Lesson 5, a motion as a curve in a plane: its exercises and their solutions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.teaching.answers import Number, Samples
from workbench.teaching.exercises import Exercise, FunctionExercise, Mistake, Question
from workbench.teaching.motions import return_curve

FloatArray = NDArray[np.float64]


def rotation_angle(a: FloatArray, b: FloatArray) -> float:
    """Give the angle, in radians, of the rotation that leads from one matrix to another."""
    cosine = (np.trace(a.T @ b) - 1) / 2
    return float(np.arccos(np.clip(cosine, -1, 1)))


def _without_the_one(a: FloatArray, b: FloatArray) -> float:
    return float(np.arccos(np.clip(np.trace(a.T @ b) / 2, -1, 1)))


def _not_relative(a: FloatArray, b: FloatArray) -> float:
    return float(np.arccos(np.clip((np.trace(a @ b) - 1) / 2, -1, 1)))


def _angle_cases(rotations: FloatArray) -> Sequence[tuple[Any, ...]]:
    """Pair rotations of some joints in frames that are far apart."""
    last = len(rotations) - 1
    pairs = [(0, last // 2), (last // 3, last), (0, last // 4)]
    joints = [0, 2, 3, rotations.shape[1] // 2]
    return [(rotations[i, joint], rotations[j, joint]) for i, j in pairs for joint in joints]


def pose_distance(angles: FloatArray, weights: FloatArray) -> float:
    """Give D_q: the sum of the joints' angles, each times its weight."""
    return float((weights * angles).sum())


def fastest_frame(distances: FloatArray) -> int:
    """Find the frame from which the next one is farthest away."""
    return int(np.diagonal(distances, 1).argmax())


def _farthest_from_start(distances: FloatArray) -> int:
    return int(distances[0].argmax())


def distance_at_lag(distances: FloatArray, lag: int) -> float:
    """Give the mean distance of all frames i and i + lag."""
    return return_curve(distances, [lag])[lag]


def _around_the_end(distances: FloatArray, lag: int) -> float:
    frames = np.arange(len(distances))
    return float(distances[frames, (frames + lag) % len(distances)].mean())


def _lag_cases(distances: FloatArray) -> Sequence[tuple[Any, ...]]:
    few = slice(0, max(12, len(distances) // 3))
    return [(distances, 1), (distances, len(distances) // 3), (distances[few, few], 5)]


def error_per_frame_per_joint(distances: FloatArray, n_joints: int) -> float:
    """Give the mean distance between frames and their reconstructions, per joint."""
    return float(distances.mean() / n_joints)


def keyframes_needed(errors: Mapping[int, float], target: float) -> int:
    """Find the smallest number of keyframes whose error is the target or below."""
    return min(count for count, error in errors.items() if error <= target)


def _nearest_error(errors: Mapping[int, float], target: float) -> int:
    return min(errors, key=lambda count: abs(errors[count] - target))


def _last_above(errors: Mapping[int, float], target: float) -> int:
    return max((count for count, error in errors.items() if error > target), default=0)


def share_of_numbers(n_frames: int, n_keyframes: int, n_joints: int) -> float:
    """Give the share of a motion's numbers that keyframes and places in the plane need."""
    return (3 * n_joints * n_keyframes + 2 * n_frames) / (3 * n_joints * n_frames)


EXERCISES: Sequence[Question] = (
    FunctionExercise(
        key="rotation-angle",
        task="Replace the `...` in `rotation_angle` so that it returns the angle in radians.",
        solution=rotation_angle,
        praise="Yes. Any rotation turns about one axis by one angle, and the trace tells it.",
        hint="`a.T @ b` leads from a to b. Its trace is 1 + 2 cos θ: solve for θ with `np.arccos`.",
        # The arc cosine loses half the digits where angles are small.
        kind=Number(tolerance=1e-6, near_zero=1e-6),
        cases=_angle_cases,
        mistakes=(
            Mistake(
                lambda a, b: np.degrees(rotation_angle(a, b)),
                "These are degrees. Leave the angle in radians.",
            ),
            Mistake(
                lambda a, b: np.linalg.norm(a - b),
                "This is the length of the difference of the matrices. It grows with the angle, "
                "but it is not the angle.",
            ),
            Mistake(_not_relative, "Transpose a: it undoes the first rotation before the second."),
            Mistake(_without_the_one, "Nearly: take 1 from the trace before you halve it."),
            Mistake(
                lambda a, b: np.cos(rotation_angle(a, b)),
                "This is the cosine of the angle. Which angle has it?",
            ),
        ),
    ),
    Exercise(
        key="pose-distance",
        task="Add up the angles of all joints, each times its weight.",
        solution=pose_distance,
        praise="Yes. This is D_q, the distance that all maps of motions start from.",
        hint="`angles` and `weights` have one value for each joint. Multiply them, then sum.",
        kind=Number(),
        mistakes=(
            Mistake(lambda angles, **_: angles.sum(), "The weights are missing."),
            Mistake(
                lambda angles, weights: (weights * angles).mean(),
                "This is the mean over joints. D_q is the sum.",
            ),
            Mistake(
                lambda angles, weights: (weights * angles).sum() / weights.sum(),
                "This is the weighted mean. D_q is the sum, without division by the weights.",
            ),
            Mistake(
                lambda angles, weights: np.sqrt((weights * angles**2).sum()),
                "D_q adds up angles, not their squares.",
            ),
            Mistake(
                lambda angles, weights: np.degrees((weights * angles).sum()),
                "Leave the angles in radians.",
            ),
        ),
    ),
    Exercise(
        key="fastest-frame",
        task="Find the frame i for which the distance of the frames i and i + 1 is largest.",
        solution=fastest_frame,
        praise="Yes. Between these two frames the body moves fastest.",
        hint="`np.diagonal(distances, 1)` has the distance of each frame to the next one.",
        kind=Samples(),
        mistakes=(
            Mistake(
                lambda distances: fastest_frame(distances) + 1,
                "This is the frame after the step. Give the one before it.",
            ),
            Mistake(
                _farthest_from_start,
                "This is the frame that differs most from the first one. Compare each frame "
                "with the next.",
            ),
            Mistake(
                lambda distances: int(np.diagonal(distances, 1).argmin()),
                "Here the body moves slowest. Look for the largest distance.",
            ),
        ),
    ),
    FunctionExercise(
        key="distance-at-lag",
        task="Replace the `...` so that it returns the mean distance of all frames i and i + lag.",
        solution=distance_at_lag,
        praise="Yes. Where this mean has a valley, the motion comes back to where it was.",
        hint="Frame 0 is compared with frame lag, frame 1 with lag + 1, and so on, as long as "
        "both are there. `np.diagonal` takes an offset.",
        kind=Number(),
        cases=_lag_cases,
        mistakes=(
            Mistake(
                _around_the_end,
                "You compare the last frames with the first ones. The clip need not be a cycle: "
                "leave these pairs out.",
            ),
            Mistake(
                lambda distances, lag: np.diagonal(distances, lag).sum(),
                "This is a sum. Take the mean, or few pairs seem to be alike.",
            ),
            Mistake(
                lambda distances, lag: distances[0, lag],
                "This compares frame 0 only. Take all frames that have one that much later.",
            ),
            Mistake(
                lambda distances, lag: np.diagonal(distances, lag).min(),
                "This is the smallest distance of any pair. Take the mean.",
            ),
        ),
    ),
    Exercise(
        key="error-per-frame-per-joint",
        task="Divide the mean of `rebuilt_distances` by the number of joints.",
        solution=error_per_frame_per_joint,
        praise="Yes. Keyframes count, with an error of 0. All errors of motions are given so.",
        hint="The mean over all frames, keyframes too; then divide by `n_joints`.",
        kind=Number(),
        mistakes=(
            Mistake(
                lambda distances, **_: distances.mean(),
                "This is the error per frame. Divide by the number of joints.",
            ),
            Mistake(
                lambda distances, n_joints: distances[distances > 0].mean() / n_joints,
                "You left the keyframes out. They count, with an error of 0.",
            ),
            Mistake(
                lambda distances, n_joints: distances.sum() / n_joints,
                "This is a sum over frames. Take the mean.",
            ),
        ),
    ),
    Exercise(
        key="keyframes-needed",
        task="Find the smallest number of keyframes with which slerp is as good or better.",
        solution=keyframes_needed,
        praise="Yes. That is how many keyframes the plane stands for, on this clip.",
        hint="Go through `slerp_errors`, a dictionary of errors by number of keyframes, and take "
        "the smallest number whose error is not above `target`.",
        kind=Number(),
        mistakes=(
            Mistake(
                _last_above,
                "With so many, slerp's error is still above the target. Take the next number.",
            ),
            Mistake(_nearest_error, "This error is the closest one, but above the target."),
            Mistake(
                lambda errors, **_: max(errors),
                "It is good enough, but not the smallest such number.",
            ),
        ),
    ),
    Exercise(
        key="share-of-numbers",
        task="Divide the count of numbers that are kept by the count of all.",
        solution=share_of_numbers,
        praise="Yes. However few keyframes there are, two numbers for each frame remain: 2 of 93, "
        "about 2 %, for 31 joints.",
        hint="Kept are 3 numbers for each joint of each keyframe, and 2 for each frame. The whole "
        "motion has 3 for each joint of each frame.",
        kind=Number(),
        mistakes=(
            Mistake(
                lambda n_frames, n_keyframes, **_: n_keyframes / n_frames,
                "This is the share of keyframes. Each frame also keeps its place in the plane.",
            ),
            Mistake(
                lambda n_frames, n_keyframes, n_joints: (
                    (3 * n_joints * n_keyframes + 2 * (n_frames - n_keyframes))
                    / (3 * n_joints * n_frames)
                ),
                "Keyframes have a place in the plane too: it says where their pose belongs.",
            ),
            Mistake(
                lambda **sizes: 1 / share_of_numbers(**sizes),
                "This is the inverse: how many times fewer numbers are kept.",
            ),
            Mistake(
                lambda **sizes: 100 * share_of_numbers(**sizes),
                "This is a percentage. Give the share, between 0 and 1.",
            ),
            Mistake(
                lambda **sizes: 1 - share_of_numbers(**sizes),
                "This is the share that is saved. Give the share that is kept.",
            ),
        ),
    ),
)
