"""Readings of the saliency method, beside the published keyframes of "stretching"."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import product
from typing import Any

import numpy as np
import pandas as pd

from workbench.errors import WorkbenchError
from workbench.experiments.runs.base import Run
from workbench.experiments.runs.saliency_readings import (
    NORMALIZATIONS,
    THRESHOLDS,
    SaliencyReadingRun,
)
from workbench.mocap.curve_saliency import CURVATURES
from workbench.reproduction.halit2010 import selector_ranks
from workbench.reproduction.halit2010.comparison import interval
from workbench.reproduction.halit2010.motions import STRETCHING, motions
from workbench.reproduction.profiles import motion_clips
from workbench.reproduction.published import published

#: A bundled clip, for readings where the thesis's own is not at hand.
_BUNDLED = "cmu/01_01-three-jumps"

#: What is read in several ways, and how the columns of results name it.
CHOICES: dict[str, dict[str, Any]] = {
    "cluster_width": {"4σ": 4.0, "2σ": 2.0},
    "curvature": dict(zip(("D′", "D"), CURVATURES, strict=True)),
    "unit_variance": {"unit variance": True, "zero mean": False},
    "normalization": dict(zip(("each curve", "all curves", "none"), NORMALIZATIONS, strict=True)),
    "threshold": dict(zip(("own curve", "all curves", "summed"), THRESHOLDS, strict=True)),
}
_TITLES = {
    "cluster_width": "longest cluster",
    "curvature": "curvature divides by",
    "unit_variance": "columns",
    "normalization": "maps stretched over",
    "threshold": "threshold",
}


#: On how many excerpts the quick profile compares selectors.
_QUICK_CLIPS = 3


def planned_runs(
    profile: str,
    seed: int = 0,  # noqa: ARG001 - plans of all notebooks are asked alike
    *,
    clips: Iterable[str] | None = None,
) -> list[Run]:
    """List the readings of one motion, and the selectors on all.

    Parameters
    ----------
    profile : {"quick", "full"}
        Which motions.
    seed : int
        Without effect: nothing is random here.
    clips : iterable of str, optional
        Names of motions, in place of the profile's.

    Returns
    -------
    list of Run
    """
    # The exact selection takes long: the quick profile has time for a few excerpts.
    chosen = motion_clips(profile)[:_QUICK_CLIPS] if profile == "quick" else motions(profile)
    names = list(chosen if clips is None else clips)
    read = STRETCHING if STRETCHING in names else _BUNDLED
    runs: list[Run] = [
        SaliencyReadingRun(read, **dict(zip(CHOICES, values, strict=True)))
        for values in product(*(choices.values() for choices in CHOICES.values()))
    ]
    for clip in names:
        runs += selector_ranks.planned_runs(clip)
    return runs


def reading_table(table: pd.DataFrame) -> pd.DataFrame:
    """List the readings of the method, the one nearest to the published values first.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.

    Returns
    -------
    DataFrame
        What is read how, the number of keyframes and the PSNR in dB. On the thesis's clip also
        the differences to the published values; the nearest reading is the one with the least
        sum of the two, in units of 10 % and 1.5 dB. Elsewhere in the order of the runs.
    """
    rows = _reading_rows(table)
    shown = pd.DataFrame(
        {
            title: [_word(name, value) for value in rows[name]]
            for name, title in _TITLES.items()
            if name in rows
        }
    )
    shown["keyframes"] = rows["n_keyframes"].astype(int).to_numpy()
    shown["PSNR, dB"] = rows["psnr"].astype(float).to_numpy()
    if reading_clip(table) == STRETCHING:
        count, ratio = published_target()
        shown["keyframes − published"] = shown["keyframes"] - round(count)
        shown["PSNR − published"] = shown["PSNR, dB"] - ratio
        far = shown["keyframes − published"].abs() / (0.1 * count)
        far += shown["PSNR − published"].abs() / 1.5
        shown = shown.iloc[np.argsort(far.to_numpy(), kind="stable")]
    shown.index = pd.RangeIndex(1, len(shown) + 1, name="reading")
    return shown


def choice_table(table: pd.DataFrame) -> pd.DataFrame:
    """Tell what each choice does, whatever the others are.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.

    Returns
    -------
    DataFrame
        For each choice the number of readings, and the median and range of the keyframes and
        of the PSNR.
    """
    rows = _reading_rows(table)
    result: dict[str, dict[str, Any]] = {}
    for name, words in CHOICES.items():
        for word, value in words.items():
            chosen = rows[rows[name] == value]
            counts, ratios = chosen["n_keyframes"].astype(float), chosen["psnr"].astype(float)
            if len(chosen):
                result[f"{_TITLES[name]}: {word}"] = {
                    "readings": len(chosen),
                    "keyframes, median": counts.median(),
                    "keyframes, range": interval(counts.min(), counts.max(), 0),
                    "PSNR, median": ratios.median(),
                    "PSNR, range": interval(ratios.min(), ratios.max(), 1),
                }
    return pd.DataFrame.from_dict(result, orient="index").rename_axis("choice")


def reading_points(table: pd.DataFrame) -> dict[str, list[tuple[float, float, str]]]:
    """Arrange the readings for a chart of keyframes and PSNR.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.

    Returns
    -------
    dict of str to list of (float, float, str)
        For each cluster limit and threshold the keyframes, the PSNR, and what else was chosen.
    """
    groups: dict[str, list[tuple[float, float, str]]] = {}
    for row in _reading_rows(table).to_dict("records"):
        words = {name: _word(name, row[name]) for name in CHOICES}
        name = f"{words['cluster_width']}, {words['threshold']}"
        others = ", ".join(words[n] for n in ("curvature", "unit_variance", "normalization"))
        groups.setdefault(name, []).append((row["n_keyframes"], row["psnr"], others))
    return groups


def default_reading(table: pd.DataFrame) -> tuple[int, float] | None:
    """Give the keyframes and the PSNR of the library's reading; None if it is not finished."""
    rows = _reading_rows(table)
    for name, words in CHOICES.items():
        rows = rows[rows[name] == next(iter(words.values()))]
    if rows.empty:
        return None
    return int(rows["n_keyframes"].iloc[0]), float(rows["psnr"].iloc[0])


def published_target() -> tuple[float, float]:
    """Give the keyframes and the PSNR that are published for "stretching"."""
    values = published("halit2010:tab4.2").table()["Stretching"]
    return float(values["keyframes"]), float(values["Saliency"])


def reading_clip(table: pd.DataFrame) -> str:
    """Tell which motion was read.

    Raises
    ------
    WorkbenchError
        If no reading has finished.
    """
    return str(_reading_rows(table)["dataset"].iloc[0])


def describe_target(table: pd.DataFrame) -> str:
    """Say what the readings are compared with, or that the clip for it is missing."""
    count, ratio = published_target()
    values = f"{count:g} keyframes and {ratio:.2f} dB"
    if reading_clip(table) == STRETCHING:
        return f"Published for this clip: {values}."
    return (
        f"The published {values} are of 13_29, which is not bundled: name a folder with "
        "mocap/asf_amc/13_29.amc in WORKBENCH_DATA and take the full profile."
    )


def _reading_rows(table: pd.DataFrame) -> pd.DataFrame:
    if "threshold" in table:
        rows = table[(table["status"] == "done") & table["threshold"].notna()]
        if len(rows):
            return rows
    raise WorkbenchError("no reading of the saliency method has finished")


def _word(name: str, value: Any) -> str:
    return next(word for word, known in CHOICES[name].items() if known == value)
