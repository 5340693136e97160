"""Tests of workbench.backprojection.rbf."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.interpolate import RBFInterpolator
from sklearn.exceptions import NotFittedError
from sklearn.utils.estimator_checks import check_estimator

from workbench.backprojection.radial import KERNELS
from workbench.backprojection.rbf import RBF
from workbench.errors import AdjustmentWarning, DegenerateDataWarning, WorkbenchError

rng = np.random.default_rng(0)
POINTS = rng.random((25, 2))
VALUES = rng.normal(size=(25, 6))
SCIPY_NAMES = {"thin-plate": "thin_plate_spline"}


def scipy_rbf(points, values, kernel, *, epsilon=None, smoothing=0.0):
    """Make scipy's interpolant with a linear polynomial, whose linear kernel is −r."""
    if kernel not in ("gaussian", "multiquadric"):
        epsilon = None
    name = SCIPY_NAMES.get(kernel, kernel)
    return RBFInterpolator(
        points, values, kernel=name, degree=1, epsilon=epsilon, smoothing=smoothing
    )


def plain_kernel(kernel, epsilon, r):
    """Evaluate φ(r) as the formulas stand."""
    return {
        "linear": lambda: r,
        "thin-plate": lambda: np.where(r > 0, r**2 * np.log(np.where(r > 0, r, 1.0)), 0.0),
        "cubic": lambda: r**3,
        "gaussian": lambda: np.exp(-((epsilon * r) ** 2)),
        "multiquadric": lambda: np.sqrt(1 + (epsilon * r) ** 2),
    }[kernel]()


@pytest.mark.parametrize(
    "estimator",
    [RBF(), RBF("gaussian", centers=5, smoothing=0.1)],
    ids=["linear", "few smooth gaussians"],
)
@pytest.mark.filterwarnings("ignore")  # scikit-learn's checks use degenerate data on purpose
def test_rbf_follows_scikit_learns_conventions(estimator):
    """The estimator passes scikit-learn's own checks."""
    check_estimator(estimator)


@pytest.mark.parametrize("smoothing", [0.0, 0.3], ids=["exact", "smooth"])
@pytest.mark.parametrize("dimensions", [2, 3], ids=["2-D", "3-D"])
@pytest.mark.parametrize("kernel", KERNELS)
def test_rbf_agrees_with_scipy(kernel, dimensions, smoothing):
    """Between and outside the control points values equal those of scipy's to 1e-8."""
    points = rng.random((40, dimensions)) * 3 + 1
    values = rng.normal(size=(40, 5))
    elsewhere = rng.random((200, dimensions)) * 6 - 1
    expected = scipy_rbf(points, values, kernel, epsilon=2.0, smoothing=smoothing)(elsewhere)
    model = RBF(kernel, epsilon=2.0, smoothing=smoothing).fit(points, values)
    assert np.abs(model.predict(elsewhere) - expected).max() < 1e-8 * np.abs(expected).max()


@pytest.mark.parametrize("kernel", KERNELS)
def test_the_attributes_are_those_of_the_formula(kernel):
    """Σ w_j φ(‖x − c_j‖) + P(x) of the published attributes is what is predicted."""
    model = RBF(kernel).fit(POINTS * 7 + 3, VALUES)
    x = rng.random((30, 2)) * 9
    r = np.linalg.norm(x[:, None] - model.centers_, axis=2)
    polynomial = model.polynomial_[0] + x @ model.polynomial_[1:]
    expected = plain_kernel(kernel, model.epsilon_, r) @ model.weights_ + polynomial
    assert np.allclose(model.predict(x), expected, atol=1e-9)
    assert np.allclose(model.weights_.sum(axis=0), 0, atol=1e-9 * np.abs(model.weights_).max())


@given(
    arrays(np.float64, (12, 2), elements=st.floats(-1e3, 1e3, width=32), unique=True),
    st.floats(1e-6, 1e6),
)
@settings(deadline=None)
def test_rbf_passes_through_its_control_points(points, size):
    """Samples at control points come back, wherever these lie and whatever their scale."""
    points = np.round(points, 1) * size
    assume(len(np.unique(points, axis=0)) == len(points))
    found = RBF().fit(points, VALUES[:12]).predict(points)
    assert np.abs(found - VALUES[:12]).max() < 1e-9


@pytest.mark.parametrize("kernel", KERNELS)
@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_every_kernel_passes_through_its_control_points(kernel, scale):
    """The default width suits the spacing, so that no kernel is badly conditioned."""
    found = RBF(kernel).fit(POINTS * scale + 5, VALUES).predict(POINTS * scale + 5)
    assert np.abs(found - VALUES).max() < 1e-7


