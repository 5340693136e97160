"""Tables 4.1 and 4.2 of Halit 2010: saliency beside curve simplification and decimation."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
import pandas as pd

from workbench.experiments.bootstrap import bootstrap
from workbench.experiments.runs.base import Run
from workbench.experiments.runs.keyframes import KeyframeRun
from workbench.reproduction.claims import Evidence
from workbench.reproduction.costa2018.results import evidence_of
from workbench.reproduction.halit2010 import contacts
from workbench.reproduction.halit2010.motions import (
    CALM,
    DYNAMIC,
    STRETCHING,
    has_skeleton,
    kind_of_motion,
    motions,
    recommended,
    title_of,
    values_of,
)
from workbench.reproduction.published import published

#: Methods of the tables by their names there.
METHODS = {"Saliency": "saliency", "Curve simplification": "chord", "Frame decimation": "pb"}

#: Motions of the tables; those of ours are found by the catalogue's words.
_WORDS = {"Stretching": "side twists", "Walking": "walk", "Basketball": "basketball"}
MOTIONS = (*_WORDS, "Boxing")

#: Names of the two representations, and the curves that keyframes are selected from.
REPRESENTATIONS = {"Euler angles": "angles", "Body coordinates": "positions"}
_ANGLES = [("", "angles")]


def planned_runs(
    profile: str,
    seed: int = 0,  # noqa: ARG001 - plans of all notebooks are asked alike
    *,
    clips: Iterable[str] | None = None,
) -> list[Run]:
    """List the runs of Tables 4.1 and 4.2 and of what the thesis claims about them.

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
    names = list(motions(profile) if clips is None else clips)
    runs: list[Run] = [method_run(clip, method) for clip in names for method in METHODS]
    for clip in stand_ins(names).values():
        if has_skeleton(clip):
            runs += [method_run(clip, method, "positions") for method in METHODS]
    runs += contacts.planned_runs(filter(has_skeleton, names), profile)
    return list(dict.fromkeys(runs))


def method_run(clip: str, method: str, curves: str = "angles") -> KeyframeRun:
    """Give the run of a method, with as many keyframes as saliency chooses."""
    parameters = recommended(clip)
    if method == "Saliency":
        return KeyframeRun(clip, parameters=parameters, curves=curves)
    return KeyframeRun(clip, METHODS[method], counted_by=parameters, curves=curves)


def stand_ins(clips: Iterable[str]) -> dict[str, str]:
    """Choose, for the motions of the tables, what is nearest to them.

    Stretching is the clip of the thesis where it is at hand. Of several clips of a kind the
    longest is taken, which all are shorter than those of the thesis.

    Parameters
    ----------
    clips : iterable of str
        Names of motions to choose from.

    Returns
    -------
    dict of str to str
        Without motions of which there is no clip.
    """
    names = list(clips)
    found = {}
    for motion, word in _WORDS.items():
        of_kind = [name for name in names if word in title_of(name)]
        if STRETCHING in of_kind and motion == "Stretching":
            found[motion] = STRETCHING
        elif of_kind:
            found[motion] = max(of_kind, key=_frames)
    return found


def _frames(clip: str) -> int:
    from workbench.datasets.catalogue import lookup

    return int(getattr(lookup(clip), "frames", None) or 0)


def comparison_table(table: pd.DataFrame, column: str) -> pd.DataFrame:
    """Set our Table 4.1 or 4.2 beside the published one.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.
    column : {"body_error", "psnr"}
        Eq. 4.1, which is Table 4.1, or Eq. 4.2, which is Table 4.2.

    Returns
    -------
    DataFrame
        For each motion ours, the published value and their difference; rows are the number of
        frames, the keyframes, what share of the frames these are, and the value of each
        method, in Table 4.1 for each representation and times 1000. Our keyframes include the
        ends of the clip.
    """
    printed = published("halit2010:tab4.1" if column == "body_error" else "halit2010:tab4.2")
    theirs = _with_shares({str(m): dict(v) for m, v in printed.table().to_dict().items()})
    ours = _with_shares(our_rows(table, column))
    rows: dict[str, dict[tuple[str, str], float | None]] = {}
    for name in theirs[MOTIONS[0]]:
        row = rows[name] = {}
        for motion in MOTIONS:
            mine, their = ours.get(motion, {}).get(name), theirs[motion][name]
            # Numbers of frames say nothing about the method where the clips are others.
            is_count = name.endswith("frames") and "%" not in name
            row[motion, "ours"] = _count(mine) if is_count else mine
            row[motion, "published"] = _count(their) if is_count else their
            row[motion, "difference"] = None if mine is None or is_count else mine - their
    scaled = {_scaled_name(name): _scaled(name, row) for name, row in rows.items()}
    content = scaled if column == "body_error" else rows
    # As objects, so that counts are written as counts.
    cells = np.array([list(row.values()) for row in content.values()], dtype=object)
    columns = pd.MultiIndex.from_tuples(list(rows["frames"]))
    result = pd.DataFrame(cells, index=list(content), columns=columns)
    result.index.name = "quantity"
    return result


