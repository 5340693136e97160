"""Tests of workbench.mocap.motion_saliency."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.errors import AdjustmentWarning, DegenerateDataWarning, WorkbenchError
from workbench.mocap.amc import read_amc
from workbench.mocap.motion_saliency import motion_saliency
from workbench.mocap.rotations import unwrap_degrees
from workbench.quality.animation import angle_errors, psnr_of_error


@pytest.fixture(scope="module")
def curves():
    """Give 600 frames of 12 smooth curves that are mixtures of five."""
    rng = np.random.default_rng(1)
    t = np.linspace(0, 1, 600)[:, None]
    waves = np.sin(2 * np.pi * (t * rng.uniform(1, 6, 5) + rng.random(5)) ** 1.3)
    return waves @ rng.normal(size=(5, 12)) + 0.01 * np.cumsum(rng.normal(size=(600, 12)), axis=0)


@pytest.fixture
def angles_13_29(real_mocap):
    """Give the unwrapped joint angles of "stretching"."""
    path = real_mocap / "asf_amc" / "13_29.amc"
    if not path.is_file():
        pytest.skip("needs mocap/asf_amc/13_29.amc in a folder named by WORKBENCH_DATA")
    return unwrap_degrees(read_amc(path).degrees)


def printed_keyframes(saliency, length):
    """Cluster candidates one frame after the other, as section 3.1.4 tells."""
    candidates, weights = saliency.candidates, saliency.weights
    runs, run = [], []
    for frame in range(len(candidates)):
        if candidates[frame].any():
            run.append(frame)
        elif run:
            runs.append(run)
            run = []
    runs += [run] if run else []
    keyframes = []
    for run in runs:
        n_parts = int(np.ceil(len(run) / length))
        # The middle of each frame decides in which of the equal parts it lies.
        parts = [[] for _ in range(n_parts)]
        for i, frame in enumerate(run):
            parts[int((i + 0.5) * n_parts / len(run))].append(frame)
        for part in parts:
            found = [(f, weights[j]) for f in part for j in np.flatnonzero(candidates[f])]
            feet = [
                (f, 1) for f in part for j in np.flatnonzero(candidates[f]) if saliency.is_foot[j]
            ]
            found = feet or found
            mean = np.average([f for f, _ in found], weights=[w for _, w in found])
            keyframes.append(min((round(abs(f - mean), 9), f) for f, _ in found)[1])
    return keyframes


def rebuilt_linearly(values, keyframes):
    """Interpolate between the keyframes, the first and the last frame added."""
    keys = np.union1d(keyframes, [0, len(values) - 1])
    frames = np.arange(len(values))
    return np.stack([np.interp(frames, keys, column[keys]) for column in values.T], axis=1)


def test_published_numbers_of_stretching(angles_13_29):
    """With σ = 10, k = 7, 13_29 gets 131 keyframes and 42.90 dB to within a few per cent."""
    found = motion_saliency(angles_13_29, sigma=10, n_components=7)
    assert angles_13_29.shape == (4592, 59)
    assert len(found.keyframes) == pytest.approx(131, abs=5)
    errors = angle_errors(angles_13_29, rebuilt_linearly(angles_13_29, found.keyframes))
    assert psnr_of_error(errors.mean()) == pytest.approx(42.90, abs=0.5)
    printed = motion_saliency(angles_13_29, sigma=10, n_components=7, cluster_width=2)
    assert len(printed.keyframes) > 190  # clusters as short as printed are far too many


@pytest.mark.parametrize("curvature", ["slope", "value"])
def test_clusters_are_those_of_a_plain_loop(curves, curvature):
    """Array operations cluster as a loop over the frames does, with feet and without."""
    heights = np.abs(np.sin(np.linspace(0, 20, 600)))[:, None] * [1.0, 2.0] + curves[:, :2] / 9
    for feet in (None, heights):
        for width in (1, 2, 4):
            found = motion_saliency(
                curves, 6, curvature=curvature, cluster_width=width, foot_heights=feet
            )
            assert found.keyframes.tolist() == printed_keyframes(found, 6 * width)
            assert np.diff(found.clusters, axis=1).max() < 6 * width
            assert len(found.keyframes) > 5


def test_candidates_exceed_the_mean_of_their_curve(curves):
    """All that is kept fits together."""
    found = motion_saliency(curves, 8)
    assert np.array_equal(found.candidates, found.saliency > found.saliency.mean(axis=0))
    inside = np.zeros(600, dtype=bool)
    for (first, last), keyframe in zip(found.clusters, found.keyframes, strict=True):
        assert first <= keyframe <= last
        inside[first : last + 1] = True
    assert np.array_equal(inside, found.candidates.any(axis=1))
    assert np.array_equal(found.keyframes_of_clusters(32), found.keyframes)


def test_the_curves_are_principal_components(curves):
    """They are uncorrelated, as varied as the eigenvalues say, and keep the share they say."""
    found = motion_saliency(curves, n_components=4)
    assert np.allclose(found.curves.T @ found.curves / 600, np.diag(found.weights), atol=1e-9)
    assert found.explained_variance_ratio == pytest.approx(found.weights.sum() / 12)
    raw = motion_saliency(curves, n_components=12, standardize=False)
    assert raw.weights.sum() == pytest.approx(curves.var(axis=0).sum())


def test_the_number_of_curves_follows_the_variance():
    """At least 7, and as many more as 90 % of the variance need."""
    rng = np.random.default_rng(0)
    independent = rng.normal(size=(500, 20))
    found = motion_saliency(independent)
    assert found.curves.shape[1] > 15
    assert found.explained_variance_ratio >= 0.9
    fewer = motion_saliency(independent, n_components=found.curves.shape[1] - 1)
    assert fewer.explained_variance_ratio < 0.9
    lopsided = rng.normal(size=(500, 1)) + 0.01 * independent
    assert motion_saliency(lopsided).curves.shape[1] == 7
    assert motion_saliency(lopsided[:, :3]).curves.shape[1] == 3


@settings(max_examples=20, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), sigma=st.floats(1, 30))
def test_units_order_and_constants_do_not_matter(seed, sigma):
    """Columns in other units, in another order, or that do not vary change no keyframe."""
    rng = np.random.default_rng(seed)
    values = np.cumsum(rng.normal(size=(120, 4)), axis=0)
    found = motion_saliency(values, sigma)
    scaled = np.column_stack([values * rng.uniform(0.1, 10, 4) + 5, np.full(120, 0.1)])
    again = motion_saliency(scaled[:, rng.permutation(5)], sigma)
    assert np.allclose(np.abs(again.curves), np.abs(found.curves), atol=1e-8)
    assert len(again.keyframes) == len(found.keyframes)
    assert np.abs(again.keyframes - found.keyframes).max(initial=0) <= 1


@settings(max_examples=20, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), sigma=st.floats(1, 30))
def test_a_motion_run_backwards_is_mirrored(seed, sigma):
    """It has the same candidates, and the same clusters up to a frame in the middle of two."""
    values = np.cumsum(np.random.default_rng(seed).normal(size=(150, 3)), axis=0)
    forwards, backwards = motion_saliency(values, sigma), motion_saliency(values[::-1], sigma)
    assert np.array_equal(forwards.candidates, backwards.candidates[::-1])
    mirrored = 149 - backwards.clusters[::-1, ::-1]
    assert mirrored.shape == forwards.clusters.shape
    assert np.abs(mirrored - forwards.clusters).max(initial=0) <= 1
    whole = np.all(mirrored == forwards.clusters, axis=1)
    keyframes = 149 - backwards.keyframes[::-1]
    assert np.abs(keyframes - forwards.keyframes)[whole].max(initial=0) <= 1


def test_noise_of_a_joint_at_rest_is_not_a_movement(curves):
    """Rounding errors of a joint that does not turn are dropped, not standardised."""
    noise = 1e-14 * np.random.default_rng(2).normal(size=(600, 30))
    with_noise = motion_saliency(np.hstack([curves, noise]), n_components=5)
    assert np.allclose(with_noise.weights, motion_saliency(curves, n_components=5).weights)


@pytest.mark.parametrize("kind", ["still", "straight"])
def test_a_motion_without_a_bend_has_no_salient_frame(kind):
    """It is said, and what is computed from it is empty, not an error."""
    slope = {"still": 0.0, "straight": 1.0}[kind]
    values = np.arange(50.0)[:, None] * slope * [1.0, 2.0] + 7.0
    with pytest.warns(DegenerateDataWarning, match="no frame is salient"):
        found = motion_saliency(values)
    assert not found.candidates.any()
    assert found.keyframes.shape == (0,)
    assert found.clusters.shape == (0, 2)
    assert not found.frame_saliency.any()


def test_ranks_are_averages_over_the_curves(curves):
    """The saliency of frames is 1 on average, whatever the units of the curves'."""
    found = motion_saliency(curves, 5)
    assert found.frame_saliency.mean() == pytest.approx(1.0)
    ratio = found.saliency / found.saliency.mean(axis=0)
    expected = ratio @ found.weights / found.weights.sum()
    assert np.allclose(found.frame_saliency, expected)


