"""What optimization is worth for held-out samples, from the results of their runs."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from workbench.errors import WorkbenchError
from workbench.experiments.bootstrap import Estimate, bootstrap
from workbench.reproduction.beyond.held_out import PROJECTORS
from workbench.reproduction.costa2018.keyframe_errors import RATIO

#: What the samples are and how they were split, from the most to the least that is new.
STRETCHES = "Clips, stretches held out"
FRAMES = "Clips, frames held out"
RAW_TABLES = "Tables, raw"
STANDARDIZED_TABLES = "Tables, standardised"
SETTINGS = (STRETCHES, FRAMES, RAW_TABLES, STANDARDIZED_TABLES)

#: Samples whose error is compared, with the columns after and before optimization.
_GAINS = {
    "training samples": ("training_error_alg12", "training_error_raw"),
    "held-out samples": ("error_alg12_mean", "error_raw_mean"),
}
#: All projectors together.
ALL = "all"

#: What rebuilds held-out samples, by what it has to keep of the training samples, with the
#: column of its error.
METHODS = {
    "keeps few samples": {
        "raw positions": "error_raw_mean",
        "Alg. 12": "error_alg12_mean",
        "local": "error_local_mean",
        "nearest control point": "error_plane_control",
        "PCA's own inverse": "error_inverse",
    },
    "keeps all training samples": {
        "nearest in the plane": "error_plane_nearest",
        "5 nearest in the plane": "error_plane_mean",
        "nearest in the data": "error_data_nearest",
    },
    "looks at the answer": {"own best position": "error_self_placed"},
}
#: Error of the poorest sensible reconstruction.
MEAN_SAMPLE = "error_mean_sample"

_MAPS = {"five nearest": "mean", "nearest": "nearest", "RBFP": "rbf"}


def finished(table: pd.DataFrame, ratio: float = RATIO) -> pd.DataFrame:
    """Take the finished runs at one share of control points, with their settings.

    Parameters
    ----------
    table : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.
    ratio : float
        Share of the training samples that are control points.

    Returns
    -------
    DataFrame
        With the columns ``setting``, one of :data:`SETTINGS`, and ``method``, the
        projector's name.

    Raises
    ------
    WorkbenchError
        If no run has finished.
    """
    done = table[(table["status"] == "done") & (table["ratio"] == ratio)]
    if done.empty:
        raise WorkbenchError(f"all runs failed; the first: {table['message'].iloc[0]}")
    of_table = done["dataset"].str.startswith("uci/")
    scaled = done["standardize"].astype(bool)
    setting = np.select(
        [~of_table & (done["split"] == "blocks"), ~of_table, ~scaled],
        [STRETCHES, FRAMES, RAW_TABLES],
        STANDARDIZED_TABLES,
    )
    names = {method: name for name, method in PROJECTORS.items()}
    return done.assign(setting=setting, method=done["projector"].map(names))


def ratios(rows: pd.DataFrame, numerator: str, denominator: str) -> NDArray[np.float64]:
    """Compute ratios of two errors for each data set.

    Parameters
    ----------
    rows : DataFrame
        From :func:`finished`, or some of it.
    numerator, denominator : str
        Columns of errors.

    Returns
    -------
    ndarray of shape (n_datasets,)
        Geometric means over what else the runs differ in: projectors, and the scaling of a
        table. Runs without one of the errors are left out; empty if none is left.
    """
    logs = log_ratio(rows, numerator, denominator)
    values: NDArray[np.float64] = np.exp(logs.groupby(rows["dataset"]).mean().dropna().to_numpy())
    return values


def estimate(rows: pd.DataFrame, numerator: str, denominator: str) -> Estimate | None:
    """Estimate the median of :func:`ratios` with an interval over data sets.

    None if there is no value.
    """
    values = ratios(rows, numerator, denominator)
    return bootstrap(values, _median) if values.size else None


def _median(values: NDArray[np.float64]) -> float:
    """Compute the median; numpy's own takes three times as long for so few values."""
    ordered = np.sort(values, axis=None)
    return float(ordered[(ordered.size - 1) // 2] + ordered[ordered.size // 2]) / 2


def gains(rows: pd.DataFrame) -> dict[str, dict[str, dict[str, Estimate]]]:
    """Estimate errors with positions by Alg. 12 over those with raw ones, for a figure.

    Parameters
    ----------
    rows : DataFrame
        From :func:`finished`.

    Returns
    -------
    dict of str to dict of str to dict of str to Estimate
        By setting, "training samples" or "held-out samples", and projector, all of them last.
    """
    return {
        setting: {
            samples: _estimates({name: (some, columns) for name, some in _by_projector(of_setting)})
            for samples, columns in _GAINS.items()
        }
        for setting, of_setting in by_setting(rows)
    }


def gain_table(rows: pd.DataFrame) -> pd.DataFrame:
    """Compare the gain on training samples with that on held-out ones, by each map.

    Parameters
    ----------
    rows : DataFrame
        From :func:`finished`.

    Returns
    -------
    DataFrame
        One row for each setting and projector; medians over data sets of the error
        by Alg. 12 relative to that of raw positions, and to raw ones placed by the
        projector's own ``transform``.
    """
    described = {}
    for setting, of_setting in by_setting(rows):
        for name, some in _by_projector(of_setting):
            row = {
                ("training", "Alg. 12 / raw"): ("training_error_alg12", "training_error_raw"),
                **{
                    ("held out, Alg. 12 / raw", f"placed by {label}"): (
                        f"error_alg12_{column}",
                        f"error_raw_{column}",
                    )
                    for label, column in _MAPS.items()
                },
                ("held out", "Alg. 12 / raw, own transform"): (
                    "error_alg12_mean",
                    "error_raw_own",
                ),
            }
            described[f"{setting}: {name}"] = {
                label: median_ratio(some, *columns) for label, columns in row.items()
            } | {("", "data sets"): some["dataset"].nunique()}
    return as_table(described, "setting, projector")


def method_errors(rows: pd.DataFrame) -> dict[str, dict[str, dict[str, Estimate]]]:
    """Estimate the error of everything that rebuilds held-out samples, for a figure.

    Parameters
    ----------
    rows : DataFrame
        From :func:`finished`.

    Returns
    -------
    dict of str to dict of str to dict of str to Estimate
        By setting, what is kept, and method: the error relative to that of the training
        samples' mean.
    """
    return {
        setting: {
            keeping: _estimates(
                {label: (of_setting, (column, MEAN_SAMPLE)) for label, column in methods.items()}
            )
            for keeping, methods in METHODS.items()
        }
        for setting, of_setting in by_setting(rows)
    }


def method_table(rows: pd.DataFrame) -> pd.DataFrame:
    """Compare the methods of :func:`method_errors` in numbers.

    Parameters
    ----------
    rows : DataFrame
        From :func:`finished`.

    Returns
    -------
    DataFrame
        One row for each method, one column for each setting; medians over data sets.
    """
    columns = {
        setting: {
            label: median_ratio(of_setting, column, MEAN_SAMPLE)
            for methods in METHODS.values()
            for label, column in methods.items()
        }
        for setting, of_setting in by_setting(rows)
    }
    return pd.DataFrame(columns).rename_axis("method")


def by_setting(rows: pd.DataFrame) -> list[tuple[str, pd.DataFrame]]:
    """Split rows by their settings, in the order of :data:`SETTINGS`."""
    groups = dict(list(rows.groupby("setting")))
    return [(setting, groups[setting]) for setting in SETTINGS if setting in groups]


def _by_projector(rows: pd.DataFrame) -> list[tuple[str, pd.DataFrame]]:
    groups = dict(list(rows.groupby("method")))
    found = [(name, groups[name]) for name in PROJECTORS if name in groups]
    return [*found, (ALL, rows)] if len(found) > 1 else found


def _estimates(
    wanted: dict[str, tuple[pd.DataFrame, tuple[str, str]]],
) -> dict[str, Estimate]:
    """Estimate ratios of columns of rows; those without a value are left out."""
    found = {name: estimate(rows, *columns) for name, (rows, columns) in wanted.items()}
    return {name: value for name, value in found.items() if value is not None}


def log_ratio(rows: pd.DataFrame, numerator: str, denominator: str) -> pd.Series:
    """Compute the logarithm of the ratio of two errors of each run."""
    quotient = rows[numerator].astype(float) / rows[denominator].astype(float)
    return quotient.map(math.log)


def median_ratio(rows: pd.DataFrame, numerator: str, denominator: str) -> float:
    """Compute the median of :func:`ratios`; NaN if there is none."""
    values = ratios(rows, numerator, denominator)
    return float(np.median(values)) if values.size else float("nan")


def as_table(described: dict[str, dict[tuple[str, str], float]], name: str) -> pd.DataFrame:
    """Make a table of described rows, with two levels of columns."""
    table = pd.DataFrame.from_dict(described, orient="index")
    table.columns = pd.MultiIndex.from_tuples(list(next(iter(described.values()))))
    table.index.name = name
    return table
