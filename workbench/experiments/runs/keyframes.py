"""Runs of keyframe selectors with parameters, judged as Halit 2010 judges them."""

from __future__ import annotations

import math
import time
import warnings
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.errors import WorkbenchError
from workbench.experiments.runs.shared import SharedSteps, messages
from workbench.experiments.store import Arrays, Row
from workbench.interpolation.slerp import Slerp
from workbench.mocap.channels import motion_to_euler
from workbench.mocap.kinematics import body_positions
from workbench.mocap.motion import Motion
from workbench.quality.animation import (
    FEMUR_LENGTH,
    N_DIMENSIONS,
    angle_errors,
    body_coordinate_error,
    femur_length,
    psnr,
    psnr_of_error,
)
from workbench.selection import selectors
from workbench.selection.curves import curve_keyframes, rebuilt_linearly
from workbench.selection.saliency import CURVES
from workbench.spaces import PoseSpace, Space

Parameters = tuple[tuple[str, Any], ...]


@dataclass(frozen=True)
class KeyframeRun:
    """One selector of keyframes on one motion, the keyframes judged by what they rebuild.

    A motion is a clip, or the table of its joint angles in degrees where the skeleton is
    missing, as :func:`workbench.load` gives it for an AMC file alone. Selectors of registered
    names work on the poses of a clip; on curves of numbers, which are a table's columns or
    the joint positions of a clip, those of :data:`~workbench.selection.curves.CURVE_SELECTORS`
    do. One of them is not registered: ``"exact"``, which on clips takes joint angles, see
    :func:`~workbench.selection.curves.least_squares_keyframes`.

    Parameters
    ----------
    dataset : str
        Name that :func:`workbench.load_space` knows, or the path of a file.
    selector : str
        Its name.
    parameters : tuple of (str, value)
        Parameters of the selector, such as ``(("sigma", 10.0), ("n_components", 7))``.
    counted_by : tuple of (str, value), optional
        Parameters of the saliency method: as many keyframes are selected as it chooses with
        them. By default the selector decides, which only ``"saliency"`` can.
    curves : {"angles", "positions"}
        Joint angles, or joint positions in the root's own frame (Halit 2010, section 4.3).

    Raises
    ------
    WorkbenchError
        If nothing decides how many keyframes there are, or the curves are others.

    Examples
    --------
    >>> print(KeyframeRun("cmu/05_10", "pb", counted_by=(("sigma", 3.0),)))
    cmu/05_10, pb, as many as saliency (sigma=3.0)
    """

    dataset: str
    selector: str = "saliency"
    parameters: Parameters = ()
    counted_by: Parameters | None = None
    curves: str = "angles"

    def __post_init__(self) -> None:
        if self.counted_by is None and self.selector != "saliency":
            raise WorkbenchError(
                f"counted_by: got None for {self.selector!r}, want the parameters of the "
                "saliency method that say how many keyframes there are"
            )
        if self.curves not in CURVES:
            raise WorkbenchError(f"curves: got {self.curves!r}, want one of {', '.join(CURVES)}")

    @property
    def standardize(self) -> bool:
        """Angles are in degrees; the saliency method brings them to unit variance itself."""
        return False

    def __str__(self) -> str:
        text = f"{self.dataset}, {self.selector}{_listed(self.parameters)}"
        if self.counted_by is not None:
            text += f", as many as saliency{_listed(self.counted_by)}"
        return text + (", body coordinates" if self.curves == "positions" else "")

    def specification(self) -> dict[str, Any]:
        """Describe the run by plain values, as stored with its result."""
        values = asdict(self)
        for name in ("parameters", "counted_by"):
            chosen = getattr(self, name)
            values[name] = None if chosen is None else _listed(chosen).strip(" ()")
        return values

    def execute(self, shared: SharedSteps) -> tuple[Row, Arrays]:
        """Execute the run.

        Parameters
        ----------
        shared : SharedSteps
            The motion.

        Returns
        -------
        row : dict
            ``n_control_points``; ``psnr``, that of joint angles interpolated linearly
            between keyframes, in dB (Eq. 4.2), with their ``mean_squared_error`` in squared
            degrees; where there is a skeleton, ``psnr_slerp`` by interpolated rotations, their
            ``body_error`` (Eq. 4.1) and their ``error``, D_q per frame and joint. For
            positions only ``body_error``, of positions interpolated linearly. None is what
            cannot be had, and the ratio of what loses nothing. ``seconds_select``.
        arrays : dict of str to ndarray
            ``control_points`` (n_control_points,).
        """
        space = shared.space
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            count = None if self.counted_by is None else len(self._count(space, self.counted_by))
            start = time.perf_counter()
            keys = self._select(space, count)
            seconds = time.perf_counter() - start
        quality = self._quality(space, keys)
        row: Row = {
            "n_samples": len(space),
            "n_control_points": len(keys),
            **quality,
            "warnings": "; ".join(messages(caught)),
            "seconds_select": seconds,
            "seconds_total": seconds,
        }
        return row, {"control_points": keys}

    def _count(self, space: Space, parameters: Parameters) -> NDArray[np.intp]:
        if isinstance(space, PoseSpace):
            saliency = selectors.create("saliency", **dict(parameters), curves=self.curves)
            return saliency.select(space)
        return curve_keyframes(space.samples, "saliency", None, **dict(parameters))

    def _select(self, space: Space, count: int | None) -> NDArray[np.intp]:
        if self.selector == "saliency" and count is None:
            return self._count(space, self.parameters)
        on_curves = self.selector == "exact" or self.curves == "positions"
        if isinstance(space, PoseSpace) and not on_curves:
            selector = selectors.create(self.selector, **dict(self.parameters))
            return selector.select(space, count)
        values = motion_curves(space, self.curves)
        return curve_keyframes(values, self.selector, count, **dict(self.parameters))

    def _quality(self, space: Space, keys: NDArray[np.intp]) -> Row:
        values = motion_curves(space, self.curves)
        rebuilt = rebuilt_linearly(values, keys)
        if self.curves == "positions":
            assert isinstance(space, PoseSpace)
            return {"body_error": _error_of_positions(space.motion, rebuilt - values)}
        error = float(angle_errors(values, rebuilt).mean())
        row: Row = {"mean_squared_error": error, "psnr": _decibels(error)}
        if isinstance(space, PoseSpace):
            rotations = Slerp().interpolate(space.motion, keys)
            ratio = psnr(space.motion, rotations)
            row["psnr_slerp"] = ratio if math.isfinite(ratio) else None
            row["body_error"] = _body_error(space.motion, rotations)
            row["error"] = float(space.errors(np.arange(len(space)), rotations).mean())
        return row


