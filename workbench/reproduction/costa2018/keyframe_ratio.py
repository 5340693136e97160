"""Figure 5.1 of Costa 2018: reconstruction error against the share of keyframes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd

from workbench.datasets.catalogue import lookup
from workbench.errors import WorkbenchError
from workbench.experiments.runs.base import Run
from workbench.experiments.runs.schemes import Scheme, SchemeRun
from workbench.figures.lines import LinePanel
from workbench.reproduction.claims import Evidence
from workbench.reproduction.costa2018.results import evidence_of, values_by_clip
from workbench.reproduction.profiles import excerpts, motion_clips
from workbench.schemes import SpatialScheme, TemporalScheme

#: The five interpolators of the caption; the text names the first four alone. Spatial schemes
#: are optimized: section 5.1 reads the charts as showing what optimization can gain.
TEMPORAL: dict[str, Scheme] = {
    "Linear": TemporalScheme("linear", selector="scs"),
    "Slerp": TemporalScheme("slerp", selector="scs"),
    "1D-RBF": TemporalScheme("rbf", selector="scs"),
}
SPATIAL: dict[str, Scheme] = {
    "MDS": SpatialScheme("mds", selector="scs", optimizer="alg12"),
    "t-SNE": SpatialScheme("tsne", selector="scs", optimizer="alg12"),
}
SCHEMES: dict[str, Scheme] = {**TEMPORAL, **SPATIAL}

#: Shares of the frames that are keyframes, per cent.
_RATIOS = {"quick": (1, 2, 3, 4, 10), "full": tuple(range(1, 11))}

#: A share that asks for fewer keyframes would silently be another share.
_MIN_KEYFRAMES = 3


@dataclass(frozen=True)
class ActionPanel:
    """One chart of the figure.

    Attributes
    ----------
    letter : str
        As in the thesis.
    action : str
        The caption's words, which are those of the database.
    published : tuple of str
        Clips of that action.
    stand_ins : tuple of str
        Clips of the nearest action, best first, for where the others are missing.
    """

    letter: str
    action: str
    published: tuple[str, ...]
    stand_ins: tuple[str, ...]


PANELS = (
    ActionPanel("a", "playground", ("cmu/01_14",), ("cmu/01_03-swing", "cmu/01_03-climb-down")),
    ActionPanel("b", "swordplay", ("cmu/02_07", "cmu/02_08", "cmu/02_09"), ("cmu/05_02",)),
    ActionPanel("c", "uneven terrain", ("cmu/03_01", "cmu/03_02", "cmu/03_03"), ("cmu/07_05",)),
    ActionPanel("d", "dance", ("cmu/05_13",), ("cmu/05_09",)),
    ActionPanel("e", "basketball", ("cmu/06_12",), ("cmu/06_02", "cmu/06_04")),
    ActionPanel("f", "walk", ("cmu/02_01", "cmu/02_02"), ("cmu/01_03-walk",)),
    ActionPanel("g", "run", ("cmu/09_06", "cmu/09_01"), ()),
    ActionPanel("h", "navigate", ("cmu/09_12",), ("cmu/06_07", "cmu/06_06")),
)
#: The quick profile has excerpts alone, and time for three of them.
_QUICK_PANELS = (
    ActionPanel("a", "playground", (), ("cmu/01_03-climb-down",)),
    ActionPanel("d", "dance", (), ("cmu/01_01-two-jumps",)),
    ActionPanel("f", "walk", (), ("cmu/01_03-walk",)),
)


def clips_by_panel(profile: str) -> dict[ActionPanel, str]:
    """Choose the clip of each chart among those on this machine.

    Parameters
    ----------
    profile : {"quick", "full"}
        Which charts and clips.

    Returns
    -------
    dict of ActionPanel to str
        Charts without a clip are left out.
    """
    panels = _QUICK_PANELS if profile == "quick" else PANELS
    present = {*excerpts(), *motion_clips(profile)}
    chosen = {}
    for panel in panels:
        found = [clip for clip in (*panel.published, *panel.stand_ins) if clip in present]
        if found:
            chosen[panel] = found[0]
    return chosen


def planned_runs(profile: str, seed: int) -> list[Run]:
    """List the runs that the notebook reads.

    Shares that give a clip fewer than three keyframes are left out: they would be run with
    three, at another share than they say.
    """
    runs: list[Run] = []
    for clip in clips_by_panel(profile).values():
        n_frames = _n_frames(clip)
        for percent in _RATIOS[profile]:
            if percent * n_frames // 100 >= _MIN_KEYFRAMES:
                runs += [
                    SchemeRun(clip, scheme, ratio=percent / 100, seed=seed)
                    for scheme in SCHEMES.values()
                ]
    return runs


def errors_by_ratio(table: pd.DataFrame, clip: str) -> pd.DataFrame:
    """Arrange the errors on a clip by share of keyframes and scheme.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.
    clip : str
        Name of the clip.

    Returns
    -------
    DataFrame of shape (n_ratios, n_schemes)
        Shares in per cent; missing where no run is finished.
    """
    here = table[table["dataset"] == clip]
    rows = {}
    for ratio in sorted(here["ratio"].unique()):
        errors = values_by_clip(here[here["ratio"] == ratio], SCHEMES)
        if len(errors):
            rows[round(100 * ratio)] = errors.iloc[0]
    return pd.DataFrame.from_dict(rows, orient="index", columns=list(SCHEMES))


def charts(table: pd.DataFrame, clips: dict[ActionPanel, str]) -> list[LinePanel]:
    """Make the charts of Figure 5.1 from results; those without a finished run are left out."""
    made = []
    for panel, clip in clips.items():
        errors = errors_by_ratio(table, clip)
        lines = {str(name): dict(column.dropna()) for name, column in errors.items()}
        if any(lines.values()):
            title = f"({panel.letter}) {panel.action}<br>{clip.removeprefix('cmu/')}"
            made.append(LinePanel(title, lines))
    if not made:
        raise WorkbenchError(f"all runs failed; the first: {table['message'].iloc[0]}")
    return made


def errors_at(table: pd.DataFrame, clips: dict[ActionPanel, str]) -> pd.DataFrame:
    """Set errors at a few shares side by side, the mean over the five interpolators.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.
    clips : dict of ActionPanel to str
        From :func:`clips_by_panel`.

    Returns
    -------
    DataFrame
        One row per chart: mean errors, and "late / early": the fall of the error from 4 to
        10 % of keyframes over that from 1 to 3 %, both per 1 %. Missing where a clip is too
        short or a run failed.
    """
    rows = {}
    for panel, clip in clips.items():
        mean = errors_by_ratio(table, clip).mean(axis=1, skipna=False)
        at = {percent: mean.get(percent, np.nan) for percent in (1, 3, 4, 10)}
        early, late = (at[1] - at[3]) / 2, (at[4] - at[10]) / 6
        rows[f"{panel.action}, {clip.removeprefix('cmu/')}"] = {
            **{f"{percent} %": error for percent, error in at.items()},
            # An error that does not fall up to 3 % has no steep part.
            "late / early": late / early if not early <= 0 else 1.0,
        }
    result = pd.DataFrame.from_dict(rows, orient="index").astype(float)
    result.index.name = "clip"
    return result


def describe_errors(at: pd.DataFrame) -> str:
    """Tell who does not see the figure how the error falls.

    Parameters
    ----------
    at : DataFrame
        From :func:`errors_at`.
    """
    parts = []
    for name, row in at.iterrows():
        values = [f"{row[p]:.2f} at {p}" for p in ("1 %", "3 %", "10 %") if pd.notna(row[p])]
        if values:
            parts.append(f"{name}: {', '.join(values)}")
    return f"Mean error over the five interpolators: {'; '.join(parts)}."


def flattening(table: pd.DataFrame, clips: dict[ActionPanel, str]) -> Evidence:
    """Compare how fast the error falls before and after 3 to 4 % of keyframes."""
    values = errors_at(table, clips)["late / early"]
    # A clip that is too short for 1 % has no such value, though no run of it failed.
    absent = int(values.isna().sum())
    note = f"{absent} of {len(values)} clips lack the runs or the frames for 1 %." * bool(absent)
    return evidence_of(values.dropna(), lambda v: float(np.median(v)), note)


def describe_stand_ins(clips: dict[ActionPanel, str]) -> str:
    """Say in a sentence which clips stand in for those of other actions."""
    others = []
    for panel, clip in clips.items():
        if clip not in panel.published:
            entry = lookup(clip)
            what = entry.title if entry else clip
            others.append(f"{clip.removeprefix('cmu/')} ({what}) for {panel.action}")
    return f"Stand-ins: {'; '.join(others)}." if others else ""


def _n_frames(clip: str) -> int:
    from workbench.datasets import load

    frames = getattr(lookup(clip), "frames", None)
    return len(load(clip)) if frames is None else int(frames)
