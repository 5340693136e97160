"""Table 5.1 from results whose errors are known."""

from __future__ import annotations

import math

import pandas as pd
import pytest

from workbench.errors import WorkbenchError
from workbench.experiments.runs.schemes import scheme_name
from workbench.reproduction.costa2018 import keyframe_errors
from workbench.reproduction.costa2018.results import describe_clips
from workbench.reproduction.published import published


def _results(errors: dict[str, list[float]]) -> pd.DataFrame:
    """Make a result table: for each scheme the errors of clips a, b, c and so on."""
    rows = [
        {
            "status": "done",
            "message": "",
            "dataset": f"cmu/{chr(ord('a') + clip)}",
            "scheme": scheme,
            "n_samples": 100 * (clip + 1),
            "error": error,
        }
        for scheme, values in errors.items()
        for clip, error in enumerate(values)
    ]
    return pd.DataFrame(rows)


SLERP = scheme_name(keyframe_errors.TEMPORAL["Slerp"])
TSNE_RAW = scheme_name(keyframe_errors.RAW["t-SNE"])
TSNE = scheme_name(keyframe_errors.OPTIMIZED["t-SNE"])
TABLE = _results({SLERP: [0.4, 0.5, 0.9], TSNE_RAW: [0.5, 0.6, 0.7], TSNE: [0.3, 0.6, 0.45]})


def test_ours_stands_beside_the_published_values():
    """The difference is ours minus the published value, and absent where one is missing."""
    table = keyframe_errors.table_5_1(keyframe_errors.boxes(TABLE))
    assert table.loc["Slerp", ("Q2", "ours")] == 0.5
    assert table.loc["Slerp", ("Q2", "published")] == 0.732
    assert table.loc["Slerp", ("Q2", "difference")] == pytest.approx(0.5 - 0.732)
    assert table.loc["t-SNE", ("Q2", "ours")] == 0.45
    assert math.isnan(table.loc["PCA", ("Q1", "ours")])
    assert "UMAP" not in table.index


def test_what_is_not_in_the_thesis_has_no_difference():
    """UMAP has values of ours and nothing beside them."""
    box = keyframe_errors.boxes(TABLE)["Slerp"]
    row = keyframe_errors.table_5_1({"UMAP": box}).loc["UMAP"]
    assert row["Q1", "ours"] == box.q1
    assert pd.isna(row["Q1", "published"])
    assert pd.isna(row["Q1", "difference"])


def test_every_published_row_is_shown():
    """Schemes without a result keep their row with the published values."""
    table = keyframe_errors.table_5_1(keyframe_errors.boxes(TABLE))
    theirs = published("costa2018:tab5.1").table()
    assert list(theirs.index) == list(table.index)
    for column in theirs:
        shown = table.loc[theirs.index, (column, "published")].astype(float)
        assert shown.tolist() == theirs[column].tolist()


def test_optimized_schemes_are_compared_with_slerp_clip_by_clip():
    """Better than slerp on the first and the last of three clips; medians 0.45 and 0.5."""
    row = keyframe_errors.medians_against_slerp(TABLE).loc["t-SNE"]
    assert row["median raw"] == 0.6
    assert row["median optimized"] == 0.45
    assert row["optimized / slerp, ours"] == pytest.approx(0.45 / 0.5)
    assert row["optimized / slerp, published"] == pytest.approx(0.515 / 0.732)
    assert row["clips where better"] == "2 of 3"


def test_medians_come_from_the_clips_that_all_have():
    """A failed run on the first clip takes that clip out of every median of the row."""
    without = TABLE[~((TABLE["scheme"] == TSNE_RAW) & (TABLE["dataset"] == "cmu/a"))]
    row = keyframe_errors.medians_against_slerp(without).loc["t-SNE"]
    assert row["median raw"] == pytest.approx((0.6 + 0.7) / 2)
    assert row["median optimized"] == pytest.approx((0.6 + 0.45) / 2)
    assert row["optimized / slerp, ours"] == pytest.approx((0.6 + 0.45) / (0.5 + 0.9))
    assert row["clips where better"] == "1 of 2"


def test_schemes_without_a_common_clip_are_not_compared():
    """Where no clip has all three runs there is no row, rather than one without numbers."""
    slerp = (TABLE["scheme"] == SLERP) & (TABLE["dataset"] != "cmu/a")
    apart = TABLE[~slerp & ~((TABLE["scheme"] == TSNE) & (TABLE["dataset"] == "cmu/a"))]
    assert keyframe_errors.medians_against_slerp(apart).empty


def test_one_clip_is_not_clips():
    """The caption of a single clip of a single length reads as a sentence."""
    text = describe_clips(TABLE[TABLE["dataset"] == "cmu/a"])
    assert text.startswith("1 CMU clip of 100 frames (a), where the thesis had 70")
    ours = describe_clips(TABLE[TABLE["dataset"] == "cmu/a"], published="")
    assert ours == text.replace(", where the thesis had 70", "")


def test_the_caption_says_which_clips_and_what_failed():
    """Clips, their number and lengths, and failures are in the sentence."""
    failure = {
        "status": "failed",
        "dataset": "cmu/d",
        "scheme": TSNE,
        "message": "cmu/d: too short",
    }
    text = describe_clips(pd.concat([TABLE, pd.DataFrame([failure])]))
    assert text.startswith("3 CMU clips of 100 to 300 frames (a, b, c), where the thesis had 70")
    assert text.endswith("1 of 10 runs failed; the first: cmu/d: too short")


def test_a_grid_that_failed_as_a_whole_is_an_error():
    """There is no table to draw when every run failed; the reason is passed on."""
    failed = TABLE.assign(status="failed", message="no kernel")
    with pytest.raises(WorkbenchError, match="all runs failed; the first: no kernel"):
        describe_clips(failed)


def test_runs_cover_raw_and_optimized():
    """Each spatial scheme is run raw and optimized, each temporal one once, on each clip."""
    runs = keyframe_errors.table_5_1_runs(["cmu/a", "cmu/b"], seed=4)
    assert len(runs) == 2 * (4 + 2 * 7)
    assert {run.seed for run in runs} == {4}
    some = keyframe_errors.table_5_1_runs(["cmu/a"], schemes=["Slerp", "PCA"])
    assert [scheme_name(run.scheme) for run in some] == [
        "slerp, uniform",
        "pca, uniform",
        "pca + alg12, uniform",
    ]


def test_the_quick_profile_leaves_out_what_is_not_in_the_thesis():
    """Quick computes all schemes of Table 5.1; full adds UMAP."""
    quick = keyframe_errors.schemes_of("quick")
    assert set(keyframe_errors.schemes_of("full")) - set(quick) == {"UMAP"}
    assert set(quick) == set(published("costa2018:tab5.1").table().index)


def test_an_unknown_scheme_is_refused():
    """A misspelt scheme is an error that lists the right ones."""
    with pytest.raises(WorkbenchError, match="schemes: got 'tsne', want some of Hermitian, Linear"):
        keyframe_errors.table_5_1_runs(["cmu/a"], schemes=["tsne"])