def motion_curves(space: Space, curves: str = "angles") -> NDArray[np.float64]:
    """Give the curves of a motion, with or without a skeleton.

    Parameters
    ----------
    space : PoseSpace or VectorSpace
        A clip, or the table of its joint angles.
    curves : {"angles", "positions"}
        Unwrapped joint angles in degrees, or joint positions in the root's own frame.

    Returns
    -------
    ndarray of shape (n_frames, n_curves)

    Raises
    ------
    WorkbenchError
        If positions are wanted of a table.
    """
    if not isinstance(space, PoseSpace):
        if curves != "angles":
            raise WorkbenchError(f"curves: {space.name!r} has no skeleton, so only 'angles'")
        return space.samples
    if curves == "angles":
        return motion_to_euler(space.motion, unwrap=True)
    # The root's own position is zero throughout.
    return body_positions(space.motion)[:, 1:].reshape(len(space), -1)


def _error_of_positions(motion: Motion, differences: NDArray[np.float64]) -> float | None:
    """Compute Eq. 4.1 from differences of positions; None without a femur to scale them by."""
    try:
        scale = FEMUR_LENGTH / femur_length(motion.skeleton)
    except WorkbenchError:
        return None
    return float(np.sum((scale * differences) ** 2) / (len(differences) * N_DIMENSIONS))


def _body_error(motion: Motion, rotations: NDArray[np.float64]) -> float | None:
    try:
        return body_coordinate_error(motion, rotations, femur=femur_length(motion.skeleton))
    except WorkbenchError:
        return None


def _decibels(error: float) -> float | None:
    return float(psnr_of_error(error)) if error > 0.0 else None


def _listed(parameters: Parameters) -> str:
    """Write parameters as a call would: " (sigma=3.0, n_components=10)"."""
    return f" ({', '.join(f'{name}={value}' for name, value in parameters)})" if parameters else ""
