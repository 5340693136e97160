"""Values of finished runs, clip by clip and scheme by scheme, and evidence from them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from workbench.errors import WorkbenchError
from workbench.experiments.bootstrap import bootstrap
from workbench.experiments.grid import describe_failures
from workbench.experiments.runs.schemes import Scheme, scheme_name
from workbench.reproduction.claims import Evidence, claim_by_id, verdict

#: Projectors of the thesis by their names there, in its order.
PROJECTORS = {
    "Force": "force",
    "Isomap": "isomap",
    "LLE": "lle",
    "MDS": "mds",
    "PCA": "pca",
    "t-SNE": "tsne",
}


def values_by_clip(
    table: pd.DataFrame, schemes: Mapping[str, Scheme], column: str = "error"
) -> pd.DataFrame:
    """Arrange a value of finished runs by clip and scheme.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`, all runs at one ratio.
    schemes : mapping of str to scheme
        What to call each scheme.
    column : str
        Which value, such as ``"stress_ratio"``.

    Returns
    -------
    DataFrame of shape (n_clips, n_schemes)
        Means over seeds; missing where no run is finished.
    """
    by_seed = {name: values_by_seed(table, scheme, column) for name, scheme in schemes.items()}
    means = {name: values.mean(axis=1) for name, values in by_seed.items()}
    clips = list(dict.fromkeys(clip for values in means.values() for clip in values.index))
    return pd.DataFrame(means, index=pd.Index(clips, name="dataset"), columns=list(schemes))


def values_by_seed(table: pd.DataFrame, scheme: Scheme, column: str = "error") -> pd.DataFrame:
    """Arrange a value of a scheme's finished runs by clip and seed.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`, all runs at one ratio.
    scheme : scheme
        The scheme.
    column : str
        Which value.

    Returns
    -------
    DataFrame of shape (n_clips, n_seeds)
        Clips in their order; missing where no run is finished.
    """
    chosen = (table["status"] == "done") & (table["scheme"] == scheme_name(scheme))
    rows = table.loc[chosen]
    if rows.empty or column not in rows:
        return pd.DataFrame(dtype=float)
    # Tests and tables of old runs may hold a single seed and not say so.
    seeds = rows["seed"].astype(int) if "seed" in rows else pd.Series(0, index=rows.index)
    index = pd.MultiIndex.from_arrays([rows["dataset"], seeds], names=["dataset", "seed"])
    values = pd.Series(rows[column].to_numpy(dtype=float), index).dropna()
    # Several runs of a clip may differ in what is not asked for here; the first stands for all.
    wide = values[~values.index.duplicated()].unstack()  # noqa: PD010 - pivot_table takes ten times as long
    return wide.reindex(index=list(dict.fromkeys(rows["dataset"])))


def on_all(values: pd.DataFrame, table: pd.DataFrame) -> pd.DataFrame:
    """Keep the clips that have all values, so that what is compared is of the same clips.

    Parameters
    ----------
    values : DataFrame of shape (n_clips, n_values)
        Such as errors of several schemes.
    table : DataFrame
        The runs that they are from.

    Returns
    -------
    DataFrame of shape (n_complete_clips, n_values)

    Raises
    ------
    WorkbenchError
        If there is no such clip; the message says why a run failed.
    """
    complete = values.dropna()
    if complete.empty:
        raise WorkbenchError(f"no clip has all runs. {describe_failures(table)}".strip())
    return complete


def evidence_of(
    values: pd.DataFrame | pd.Series,
    statistic: Callable[[NDArray[np.float64]], float],
    note: str = "",
) -> Evidence:
    """Estimate an effect over clips.

    Parameters
    ----------
    values : DataFrame of shape (n_clips, n_values) or Series of shape (n_clips,)
        What the effect is computed from.
    statistic : callable
        Takes these values as an array and gives the effect.
    note : str
        What a reader should know.

    Returns
    -------
    Evidence
        Without an estimate if no clip has all values.
    """
    complete = values.dropna()
    if complete.empty:
        reason = "There is no clip on which all runs that are compared have finished."
        return Evidence(None, note=f"{reason} {note}".strip())
    left_out = len(values) - len(complete)
    if left_out:
        note = f"{note} Without {left_out} of {len(values)} clips, where a run failed.".strip()
    return Evidence(bootstrap(complete.to_numpy(float), statistic), note=note)


def part(values: pd.DataFrame, name: str) -> pd.DataFrame:
    """Take the columns that stand under a name of the upper of two levels."""
    return values.loc[:, [name]].droplevel(0, axis=1)


def compare_medians(
    table: pd.DataFrame,
    schemes: dict[str, Scheme],
    effect: Callable[[NDArray[np.float64]], float],
) -> Evidence:
    """Estimate an effect of the schemes' medians over clips and seeds.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`, all runs at one ratio.
    schemes : dict of str to scheme
        The schemes that are compared.
    effect : callable
        Takes the schemes' median errors, an array of shape (n_schemes,), in their order.

    Returns
    -------
    Evidence
        From the clips on which all schemes have finished.
    """
    clips = values_by_clip(table, schemes).dropna().index
    if clips.empty:
        return Evidence(None, note="There is no clip on which all these schemes have finished.")
    by_seed = [values_by_seed(table, scheme).loc[clips] for scheme in schemes.values()]
    n_seeds = max(values.shape[1] for values in by_seed)
    # What takes no seed was run from one, and stands for all of them; so does a first seed
    # for another whose run failed.
    errors = [values.ffill(axis=1).bfill(axis=1).to_numpy() for values in by_seed]
    stacked = np.stack([values[:, np.arange(n_seeds) % values.shape[1]] for values in errors], -1)
    return Evidence(
        bootstrap(stacked, lambda values: effect(np.median(values, axis=0)), seeds=True)
    )


def geometric_mean(values: pd.DataFrame) -> pd.Series:
    """Average ratios over columns, so that twice as much and half as much cancel out."""
    return values.map(math.log).mean(axis=1, skipna=False).map(math.exp)


def listed(names: Iterable[str]) -> str:
    """Write names as a list in a sentence.

    Examples
    --------
    >>> listed(["a", "b", "c"])
    'a, b and c'
    """
    words = list(names)
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"


def judged(evidence: Mapping[str, Evidence]) -> pd.DataFrame:
    """Show the verdicts that evidence leads to.

    Parameters
    ----------
    evidence : mapping of str to Evidence
        By the ids of claims.

    Returns
    -------
    DataFrame
        One row per claim: the effect with its interval, where it holds, what was published.
    """
    rows = {}
    for claim_id, found in evidence.items():
        claim, estimate = claim_by_id(claim_id), found.estimate
        rows[claim.sentence] = {
            "effect": claim.effect,
            "ours": None if estimate is None else estimate.value,
            "from": None if estimate is None else estimate.low,
            "to": None if estimate is None else estimate.high,
            "holds": claim.holds_where,
            "published": claim.published,
            "verdict": verdict(claim, found),
        }
    table = pd.DataFrame.from_dict(rows, orient="index")
    table.index.name = "claim"
    return table


def describe_clips(
    table: pd.DataFrame,
    keyframes: str = "uniform keyframes, 3 %, first and last frame included",
    *,
    published: str = "70",
) -> str:
    """Say in a sentence which clips were used and how many, which keyframes, and what failed.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.
    keyframes : str
        Which frames are keyframes.
    published : str
        How many clips the thesis had; empty for what is not in it.

    Returns
    -------
    str

    Raises
    ------
    WorkbenchError
        If no run has finished.
    """
    done = table[table["status"] == "done"]
    clips = done.drop_duplicates("dataset")
    if clips.empty:
        raise WorkbenchError(f"all runs failed; the first: {table['message'].iloc[0]}")
    names = ", ".join(name.removeprefix("cmu/") for name in clips["dataset"])
    lengths = clips["n_samples"].astype(int)
    number = "1 CMU clip" if len(clips) == 1 else f"{len(clips)} CMU clips"
    shortest, longest = lengths.min(), lengths.max()
    span = str(longest) if shortest == longest else f"{shortest} to {longest}"
    theirs = f", where the thesis had {published}" if published else ""
    text = f"{number} of {span} frames ({names}){theirs}; {keyframes}."
    return f"{text} {describe_failures(table)}".strip()
