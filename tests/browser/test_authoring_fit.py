"""The browser refits spatial keyframes and deforms trajectories as Python does."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.browser.chromium import Visit
from workbench.authoring.trajectories import Trajectory
from workbench.backprojection.poses import SpatialKeyframes
from workbench.backprojection.rbf import RBF
from workbench.datasets import load_space
from workbench.spaces import PoseSpace
from workbench.widgets.module import es_module

pytestmark = pytest.mark.browser

KERNELS = ["linear", "thin-plate", "cubic", "gaussian", "multiquadric"]
_PARTS = """
async ([text, call, argument]) => {
  const names = ["FittedRadial", "nearestRotations", "draggedCurve", "retimed", "placedFrames",
    "placeAt", "frameCount"];
  const source = `${text}\\nexport { ${names.join()} };`;
  const address = URL.createObjectURL(new Blob([source], {type: "text/javascript"}));
  const parts = await import(address);
  return new Function("parts", "argument", call)(parts, argument);
}
"""
_EVALUATE = """
const { kernel, epsilon, places, poses } = argument;
const numbers = (name) => Float64Array.from(argument[name].flat());
const [points, values] = [numbers("points"), numbers("values")];
const f = new parts.FittedRadial({ kernel, epsilon, points, values });
return places.map((place) => {
  const values = f.at(place).slice();
  return [...(poses ? parts.nearestRotations(values) : values)];
});
"""


def in_browser(visit: Visit, call: str, argument: Any) -> Any:
    text = es_module("back_projection", "authoring_fit", "authoring_curve")
    return visit.page.evaluate(_PARTS, [text, call, argument])


def fitted(
    visit: Visit,
    points: np.ndarray,
    values: np.ndarray,
    places: np.ndarray,
    kernel: str = "linear",
    *,
    epsilon: float = 0.0,
    poses: bool = False,
) -> np.ndarray:
    argument = {
        "kernel": kernel,
        "epsilon": epsilon,
        "points": np.asarray(points).tolist(),
        "values": np.asarray(values).tolist(),
        "places": np.asarray(places).tolist(),
        "poses": poses,
    }
    return np.array(in_browser(visit, _EVALUATE, argument))


@pytest.mark.parametrize("kernel", KERNELS)
def test_refitted_numbers_are_those_of_python(visit: Visit, kernel: str) -> None:
    """At random places and at markers, all kernels agree to 1e-6, far from the origin too."""
    for n_markers in (3, 5, 30, 60):
        rng = np.random.default_rng(n_markers)
        points = 40.0 + 7.0 * rng.random((n_markers, 2))
        values = rng.normal(size=(n_markers, 5))
        places = np.concatenate([rng.uniform(38, 49, (40, 2)), points[:3]])
        expected = RBF(kernel).fit(points, values).predict(places)
        shown = fitted(visit, points, values, places, kernel)
        np.testing.assert_allclose(shown, expected, rtol=0, atol=1e-6)


@pytest.mark.parametrize("kernel", ["gaussian", "multiquadric"])
def test_a_given_width_is_in_units_of_the_plane(visit: Visit, kernel: str) -> None:
    """A width that is asked for is the one of Python."""
    rng = np.random.default_rng(0)
    points, values = 30 * rng.random((12, 2)), rng.normal(size=(12, 2))
    places = 30 * rng.random((20, 2))
    expected = RBF(kernel, epsilon=0.21).fit(points, values).predict(places)
    shown = fitted(visit, points, values, places, kernel, epsilon=0.21)
    np.testing.assert_allclose(shown, expected, rtol=0, atol=1e-6)


@pytest.mark.parametrize(
    "points",
    [
        [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [5.0, 5.0]],
        [[1.0, 2.0], [3.0, -1.0]],
        [[4.0, 4.0]],
        [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 0.0], [0.0, 1.0]],
        [[2.0, 2.0], [2.0, 2.0], [2.0, 2.0]],
    ],
    ids=["collinear", "two", "one", "coinciding", "all at one place"],
)
@pytest.mark.filterwarnings("ignore:.*coincide")
def test_degenerate_markers_give_what_python_gives(visit: Visit, points: list) -> None:
    """Markers on a line, too few or at one place: the same smooth function, no NaN."""
    values = np.random.default_rng(1).normal(size=(len(points), 3))
    places = np.random.default_rng(2).uniform(-2, 6, (20, 2))
    expected = RBF().fit(points, values).predict(places)
    np.testing.assert_allclose(fitted(visit, points, values, places), expected, rtol=0, atol=1e-6)


@pytest.mark.parametrize("kernel", KERNELS)
def test_poses_between_real_markers_are_those_of_python(visit: Visit, kernel: str) -> None:
    """Thirty poses of a jump give the same rotations to 1e-6 wherever the mouse may be."""
    space = load_space("cmu/01_01-jump")
    assert isinstance(space, PoseSpace)
    rng = np.random.default_rng(4)
    keys = np.linspace(0, len(space) - 1, 30).astype(int)
    points = rng.normal(size=(30, 2))
    places = rng.uniform(-2, 2, (30, 2))
    model = SpatialKeyframes(kernel).fit(points, space.samples[keys])
    poses = space.samples[keys].reshape(30, -1)
    shown = fitted(visit, points, poses, places, kernel, poses=True)
    expected = model.predict(places).reshape(30, -1)
    np.testing.assert_allclose(shown, expected, rtol=0, atol=1e-6)


@pytest.mark.parametrize("kernel", ["thin-plate", "cubic", "gaussian"])
def test_markers_too_close_to_tell_apart_give_what_python_gives(visit: Visit, kernel: str) -> None:
    """Where rounding leaves no Cholesky factor: least squares of smallest norm, as in Python."""
    rng = np.random.default_rng(3)
    points = rng.random((20, 2))
    points[10:] = points[:10] + 1e-10 * rng.normal(size=(10, 2))
    values = rng.normal(size=(20, 3))
    places = rng.uniform(-0.5, 1.5, (30, 2))
    expected = RBF(kernel, epsilon=3.0).fit(points, values).predict(places)
    argument = {"points": points.tolist(), "values": values.tolist(), "kernel": kernel}
    definite = in_browser(
        visit,
        """
        const numbers = (name) => Float64Array.from(argument[name].flat());
        const [points, values] = [numbers("points"), numbers("values")];
        const { kernel } = argument;
        return new parts.FittedRadial({ kernel, epsilon: 3, points, values }).factor !== null;
        """,
        argument,
    )
    assert not definite
    shown = fitted(visit, points, values, places, kernel, epsilon=3.0)
    np.testing.assert_allclose(shown, expected, rtol=0, atol=1e-6)


def test_a_dragged_trajectory_is_that_of_python(visit: Visit) -> None:
    """For any point, place and radius all points agree to 1e-9."""
    rng = np.random.default_rng(7)
    points = np.cumsum(rng.normal(size=(200, 2)), axis=0)
    path = Trajectory(points, np.arange(200.0))
    drags = [
        (int(rng.integers(200)), rng.normal(scale=20, size=2).tolist(), float(rng.uniform(0.1, 90)))
        for _ in range(12)
    ] + [(0, [3.0, 4.0], 5.0), (199, [0.0, 0.0], 1e6)]
    shown = in_browser(
        visit,
        "const points = Float64Array.from(argument[0].flat());"
        "return argument[1].map((drag) => [...parts.draggedCurve(points, ...drag)]);",
        [points.tolist(), drags],
    )
    expected = [path.dragged(*drag).points for drag in drags]
    np.testing.assert_allclose(np.reshape(shown, (-1, 200, 2)), expected, rtol=0, atol=1e-9)


def test_a_trajectory_is_where_python_has_it(visit: Visit) -> None:
    """Between, at, before and after its points; and it has as many frames."""
    rng = np.random.default_rng(8)
    path = Trajectory(rng.normal(size=(9, 2)), np.cumsum(rng.uniform(0.1, 1, 9)))
    seconds = [-1.0, *path.times, *rng.uniform(0, path.times[-1], 20), 99.0]
    answer = in_browser(
        visit,
        "const [points, times] = argument.slice(0, 2).map((a) => Float64Array.from(a.flat()));"
        "const places = argument[2].map((t) => parts.placeAt(points, times, t));"
        "return [places, parts.frameCount(times, 1 / 30)];",
        [path.points.tolist(), path.times.tolist(), seconds],
    )
    np.testing.assert_allclose(answer[0], path.at(seconds), rtol=0, atol=1e-12)
    assert answer[1] == len(path.frames(1 / 30))


def test_retiming_keeps_the_order_of_time(visit: Visit) -> None:
    """Handles get their times, what is beside them moves less, and times always grow."""
    rng = np.random.default_rng(9)
    times = np.cumsum(rng.uniform(0.001, 1, 80))
    handles = [0, 9, 30, 31, 60, 79]
    for _ in range(20):
        new = np.sort(rng.uniform(times[0], times[-1], len(handles)))
        shown = np.array(
            in_browser(
                visit,
                "return [...parts.retimed(...argument)]",
                [times.tolist(), handles, new.tolist()],
            )
        )
        np.testing.assert_allclose(shown[handles], new, rtol=0, atol=1e-12)
        assert np.all(np.diff(shown) > 0)


def test_unmoved_handles_leave_times_alone(visit: Visit) -> None:
    """Where no handle was moved nor its neighbours, times are what they were."""
    times = np.linspace(0, 5, 51)
    new = times[[0, 10, 20, 30, 40, 50]]
    new[1] = 1.6
    shown = np.array(
        in_browser(
            visit,
            "return [...parts.retimed(...argument)]",
            [times.tolist(), [0, 10, 20, 30, 40, 50], new.tolist()],
        )
    )
    np.testing.assert_allclose(shown[30:], times[30:], rtol=0, atol=1e-12)
    assert shown[10] == pytest.approx(1.6)


def test_frames_follow_markers_by_their_influence(visit: Visit) -> None:
    """Places are the matrix product."""
    rng = np.random.default_rng(10)
    influence, markers = rng.normal(size=(50, 6)), rng.normal(size=(6, 2))
    shown = in_browser(
        visit,
        "return [...parts.placedFrames(...argument.map((a) => Float64Array.from(a.flat())))]",
        [influence.tolist(), markers.tolist()],
    )
    np.testing.assert_allclose(np.reshape(shown, (-1, 2)), influence @ markers, atol=1e-12)
