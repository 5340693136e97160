"""Figure 5.2 of Costa 2018: keyframe selectors with temporal and spatial schemes."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd

from workbench.experiments.bootstrap import bootstrap
from workbench.experiments.runs.base import Run
from workbench.experiments.runs.schemes import Scheme, SchemeRun
from workbench.reproduction.claims import Evidence
from workbench.reproduction.costa2018.keyframe_errors import RATIO
from workbench.reproduction.costa2018.results import PROJECTORS, evidence_of, on_all, values_by_clip
from workbench.reproduction.profiles import motion_clips
from workbench.reproduction.published import published
from workbench.schemes import SpatialScheme, TemporalScheme

#: Selectors by their names in the thesis.
SELECTORS = {"US": "uniform", "SCS": "scs", "PB": "pb", "ROLS": "rols"}
#: What is compared with uniform sampling.
ELABORATE = ("SCS", "PB", "ROLS")

#: Temporal schemes of the figure; Hermitian is read as in Table 5.1.
INTERPOLATORS = {"Slerp": "slerp", "Linear": "linear", "Hermitian": "hermite-keys"}

#: The panels of the figure.
TEMPORAL, RAW, OPTIMIZED = (
    "(a) temporal schemes",
    "(b) spatial schemes",
    "(c) spatial schemes, optimized",
)

#: The quick profile has time for two excerpts.
_QUICK_CLIPS = ("cmu/01_01-jump", "cmu/01_03-walk")


def schemes(panel: str, selector: str) -> dict[str, Scheme]:
    """List the schemes of a panel with one selector.

    Parameters
    ----------
    panel : str
        :data:`TEMPORAL`, :data:`RAW` or :data:`OPTIMIZED`.
    selector : str
        One of :data:`SELECTORS`.

    Returns
    -------
    dict of str to scheme
        By the names of interpolators or projectors.
    """
    chosen = SELECTORS[selector]
    if panel == TEMPORAL:
        return {name: TemporalScheme(method, chosen) for name, method in INTERPOLATORS.items()}
    optimizer = "alg12" if panel == OPTIMIZED else None
    return {
        name: SpatialScheme(method, chosen, optimizer=optimizer)
        for name, method in PROJECTORS.items()
    }


def clips_of(profile: str) -> list[str]:
    """Choose the clips of a profile: all of the full one, two of the quick one."""
    clips = motion_clips(profile)
    return [clip for clip in clips if clip in _QUICK_CLIPS] if profile == "quick" else clips


def planned_runs(profile: str, seed: int) -> list[Run]:
    """List the runs that the notebook reads."""
    return [
        SchemeRun(clip, scheme, ratio=RATIO, seed=seed)
        for clip in clips_of(profile)
        for panel in (TEMPORAL, RAW, OPTIMIZED)
        for selector in SELECTORS
        for scheme in schemes(panel, selector).values()
    ]


def errors(table: pd.DataFrame) -> pd.DataFrame:
    """Arrange the errors of all schemes with all selectors, clip by clip.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.

    Returns
    -------
    DataFrame
        One row per clip on which all runs are finished, so that means are over the same
        clips; columns are panel, scheme and selector.
    """
    parts: Mapping[tuple[str, str], pd.DataFrame] = {
        (panel, selector): values_by_clip(table, schemes(panel, selector))
        for panel in (TEMPORAL, RAW, OPTIMIZED)
        for selector in SELECTORS
    }
    joined = pd.concat(parts, axis=1, names=["panel", "selector", "scheme"])
    return on_all(joined.reorder_levels(["panel", "scheme", "selector"], axis=1), table)


def bars(clips: pd.DataFrame) -> dict[str, dict[str, dict[str, float]]]:
    """Compute the mean errors that Figure 5.2 shows: by panel, selector and scheme."""
    means = clips.mean()
    panels = {TEMPORAL: INTERPOLATORS, RAW: PROJECTORS, OPTIMIZED: PROJECTORS}
    return {
        panel: {
            selector: {name: float(means[panel, name, selector]) for name in names}
            for selector in SELECTORS
        }
        for panel, names in panels.items()
    }


def mean_errors(clips: pd.DataFrame) -> pd.DataFrame:
    """Set the mean errors in a table, schemes by selectors, and the two published ones beside.

    Parameters
    ----------
    clips : DataFrame
        From :func:`errors`.

    Returns
    -------
    DataFrame
        One row per scheme; the published column names the selector it is for.
    """
    rows: dict[str, dict[str, float | str | None]] = {}
    printed = published("costa2018:fig5.2").table()["mean"]
    names = {TEMPORAL: "{}", RAW: "{}, raw", OPTIMIZED: "{}, optimized"}
    for panel, by_selector in bars(clips).items():
        for scheme in next(iter(by_selector.values())):
            name = names[panel].format(scheme)
            row: dict[str, float | str | None] = {
                selector: values[scheme] for selector, values in by_selector.items()
            }
            known = [s for s in SELECTORS if f"{name}, {s}" in printed.index]
            row["published"] = (
                f"{printed[f'{name}, {known[0]}']:.3f} ({known[0]})" if known else None
            )
            rows[name] = row
    table = pd.DataFrame.from_dict(rows, orient="index")
    table.index.name = "scheme"
    return table


def describe_means(means: pd.DataFrame) -> str:
    """Tell who does not see the figure the mean errors with uniform sampling.

    Parameters
    ----------
    means : DataFrame
        From :func:`mean_errors`.
    """
    names = [str(name) for name in means.index]
    values = "; ".join(
        f"{name} {value:.2f}" for name, value in zip(names, means["US"], strict=True)
    )
    numbers = means[list(SELECTORS)].to_numpy(float)
    row, column = divmod(int(numbers.argmin()), len(SELECTORS))
    return (
        "Bar charts of the mean error of four keyframe selectors with three temporal and six "
        f"spatial schemes. With uniform sampling: {values}. The lowest is {names[row]} with "
        f"{list(SELECTORS)[column]}, {numbers.min():.2f}."
    )


def against_uniform(clips: pd.DataFrame) -> pd.DataFrame:
    """Compare each elaborate selector with uniform sampling on the same clips.

    Parameters
    ----------
    clips : DataFrame
        From :func:`errors`.

    Returns
    -------
    DataFrame
        One row per panel and selector: the mean error over that of uniform sampling,
        geometric mean over the schemes of the panel, with its interval over clips.
    """
    rows = {}
    for panel in (TEMPORAL, RAW, OPTIMIZED):
        for selector in ELABORATE:
            pair = np.stack([_with(clips, panel, name).to_numpy() for name in (selector, "US")], 1)
            found = bootstrap(pair, _mean_ratio)
            rows[f"{panel}, {selector}"] = {
                "error / error of US": found.value,
                "from": found.low,
                "to": found.high,
            }
    table = pd.DataFrame.from_dict(rows, orient="index")
    table.index.name = "selector"
    return table


def _with(clips: pd.DataFrame, panel: str, selector: str) -> pd.DataFrame:
    """Take the errors of a panel's schemes with one selector."""
    return clips[[(panel, name, selector) for name in schemes(panel, selector)]]


