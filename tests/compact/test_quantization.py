"""Tests of workbench.compact.quantization."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from workbench.compact.quantization import (
    FINEST_BITS,
    power_of_two_below,
    quantize,
    step_for_bits,
)
from workbench.errors import WorkbenchError
from workbench.mocap.rotations import (
    geodesic_angles,
    rotation_vectors,
    rotations_from_vectors,
)

TABLES = arrays(np.float64, (5, 3), elements=st.floats(-1e6, 1e6))
BITS = st.integers(8, FINEST_BITS)


@given(TABLES, BITS)
def test_rounding_keeps_the_stated_bound(values, bits):
    """No number changes by more than half a step, and counts fit in the bits."""
    rounded = quantize(values, step_for_bits(values, bits))
    assert np.abs(rounded.values - values).max() <= rounded.bound
    assert np.abs(rounded.counts).max() <= 2 ** (bits - 1)


@given(TABLES)
def test_more_bits_are_never_worse(values):
    """Each bit halves the bound."""
    bounds = [quantize(values, step_for_bits(values, bits)).bound for bits in (12, 13, 20)]
    assert bounds[0] == 2 * bounds[1] == 256 * bounds[2]


@given(TABLES, st.integers(-10, 3))
def test_a_column_at_its_origin_is_exact(values, exponent):
    """Where nothing moves nothing is rounded; elsewhere the bound holds, as float64 does."""
    values[:, 1] = values[0, 1]
    rounded = quantize(values, 2.0**exponent, values[0].copy())
    assert np.array_equal(rounded.values[:, 1], values[:, 1])
    assert np.abs(rounded.values - values).max() <= rounded.bound + 1e-9


@given(arrays(np.float64, (4, 3), elements=st.floats(-2.0, 2.0)), st.integers(12, 24))
def test_rotations_are_off_by_at_most_the_stated_angle(turns, bits):
    """Rounded rotation vectors turn by at most √3 times the bound of a number."""
    vectors = rotation_vectors(rotations_from_vectors(turns))
    rounded = quantize(vectors, step_for_bits(np.array([np.pi]), bits))
    angles = geodesic_angles(
        rotations_from_vectors(rounded.values), rotations_from_vectors(vectors)
    )
    assert angles.max() <= np.sqrt(3) * rounded.bound + 1e-14


def test_sixteen_bits_keep_any_rotation_to_six_thousandths_of_a_degree():
    """The bound that the docstrings state, whatever the poses."""
    bound = step_for_bits(np.array([np.pi]), 16) / 2
    assert np.degrees(np.sqrt(3) * bound) < 0.0061


@pytest.mark.parametrize(
    ("limit", "step"), [(0.01, 2**-7), (1.0, 1.0), (0.75, 0.5), (3.0, 2.0)], ids=str
)
def test_steps_are_rounded_down(limit, step):
    """The power of two is the largest that is not above the limit."""
    assert power_of_two_below(limit) == step


def test_nothing_but_zeros_has_a_step():
    """Zeros, and no numbers at all, are kept as they are."""
    for values in (np.zeros((3, 2)), np.zeros((3, 0)), np.full((3, 2), 1e-320)):
        rounded = quantize(values, step_for_bits(values, 16))
        assert np.abs(rounded.values - values).max(initial=0.0) <= rounded.bound


def test_too_small_a_step_is_refused():
    """A count that no 64-bit number holds is an error, not an overflow."""
    with pytest.raises(WorkbenchError, match=r"step: got 1e-10, too small"):
        quantize(np.array([[1e12]]), 1e-10)
