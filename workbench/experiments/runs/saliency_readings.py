"""Runs of the saliency method with its ambiguous steps read in every way."""

from __future__ import annotations

import time
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.errors import WorkbenchError
from workbench.experiments.runs.keyframes import motion_curves
from workbench.experiments.runs.shared import SharedSteps
from workbench.experiments.store import Arrays, Row
from workbench.mocap.curve_saliency import saliency_maps
from workbench.mocap.motion_saliency import motion_saliency
from workbench.quality.animation import angle_errors, psnr_of_error
from workbench.selection.curves import rebuilt_linearly

#: What a saliency map is stretched to before it is multiplied by (M − m)²: the largest value
#: of the curve's maps, that of the motion's, or nothing.
NORMALIZATIONS = ("curve", "motion", "none")
#: What a candidate exceeds: the mean of its curve, the mean over all curves, or, summed over
#: the curves, the mean of the sums.
THRESHOLDS = ("curve", "motion", "summed")


@dataclass(frozen=True)
class SaliencyReadingRun:
    """The saliency method on one motion, with each ambiguous step read in one way.

    The maps are the library's; they are normalised and compared here, so that readings which
    the library does not offer can be tried. The default ones are those of
    :func:`~workbench.mocap.motion_saliency.motion_saliency`.

    Parameters
    ----------
    dataset : str
        Name that :func:`workbench.load_space` knows, or the path of a file; a clip, or a table
        of joint angles.
    sigma : float
        σ in frames.
    n_components : int
        k.
    cluster_width : float
        The most frames of a cluster, in σ.
    curvature : {"slope", "value"}
        What the curvature's denominator takes: D′² or, as printed, D² (Eq. 3.4).
    unit_variance : bool
        Whether the columns are brought to unit variance, not only to zero mean (Eq. 3.1).
    normalization : {"curve", "motion", "none"}
        See :data:`NORMALIZATIONS`.
    threshold : {"curve", "motion", "summed"}
        See :data:`THRESHOLDS`.

    Raises
    ------
    WorkbenchError
        If the normalisation or the threshold is another.

    Examples
    --------
    >>> print(SaliencyReadingRun("cmu-amc/13_29", cluster_width=2.0))
    cmu-amc/13_29, clusters of 2σ, slope, unit variance, curve, curve
    """

    dataset: str
    sigma: float = 10.0
    n_components: int = 7
    cluster_width: float = 4.0
    curvature: str = "slope"
    unit_variance: bool = True
    normalization: str = "curve"
    threshold: str = "curve"

    def __post_init__(self) -> None:
        for name, known in (("normalization", NORMALIZATIONS), ("threshold", THRESHOLDS)):
            if getattr(self, name) not in known:
                got = getattr(self, name)
                raise WorkbenchError(f"{name}: got {got!r}, want one of {', '.join(known)}")

    @property
    def standardize(self) -> bool:
        """The columns are standardised by the method itself."""
        return False

    def __str__(self) -> str:
        columns = "unit variance" if self.unit_variance else "zero mean"
        return (
            f"{self.dataset}, clusters of {self.cluster_width:g}σ, {self.curvature}, {columns}, "
            f"{self.normalization}, {self.threshold}"
        )

    def specification(self) -> dict[str, Any]:
        """Describe the run by plain values, as stored with its result."""
        return asdict(self)

    def execute(self, shared: SharedSteps) -> tuple[Row, Arrays]:
        """Execute the run.

        Parameters
        ----------
        shared : SharedSteps
            The motion.

        Returns
        -------
        row : dict
            ``n_keyframes``, as the method gives them, and ``psnr`` of joint angles interpolated
            linearly between these and the ends of the clip, in dB; ``n_control_points`` with
            the ends; None for a ratio where nothing is lost.
        arrays : dict of str to ndarray
            ``control_points`` (n_control_points,).
        """
        values = motion_curves(shared.space)
        start = time.perf_counter()
        keyframes = self._keyframes(values)
        seconds = time.perf_counter() - start
        keys = np.union1d(keyframes, [0, len(values) - 1])
        error = float(angle_errors(values, rebuilt_linearly(values, keys)).mean())
        row: Row = {
            "n_samples": len(values),
            "n_control_points": len(keys),
            "n_keyframes": len(keyframes),
            "psnr": float(psnr_of_error(error)) if error > 0.0 else None,
            "seconds_total": seconds,
        }
        return row, {"control_points": keys}

    def _keyframes(self, values: NDArray[np.float64]) -> NDArray[np.intp]:
        # Components, eigenvalues and clusters are not ambiguous, and are taken from there.
        found = motion_saliency(
            values,
            self.sigma,
            self.n_components,
            standardize=self.unit_variance,
            curvature=self.curvature,
            cluster_width=self.cluster_width,
        )
        maps = saliency_maps(found.curves, self.sigma, curvature=self.curvature)
        saliency = _saliency(maps, self.normalization)
        if self.threshold == "curve":
            candidates = saliency > saliency.mean(axis=0)
        elif self.threshold == "motion":
            candidates = saliency > saliency.mean()
        else:
            sums = saliency.sum(axis=1, keepdims=True)
            candidates = np.repeat(sums > sums.mean(), saliency.shape[1], axis=1)
        read = replace(found, saliency=saliency, candidates=candidates)
        return read.keyframes_of_clusters(found.cluster_length)


def _saliency(maps: NDArray[np.float64], normalization: str) -> NDArray[np.float64]:
    """Normalise the maps of each curve and add them: (n_frames, n_curves)."""
    largest = maps.max(axis=(0, 1)) if normalization == "curve" else maps.max()
    lowest = maps.min(axis=1, keepdims=True)
    spread = maps.max(axis=1, keepdims=True) - lowest
    if normalization != "none":
        maps = (maps - lowest) * largest / np.where(spread > 0.0, spread, np.inf)
    result = np.zeros(maps.shape[1:])
    for scale in maps:
        for j, curve in enumerate(scale.T):
            result[:, j] += curve * (curve.max() - _mean_of_other_peaks(curve)) ** 2
    return result


def _mean_of_other_peaks(curve: NDArray[np.float64]) -> float:
    """Average the local maxima without the largest; 0 if there is no other."""
    padded = np.concatenate([[-np.inf], curve, [-np.inf]])
    peaks = curve[(curve > padded[:-2]) & (curve >= padded[2:])]
    return float((peaks.sum() - peaks.max()) / (len(peaks) - 1)) if len(peaks) > 1 else 0.0