def test_a_foot_takes_the_place_of_a_component_and_wins(curves):
    """A step that the body does not show becomes a keyframe, in its frame."""
    height = np.zeros(600)
    height[300:] = 1.0
    found = motion_saliency(curves, n_components=6, foot_heights=height[:, None])
    assert found.curves.shape == (600, 6)
    assert found.is_foot.tolist() == [False] * 5 + [True]
    steps = np.flatnonzero(found.candidates[:, 5])
    assert len(steps)
    assert np.all(np.abs(steps - 299.5) <= 30)  # within two widths of the widest window
    for (first, last), keyframe in zip(found.clusters, found.keyframes, strict=True):
        if found.candidates[first : last + 1, 5].any():
            assert found.candidates[keyframe, 5]


def test_a_foot_at_rest_wins_nothing(curves):
    """Rounding errors of a foot that stands still are not taken for contacts."""
    rounding = np.random.default_rng(4).choice([90.2, np.nextafter(90.2, 91)], 600)
    step = np.where(np.arange(600) < 300, 90.2, 95.0)
    found = motion_saliency(curves, 6, 8, foot_heights=np.column_stack([step, rounding]))
    assert found.candidates[:, 6].any()
    assert not found.saliency[:, 7].any()


@pytest.mark.parametrize("scale", [1e200, 1e-200])
def test_numbers_that_cannot_be_squared_are_refused(curves, scale):
    """It is said, in place of an overflow somewhere inside."""
    with pytest.raises(WorkbenchError, match=r"values: got numbers up to \S+e[+-]"):
        motion_saliency(scale * curves)


