"""Tests of workbench.interpolation.hermite."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline

from workbench.interpolation import interpolators
from workbench.interpolation.hermite import cubic_curves, tangents
from workbench.mocap.motion import Motion
from workbench.mocap.rotations import rotations_from_euler

KEYS = np.array([0, 3, 4, 17, 40])


def turning(arm, degrees):
    """Make a motion of the arm whose second joint turns by given angles, three a frame."""
    angles = np.zeros((len(degrees), 4, 3))
    angles[:, 1] = degrees
    return Motion(
        arm, rotations_from_euler("ZYX", angles), np.zeros((len(degrees), 3)), 0.1, name="turn"
    )


@pytest.mark.parametrize("name", ["hermite", "hermite-keys"])
def test_quadratic_angles_are_rebuilt_exactly(arm, name):
    """Parabolas in all three angles, from unevenly spaced keyframes."""
    t = np.arange(41) / 40
    motion = turning(arm, np.stack([300 * t**2, 60 * t - 80 * t**2, 20 - 50 * t], axis=1))
    rebuilt = interpolators.create(name).interpolate(motion, KEYS)
    assert np.abs(rebuilt - motion.rotations).max() < 1e-10


def test_cubic_curves_with_exact_tangents_are_rebuilt_exactly():
    """A cubic comes back from its values and derivatives."""
    t = np.arange(41.0)
    values = np.stack([t**3 - 50 * t**2 + 7, 3 * t], axis=1)
    slopes = np.stack([3 * t**2 - 100 * t, np.full(41, 3.0)], axis=1)
    rebuilt = cubic_curves(values[KEYS], slopes[KEYS], KEYS, 41)
    assert np.abs(rebuilt - values).max() < 1e-9


def test_curves_agree_with_scipy():
    """Random values and slopes give scipy's cubic Hermite spline; outside, its ends hold."""
    rng = np.random.default_rng(0)
    values, slopes = rng.normal(size=(2, 5, 3))
    keys = KEYS + 2
    curves = cubic_curves(values, slopes, keys, 50)
    inside = np.arange(2, 43)
    assert np.allclose(curves[inside], CubicHermiteSpline(keys, values, slopes)(inside))
    assert np.array_equal(curves[:2], values[[0, 0]])
    assert np.allclose(curves[43:], values[-1], rtol=0, atol=1e-12)


def test_inner_tangents_are_central_differences():
    """Between frames, half the difference of the neighbours; two values give a line."""
    values = np.random.default_rng(0).normal(size=(9, 2))
    expected = (values[2:] - values[:-2]) / 2
    assert np.allclose(tangents(values, np.arange(9))[1:-1], expected)
    line = tangents(np.array([[0.0], [6.0]]), np.array([4, 7]))
    assert line.tolist() == [[2.0], [2.0]]


def test_tangents_of_the_frames_are_stored(waving):
    """The clip's tangents double what is kept, and tell more than the keyframes alone."""
    keys = [*range(0, 60, 12), 59]
    kept = {
        name: interpolators.create(name).encode(waving, np.array(keys)).shape
        for name in ("linear", "hermite", "hermite-keys")
    }
    assert kept == {"linear": (6, 12), "hermite": (6, 24), "hermite-keys": (6, 12)}
    errors = {
        name: np.abs(interpolators.create(name).interpolate(waving, keys) - waving.rotations).mean()
        for name in kept
    }
    assert errors["hermite"] < errors["hermite-keys"] < errors["linear"]
