"""What every registered back-projector keeps, on random maps of random data."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sklearn.exceptions import NotFittedError

from tests.contract.strategies import examples, poses, seeds, spaces, tables
from workbench.backprojection import BackProjector, back_projector_for, back_projectors
from workbench.errors import WorkbenchError
from workbench.projection import fit_projection
from workbench.projection.fitted import Projection
from workbench.spaces import PoseSpace, Space

#: Those that pass through the samples of all control points at different places.
INTERPOLATING = {"rbf", "ilamp", "spatial-keyframes"}
#: Those that rebuild poses only.
FOR_POSES = {"spatial-keyframes"}

every_back_projector = pytest.mark.parametrize("name", back_projectors.names())
both_dimensions = pytest.mark.parametrize("dimensions", [2, 3])
pytestmark = pytest.mark.filterwarnings("ignore::UserWarning")


def ready(space: Space, name: str, projection: Projection) -> BackProjector:
    """Build a back-projector, telling it the projection if it needs one, as schemes do."""
    built = back_projector_for(space, name, random_state=0)
    if hasattr(built, "use_projection"):
        built.use_projection(projection)
    return built


def check_samples(space: Space, rebuilt: np.ndarray, n_points: int) -> None:
    """Check that there are finite samples; where they are poses, rotations."""
    assert rebuilt.shape == (n_points, *space.samples.shape[1:])
    assert np.isfinite(rebuilt).all()
    if isinstance(space, PoseSpace):
        assert np.abs(rebuilt @ np.swapaxes(rebuilt, -1, -2) - np.eye(3)).max() < 1e-9
        assert np.linalg.det(rebuilt).min() > 0


def space_for(name: str) -> st.SearchStrategy[Space]:
    return poses() if name in FOR_POSES else spaces()


@every_back_projector
@both_dimensions
@examples
@given(draw=st.data())
def test_points_become_samples(name, dimensions, draw):
    """As many samples as points, within the map and far from it, again the same."""
    space = draw.draw(space_for(name))
    projection = fit_projection(space, "pca", dimensions=dimensions)
    fitted = ready(space, name, projection).fit(projection.embedding, space.samples)
    rng = np.random.default_rng(draw.draw(seeds))
    points = rng.normal(0.5, 2.0, (7, dimensions))
    rebuilt = fitted.predict(points)
    check_samples(space, rebuilt, 7)
    check_samples(space, fitted.predict(points[:1]), 1)
    again = ready(space, name, projection).fit(projection.embedding, space.samples)
    assert np.array_equal(again.predict(points), rebuilt)


@pytest.mark.parametrize("name", sorted(INTERPOLATING))
@both_dimensions
@examples
@given(draw=st.data())
def test_control_points_give_back_their_samples(name, dimensions, draw):
    """Methods that interpolate are exact at control points, whatever these are."""
    space = draw.draw(space_for(name))
    points = np.random.default_rng(draw.draw(seeds)).random((len(space), dimensions))
    fitted = back_projector_for(space, name).fit(points, space.samples)
    missed = np.abs(fitted.predict(points) - space.samples).max()
    assert missed < 1e-8 * max(1.0, np.abs(space.samples).max())


@every_back_projector
@both_dimensions
@pytest.mark.parametrize("shape", ["collinear", "in pairs", "in one place"])
@examples
@given(draw=st.data())
def test_degenerate_control_points_are_no_obstacle(name, dimensions, shape, draw):
    """Control points on a line, in pairs or in one place have finite samples all the same."""
    space = draw.draw(space_for(name))
    n = len(space)
    points = np.zeros((n, dimensions))
    if shape == "collinear":
        points[:] = np.linspace(0, 1, n)[:, None]
    elif shape == "in pairs":
        points[:] = np.random.default_rng(0).random((n, dimensions))
        points[1::2] = points[: n - 1 : 2]
    projection = fit_projection(space, "pca", dimensions=dimensions)
    fitted = ready(space, name, projection).fit(points, space.samples)
    check_samples(space, fitted.predict(points + 0.25), n)
    if name in INTERPOLATING and shape == "collinear":
        assert np.allclose(fitted.predict(points), space.samples, atol=1e-7 * scale(space))


@every_back_projector
@examples
@given(draw=st.data())
def test_equal_samples_are_rebuilt_everywhere(name, draw):
    """Where all control points have one sample, every point has it."""
    space = draw.draw(space_for(name))
    projection = fit_projection(space, "pca", dimensions=2)
    if name == "inverse":
        return  # it inverts the projection of all samples, whatever the control points are
    same = np.repeat(space.samples[:1], len(space), axis=0)
    fitted = ready(space, name, projection).fit(projection.embedding, same)
    points = np.random.default_rng(0).random((5, 2)) * 3 - 1
    assert np.allclose(fitted.predict(points), same[:1], atol=1e-9 * scale(space))


@every_back_projector
@examples
@given(draw=st.data())
def test_derivatives_agree_with_differences(name, draw):
    """Where there is a Jacobian, it is what the rebuilt samples change by."""
    space = draw.draw(space_for(name))
    projection = fit_projection(space, "pca", dimensions=2)
    fitted = ready(space, name, projection).fit(projection.embedding, space.samples)
    if not hasattr(fitted, "predict_with_jacobian"):
        assert not hasattr(fitted, "jacobian")
        return
    points = np.random.default_rng(draw.draw(seeds)).random((6, 2)) + 1.5
    values, jacobian = fitted.predict_with_jacobian(points)
    assert jacobian.shape == (*values.shape, 2)
    assert np.allclose(values, fitted.predict(points), atol=1e-9 * scale(space))
    assert np.isfinite(jacobian).all()
    if not isinstance(space, PoseSpace):  # of poses, nearest rotations may jump
        step = 1e-6
        for d in range(2):
            shift = step * np.eye(2)[d]
            slope = (fitted.predict(points + shift) - fitted.predict(points - shift)) / (2 * step)
            size = max(np.abs(slope).max(), scale(space))
            assert np.abs(jacobian[..., d] - slope).max() < 1e-4 * size


@every_back_projector
@examples
@given(space=tables())
def test_samples_stay_as_they_are(name, space):
    """Neither fitting nor predicting changes what was given."""
    if name in FOR_POSES:
        with pytest.raises(WorkbenchError, match="rebuilds poses"):
            back_projector_for(space, name)
        return
    projection = fit_projection(space, "pca")
    points, samples = projection.embedding.copy(), space.samples.copy()
    ready(space, name, projection).fit(projection.embedding, space.samples).predict(points)
    assert np.array_equal(points, projection.embedding)
    assert np.array_equal(samples, space.samples)


@every_back_projector
def test_nothing_is_predicted_before_fit(name, waving):
    """As of every scikit-learn estimator, the error is a NotFittedError, and a ValueError."""
    space = PoseSpace(waving)
    with pytest.raises((NotFittedError, WorkbenchError), match="fit"):
        ready(space, name, fit_projection(space, "pca")).predict(np.zeros((1, 2)))
    assert issubclass(NotFittedError, ValueError)


def scale(space: Space) -> float:
    return float(max(1.0, np.abs(space.samples).max()))
