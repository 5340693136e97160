"""Costa 2018, Figures 5.4 and 5.6 to 5.11 and Table 5.2: projection in two steps, and stress."""

from __future__ import annotations

import numpy as np
import pandas as pd

from workbench.experiments.runs.base import Run
from workbench.experiments.runs.schemes import Scheme, SchemeRun
from workbench.figures.style import BLUE, ORANGE, SKY, VERMILLION
from workbench.reproduction.claims import Evidence
from workbench.reproduction.costa2018.keyframe_errors import RATIO
from workbench.reproduction.costa2018.motion_figures import figure_runs
from workbench.reproduction.costa2018.results import (
    PROJECTORS,
    evidence_of,
    geometric_mean,
    on_all,
    part,
    values_by_clip,
)
from workbench.reproduction.costa2018.selectors import OPTIMIZED, SELECTORS, clips_of, schemes
from workbench.reproduction.published import published
from workbench.schemes import SpatialScheme

#: The bars of Figure 5.4.
ONE_STEP, ONE_STEP_OPTIMIZED = "one step", "one step, optimized"
RBFP, RBFP_OPTIMIZED = "two steps (RBFP)", "two steps (RBFP), optimized"
LAMP = "two steps (LAMP)"

#: Two-step method and optimizer of each; keyframes are by ROLS.
_STEPS = {
    ONE_STEP: (None, None),
    ONE_STEP_OPTIMIZED: (None, "alg12"),
    RBFP: ("rbfp", None),
    RBFP_OPTIMIZED: ("rbfp", "alg12"),
    LAMP: ("lamp", None),
}
#: What Figure 5.4 shows. LAMP is not in it: the text says why.
IN_FIGURE = (ONE_STEP, ONE_STEP_OPTIMIZED, RBFP, RBFP_OPTIMIZED)

#: Light before the optimization and dark after it, so that print without colours tells both.
COLORS = {
    ONE_STEP: SKY,
    ONE_STEP_OPTIMIZED: BLUE,
    RBFP: ORANGE,
    RBFP_OPTIMIZED: VERMILLION,
}

#: Ratios of stress, after optimization over before, by the name of the formula.
FORMULAS = {
    "Eq. 4.1": "stress_ratio",
    "scale-normalised": "scale_normalized_stress_ratio",
}

#: Rows of Table 5.2 in its order.
_ROWS = ("PB", "ROLS", "SCS", "US", "RBFP, ROLS")


def family(steps: str) -> dict[str, Scheme]:
    """List the schemes of one kind of bar of Figure 5.4, by the names of projectors."""
    two_step, optimizer = _STEPS[steps]
    return {
        name: SpatialScheme(method, "rols", two_step=two_step, optimizer=optimizer)
        for name, method in PROJECTORS.items()
    }


def rows_of_table() -> dict[str, dict[str, Scheme]]:
    """List the optimized schemes of each row of Table 5.2, by the names of projectors."""
    one_step = {name: schemes(OPTIMIZED, name) for name in sorted(SELECTORS)}
    return {**one_step, "RBFP, ROLS": family(RBFP_OPTIMIZED)}


def planned_runs(profile: str, seed: int) -> list[Run]:
    """List the runs that the notebook reads; those in one step are also in Figure 5.2."""
    every: list[Scheme] = [scheme for steps in _STEPS for scheme in family(steps).values()]
    every += [scheme for row in rows_of_table().values() for scheme in row.values()]
    runs: list[Run] = [
        SchemeRun(clip, scheme, ratio=RATIO, seed=seed)
        for clip in clips_of(profile)
        for scheme in every
    ]
    return list(dict.fromkeys([*runs, *figure_runs(profile, seed)]))


def errors(table: pd.DataFrame, clips: list[str]) -> pd.DataFrame:
    """Arrange errors clip by clip.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.
    clips : list of str
        Those that the means are over; the figures of single motions may use others.

    Returns
    -------
    DataFrame
        One row per clip on which all runs are finished; columns are the bar and the
        projector.
    """
    parts = {steps: values_by_clip(table, family(steps)) for steps in _STEPS}
    joined = pd.concat(parts, axis=1)
    return on_all(joined[joined.index.isin(clips)], table)