@pytest.mark.parametrize("kernel", KERNELS)
def test_rbf_continues_a_plane_exactly(kernel):
    """Samples that depend linearly on the position are rebuilt everywhere."""
    coefficients = rng.normal(size=(2, 7))
    elsewhere = rng.normal(size=(50, 2)) * 10
    found = RBF(kernel).fit(POINTS, POINTS @ coefficients + 3.0).predict(elsewhere)
    assert np.allclose(found, elsewhere @ coefficients + 3.0, atol=1e-9)


@pytest.mark.parametrize("dimensions", [2, 3], ids=["2-D", "3-D"])
@pytest.mark.parametrize("kernel", KERNELS)
def test_an_isometric_plane_is_recovered(kernel, dimensions):
    """Points of a plane in 10-D come back to 1e-9 from where they lie in the plane."""
    axes = np.linalg.qr(rng.normal(size=(10, dimensions)))[0].T
    plane = rng.random((300, dimensions))
    samples = plane @ axes + rng.normal(size=10)
    found = RBF(kernel).fit(plane[:40], samples[:40]).predict(plane)
    assert np.abs(found - samples).max() < 1e-9


@given(st.floats(0, 2 * np.pi), st.floats(1e-3, 1e3), st.floats(-100, 100), st.booleans())
@settings(deadline=None)
def test_the_linear_kernel_does_not_care_how_the_plane_lies(angle, size, shift, mirrored):
    """Turning, mirroring, moving and scaling the plane changes no rebuilt sample."""
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]) * size
    if mirrored:
        turn = turn[::-1]
    x = np.random.default_rng(1).random((20, 2)) * 2
    expected = RBF().fit(POINTS, VALUES).predict(x)
    found = RBF().fit(POINTS @ turn + shift * size, VALUES).predict(x @ turn + shift * size)
    assert np.abs(found - expected).max() < 1e-8


@pytest.mark.parametrize("kernel", KERNELS)
def test_few_centers_are_a_least_squares_fit(kernel):
    """The residual of fewer centres is orthogonal to all that they can express."""
    points, values = rng.random((60, 2)), rng.normal(size=(60, 3))
    model = RBF(kernel, centers=12).fit(points, values)
    assert model.centers_.shape == (12, 2)
    r = np.linalg.norm(points[:, None] - model.centers_, axis=2)
    nodes = np.column_stack([np.ones(12), model.centers_])
    unseen = np.linalg.svd(nodes.T)[2][3:].T
    basis = plain_kernel(kernel, model.epsilon_, r) @ unseen
    design = np.column_stack([basis, np.ones(60), points])
    residual = values - model.predict(points)
    scale = np.linalg.norm(design, axis=0)[:, None]
    assert np.abs(design.T @ residual / scale).max() < 1e-9


@pytest.mark.parametrize("smoothing", [0.0, 0.2], ids=["exact", "smooth"])
def test_as_many_centers_as_control_points_are_all(smoothing):
    """Both ways of solving agree where they mean the same."""
    everything = RBF("cubic", smoothing=smoothing).fit(POINTS, VALUES)
    some = RBF("cubic", smoothing=smoothing, centers=25).fit(POINTS, VALUES)
    assert np.array_equal(some.weights_, everything.weights_)
    with pytest.warns(AdjustmentWarning, match="centers=90 lowered to 25"):
        assert len(RBF(centers=90).fit(POINTS, VALUES).centers_) == 25


def test_smoothing_of_few_centers_minimises_its_objective():
    """No other weights have a lower sum of squared residuals and λ-weighted energy."""
    points, values = rng.random((50, 2)), rng.normal(size=(50, 1))
    model = RBF(centers=10, smoothing=0.3).fit(points, values)
    among = np.linalg.norm(model.centers_[:, None] - model.centers_, axis=2)
    nodes = np.column_stack([np.ones(10), model.centers_])
    unseen = np.linalg.svd(nodes.T)[2][3:].T
    r = np.linalg.norm(points[:, None] - model.centers_, axis=2)
    full = np.column_stack([np.ones(50), points])

    def objective(weights, polynomial):
        residual = values - r @ weights - full @ polynomial
        return float((residual**2).sum() - 0.3 * (weights.T @ among @ weights).item())

    best = objective(model.weights_, model.polynomial_)
    for _ in range(50):
        other = model.weights_ + unseen @ rng.normal(size=(7, 1)) * 1e-3
        assert objective(other, model.polynomial_ + rng.normal(size=(3, 1)) * 1e-3) > best