def _mean_ratio(pair: np.ndarray) -> float:
    """Compare means over clips, geometric mean over schemes; shape (n_clips, 2, n_schemes)."""
    means = pair.mean(axis=0)
    return float(np.exp(np.log(means[0] / means[1]).mean()))


def evidence(clips: pd.DataFrame) -> dict[str, Evidence]:
    """Give the evidence for the claims about Figure 5.2.

    Parameters
    ----------
    clips : DataFrame
        From :func:`errors`.

    Returns
    -------
    dict of str to Evidence
        By the ids of the claims.
    """
    uniform = {panel: _with(clips, panel, "US") for panel in (TEMPORAL, RAW, OPTIMIZED)}
    n_temporal = len(INTERPOLATORS)

    def spatial_over_temporal(values: np.ndarray) -> float:
        means = values.mean(axis=0)
        return float(means[n_temporal:].mean() / means[:n_temporal].min())

    def best_elaborate(values: np.ndarray) -> float:
        means = values.mean(axis=0).reshape(len(SELECTORS), -1)
        logarithms = np.log(means[1:] / means[0]).mean(axis=1)
        return float(np.exp(logarithms.min()))

    by_scheme = pd.concat(
        [
            _with(clips, panel, selector)
            for selector in SELECTORS
            for panel in (TEMPORAL, RAW, OPTIMIZED)
        ],
        axis=1,
    )
    best = [(OPTIMIZED, "t-SNE", "US"), (TEMPORAL, "Slerp", "SCS")]
    return {
        "costa2018:temporal-alike": evidence_of(
            uniform[TEMPORAL], lambda v: float(v.mean(axis=0).max() / v.mean(axis=0).min())
        ),
        "costa2018:uniform-not-beaten": evidence_of(by_scheme, best_elaborate),
        "costa2018:spatial-needs-optimization": evidence_of(
            pd.concat([uniform[TEMPORAL], uniform[OPTIMIZED]], axis=1), spatial_over_temporal
        ),
        "costa2018:raw-spatial-is-worse": evidence_of(
            pd.concat([uniform[TEMPORAL], uniform[RAW]], axis=1), spatial_over_temporal
        ),
        "costa2018:best-means": evidence_of(
            clips[best], lambda v: float(v[:, 0].mean() / v[:, 1].mean())
        ),
    }
