"""Exercises of lesson 5: right answers found in another way, and the mistakes that are made."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from workbench import TemporalScheme, load_space
from workbench.mocap.rotations import geodesic_angles
from workbench.spaces import PoseSpace
from workbench.teaching import Lesson
from workbench.teaching.motions import facing_one_way, return_curve


@pytest.fixture(scope="module")
def jump() -> PoseSpace:
    space = load_space("cmu/01_01-jump")
    assert isinstance(space, PoseSpace)
    return space


def check(key: str, answer: Any, **given: Any) -> Any:
    return Lesson(5).check(key, answer, **given).verdict


def test_the_angle_is_that_of_the_package(jump: PoseSpace) -> None:
    """Exercise 1 accepts the angle computed without the trace."""

    def by_chord(a: Any, b: Any) -> Any:
        return float(geodesic_angles(a, b))

    assert check("rotation-angle", by_chord, rotations=jump.samples).state == "solved"


@pytest.mark.parametrize(
    ("mistake", "hint"),
    [
        (lambda a, b: np.degrees(geodesic_angles(a, b)), "radians"),
        (lambda a, b: np.sqrt(((a - b) ** 2).sum()), "not the angle"),
        (lambda a, b: np.arccos(np.clip((np.trace(a @ b) - 1) / 2, -1, 1)), "Transpose"),
        (lambda a, b: np.cos(geodesic_angles(a, b)), "cosine"),
        (lambda a, b: a.T @ b, "9 values"),
        (lambda a: 0.0, "2 arguments"),
    ],
    ids=["degrees", "chord", "not-relative", "cosine", "a-matrix", "one-argument"],
)
def test_wrong_angles_get_a_hint(jump: PoseSpace, mistake: Any, hint: str) -> None:
    """A typical wrong angle is named."""
    verdict = check("rotation-angle", mistake, rotations=jump.samples)
    assert verdict.state in ("wrong", "unreadable")
    assert hint in verdict.text


def test_the_pose_distance_is_that_of_the_space(jump: PoseSpace) -> None:
    """Exercise 2 is the space's D_q; without weights, or as a mean, it is another number."""
    middle = len(jump) // 2
    angles = geodesic_angles(jump.samples[0], jump.samples[middle])
    given = {"angles": angles, "weights": jump.weights}
    assert check("pose-distance", jump.distances[0, middle], **given).state == "solved"
    assert "weights are missing" in check("pose-distance", angles.sum(), **given).text
    assert "mean" in check("pose-distance", jump.distances[0, middle] / 31, **given).text


def test_the_fastest_frame_starts_the_largest_step(jump: PoseSpace) -> None:
    """Exercise 3 wants the first of the two frames, and successive ones."""
    steps = jump.pair_distances(np.arange(len(jump) - 1), np.arange(1, len(jump)))
    frame = int(np.argmax(steps))
    given = {"distances": jump.distances}
    assert check("fastest-frame", frame, **given).state == "solved"
    assert "one before" in check("fastest-frame", frame + 1, **given).text
    assert "first one" in check("fastest-frame", jump.distances[0].argmax(), **given).text


def test_a_cycle_returns_after_its_period() -> None:
    """Exercise 4 on points of a circle: distance 0 at the period; no pair goes around the end."""
    circle = np.exp(2j * np.pi * np.arange(45) / 10)
    curve = return_curve(np.abs(circle[:, None] - circle), range(1, 20))
    assert curve[10] == pytest.approx(0, abs=1e-12)
    assert curve[5] == pytest.approx(2)
    spiral = circle * np.linspace(1, 2, 45)
    distances = np.abs(spiral[:, None] - spiral)

    def by_loop(matrix: Any, lag: int) -> Any:
        return np.mean([matrix[i, i + lag] for i in range(len(matrix) - lag)])

    def around(matrix: Any, lag: int) -> Any:
        frames = np.arange(len(matrix))
        return matrix[frames, (frames + lag) % len(matrix)].mean()

    assert check("distance-at-lag", by_loop, distances=distances).state == "solved"
    assert "last frames" in check("distance-at-lag", around, distances=distances).text
    one = check("distance-at-lag", lambda matrix, lag: matrix[0, lag], distances=distances)
    assert one.state == "wrong"


def test_a_walk_returns_but_for_its_heading() -> None:
    """What section 3 of the lesson says: the valley is deep only without the root's turn."""
    walk = load_space("cmu/01_03-walk")
    assert isinstance(walk, PoseSpace)
    lags = range(60, 231)
    turning = return_curve(walk.distances, lags)
    ahead = return_curve(facing_one_way(walk).distances, lags)
    stride = min(ahead, key=lambda lag: ahead[lag])
    assert 150 < stride < 170
    assert ahead[stride] < 0.5 * ahead[stride // 2]
    assert turning[stride] > 0.6 * turning[stride // 2]


def test_the_error_is_that_of_the_scheme(jump: PoseSpace) -> None:
    """Exercise 5 is what results call their error."""
    result = TemporalScheme("slerp").run(jump, count=9)
    every = np.arange(len(jump))
    given = {"distances": jump.errors(every, result.reconstruction) * 31, "n_joints": 31}
    key = "error-per-frame-per-joint"
    assert check(key, result.error, **given).state == "solved"
    assert "per frame" in check(key, result.error * 31, **given).text
    assert "keyframes out" in check(key, result.errors[result.errors > 0].mean(), **given).text


@pytest.mark.parametrize(
    ("answer", "hint"),
    [(6, "still above"), (24, "smallest"), (3, "Go through")],
    ids=["last-above", "the-most", "the-fewest"],
)
def test_fewest_keyframes_that_are_good_enough(answer: int, hint: str) -> None:
    """Exercise 6 wants the first number at or below the target."""
    given = {"errors": {3: 1.0, 6: 0.5, 9: 0.2, 24: 0.1}, "target": 0.3}
    assert check("keyframes-needed", 9, **given).state == "solved"
    assert hint in check("keyframes-needed", answer, **given).text


def test_the_share_counts_keyframes_and_places() -> None:
    """Exercise 7: 3 · 31 · 10 numbers and 2 · 100 places of 3 · 31 · 100."""
    given = {"n_frames": 100, "n_keyframes": 10, "n_joints": 31}
    share = (930 + 200) / 9300
    assert check("share-of-numbers", share, **given).state == "solved"
    assert "share of keyframes" in check("share-of-numbers", 0.1, **given).text
    assert "saved" in check("share-of-numbers", 1 - share, **given).text
    assert "percentage" in check("share-of-numbers", 100 * share, **given).text
