"""Runs that write compact files: what a scheme needs in bytes, not only in keyframes."""

from __future__ import annotations

import time
import warnings
from dataclasses import dataclass
from typing import Any

import numpy as np

from workbench.compact import compact_bytes, compact_motion, compare_sizes
from workbench.errors import WorkbenchError
from workbench.experiments.runs.schemes import Scheme, SchemeRun
from workbench.experiments.runs.shared import SharedSteps, messages
from workbench.experiments.store import Arrays, Row
from workbench.results import Result, SpatialResult
from workbench.schemes import SpatialScheme, TemporalScheme
from workbench.spaces import PoseSpace


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
        motion = poses_of(shared).motion
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
        space = poses_of(shared)
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


def poses_of(shared: SharedSteps) -> PoseSpace:
    """Give the space as a motion's; a table has no compact file."""
    if not isinstance(shared.space, PoseSpace):
        raise WorkbenchError(f"data: got the table {shared.space.name!r}, want a motion")
    return shared.space
