"""Tests of workbench.mocap.curve_saliency."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from workbench.errors import WorkbenchError
from workbench.mocap.curve_saliency import curve_curvature, curve_saliency, saliency_maps


def printed_curvature(curve, curvature):
    """Compute Eq. 3.4 frame by frame."""
    last = len(curve) - 1
    slopes = np.gradient(curve)
    result = []
    for f in range(last + 1):
        middle = min(max(f, 1), last - 1)
        second = curve[middle + 1] - 2 * curve[middle] + curve[middle - 1]
        below = slopes[f] if curvature == "slope" else curve[f]
        result.append(abs(second) / (1 + below**2) ** 1.5)
    return np.array(result)


def printed_mean(bend, f, sigma):
    """Compute Eq. 3.5 for one frame."""
    reach = int(2 * sigma)
    near = np.arange(max(0, f - reach), min(len(bend), f + reach + 1))
    weights = np.exp(-((near - f) ** 2) / (2 * sigma**2))
    return weights @ bend[near] / weights.sum()


def printed_maps(curve, sigma, curvature):
    """Compute Eq. 3.4 to 3.7 as they are printed, frame by frame."""
    bend = printed_curvature(curve, curvature)
    maps = []
    for s in (sigma, 1.5 * sigma, 2.0 * sigma, 2.5 * sigma):
        differences = [
            printed_mean(bend, f, s) - printed_mean(bend, f, 2 * s) for f in range(len(curve))
        ]
        maps.append(np.abs(differences))
    return np.array(maps)


def printed_saliency(curve, sigma, curvature):
    """Normalise the maps as it is printed, and add them."""
    maps = printed_maps(curve, sigma, curvature)
    frames = range(len(curve))
    largest = maps.max()
    total = np.zeros(len(curve))
    for row in maps:
        row = (row - row.min()) / (row.max() - row.min()) * largest
        padded = np.concatenate([[-np.inf], row, [-np.inf]])
        peaks = [
            row[i] for i in frames if padded[i] < row[i] > padded[i + 2]
        ]  # no equal neighbours on random curves
        peaks.remove(max(peaks))
        mean = np.mean(peaks) if peaks else 0.0
        total += row * (largest - mean) ** 2
    return total


@pytest.mark.parametrize("curvature", ["slope", "value"])
@pytest.mark.parametrize("sigma", [1, 2.3, 7, 40])
def test_saliency_is_the_printed_formula(sigma, curvature):
    """Blockwise Fourier sums and single loops give what the formulas give, to 1e-10."""
    walk = np.cumsum(np.random.default_rng(3).normal(size=(2, 150)), axis=1)
    found = curve_saliency(walk.T, sigma, curvature=curvature)
    maps = saliency_maps(walk.T, sigma, curvature=curvature)
    for index, curve in enumerate(walk):
        expected = printed_saliency(curve, sigma, curvature)
        assert np.allclose(found[:, index], expected, rtol=1e-10, atol=1e-10 * expected.max())
        expected = printed_maps(curve, sigma, curvature)
        assert np.allclose(maps[:, :, index], expected, rtol=1e-10, atol=1e-10 * expected.max())


def test_long_curves_are_cut_into_blocks_without_a_seam():
    """In the middle of a long clip the means are those of a plain sum."""
    curve = np.cumsum(np.random.default_rng(4).normal(size=2500))
    found = curve_saliency(curve[:, None], 10).ravel()
    expected = printed_saliency(curve, 10, "slope")
    assert np.allclose(found, expected, rtol=1e-10, atol=1e-10 * expected.max())


@pytest.mark.parametrize("center", [30, 100, 169])
def test_a_bump_is_most_salient_at_its_top(center):
    """The one thing that happens on a curve is where its saliency peaks."""
    bump = np.exp(-(((np.arange(200) - center) / 5.0) ** 2))
    assert curve_saliency(bump[:, None], 3).argmax() == center


@pytest.mark.parametrize("slope", [0.0, 0.37, -1e6])
def test_straight_lines_have_no_saliency(slope):
    """Rounding is not taken for movement."""
    line = 1000.0 + slope * np.arange(300) / 7.0
    assert not curve_saliency(line[:, None], 10).any()


def test_the_curvature_is_that_of_the_graph():
    """A circle of radius 50 has curvature 1/50; with D in the denominator it has not."""
    x = np.arange(-20.0, 21.0)
    circle = np.sqrt(50.0**2 - x**2)[:, None]
    assert np.allclose(curve_curvature(circle)[2:-2], 1 / 50, rtol=2e-3)
    assert not np.allclose(curve_curvature(circle, "value")[2:-2], 1 / 50, rtol=0.5)


@settings(max_examples=25, deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1),
    n_frames=st.integers(3, 300),
    sigma=st.floats(1, 500),
    curvature=st.sampled_from(["slope", "value"]),
)
@example(seed=13248, n_frames=3, sigma=86.0, curvature="slope")
def test_saliency_does_not_know_the_direction_of_time(seed, n_frames, sigma, curvature):
    """Curves run backwards, or upside down, are as salient in the same frames."""
    curves = np.cumsum(np.random.default_rng(seed).normal(size=(n_frames, 2)), axis=0)
    found = curve_saliency(curves, sigma, curvature=curvature)
    assert found.shape == curves.shape
    assert found.min() >= 0
    assert np.isfinite(found).all()
    # Windows much wider than the clip hardly differ, and peaks of about one height nearly
    # cancel. What is then left of the curvature's rounding, 1e-10 of it, meets the square of
    # the largest map, in four maps, the smallest of which is stretched about sevenfold.
    largest = saliency_maps(curves, sigma, curvature=curvature).max(axis=(0, 1))
    rounding = 1e-10 * curve_curvature(curves, curvature).max(axis=0)
    tolerance = 1e-6 * found.max(axis=0) + 100 * rounding * largest**2
    turned = curve_saliency(curves[::-1], sigma, curvature=curvature)[::-1]
    assert np.all(np.abs(turned - found) <= tolerance)
    assert np.array_equal(curve_saliency(-curves, sigma, curvature=curvature), found)


@pytest.mark.parametrize(
    ("curves", "options", "message"),
    [
        ([[1.0], [2.0]], {}, r"curves: got shape \(2, 1\)"),
        ([1.0, 2.0, 3.0], {}, r"curves: got shape \(3,\)"),
        ([["a"], ["b"], ["c"]], {}, "no array of numbers"),
        ([[1.0], [np.nan], [2.0]], {}, r"got nan at \[1, 0\]"),
        (np.zeros((9, 1)), {"sigma": 0.5}, "sigma: got 0.5, want a number of frames, at least 1"),
        (np.zeros((9, 1)), {"sigma": np.nan}, "sigma: got nan"),
        (np.zeros((9, 1)), {"sigma": "3"}, "sigma: got '3'"),
        (np.zeros((9, 1)), {"curvature": "D"}, "curvature: got 'D', want one of slope, value"),
    ],
    ids=["two frames", "one axis", "words", "nan", "narrow", "no number", "word", "curvature"],
)
def test_bad_input_is_refused(curves, options, message):
    """The message names the argument."""
    with pytest.raises(WorkbenchError, match=message):
        curve_saliency(curves, **{"sigma": 2.0, **options})
