"""Tests of workbench.mocap.rotation_angle."""

from __future__ import annotations

import numpy as np
import pytest

from workbench.mocap.rotation_angle import angle_from_squared_chord


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
