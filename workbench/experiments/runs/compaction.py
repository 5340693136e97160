"""Runs that write compact files: what a scheme needs in bytes, not only in keyframes."""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from workbench.compact import compact_bytes, compact_motion, compare_sizes
from workbench.errors import WorkbenchError
from workbench.experiments.runs.schemes import Scheme, SchemeRun, scheme_name
from workbench.experiments.runs.shared import SharedSteps, messages
from workbench.experiments.store import Arrays, Row
from workbench.results import Result, SpatialResult
from workbench.schemes import SpatialScheme, TemporalScheme
from workbench.spaces import PoseSpace
from workbench.validation import control_point_count


@dataclass(frozen=True)
class MotionFormsRun:
    """The bytes of a whole motion in other forms, which compact files are compared with.

    Parameters
    ----------
    dataset : str
        Name of a clip.
    """

    dataset: str
    standardize: bool = False

    def specification(self) -> dict[str, Any]:
        """Describe the run by plain values, as stored with its result."""
        return {"dataset": self.dataset, "kind": "forms", "standardize": self.standardize}

    def execute(self, shared: SharedSteps) -> tuple[Row, Arrays]:
        """Write the motion as BVH, and compress that.

        Returns
        -------
        row : dict
            ``n_samples``, ``n_joints``; ``bvh_bytes``, ``gzip_bytes`` and ``float32_bytes``
            as :class:`workbench.compact.Sizes` describes them.
        arrays : dict
            Empty.
        """
        motion = _poses(shared).motion
        sizes = compare_sizes(1, motion)
        row: Row = {
            "n_samples": len(motion),
            "n_joints": motion.skeleton.n_joints,
            "bvh_bytes": sizes.bvh_bytes,
            "gzip_bytes": sizes.gzip_bytes,
            "float32_bytes": sizes.float32_bytes,
        }
        return row, {}


@dataclass(frozen=True)
class CompactionRun(SchemeRun):
    """One scheme on one clip, and the file that its result is written to.

    Parameters
    ----------
    dataset, scheme, ratio, count, seed, standardize
        As for :class:`~workbench.experiments.runs.schemes.SchemeRun`.
    """

    def execute(self, shared: SharedSteps) -> tuple[Row, Arrays]:
        """Execute the scheme and write its compact file.

        Parameters
        ----------
        shared : SharedSteps
            The space and its projections.

        Returns
        -------
        row : dict
            ``error`` of the scheme; ``file_error`` of what the file gives, after rounding;
            ``bytes`` of the file. For spatial schemes also ``plane_error``, if only the
            projected keyframes were stored and the other positions interpolated, linearly in
            time, between them.
        arrays : dict of str to ndarray
            ``errors`` (n_frames,), ``control_points`` (n_keyframes,) and for spatial schemes
            ``plane_errors`` (n_frames,).
        """
        space = _poses(shared)
        start = time.perf_counter()
        with warnings.catch_warnings(record=True) as caught:
            result = run_from_shared_projection(
                shared, self.scheme, self.seed, ratio=self.ratio, count=self.count
            )
            file_error, n_bytes = written(self.scheme, result)
        row: Row = {
            "n_samples": len(space),
            "n_control_points": len(result.control_points),
            "error": result.error,
            "file_error": file_error,
            "bytes": n_bytes,
            "warnings": "; ".join(messages(caught)),
            "seconds_total": time.perf_counter() - start,
        }
        arrays: Arrays = {"errors": result.errors, "control_points": result.control_points}
        if isinstance(result, SpatialResult):
            arrays["plane_errors"] = interpolated_in_the_plane(space, result)
            row["plane_error"] = float(arrays["plane_errors"].mean())
        return row, arrays