def test_smoothing_counts_repeated_control_points():
    """Ten control points at one place pull ten times as hard, as scipy has it."""
    points = np.vstack([POINTS, np.repeat(POINTS[:1], 9, axis=0)])
    values = np.vstack([VALUES, rng.normal(size=(9, 6))])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        model = RBF(smoothing=0.5).fit(points, values)
    expected = scipy_rbf(points, values, "linear", smoothing=0.5)(POINTS)
    assert np.allclose(model.predict(POINTS), expected, atol=1e-9)


@pytest.mark.parametrize(
    "points",
    [
        np.stack([POINTS[:, 0], 2 * POINTS[:, 0] + 1], axis=1),
        np.stack([POINTS[:, 0], np.full(25, 0.3)], axis=1),
    ],
    ids=["oblique line", "horizontal line"],
)
@pytest.mark.parametrize("kernel", KERNELS)
def test_collinear_control_points_are_rebuilt(kernel, points):
    """Control points on a line leave the polynomial undetermined, which harms nothing."""
    model = RBF(kernel).fit(points, VALUES)
    assert np.abs(model.predict(points) - VALUES).max() < 1e-6
    beside = points + np.array([0.0, 0.5])
    assert np.isfinite(model.predict(beside)).all()
    assert np.isfinite(RBF(kernel, centers=6).fit(points, VALUES).predict(beside)).all()


def test_coinciding_control_points_give_their_mean_with_a_warning():
    """Different samples at one place become their mean; all other samples stay exact."""
    points = POINTS.copy()
    points[7] = points[3]
    with pytest.warns(DegenerateDataWarning, match="1 control points coincide"):
        model = RBF().fit(points, VALUES)
    expected = VALUES.copy()
    expected[[3, 7]] = VALUES[[3, 7]].mean(axis=0)
    assert np.abs(model.predict(points) - expected).max() < 1e-9


