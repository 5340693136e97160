"""Motions for the experiments of Halit 2010, and the parameters recommended for them."""

from __future__ import annotations

import re
from collections.abc import Iterable

import pandas as pd

from workbench.experiments.grid import describe_failures
from workbench.experiments.runs.keyframes import KeyframeRun, Parameters
from workbench.reproduction.profiles import excerpts, motion_clips

#: "Stretching", the only clip of the thesis that is at hand, and what else is there of its
#: kind. Their skeleton is not, so they are tables of joint angles.
STRETCHING = "cmu-amc/13_29"
_WITHOUT_SKELETON = (STRETCHING, "cmu-amc/13_31", "cmu-amc/14_14")

#: What the catalogue calls motions that are calm as walking and stretching are.
_CALM = re.compile(r"walk|stretch|squats|turn on the spot|lean over the|swing gently")

CALM, DYNAMIC = "calm", "dynamic"

#: σ and k of Tables 4.1 and 4.2.
PARAMETERS: dict[str, tuple[float, int]] = {CALM: (10.0, 7), DYNAMIC: (3.0, 10)}


def motions(profile: str) -> list[str]:
    """Choose the motions of a profile.

    Parameters
    ----------
    profile : {"quick", "full"}
        ``quick``: the bundled excerpts. ``full``: all clips found of the lengths of
        Costa 2018, and the long ones of which joint angles alone are found.

    Returns
    -------
    list of str
    """
    from workbench.datasets import list_datasets

    clips = motion_clips(profile)
    if profile == "quick":
        # Selectors take little time, so that there is no need to choose some of them.
        return excerpts()
    found = {status.entry.name for status in list_datasets() if status.state == "available"}
    return [*clips, *(name for name in _WITHOUT_SKELETON if name in found)]


def has_skeleton(dataset: str) -> bool:
    """Tell whether the poses of a motion are known, and not its joint angles alone."""
    return dataset not in _WITHOUT_SKELETON


def kind_of_motion(dataset: str) -> str:
    """Tell whether a motion is calm or dynamic, by what the catalogue calls it.

    The thesis calls walking and stretching low-dynamic, basketball, boxing and dancing
    high-dynamic. A motion that the catalogue does not know counts as dynamic.

    Examples
    --------
    >>> kind_of_motion("cmu/02_01"), kind_of_motion("cmu/05_10"), kind_of_motion("cmu-amc/13_29")
    ('calm', 'dynamic', 'calm')
    """
    return CALM if _CALM.search(title_of(dataset)) else DYNAMIC


def title_of(dataset: str) -> str:
    """Give the catalogue's words for a motion; empty for one that it does not know."""
    from workbench.datasets.catalogue import lookup

    entry = lookup(dataset)
    return "" if entry is None else entry.title


def saliency_parameters(sigma: float, n_components: int, *, contacts: bool = False) -> Parameters:
    """Write parameters of the saliency method as runs hold them."""
    parameters: Parameters = (("sigma", float(sigma)), ("n_components", int(n_components)))
    return (*parameters, ("contacts", True)) if contacts else parameters


def recommended(dataset: str) -> Parameters:
    """Give the parameters that Tables 4.1 and 4.2 have for the kind of a motion."""
    return saliency_parameters(*PARAMETERS[kind_of_motion(dataset)])


def values_of(table: pd.DataFrame, runs: Iterable[KeyframeRun], column: str) -> list[float]:
    """Find a value of runs, as floats; not a number where one is not finished or has none.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`; runs of other kinds are passed over.
    runs : iterable of KeyframeRun
        The runs.
    column : str
        Such as ``"psnr"``.

    Returns
    -------
    list of float
    """
    names = ["dataset", "selector", "parameters", "counted_by", "curves"]
    found: dict[tuple[str, ...], float] = {}
    if column in table and set(names) <= set(table.columns):
        done = table[(table["status"] == "done") & table["selector"].notna()]
        keys = done[names].fillna("").itertuples(index=False, name=None)
        values = pd.to_numeric(done[column], errors="coerce").tolist()
        found = dict(zip(keys, values, strict=True))
    described = (run.specification() for run in runs)
    return [found.get(tuple(of[name] or "" for name in names), float("nan")) for of in described]


def short_titles(table: pd.DataFrame) -> dict[str, str]:
    """Name motions by number and by the first words of the catalogue: "07_01, walk"."""
    return {
        str(
            name
        ): f"{str(name).split('/', 1)[-1]}, {re.split('[,-] ?', title_of(str(name)))[0]}".strip(
            ", "
        )
        for name in dict.fromkeys(table["dataset"])
    }


def describe_motions(table: pd.DataFrame) -> str:
    """Say in a sentence which motions were used and how many of each kind, and what failed."""
    done = table[table["status"] == "done"].drop_duplicates("dataset")
    parts = []
    for kind in (CALM, DYNAMIC):
        names = [name for name in done["dataset"] if kind_of_motion(name) == kind]
        if names:
            short = ", ".join(name.split("/", 1)[-1] for name in names)
            parts.append(f"{len(names)} {kind} ({short})")
    lengths = done["n_samples"].astype(int)
    if not parts:
        return f"All runs failed. {describe_failures(table)}".strip()
    span = f"{lengths.min()} to {lengths.max()} frames"
    text = f"Motions of the CMU database, {span}: {' and '.join(parts)}."
    return f"{text} {describe_failures(table)}".strip()
