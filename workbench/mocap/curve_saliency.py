"""Saliency of curves: where a curve bends otherwise than its surroundings do."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from numbers import Real

import numba
import numpy as np
from numpy.typing import ArrayLike, NDArray

from workbench.errors import WorkbenchError
from workbench.kernels import compiled
from workbench.validation import MIN_SAMPLES, finite

#: Widths of the four centre windows, in σ; the surround of each is twice as wide (Eq. 3.7).
SCALES = (1.0, 1.5, 2.0, 2.5)

CURVATURES = ("slope", "value")

# Differences below this share of the largest value are rounding errors of a curve that has
# been centred, scaled and projected; amplified by the normalisation they would look salient.
_ROUNDING = 1e-10


def curve_saliency(
    curves: ArrayLike, sigma: float, *, curvature: str = "slope"
) -> NDArray[np.float64]:
    """Measure how salient each frame of each curve is.

    The centre-surround operator of Halit 2010, section 3.1.2, on the curvature C of a curve
    (see :func:`curve_curvature`). With G(f, s) the Gaussian-weighted mean of C over the frames
    within 2s of f (Eq. 3.5, read with C(x) in the sum, and with the weights of the frames
    inside the clip adding up to 1), four maps

        S_i(f) = |G(f, σ_i) − G(f, 2σ_i)|, σ_i = σ, 1.5σ, 2σ, 2.5σ    (Eq. 3.6, 3.7)

    are each stretched to [0, H], H being the largest value of the curve's four maps,
    multiplied by (H − m_i)², m_i being the mean of the map's local maxima without the
    largest, and added. A map with one outstanding peak thus counts, and a map with many
    equal ones hardly does.

    Parameters
    ----------
    curves : array-like of shape (n_frames, n_curves)
        The curves, sampled at equal intervals.
    sigma : float
        σ in frames, at least 1.
    curvature : {"slope", "value"}
        What the denominator of the curvature takes, see :func:`curve_curvature`.

    Returns
    -------
    ndarray of shape (n_frames, n_curves)
        At least 0, in units that differ from curve to curve; 0 everywhere for a curve without
        curvature.

    Raises
    ------
    WorkbenchError
        If there are fewer than 3 frames, numbers that are not finite, or σ is below 1.

    Examples
    --------
    >>> frames = np.arange(101.0)
    >>> bump = np.exp(-(((frames - 50.0) / 4.0) ** 2))
    >>> int(curve_saliency(bump[:, None], sigma=2).argmax())
    50
    """
    bends = np.ascontiguousarray(curve_curvature(curves, curvature).T)
    sigma = check_sigma(sigma)
    saliency = np.zeros(bends.shape)
    # One share of the curves for each thread that compiled kernels use too.
    n_shares = max(1, min(len(bends), numba.get_num_threads()))
    shares = [slice(start, None, n_shares) for start in range(n_shares)]
    with ThreadPoolExecutor(n_shares) as pool:
        list(pool.map(lambda share: _add_saliency(bends[share], sigma, saliency[share]), shares))
    return np.ascontiguousarray(saliency.T)


def saliency_maps(
    curves: ArrayLike, sigma: float, *, curvature: str = "slope"
) -> NDArray[np.float64]:
    """Compute the four maps of which :func:`curve_saliency` makes one.

    For a look at the scales one by one, or to put the maps together in another way.

    Parameters
    ----------
    curves, sigma, curvature
        As for :func:`curve_saliency`.

    Returns
    -------
    ndarray of shape (4, n_frames, n_curves)
        |G(f, σ_i) − G(f, 2σ_i)| at the scales of :data:`SCALES` (Halit 2010, Eq. 3.5 to 3.7).

    Raises
    ------
    WorkbenchError
        If there are fewer than 3 frames, numbers that are not finite, or σ is below 1.

    Examples
    --------
    >>> bump = np.exp(-(((np.arange(101.0) - 50.0) / 4.0) ** 2))
    >>> saliency_maps(bump[:, None], sigma=2).argmax(axis=1).ravel()
    array([50, 50, 50, 50])
    """
    bends = np.ascontiguousarray(curve_curvature(curves, curvature).T)
    centre_surround = _CentreSurround(check_sigma(sigma), bends.shape[1])
    return np.stack([np.abs(centre_surround(bend)) for bend in bends], axis=-1)


def _add_saliency(bends: NDArray[np.float64], sigma: float, saliency: NDArray[np.float64]) -> None:
    """Add the four maps of curves, whose curvature is given, to their saliency, in place."""
    centre_surround = _CentreSurround(sigma, bends.shape[1])
    for bend, total in zip(bends, saliency, strict=True):
        _add_maps(centre_surround(bend), _ROUNDING * bend.max(), total)


def curve_curvature(curves: ArrayLike, curvature: str = "slope") -> NDArray[np.float64]:
    """Compute the curvature of each curve in each frame.

    |D″| / (1 + D′²)^{3/2} for ``"slope"``, which is the curvature of the graph of D; with D²
    in place of D′² for ``"value"``, as Halit 2010, Eq. 3.4 prints it. Derivatives are central
    differences per frame; the first and the last frame take the D″ of their neighbours.

    Parameters
    ----------
    curves : array-like of shape (n_frames, n_curves)
        The curves.
    curvature : {"slope", "value"}
        What stands in the denominator.

    Returns
    -------
    ndarray of shape (n_frames, n_curves)
        Exactly 0 where a curve is straight to within rounding.

    Raises
    ------
    WorkbenchError
        If there are fewer than 3 frames, or numbers that are not finite.

    Examples
    --------
    >>> curve_curvature([[0.0], [0.0], [1.0], [2.0]], "value").ravel()
    array([1., 1., 0., 0.])
    """
    values = as_curves(curves)
    if curvature not in CURVATURES:
        raise WorkbenchError(f"curvature: got {curvature!r}, want one of {', '.join(CURVATURES)}")
    result = np.empty(values.shape)
    _bend(values, _ROUNDING * np.abs(values).max(axis=0), curvature == "slope", result)
    return result


@compiled
def _bend(values, rounding, by_slope, result):  # type: ignore[no-untyped-def]  # compiled
    """Write the curvature of each column of ``values``."""
    last = len(values) - 1
    for f in range(last + 1):
        before, after = max(f - 1, 0), min(f + 1, last)
        middle = min(max(f, 1), last - 1)
        for j in range(values.shape[1]):
            second = values[middle + 1, j] - 2.0 * values[middle, j] + values[middle - 1, j]
            below = values[f, j]
            if by_slope:
                below = (values[after, j] - values[before, j]) / (after - before)
            below = 1.0 + below * below
            result[f, j] = 0.0
            if abs(second) > rounding[j]:
                result[f, j] = abs(second) / (below * np.sqrt(below))


def as_curves(values: ArrayLike, name: str = "curves") -> NDArray[np.float64]:
    """Check curves.

    Parameters
    ----------
    values : array-like of shape (n_frames, n_curves)
        The curves.
    name : str
        The argument's name, for the message.

    Returns
    -------
    ndarray of shape (n_frames, n_curves)

    Raises
    ------
    WorkbenchError
        If they are no numbers, of another shape, not finite, or fewer than 3 frames.
    """
    try:
        array = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise WorkbenchError(f"{name}: got what is no array of numbers") from None
    if array.ndim != 2 or len(array) < MIN_SAMPLES:
        raise WorkbenchError(
            f"{name}: got shape {array.shape}, want (n_frames, n_curves), "
            f"at least {MIN_SAMPLES} frames"
        )
    return finite(array, name)


def check_sigma(sigma: float, name: str = "sigma") -> float:
    """Refuse a width of the Gaussian window that is no number of frames.

    Raises
    ------
    WorkbenchError
        If it is no finite number from 1 on: a narrower window holds too few frames.
    """
    is_number = isinstance(sigma, Real) and not isinstance(sigma, bool)
    if not is_number or not 1.0 <= sigma < np.inf:
        raise WorkbenchError(f"{name}: got {sigma!r}, want a number of frames, at least 1")
    return float(sigma)


class _CentreSurround:
    """The differences G(f, σ_i) − G(f, 2σ_i) of one curve after the other.

    The curve is cut into overlapping blocks that fit the processor's cache, whose Fourier
    transform serves all windows; so the time is linear in the number of frames and hardly
    depends on σ. Where all of both windows is inside the clip, their difference is one
    filter. In the blocks at the ends each window has a mean of its own, which counts the
    frames inside only.
    """

    def __init__(self, sigma: float, n_frames: int) -> None:
        from scipy.fft import next_fast_len, rfft

        centres = sigma * np.array(SCALES)
        widths = np.concatenate([centres, 2.0 * centres])
        # Weights beyond the clip never meet a frame.
        reaches = np.minimum(2.0 * widths, n_frames - 1).astype(np.intp)
        radius = int(reaches.max())
        block = next_fast_len(min(max(1024, 10 * radius), n_frames + 2 * radius), True)
        step = block - 2 * radius
        n_blocks = -(-n_frames // step)
        self.n_frames, self.radius, self.step = n_frames, radius, step

        kernels = np.zeros((len(widths), block))
        inside = np.ones((len(widths), n_blocks * step))
        for kernel, share, width, reach in zip(kernels, inside, widths, reaches, strict=True):
            weights = np.exp(-0.5 * (np.arange(reach + 1) / width) ** 2)
            weights /= weights[0] + 2.0 * weights[1:].sum()
            kernel[: reach + 1] = weights
            kernel[block - reach :] = weights[:0:-1]
            beyond = np.cumsum(weights[:0:-1])[::-1]
            share[:reach] -= beyond
            share[n_frames - reach : n_frames] -= beyond[::-1]
        self.windows = rfft(kernels).real  # the kernels are even
        self.filters = self.windows[: len(SCALES)] - self.windows[len(SCALES) :]
        # A block is longer than two windows reach, so that the clip's end is in the last two.
        self.end_blocks = np.unique(np.clip([0, n_blocks - 2, n_blocks - 1], 0, None))
        self.inside = inside.reshape(len(widths), n_blocks, step)[:, self.end_blocks]

        # Written over for each curve, because fresh pages of memory take longer than the sums.
        self._padded = np.zeros(n_blocks * step + 2 * radius)
        self._products = np.empty((n_blocks, self.windows.shape[1]), dtype=np.complex128)
        self._differences = np.empty((len(SCALES), n_blocks, step))

    def __call__(self, curve: NDArray[np.float64]) -> NDArray[np.float64]:
        """Filter a curve of shape (n_frames,); return (n_scales, n_frames), until the next."""
        from scipy.fft import irfft, rfft

        length = self.step + 2 * self.radius
        middle = slice(self.radius, self.radius + self.step)
        self._padded[self.radius : self.radius + self.n_frames] = curve
        blocks = np.lib.stride_tricks.sliding_window_view(self._padded, length)[:: self.step]
        transformed = rfft(blocks)
        for difference, spectrum in zip(self._differences, self.filters, strict=True):
            np.multiply(transformed, spectrum, out=self._products)
            difference[:] = irfft(self._products, length, overwrite_x=True)[:, middle]
        at_ends = transformed[self.end_blocks] * self.windows[:, None]
        means = irfft(at_ends, length)[..., middle] / self.inside
        self._differences[:, self.end_blocks] = means[: len(SCALES)] - means[len(SCALES) :]
        return self._differences.reshape(len(SCALES), -1)[:, : self.n_frames]


@compiled
def _add_maps(differences, rounding, saliency):  # type: ignore[no-untyped-def]  # compiled
    """Add the normalised absolute values of a curve's differences to its saliency."""
    n_maps, n_frames = differences.shape
    lowest = np.empty(n_maps)
    highest = np.empty(n_maps)
    for i in range(n_maps):
        row = differences[i]
        low, high = np.inf, 0.0
        for f in range(n_frames):
            value = abs(row[f])
            if value <= rounding:
                value = 0.0
            row[f] = value
            low, high = min(low, value), max(high, value)
        lowest[i], highest[i] = low, high
    largest = highest.max()
    for i in range(n_maps):
        spread = highest[i] - lowest[i]
        if spread <= 0.0:
            continue
        row = differences[i]
        # A peak is a run of equal values with lower ones on both sides, or with the clip's end.
        n_peaks, peaks, rising = 0, 0.0, True
        for f in range(n_frames):
            if f + 1 == n_frames or row[f + 1] < row[f]:
                if rising:
                    n_peaks += 1
                    peaks += row[f]
                rising = False
            elif row[f + 1] > row[f]:
                rising = True
        mean_peak = 0.0
        if n_peaks > 1:
            mean_peak = (peaks - highest[i]) / (n_peaks - 1) - lowest[i]
        scale = largest / spread
        factor = scale * (largest - scale * mean_peak) ** 2
        for f in range(n_frames):
            saliency[f] += factor * (row[f] - lowest[i])
