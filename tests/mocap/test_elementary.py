"""Tests of workbench.mocap.elementary."""

from __future__ import annotations

import numpy as np
import pytest

from workbench.mocap.elementary import angle_from_squared_chord, sine_and_cosine


def by_library(chord2):
    """Evaluate 2·asin(√(chord² / 8)) in extended precision."""
    return 2 * np.arcsin(np.sqrt(np.asarray(chord2, dtype=np.longdouble) / 8))


@pytest.mark.parametrize(
    "chord2",
    [
        np.linspace(1e-3, 8.0, 4001),
        np.logspace(-300, -1, 1000),
        4.0 + np.linspace(-1e-3, 1e-3, 501),
        8.0 - np.logspace(-12, -1, 300),
    ],
    ids=["whole-range", "tiny", "where-the-halves-meet", "half-a-turn"],
)
def test_angles_agree_with_the_library_in_extended_precision(chord2):
    """The polynomial has the precision of a double everywhere."""
    found = np.array([angle_from_squared_chord(value) for value in chord2])
    expected = by_library(chord2)
    assert np.max(np.abs(found / expected - 1)) < 1e-15


def test_ends_of_the_range_are_exact():
    """Equal rotations are 0 apart, opposite ones π, and rounding beyond them changes nothing."""
    assert angle_from_squared_chord(0.0) == 0.0
    assert angle_from_squared_chord(8.0) == np.pi
    assert angle_from_squared_chord(np.nextafter(8.0, 9.0)) == np.pi


@pytest.mark.parametrize(
    "degrees",
    [np.linspace(-720, 720, 20011), np.logspace(-300, 0, 2000), 1e9 + np.linspace(0, 360, 999)],
    ids=["two-turns", "tiny", "far-out"],
)
def test_sines_agree_with_the_library_in_extended_precision(degrees):
    """Sine and cosine have the precision of a double, small sines relatively too."""
    found = np.array([sine_and_cosine(value) for value in degrees]).T
    half_turn = np.longdouble("3.14159265358979323846264338327950288")
    radians = np.fmod(np.asarray(degrees, dtype=np.longdouble), 360) * half_turn / 180
    expected = np.stack([np.sin(radians), np.cos(radians)])
    assert np.max(np.abs(found - expected)) < 2e-16
    near = np.abs(degrees) < 45
    assert np.all(np.abs(found[0] - expected[0])[near] <= 4e-16 * np.abs(expected[0])[near])


@pytest.mark.parametrize("turns", range(-5, 6))
def test_quarter_turns_are_exact(turns):
    """Sines of multiples of 90 degrees are -1, 0 or 1."""
    sine, cosine = sine_and_cosine(90.0 * turns)
    assert (sine, cosine) == ([0, 1, 0, -1][turns % 4], [1, 0, -1, 0][turns % 4])


def test_no_number_has_no_sine():
    """A missing angle stays one."""
    assert np.isnan(sine_and_cosine(np.nan)).all()
