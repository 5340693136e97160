"""Section 5.1 of Costa 2018: how small motions get, by formula and as files."""

from __future__ import annotations

from typing import Any

import numpy as np
import pandas as pd

from workbench.experiments.bootstrap import Estimate
from workbench.experiments.runs.base import Run
from workbench.experiments.runs.compaction import CompactionRun, MotionFormsRun
from workbench.experiments.runs.equal_size import EqualSizeRun
from workbench.experiments.runs.schemes import Scheme, scheme_name
from workbench.figures.tradeoffs import Curve
from workbench.reproduction.claims import Evidence
from workbench.reproduction.costa2018.results import evidence_of, values_by_clip
from workbench.reproduction.costa2018.size_formulas import (
    equal_size_difference,
    spatial_limit,
    spatial_size,
    temporal_limit,
    temporal_size,
    whole_size,
)
from workbench.reproduction.profiles import motion_clips
from workbench.reproduction.published import published
from workbench.schemes import SpatialScheme, TemporalScheme

#: Share of the frames that are keyframes in the text.
RATIO = 0.03
#: Bytes of a number, where formulas are compared with files.
BYTES = 4

SLERP = TemporalScheme("slerp", selector="uniform")
TSNE = SpatialScheme("tsne", selector="uniform", optimizer="alg12")

#: Schemes of the figure; those of the text come first.
SCHEMES: dict[str, Scheme] = {
    "Slerp": SLERP,
    "t-SNE, optimized": TSNE,
    "Hermitian": TemporalScheme("hermite-keys", selector="uniform"),
    "Isomap, optimized": SpatialScheme("isomap", selector="uniform", optimizer="alg12"),
    "PCA, optimized": SpatialScheme("pca", selector="uniform", optimizer="alg12"),
}
#: Schemes of the figure whose points say how many keyframes they are for.
_LABELLED = ("Slerp", "t-SNE, optimized")
_QUICK_SCHEMES = ("Slerp", "t-SNE, optimized", "Hermitian")
_RATIOS = {
    "quick": (0.02, RATIO, 0.06),
    "full": (0.01, 0.02, RATIO, 0.04, 0.06, 0.08, 0.1),
}
#: On how many clips, spread over those of the profile.
_N_CLIPS = {"quick": 2, "full": 10}

#: Claims about the formulas, and what they say.
LIMIT_CLAIMS = {
    "costa2018:limit-temporal": 100 * temporal_limit(RATIO),
    "costa2018:limit-spatial": 100 * spatial_limit(RATIO),
    "costa2018:keyframes-for-equal-size": 100 * equal_size_difference(),
}


