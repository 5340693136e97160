"""The browser's back-projection and kinematics give the numbers of Python's."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.browser.chromium import Visit
from workbench.backprojection.poses import PoseBackProjector, SpatialKeyframes
from workbench.backprojection.rbf import RBF
from workbench.datasets import load_space
from workbench.mocap.kinematics import end_site_positions, forward_kinematics
from workbench.mocap.nearest_rotation import nearest_rotations
from workbench.spaces import PoseSpace
from workbench.widgets.module import es_module
from workbench.widgets.radial import radial_function

pytestmark = pytest.mark.browser

KERNELS = ["linear", "thin-plate", "cubic", "gaussian", "multiquadric"]
_PARTS = """
async ([text, call, argument]) => {
  const names = "RadialFunction, nearestRotations, vectorError, poseError, Kinematics";
  const source = `${text}\\nexport { ${names} };`;
  const address = URL.createObjectURL(new Blob([source], {type: "text/javascript"}));
  const parts = await import(address);
  return new Function("parts", "argument", call)(parts, argument);
}
"""
_EVALUATE = """
const { radial, places, poses } = argument;
const f = new parts.RadialFunction({
  ...radial, centers: Float64Array.from(radial.centers),
  coefficients: Float64Array.from(radial.coefficients) });
return places.map((place) => {
  const values = f.at(place).slice();
  return [...(poses ? parts.nearestRotations(values) : values)];
});
"""


def in_browser(visit: Visit, call: str, argument: Any) -> Any:
    text = es_module("back_projection", "kinematics")
    return visit.page.evaluate(_PARTS, [text, call, argument])


def evaluated(visit: Visit, back_projector: Any, places: np.ndarray, *, poses: bool) -> np.ndarray:
    radial = radial_function(back_projector)
    numbers = {
        "kernel": radial.kernel,
        "epsilon": radial.epsilon,
        "centers": radial.centers.ravel().tolist(),
        "coefficients": radial.coefficients.ravel().tolist(),
    }
    argument = {"radial": numbers, "places": places.tolist(), "poses": poses}
    return np.array(in_browser(visit, _EVALUATE, argument))


@pytest.mark.parametrize("kernel", KERNELS)
def test_vectors_are_rebuilt_as_in_python(visit: Visit, kernel: str) -> None:
    """Rebuilt rows agree to 1e-6 at random places and at a centre."""
    rng = np.random.default_rng(3)
    points, samples = rng.random((25, 2)), rng.normal(size=(25, 7))
    model = RBF(kernel).fit(points, samples)
    places = np.concatenate([rng.uniform(-1, 2, (60, 2)), points[:2]])
    shown = evaluated(visit, model, places, poses=False)
    np.testing.assert_allclose(shown, model.predict(places), rtol=0, atol=1e-6)


@pytest.mark.parametrize(
    "model", [SpatialKeyframes(), PoseBackProjector(RBF("cubic"))], ids=["skf", "rbf"]
)
def test_poses_are_rebuilt_as_in_python(visit: Visit, model: PoseBackProjector) -> None:
    """Rotations, node positions and the error of a frame agree to 1e-6 at random places."""
    space = load_space("cmu/01_01-jump")
    assert isinstance(space, PoseSpace)
    rng = np.random.default_rng(4)
    keys = np.linspace(0, len(space) - 1, 30).astype(int)
    model = model.fit(rng.random((30, 2)), space.samples[keys])
    places = rng.uniform(-0.5, 1.5, (40, 2))
    shown = evaluated(visit, model, places, poses=True)
    rotations = model.predict(places)
    np.testing.assert_allclose(shown, rotations.reshape(40, -1), rtol=0, atol=1e-6)

    skeleton = space.motion.skeleton
    ends = skeleton.end_sites
    root = np.array([1.0, 20.0, -3.0])
    argument = {
        "parents": [*skeleton.parents.tolist(), *(site.joint for site in ends)],
        "offsets": np.concatenate([skeleton.offsets, [s.offset for s in ends]]).ravel().tolist(),
        "joints": skeleton.n_joints,
        "poses": rotations.reshape(40, -1).tolist(),
        "root": root.tolist(),
        "original": space.samples[7].ravel().tolist(),
        "weights": space.weights.tolist(),
    }
    answer = in_browser(
        visit,
        """
        const body = new parts.Kinematics(argument);
        const placed = argument.poses.map((pose) => [...body.place(pose, argument.root)]);
        const { original, weights } = argument;
        return [placed, argument.poses.map((pose) => parts.poseError(original, pose, weights))];
        """,
        argument,
    )
    joints = np.array(answer[0]).reshape(40, -1, 3)[:, : skeleton.n_joints]
    expected = forward_kinematics(skeleton, rotations, root)
    np.testing.assert_allclose(joints, expected, rtol=0, atol=1e-6)
    errors = space.errors(np.full(40, 7), rotations)
    np.testing.assert_allclose(answer[1], errors, rtol=0, atol=1e-6)


def test_end_sites_hang_on_their_joints(visit: Visit) -> None:
    """A frame's own rotations give the positions of its end sites, root and all."""
    space = load_space("cmu/01_01-jump")
    assert isinstance(space, PoseSpace)
    motion, skeleton = space.motion, space.motion.skeleton
    ends = skeleton.end_sites
    argument = {
        "parents": [*skeleton.parents.tolist(), *(site.joint for site in ends)],
        "offsets": np.concatenate([skeleton.offsets, [s.offset for s in ends]]).ravel().tolist(),
        "joints": skeleton.n_joints,
        "pose": space.samples[9].ravel().tolist(),
        "root": motion.root_translation[9].tolist(),
    }
    placed = in_browser(
        visit,
        "return [...new parts.Kinematics(argument).place(argument.pose, argument.root)]",
        argument,
    )
    shown = np.reshape(placed, (-1, 3))[skeleton.n_joints :]
    np.testing.assert_allclose(shown, end_site_positions(motion)[9], rtol=0, atol=1e-6)


def test_any_matrix_gets_its_nearest_rotation(visit: Visit) -> None:
    """Well-behaved, reflecting, nearly singular matrices and 0 agree to 1e-6 with Python."""
    rng = np.random.default_rng(5)
    matrices = rng.normal(size=(300, 3, 3))
    matrices[:20] = np.eye(3) + 0.01 * rng.normal(size=(20, 3, 3))
    matrices[20:30, 2] = 1.001 * matrices[20:30, 1] + 1e-3 * rng.normal(size=(10, 3))
    matrices[30] = 0.0
    matrices[31] = np.diag([1.0, 2.0, -3.0])
    argument = matrices.ravel().tolist()
    shown = in_browser(
        visit, "return [...parts.nearestRotations(Float64Array.from(argument))]", argument
    )
    expected = nearest_rotations(matrices)
    np.testing.assert_allclose(np.reshape(shown, (-1, 3, 3)), expected, rtol=0, atol=1e-6)


def test_errors_of_vectors_are_euclidean(visit: Visit) -> None:
    """The browser's distance is the space's."""
    pair = [[1.0, 2.0, 2.0], [0.0, 0.0, 0.0]]
    assert in_browser(visit, "return parts.vectorError(...argument)", pair) == 3.0


def test_only_plain_radial_functions_go_to_the_browser() -> None:
    """A derived class, which may do more, stays in Python, and so do other methods."""
    from sklearn.neighbors import KNeighborsRegressor

    class Own(RBF):
        pass

    points, samples = np.random.default_rng(0).random((2, 5, 2))
    assert radial_function(Own().fit(points, samples)) is None
    assert radial_function(KNeighborsRegressor(1).fit(points, samples)) is None