def bars(by_clip: pd.DataFrame) -> dict[str, dict[str, float]]:
    """Compute the mean errors of Figure 5.4: by bar and projector."""
    means = mean_errors(by_clip)
    return {steps: {str(name): float(v) for name, v in means[steps].items()} for steps in IN_FIGURE}


def mean_errors(by_clip: pd.DataFrame) -> pd.DataFrame:
    """Set the mean errors of one and two steps in a table, LAMP among them."""
    table = pd.DataFrame({steps: part(by_clip, steps).mean() for steps in _STEPS})
    table.index.name = "projector"
    return table


def describe_means(means: pd.DataFrame) -> str:
    """Tell who does not see Figure 5.4 its values.

    Parameters
    ----------
    means : DataFrame
        From :func:`mean_errors`.
    """
    parts = [
        f"{name}: " + ", ".join(f"{row[steps]:.2f}" for steps in IN_FIGURE)
        for name, row in means.iterrows()
    ]
    return (
        "Bar chart of the mean error for six projectors, each in one step, in one step optimized, "
        f"in two steps and in two steps optimized. {'; '.join(parts)}."
    )


def stress_ratios(table: pd.DataFrame, clips: list[str], formula: str) -> pd.DataFrame:
    """Arrange the ratios of stress, after optimization over before, clip by clip.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.
    clips : list of str
        Those that the means are over.
    formula : str
        One of :data:`FORMULAS`.

    Returns
    -------
    DataFrame
        One row per clip on which all runs are finished; columns are the row of Table 5.2 and
        the projector.
    """
    parts = {
        row: values_by_clip(table, of_row, FORMULAS[formula])
        for row, of_row in rows_of_table().items()
    }
    joined = pd.concat(parts, axis=1)
    return on_all(joined[joined.index.isin(clips)], table)


def table_5_2(ratios: pd.DataFrame) -> pd.DataFrame:
    """Set our Table 5.2 beside the published one.

    Parameters
    ----------
    ratios : DataFrame
        By Eq. 4.1, from :func:`stress_ratios`.

    Returns
    -------
    DataFrame
        For each selector three rows: ours, the published values and their difference.
    """
    printed = published("costa2018:tab5.2").table()[list(PROJECTORS)]
    ours = mean_ratios(ratios)
    rows = {}
    for name in _ROWS:
        rows[f"{name}: ours"] = ours.loc[name]
        rows[f"{name}: published"] = printed.loc[name]
        rows[f"{name}: difference"] = ours.loc[name] - printed.loc[name]
    table = pd.DataFrame.from_dict(rows, orient="index")
    table.index.name = "selector"
    return table


def mean_ratios(ratios: pd.DataFrame) -> pd.DataFrame:
    """Average the ratios of stress over clips, in the layout of Table 5.2."""
    table = pd.DataFrame({name: part(ratios, name).mean() for name in _ROWS}).T
    table.index.name = "selector"
    return table


def evidence(table: pd.DataFrame, clips: list[str]) -> dict[str, Evidence]:
    """Give the evidence for the claims about two steps and about stress.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.
    clips : list of str
        The clips of the profile.

    Returns
    -------
    dict of str to Evidence
        By the ids of the claims.
    """
    by_clip = errors(table, clips)

    def compare(steps: str, with_steps: str) -> Evidence:
        ratio = geometric_mean(part(by_clip, steps) / part(by_clip, with_steps))
        return evidence_of(ratio, lambda values: float(np.median(values)))

    found = {
        "costa2018:rbfp-needs-optimization": compare(RBFP, ONE_STEP),
        "costa2018:rbfp-optimized-recovers": compare(RBFP_OPTIMIZED, ONE_STEP_OPTIMIZED),
        "costa2018:lamp-is-poor": compare(LAMP, ONE_STEP),
    }
    for formula, ending in (("Eq. 4.1", ""), ("scale-normalised", "-normalized")):
        ratios = stress_ratios(table, clips, formula)
        two = part(ratios, "RBFP, ROLS").mean(axis=1)
        one = ratios.drop(columns="RBFP, ROLS", level=0).mean(axis=1)
        for claim, values in (("stress-falls-for-rbfp", two), ("stress-stays-for-one-step", one)):
            found[f"costa2018:{claim}{ending}"] = evidence_of(
                values, lambda values: float(values.mean())
            )
    return found
