"""Elementary functions as polynomials without branches or calls.

A library's arcsine or sine handles one number at a time inside a compiled loop and costs more
than all the rest of it. A loop that stores one of these per turn is compiled to instructions
on several numbers at once.
"""

from __future__ import annotations

import math

from workbench.kernels import compiled_fused

# arcsin(√t) / √t = 1 + t · (c_0 + c_1·t + …) for t in [0, 1/2]: interpolation at Chebyshev
# points, whose relative error (6e-17) is below the rounding of a double.
_C0 = 0.1666666666666666
_C1 = 0.07500000000008983
_C2 = 0.04464285712358516
_C3 = 0.030381946078023858
_C4 = 0.022372086303686842
_C5 = 0.017354730668996843
_C6 = 0.013929824301362788
_C7 = 0.011985559032731258
_C8 = 0.005891962383848912
_C9 = 0.03382397747722756
_C10 = -0.11747841395554583
_C11 = 0.46581061083892017
_C12 = -1.2586813003945883
_C13 = 2.5735080644015933
_C14 = -3.741599300200137
_C15 = 3.7316474816315233
_C16 = -2.2779904894416334
_C17 = 0.6629475548369098

# sin(r°) / r = s_0 + s_1·r² + … and (cos(r°) − 1) / r² = c_0 + c_1·r² + … for r in [−45, 45],
# found likewise (relative errors 2e-17 and 4e-17). In degrees, quarter turns are exact.
_SIN0 = 0.017453292519943295
_SIN1 = -8.860961557012953e-07
_SIN2 = 1.3496016231611543e-11
_SIN3 = -9.788384855392072e-17
_SIN4 = 4.141266538492003e-22
_SIN5 = -1.1467564823560734e-27
_SIN6 = 2.2164560059574632e-33
_COS0 = -0.0001523087098933543
_COS1 = 3.86632385156299e-09
_COS2 = -3.9258319857408015e-14
_COS3 = 2.1354943029153012e-19
_COS4 = -7.227874204324564e-25
_COS5 = 1.667912805508616e-30
_COS6 = -2.766732424324131e-36

# Adding and taking away 1.5 · 2**52 rounds to the nearest whole number, up to 2**51.
_TO_WHOLE = 6755399441055744.0


@compiled_fused
def angle_from_squared_chord(chord2):  # type: ignore[no-untyped-def]  # compiled
    """Compute the angle 2·asin(‖A − B‖_F / (2√2)) between two rotations from ‖A − B‖²_F.

    Within 1e-15 of the angle, relatively, and exactly 0 for equal rotations; squared chords
    above 8, which rounding gives, count as 8 (half a turn).

    Parameters
    ----------
    chord2 : float
        Sum of the nine squared differences of the two matrices' entries.

    Returns
    -------
    float
        Radians, within [0, π].

    Examples
    --------
    >>> angle_from_squared_chord(0.0), round(angle_from_squared_chord(4.0) / math.pi, 15)
    (0.0, 0.5)
    """
    # With s = sin²(angle / 2), arcsin(√s) = π/2 − arcsin(√(1 − s)) leads the upper half of
    # the range back to the lower one.
    s = 0.125 * chord2
    t = max(min(s, 1.0 - s), 0.0)
    p = _C17
    p = p * t + _C16
    p = p * t + _C15
    p = p * t + _C14
    p = p * t + _C13
    p = p * t + _C12
    p = p * t + _C11
    p = p * t + _C10
    p = p * t + _C9
    p = p * t + _C8
    p = p * t + _C7
    p = p * t + _C6
    p = p * t + _C5
    p = p * t + _C4
    p = p * t + _C3
    p = p * t + _C2
    p = p * t + _C1
    p = p * t + _C0
    root = 2.0 * math.sqrt(t)
    angle = root + root * (t * p)
    return angle if s < 0.5 else math.pi - angle


@compiled_fused
def sine_and_cosine(degrees):  # type: ignore[no-untyped-def]  # compiled
    """Compute sine and cosine of an angle in degrees.

    Within 2e-16 of the true values, and exact at multiples of 90 degrees, which a conversion
    to radians would miss.

    Parameters
    ----------
    degrees : float
        Below 1e15 in size.

    Returns
    -------
    sine, cosine : float

    Examples
    --------
    >>> sine_and_cosine(-90.0)
    (-1.0, 0.0)
    """
    quarters = (degrees * (1.0 / 90.0) + _TO_WHOLE) - _TO_WHOLE
    r = degrees - 90.0 * quarters
    quadrant = quarters - 4.0 * ((quarters * 0.25 + _TO_WHOLE) - _TO_WHOLE)  # −2 … 2
    z = r * r
    p = _SIN6
    p = p * z + _SIN5
    p = p * z + _SIN4
    p = p * z + _SIN3
    p = p * z + _SIN2
    p = p * z + _SIN1
    p = p * z + _SIN0
    small = r * p
    p = _COS6
    p = p * z + _COS5
    p = p * z + _COS4
    p = p * z + _COS3
    p = p * z + _COS2
    p = p * z + _COS1
    p = p * z + _COS0
    large = 1.0 + z * p
    odd = quadrant * quadrant == 1.0
    sine = large if odd else small
    cosine = small if odd else large
    if quadrant < -0.5 or quadrant > 1.5:
        sine = -sine
    if quadrant > 0.5 or quadrant < -1.5:
        cosine = -cosine
    return sine, cosine