def test_coinciding_control_points_of_equal_samples_are_fine():
    """A repeated control point that says the same twice needs no warning."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        model = RBF().fit(np.vstack([POINTS, POINTS[:1]]), np.vstack([VALUES, VALUES[:1]]))
    assert np.abs(model.predict(POINTS) - VALUES).max() < 1e-9


@pytest.mark.parametrize("kernel", KERNELS)
@pytest.mark.parametrize("n", [1, 2, 3])
def test_few_control_points_suffice(n, kernel):
    """One, two and three control points are reproduced."""
    model = RBF(kernel).fit(POINTS[:n], VALUES[:n])
    assert np.abs(model.predict(POINTS[:n]) - VALUES[:n]).max() < 1e-12


def test_all_control_points_in_one_place_give_the_mean():
    """Nothing but the mean can be learnt from a single place."""
    with pytest.warns(DegenerateDataWarning):
        model = RBF().fit(np.ones((5, 2)), VALUES[:5])
    assert np.allclose(model.predict(POINTS), VALUES[:5].mean(axis=0))


@pytest.mark.parametrize("centers", [None, 2], ids=["all centres", "two centres"])
@pytest.mark.parametrize("kernel", KERNELS)
def test_equal_samples_stay_equal_everywhere(kernel, centers):
    """Control points that differ by rounding noise do not blow it up."""
    points = [[0, 0], [0, 1e-13], [1e-17, 0], [1.0, 0.0], [0.0, 1.0]]
    model = RBF(kernel, centers=centers).fit(points, [[3.0, 4.1]] * 5)
    assert np.array_equal(model.predict([[1.0, 1.0], [-50.0, 7.0]]), [[3.0, 4.1]] * 2)


def test_nearly_coinciding_control_points_are_rebuilt():
    """Two control points 1e-9 apart with different samples come back to 1e-5."""
    points = POINTS.copy()
    points[7] = points[3] + 1e-9
    model = RBF().fit(points, VALUES)
    assert np.abs(model.predict(points) - VALUES).max() < 1e-5


def central_differences(predict, x, h):
    """Differentiate by central differences: (n_points, ..., n_dimensions)."""
    steps = h * np.eye(x.shape[1])
    return np.stack([(predict(x + s) - predict(x - s)) / (2 * h) for s in steps], axis=-1)


@given(
    arrays(np.float64, (9, 3), elements=st.floats(-2, 2, width=32)),
    st.sampled_from(list(KERNELS)),
    st.sampled_from([2, 3]),
)
@settings(deadline=None)
def test_the_jacobian_agrees_with_central_differences(x, kernel, dimensions):
    """Away from control points it is right to 1e-6 of its largest entry."""
    points = np.random.default_rng(2).random((20, dimensions))
    x = x[:, :dimensions]
    assume(np.linalg.norm(x[:, None] - points, axis=2).min() > 1e-2)
    model = RBF(kernel, epsilon=2.0).fit(points, VALUES[:20])
    found = model.jacobian(x)
    assert found.shape == (9, 6, dimensions)
    expected = central_differences(model.predict, x, 1e-5)
    assert np.abs(found - expected).max() < 1e-6 * max(1.0, np.abs(found).max())


@pytest.mark.parametrize("kernel", KERNELS)
def test_the_jacobian_at_a_control_point_is_the_symmetric_derivative(kernel):
    """The kink of the linear kernel contributes nothing at its own centre."""
    model = RBF(kernel).fit(POINTS, VALUES)
    expected = central_differences(model.predict, POINTS, 1e-7)
    scale = np.abs(expected).max()
    assert np.abs(model.jacobian(POINTS) - expected).max() < 1e-4 * scale


def test_both_at_once_are_both():
    """The values and the Jacobian of one call are those of two; blocks change nothing."""
    x = rng.random((20000, 2))
    model = RBF().fit(POINTS, VALUES)
    values, jacobian = model.predict_with_jacobian(x)
    assert np.array_equal(values, model.predict(x))
    assert np.array_equal(jacobian, model.jacobian(x))
    assert np.allclose(values[12345], model.predict(x[12345:12346])[0], rtol=1e-12)
    assert np.swapaxes(jacobian, 1, 2).flags.c_contiguous


def test_a_single_output_is_one_column_of_the_jacobian():
    """Samples that are numbers give values of shape (n,) and a Jacobian of shape (n, 1, 2)."""
    values, jacobian = RBF().fit(POINTS, VALUES[:, 0]).predict_with_jacobian(POINTS)
    assert values.shape == (25,)
    assert jacobian.shape == (25, 1, 2)


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"kernel": "quintic"}, "kernel: got 'quintic', want one of linear, thin-plate"),
        ({"kernel": None}, "kernel: got None"),
        ({"smoothing": -1.0}, "smoothing: got -1.0, want a number of at least 0"),
        ({"smoothing": np.nan}, "smoothing: got nan"),
        ({"epsilon": 0.0}, "epsilon: got 0.0, want a number above 0"),
        ({"epsilon": "wide"}, "epsilon: got 'wide'"),
        ({"centers": 0}, "centers: got 0, want an integer of at least 1"),
        ({"centers": 2.5}, "centers: got 2.5"),
        ({"centers": True}, "centers: got True"),
    ],
    ids=lambda value: str(value) if isinstance(value, dict) else "",
)
def test_wrong_parameters_are_refused(parameters, message):
    """The message names the parameter, its value and what is allowed."""
    with pytest.raises(WorkbenchError, match=message):
        RBF(**parameters).fit(POINTS, VALUES)


@pytest.mark.parametrize(
    ("points", "values"),
    [
        (np.where(POINTS > 0.9, np.nan, POINTS), VALUES),
        (POINTS, np.where(VALUES > 1, np.inf, VALUES)),
        (POINTS[:20], VALUES),
        (POINTS[:, 0], VALUES),
        (POINTS[:0], VALUES[:0]),
    ],
    ids=["nan position", "infinite sample", "fewer positions", "flat positions", "nothing"],
)
def test_wrong_control_points_are_refused(points, values):
    """Nothing is learnt from what is no set of control points."""
    with pytest.raises(ValueError, match=r"NaN|infinity|inconsistent|Expected 2D|0 sample"):
        RBF().fit(points, values)


@pytest.mark.parametrize("method", ["predict", "jacobian", "predict_with_jacobian"])
def test_wrong_positions_are_refused(method):
    """Every way to evaluate refuses nan, other dimensions, and to go before fit."""
    with pytest.raises(NotFittedError, match="not fitted"):
        getattr(RBF(), method)(POINTS)
    call = getattr(RBF().fit(POINTS, VALUES), method)
    with pytest.raises(ValueError, match="NaN"):
        call([[0.0, np.nan]])
    with pytest.raises(ValueError, match="3 features"):
        call(np.zeros((4, 3)))