def clips_of(profile: str) -> list[str]:
    """Choose clips spread over those of a profile."""
    names = motion_clips(profile)
    return names[:: -(-len(names) // _N_CLIPS[profile])]


def planned_runs(profile: str, seed: int) -> list[Run]:
    """List the runs that the notebook reads for its default parameters."""
    return compression_runs(clips_of(profile), profile, seed=seed)


def compression_runs(clips: list[str], profile: str, *, seed: int = 0) -> list[Run]:
    """List the runs of the trade-off, of equal sizes and of other forms of the clips.

    Parameters
    ----------
    clips : list of str
        Names of clips.
    profile : {"quick", "full"}
        How many schemes and ratios.
    seed : int
        Seed of the projectors that take one.

    Returns
    -------
    list of Run
    """
    names = _QUICK_SCHEMES if profile == "quick" else tuple(SCHEMES)
    runs: list[Run] = []
    for clip in clips:
        runs.append(MotionFormsRun(clip))
        runs += [
            CompactionRun(clip, SCHEMES[name], ratio=ratio, seed=seed)
            for name in names
            for ratio in _RATIOS[profile]
        ]
        runs.append(EqualSizeRun(clip, SLERP, TSNE, RATIO, seed=seed))
    return runs


def limits_table() -> pd.DataFrame:
    """Set our limits of Eq. 5.1 to 5.3 beside the published ones, in per cent."""
    theirs = published("costa2018:sec5.1").table()["per cent"].astype(float)
    ours = pd.Series(list(LIMIT_CLAIMS.values()), index=theirs.index)
    table = pd.DataFrame({"ours": ours, "published": theirs, "difference": ours - theirs})
    table.index.name = "per cent"
    return table


def bytes_table(results: pd.DataFrame) -> pd.DataFrame:
    """Set the bytes of formulas beside those of files, clip by clip, at 3 % keyframes.

    Parameters
    ----------
    results : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.

    Returns
    -------
    DataFrame
        One row for each clip with finished runs. Formulas are for 4 bytes a number, without
        header; "of whole" is the file's size over Eq. 5.1, in per cent.
    """
    rows: dict[str, dict[tuple[str, str], Any]] = {}
    for clip, forms in _forms(results).iterrows():
        n_frames, n_joints = int(forms["n_samples"]), int(forms["n_joints"])
        whole = BYTES * whole_size(n_frames, n_joints=n_joints)
        row: dict[tuple[str, str], Any] = {
            ("motion", "frames"): n_frames,
            ("motion", "BVH"): int(forms["bvh_bytes"]),
            ("motion", "gzip"): int(forms["gzip_bytes"]),
            ("motion", "Eq. 5.1"): int(whole),
        }
        for name, size in (("Slerp", temporal_size), ("t-SNE, optimized", spatial_size)):
            file = _row(results, clip, SCHEMES[name])
            if file is None:
                break
            ratio = file["n_control_points"] / n_frames
            row[name, "equation"] = round(BYTES * size(n_frames, ratio, n_joints=n_joints))
            row[name, "file"] = int(file["bytes"])
            row[name, "of whole, %"] = 100 * file["bytes"] / whole
            row[name, "of gzip, %"] = 100 * file["bytes"] / forms["gzip_bytes"]
            row[name, "error"] = file["file_error"]
        else:
            rows[str(clip)] = row
    return _framed(rows, "clip")


def equal_size_table(results: pd.DataFrame) -> pd.DataFrame:
    """Compare slerp at equal bytes, and positions interpolated in the plane, with t-SNE.

    Parameters
    ----------
    results : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.

    Returns
    -------
    DataFrame
        One row for each clip whose runs have finished.
    """
    rows: dict[str, dict[tuple[str, str], Any]] = {}
    for _, equal in equal_sizes(results).iterrows():
        stored = _row(results, equal["dataset"], TSNE)
        if stored is None:
            continue
        rows[str(equal["dataset"])] = {
            ("t-SNE, optimized", "keyframes"): int(equal["reference_n_control_points"]),
            ("t-SNE, optimized", "bytes"): int(equal["reference_bytes"]),
            ("t-SNE, optimized", "error"): equal["reference_file_error"],
            ("slerp, as large", "keyframes"): int(equal["n_control_points"]),
            ("slerp, as large", "bytes"): int(equal["bytes"]),
            ("slerp, as large", "error"): equal["file_error"],
            ("slerp, as large", "error / t-SNE"): equal["file_error"]
            / equal["reference_file_error"],
            ("t-SNE, keyframes only", "error"): stored["plane_error"],
            ("t-SNE, keyframes only", "error / stored"): stored["plane_error"] / stored["error"],
        }
    return _framed(rows, "clip")


def equal_sizes(results: pd.DataFrame) -> pd.DataFrame:
    """Give the finished runs that look for an equal size."""
    return results[(results["status"] == "done") & (results["kind"] == "equal size")]


def trade_off_curves(results: pd.DataFrame, *, by_formula: bool = False) -> list[Curve]:
    """Average errors and sizes over clips, one curve over the keyframe ratios for each scheme.

    Parameters
    ----------
    results : DataFrame
        From :func:`workbench.experiments.grid.run_grid`.
    by_formula : bool
        Whether sizes are those of Eq. 5.2 and 5.3, not of files.

    Returns
    -------
    list of Curve
        Sizes in per cent of Eq. 5.1 at 4 bytes a number; geometric means over the clips on
        which all runs have finished.
    """
    forms = _forms(results)
    done = results[(results["status"] == "done") & results["bytes"].notna()]
    done = done[done["kind"] != "equal size"]
    if done.empty or forms.empty:
        return []
    whole = done["dataset"].map(forms["float32_bytes"])
    sizes = done["bytes"] / whole
    if by_formula:
        joints = done["dataset"].map(forms["n_joints"])
        shares = done["n_control_points"] / done["n_samples"]
        limit = shares * (3 * joints + 1) + 3 + 2 * (done["kind"] == "spatial")
        sizes = limit / (3 * joints + 3)
    done = done.assign(size=100 * sizes).dropna(subset=["size"])
    counts = done.groupby("dataset").size()
    done = done[done["dataset"].isin(counts.index[counts == counts.max()])]
    curves = []
    for name, scheme in SCHEMES.items():
        rows = done[done["scheme"] == scheme_name(scheme)]
        if rows.empty:
            continue
        logarithms = rows[["size", "file_error"]].astype(float).transform(np.log)
        means = logarithms.groupby(rows["ratio"]).mean().transform(np.exp)
        curves.append(
            Curve(
                name,
                means["size"].tolist(),
                means["file_error"].tolist(),
                [f"{100 * ratio:.3g} % keyframes" for ratio in means.index],
                [f"{100 * ratio:.3g} %" for ratio in means.index] if name in _LABELLED else (),
            )
        )
    return curves


def equal_size_evidence(results: pd.DataFrame) -> Evidence:
    """Give the error of slerp over that of optimized t-SNE in files of equal size."""
    runs = equal_sizes(results)
    ratios = pd.Series(dtype=float)
    if len(runs):
        ratios = (runs["file_error"] / runs["reference_file_error"]).astype(float)
    return evidence_of(
        ratios,
        lambda values: float(np.median(values)),
        f"Lower on {int((ratios < 1).sum())} of {len(ratios)} clips.",
    )


def plane_evidence(results: pd.DataFrame) -> Evidence:
    """Give the error with only projected keyframes stored over that with all positions stored."""
    at_ratio = results[results["ratio"] == RATIO]
    at_ratio = at_ratio[at_ratio["kind"] == "spatial"]
    columns = [values_by_clip(at_ratio, {"t-SNE": TSNE}, c) for c in ("plane_error", "error")]
    ratios = columns[0]["t-SNE"] / columns[1]["t-SNE"]
    return evidence_of(ratios, lambda values: float(np.median(values)))


def limit_evidence(claim: str) -> Evidence:
    """Give what a formula says about a claim of :data:`LIMIT_CLAIMS`."""
    return Evidence(Estimate.exact(LIMIT_CLAIMS[claim]), note="It follows from the formulas.")


def trade_off_alt(curves: list[Curve]) -> str:
    """Say what a reader who does not see the trade-off should know."""
    parts = [
        f"{curve.name}: error {curve.y[0]:.2f} at {curve.x[0]:.1f} % of the whole motion's size, "
        f"{curve.y[-1]:.2f} at {curve.x[-1]:.1f} %"
        for curve in curves
    ]
    return f"Curves of the error against size. {'; '.join(parts)}."


def _forms(results: pd.DataFrame) -> pd.DataFrame:
    done = results[(results["status"] == "done") & (results["kind"] == "forms")]
    return done.set_index("dataset")


def _row(results: pd.DataFrame, clip: Any, scheme: Scheme) -> dict[Any, Any] | None:
    """Find the finished run of a scheme on a clip at 3 % keyframes."""
    rows = results[
        (results["status"] == "done")
        & (results["dataset"] == clip)
        & (results["scheme"] == scheme_name(scheme))
        & (results["ratio"] == RATIO)
        & (results["kind"] != "equal size")
    ]
    return rows.iloc[0].to_dict() if len(rows) else None


def _framed(rows: dict[str, dict[tuple[str, str], Any]], index: str) -> pd.DataFrame:
    frame = pd.DataFrame.from_dict(rows, orient="index")
    if rows:
        frame.columns = pd.MultiIndex.from_tuples(list(next(iter(rows.values()))))
    frame.index.name = index
    return frame
