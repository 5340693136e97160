"""Runs that find out how many keyframes make the files of two schemes equally large."""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any

from workbench.experiments.runs.compaction import poses_of, run_from_shared_projection, written
from workbench.experiments.runs.schemes import Scheme, SchemeRun, scheme_name
from workbench.experiments.runs.shared import SharedSteps
from workbench.experiments.store import Arrays, Row
from workbench.validation import control_point_count


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
        space = poses_of(shared)
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