def test_more_components_than_there_are_is_adjusted(curves):
    """The warning says how many were taken."""
    with pytest.warns(AdjustmentWarning, match="got 40, took 12"):
        found = motion_saliency(curves, n_components=40)
    assert found.curves.shape == (600, 12)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"n_components": 0}, "n_components: got 0, want at least 1"),
        ({"n_components": 2.5}, "n_components: got 2.5"),
        ({"n_components": True}, "n_components: got True"),
        ({"n_components": 1, "foot_heights": np.zeros((600, 1))}, "beside the 1 of the feet"),
        ({"variance": 1.5}, "variance: got 1.5, want a number above 0 and at most 1"),
        ({"cluster_width": 0}, "cluster_width: got 0"),
        ({"cluster_width": np.inf}, "cluster_width: got inf"),
        ({"sigma": -1}, "sigma: got -1"),
        ({"foot_sigma": 0}, "foot_sigma: got 0"),
        ({"foot_heights": np.zeros((7, 2))}, "foot_heights: got 7 frames, want 600"),
        ({"foot_heights": np.full((600, 1), np.inf)}, "foot_heights: got inf"),
    ],
    ids=lambda value: str(value)[:24] if isinstance(value, str) else "",
)
def test_bad_parameters_are_refused(curves, options, message):
    """The message names the parameter."""
    with pytest.raises(WorkbenchError, match=message):
        motion_saliency(curves, **options)