@dataclass(frozen=True)
class EqualSizeRun:
    """A scheme with as many keyframes as make its file as large as another scheme's.

    Schemes of equal keyframe counts are not equally large: one stores positions that the
    other does without. This run finds the largest count at which the file is no larger than
    the other's.

    Parameters
    ----------
    dataset : str
        Name of a clip.
    scheme : TemporalScheme or SpatialScheme
        The scheme whose number of keyframes is looked for; the smaller at equal counts.
    reference : TemporalScheme or SpatialScheme
        The other scheme.
    ratio : float
        Share of the frames that are keyframes of the other scheme.
    seed : int
        Seed of both.

    Raises
    ------
    WorkbenchError
        If a method is not a name.
    """

    dataset: str
    scheme: Scheme
    reference: Scheme
    ratio: float
    seed: int = 0
    standardize: bool = False

    def __post_init__(self) -> None:
        for scheme in (self.scheme, self.reference):
            SchemeRun(self.dataset, scheme, ratio=self.ratio)

    def __str__(self) -> str:
        return (
            f"{self.dataset}, {scheme_name(self.scheme)} as large as "
            f"{scheme_name(self.reference)} at {100 * self.ratio:.4g} %, seed {self.seed}"
        )

    def specification(self) -> dict[str, Any]:
        """Describe the run by plain values, as stored with its result."""
        reference = {f"reference_{key}": value for key, value in asdict(self.reference).items()}
        return {
            "dataset": self.dataset,
            "kind": "equal size",
            **asdict(self.scheme),
            "scheme": scheme_name(self.scheme),
            **reference,
            "reference": scheme_name(self.reference),
            "ratio": self.ratio,
            "seed": self.seed,
            "standardize": self.standardize,
        }

    def execute(self, shared: SharedSteps) -> tuple[Row, Arrays]:
        """Look for the number of keyframes.

        Parameters
        ----------
        shared : SharedSteps
            The space and its projections.

        Returns
        -------
        row : dict
            ``n_control_points``, ``file_error``, ``bytes`` of the scheme; with ``reference_``
            before them, of the other scheme. The errors are those of what the files give.
        arrays : dict
            Empty.
        """
        space = _poses(shared)
        start_seconds = time.perf_counter()
        tried: dict[int, tuple[float, int]] = {}

        def bytes_with(count: int) -> int:
            if count not in tried:
                result = run_from_shared_projection(shared, self.scheme, self.seed, count=count)
                tried[count] = written(self.scheme, result)
            return tried[count][1]

        with warnings.catch_warnings():
            # Rounding and coinciding markers are told of by the runs at equal counts.
            warnings.simplefilter("ignore")
            result = run_from_shared_projection(shared, self.reference, self.seed, ratio=self.ratio)
            error, n_bytes = written(self.reference, result)
            start = control_point_count(len(space), ratio=self.ratio)
            count = largest_count(bytes_with, n_bytes, start, len(space))
        row: Row = {
            "n_samples": len(space),
            "n_control_points": count,
            "file_error": tried[count][0],
            "bytes": tried[count][1],
            "reference_n_control_points": len(result.control_points),
            "reference_file_error": error,
            "reference_bytes": n_bytes,
            "seconds_total": time.perf_counter() - start_seconds,
        }
        return row, {}


def largest_count(size: Callable[[int], int], limit: int, start: int, most: int) -> int:
    """Find the largest count whose size is no larger than a limit.

    The size grows with the count, but for steps of rounding: of counts that are larger than
    one that is too large, none is tried.

    Parameters
    ----------
    size : callable
        Size at a count.
    limit : int
        The limit.
    start : int
        Where to begin.
    most : int
        The largest count there is.

    Returns
    -------
    int
        The smallest count, 3, if all are too large.

    Examples
    --------
    >>> largest_count(lambda count: 10 * count, 256, start=3, most=100)
    25
    """
    fits, too_large, step = 2, most + 1, 1
    count = start
    while fits < count < too_large:
        if size(count) <= limit:
            fits, count = count, min(count + step, too_large)
        else:
            too_large, count = count, max(count - step, fits)
        step *= 2
    while too_large - fits > 1:
        count = (fits + too_large) // 2
        if size(count) <= limit:
            fits = count
        else:
            too_large = count
    if fits < 3:
        size(3)
    return max(fits, 3)


def written(scheme: Scheme, result: Result) -> tuple[float, int]:
    """Write the compact file of a scheme's result; give the error of what it holds, its bytes."""
    interpolator = None
    if isinstance(scheme, TemporalScheme):
        assert isinstance(scheme.interpolator, str)
        interpolator = scheme.interpolator
    compact = compact_motion(result, interpolator)
    return compact.error, len(compact_bytes(compact))


def run_from_shared_projection(
    shared: SharedSteps, scheme: Scheme, seed: int, **amount: Any
) -> Result:
    """Run a scheme, from the projection that other runs on the space start from if it can."""
    options: dict[str, Any] = {**amount, "random_state": seed}
    if isinstance(scheme, SpatialScheme) and scheme.two_step is None:
        projection = shared.projection(scheme.projector, seed, scheme.dimensions)
        options["projected"] = projection.embedding
    return scheme.run(shared.space, **options)


def interpolated_in_the_plane(space: PoseSpace, result: SpatialResult) -> np.ndarray:
    """Measure the errors of frames placed on straight lines between the projected keyframes.

    Costa 2018, section 5.1: what if the positions of the frames between keyframes were not
    stored? Each is put between the two keyframes beside it, as far along as it is in time.

    Parameters
    ----------
    space : PoseSpace
        The motion.
    result : SpatialResult
        Of a spatial scheme; its control points are the keyframes.

    Returns
    -------
    ndarray of shape (n_frames,)
        Error of each frame; 0 at the keyframes.
    """
    keys = result.control_points
    frames = np.arange(len(space))
    places = np.stack(
        [np.interp(frames, keys, column) for column in result.embedding[keys].T], axis=1
    )
    free = np.setdiff1d(frames, keys)
    errors = np.zeros(len(space))
    errors[free] = space.errors(free, result.back_projector.predict(places[free]))
    return errors


def _poses(shared: SharedSteps) -> PoseSpace:
    if not isinstance(shared.space, PoseSpace):
        raise WorkbenchError(f"data: got the table {shared.space.name!r}, want a motion")
    return shared.space