def our_rows(table: pd.DataFrame, column: str) -> dict[str, dict[str, float]]:
    """Gather our values for the rows of Table 4.1 or 4.2, by motion."""
    done = table[table["status"] == "done"]
    found: dict[str, dict[str, float]] = {}
    for motion, clip in stand_ins(dict.fromkeys(done["dataset"])).items():
        row: dict[str, float] = {}
        for label, curves in REPRESENTATIONS.items() if column == "body_error" else _ANGLES:
            lead = f"{label}: " if label else ""
            runs = {method: method_run(clip, method, curves) for method in METHODS}
            saliency = [runs["Saliency"]]
            [frames] = values_of(table, saliency, "n_samples")
            [row[f"{lead}keyframes"]] = values_of(table, saliency, "n_control_points")
            # Without a skeleton there are no runs on positions.
            row["frames"] = frames if np.isfinite(frames) else row.get("frames", frames)
            for method, value in zip(runs, values_of(table, runs.values(), column), strict=True):
                row[f"{lead}{method}"] = value
        found[motion] = {name: value for name, value in row.items() if np.isfinite(value)}
    return found


def _with_shares(values: dict[str, dict[str, float]]) -> dict[str, dict[str, float]]:
    """Put the share of the frames below each number of keyframes."""
    found: dict[str, dict[str, float]] = {}
    for motion, rows in values.items():
        row = found[motion] = {}
        for name, value in rows.items():
            row[name] = value
            if name.endswith("keyframes"):
                row[f"{name}, % of frames"] = 100 * value / rows["frames"]
    return found


def _count(value: float | None) -> int | None:
    return None if value is None else int(value)


def _scaled_name(name: str) -> str:
    return name if "frames" in name else f"{name}, error × 1000"


def _scaled(name: str, row: dict[tuple[str, str], float | None]) -> dict[Any, float | None]:
    factor = 1 if "frames" in name else 1000
    return {key: None if value is None else factor * value for key, value in row.items()}


def describe_stand_ins(table: pd.DataFrame) -> str:
    """Say in a sentence what stands for each motion of the tables, and what is missing."""
    done = table[table["status"] == "done"]
    found = stand_ins(dict.fromkeys(done["dataset"]))
    parts = []
    for motion, clip in found.items():
        if clip == STRETCHING:
            parts.append(f"{motion} is the clip of the thesis, {clip}, without its skeleton")
        else:
            parts.append(f"for {motion} stands {clip} ({title_of(clip)})")
    missing = [motion for motion in MOTIONS if motion not in found]
    if missing:
        parts.append(f"there is no clip of {', '.join(missing)} on this machine")
    text = "; ".join(parts)
    return f"{text[:1].upper()}{text[1:]}."


def method_values(table: pd.DataFrame, column: str = "psnr") -> pd.DataFrame:
    """Arrange a value of the three methods by motion, at the counts that saliency chooses."""
    clips = list(dict.fromkeys(table.loc[table["selector"].notna(), "dataset"]))
    values = {
        name: values_of(table, [method_run(clip, name) for clip in clips], column)
        for name in METHODS
    }
    return pd.DataFrame(values, index=pd.Index(clips, name="motion")).dropna()


def difference(table: pd.DataFrame, better: str, worse: str) -> Evidence:
    """Estimate the difference of PSNR between two methods at equal counts: median in dB."""
    values = method_values(table)[[better, worse]]
    return evidence_of(values, lambda v: float(np.median(v[:, 0] - v[:, 1])))


def share_of_keyframes(table: pd.DataFrame) -> Evidence:
    """Estimate the share of the frames that saliency chooses: mean in per cent."""
    return evidence_of(_shares(table), lambda v: float(np.mean(v)))


def _shares(table: pd.DataFrame) -> pd.Series:
    counts = method_values(table, "n_control_points")["Saliency"]
    return 100 * counts / method_values(table, "n_samples")["Saliency"]


def difference_table(table: pd.DataFrame) -> pd.DataFrame:
    """Compare the methods over all motions and over those of each kind.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.

    Returns
    -------
    DataFrame
        For all, calm and dynamic motions: how many, the mean share of the frames that are
        keyframes in per cent, the median PSNR of each method, and the median difference to
        saliency with its interval, in dB.
    """
    values = method_values(table)
    shares = _shares(table)
    rows = {}
    for kind in ("all", CALM, DYNAMIC):
        chosen = values
        if kind != "all":
            chosen = values[[kind_of_motion(str(name)) == kind for name in values.index]]
        if chosen.empty:
            continue
        row: dict[tuple[str, str], Any] = {
            ("motions", ""): len(chosen),
            ("keyframes, %", ""): shares[chosen.index].mean(),
        }
        row |= {("median PSNR, dB", name): chosen[name].median() for name in METHODS}
        for name in list(METHODS)[1:]:
            found = bootstrap(
                (chosen[name] - chosen["Saliency"]).to_numpy(), lambda v: float(np.median(v))
            )
            row["minus saliency, dB", name] = found.value
            row["minus saliency, dB", f"{name}, 95 %"] = interval(found.low, found.high)
        rows[kind] = row
    result = pd.DataFrame.from_dict(rows, orient="index")
    result.index.name = "kind"
    return result


def interval(low: float, high: float, digits: int = 2) -> str:
    """Write an interval: "0.10 to 0.25"."""
    return f"{low:.{digits}f} to {high:.{digits}f}".replace("-", "\N{MINUS SIGN}")
