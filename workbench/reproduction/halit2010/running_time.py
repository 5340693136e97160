"""Figure 4.2 of Halit 2010: the time of the saliency method."""

from __future__ import annotations

import numpy as np
import pandas as pd

from workbench.experiments.bootstrap import bootstrap
from workbench.experiments.runs.base import Run
from workbench.experiments.runs.saliency_times import SaliencyTimeRun
from workbench.reproduction.claims import Evidence

#: The clip that is repeated for Figure 4.2; it is bundled.
TIMED_CLIP = "cmu/01_01"

_LENGTHS = {
    "quick": (10_000, 30_000, 100_000),
    "full": (10_000, 20_000, 30_000, 40_000, 50_000, 60_000, 70_000, 80_000, 90_000, 100_000),
}
_REPETITIONS = {"quick": 6, "full": 10}


def planned_runs(profile: str) -> list[Run]:
    """List the runs that measure the time, each length as often as the others."""
    return [
        SaliencyTimeRun(TIMED_CLIP, n_frames, repetition=repetition)
        for repetition in range(_REPETITIONS[profile])
        for n_frames in _LENGTHS[profile]
    ]


def times(table: pd.DataFrame) -> pd.DataFrame:
    """Arrange the running times by repetition and number of frames, in seconds."""
    if "n_frames" not in table:
        return pd.DataFrame(dtype=float)
    rows = table[(table["status"] == "done") & table["n_frames"].notna()]
    values = rows.astype({"n_frames": int, "repetition": int}).pivot_table(
        "seconds_total", "repetition", "n_frames", aggfunc="first"
    )
    return values.astype(float)


def time_table(seconds: pd.DataFrame) -> pd.DataFrame:
    """Summarize the running times for each number of frames."""
    result = pd.DataFrame(
        {
            "seconds, median": seconds.median(),
            "seconds, least": seconds.min(),
            "seconds, most": seconds.max(),
            "microseconds per frame": 1e6 * seconds.median() / seconds.columns.to_numpy(float),
        }
    )
    result.index.name = "frames"
    return result


def growth(seconds: pd.DataFrame) -> Evidence:
    """Estimate the exponent with which the time grows, over repetitions.

    Parameters
    ----------
    seconds : DataFrame
        From :func:`times`.

    Returns
    -------
    Evidence
        Median of the slopes of log(seconds) over log(frames).
    """
    complete = seconds.dropna()
    if complete.empty or complete.shape[1] < 2:
        return Evidence(None, units="repetitions", note="No complete repetition has finished.")
    frames = np.log(complete.columns.to_numpy(float))
    slopes = np.polyfit(frames, np.log(complete.to_numpy(float)).T, 1)[0]
    return Evidence(
        bootstrap(slopes, lambda values: float(np.median(values))),
        units="repetitions",
        note=f"{TIMED_CLIP} played forth and back, one thread in each process.",
    )
