"""Values of runs are arranged by clip, and evidence says what it rests on."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from tests.reproduction.costa2018.synthetic import results_of
from workbench.errors import WorkbenchError
from workbench.experiments.runs.schemes import SchemeRun
from workbench.reproduction.claims import Evidence
from workbench.reproduction.costa2018 import results
from workbench.schemes import SpatialScheme, TemporalScheme

SLERP, TSNE = TemporalScheme("slerp"), SpatialScheme("tsne", "uniform", optimizer="alg12")
CLIPS = ("cmu/b", "cmu/a")


def _table(failing: str = "") -> pd.DataFrame:
    runs = [SchemeRun(clip, SLERP, ratio=0.03) for clip in CLIPS]
    runs += [SchemeRun(clip, TSNE, ratio=0.03, seed=seed) for clip in CLIPS for seed in (0, 1)]

    def values(run):
        if run["dataset"] == failing and run["kind"] == "spatial":
            return "too short"
        error = {"cmu/a": 1.0, "cmu/b": 2.0}[run["dataset"]]
        return {"error": error if run["kind"] == "temporal" else error / 2 + run["seed"]}

    return results_of(runs, values)


def test_values_are_means_over_seeds_in_the_order_of_the_clips():
    """t-SNE has 0.5 and 1.5 on a, 1 and 2 on b, which comes first."""
    found = results.values_by_clip(_table(), {"slerp": SLERP, "t-SNE": TSNE})
    assert found.index.tolist() == ["cmu/b", "cmu/a"]
    assert found["slerp"].tolist() == [2.0, 1.0]
    assert found["t-SNE"].tolist() == [1.5, 1.0]


def test_failed_runs_and_absent_values_are_missing():
    """A scheme that failed on a clip has no value there; an unknown column has none at all."""
    table = _table(failing="cmu/a")
    assert results.values_by_clip(table, {"t-SNE": TSNE})["t-SNE"].to_dict() == {"cmu/b": 1.5}
    both = results.values_by_clip(table, {"slerp": SLERP, "t-SNE": TSNE})
    assert both["t-SNE"].isna().tolist() == [False, True]
    assert results.values_by_clip(table, {"slerp": SLERP}, "stress_ratio").empty
    assert results.on_all(both, table).index.tolist() == ["cmu/b"]


def test_nothing_to_compare_is_an_error_that_says_why():
    """If no clip has all values, the reason of the first failure is passed on."""
    table = _table().assign(status="failed", message="no kernel")
    values = results.values_by_clip(table, {"slerp": SLERP})
    with pytest.raises(WorkbenchError, match=r"no clip has all runs\. 6 of 6 .*: no kernel"):
        results.on_all(values, table)


def test_evidence_leaves_out_incomplete_clips_and_says_so():
    """Two of three clips remain; the note tells that one is missing."""
    found = results.evidence_of(pd.Series([1.0, 3.0, np.nan]), lambda v: float(v.mean()))
    assert found.estimate is not None
    assert (found.estimate.value, found.estimate.n_units) == (2.0, 2)
    assert "Without 1 of 3 clips" in found.note
    assert results.evidence_of(pd.Series([np.nan]), lambda v: float(v.mean())).estimate is None


def test_medians_are_compared_over_clips_and_seeds():
    """A scheme without a seed stands for every seed: medians 1.25 and 1.5."""
    schemes = {"t-SNE": TSNE, "slerp": SLERP}
    found = results.compare_medians(_table(), schemes, lambda m: float(m[0] / m[1])).estimate
    assert found is not None
    assert found.value == pytest.approx(1.25 / 1.5)
    assert (found.n_units, found.n_seeds) == (2, 2)
    nothing = _table().assign(status="failed")
    assert results.compare_medians(nothing, schemes, lambda m: float(m[0])).estimate is None


def test_twice_and_half_as_much_cancel_out():
    """The geometric mean of 2 and 1/2 is 1; a missing ratio leaves none."""
    ratios = pd.DataFrame({"a": [2.0, 1.0], "b": [0.5, np.nan]})
    found = results.geometric_mean(ratios)
    assert found[0] == pytest.approx(1.0)
    assert np.isnan(found[1])


def test_judged_claims_show_the_effect_and_the_verdict():
    """Without an estimate a claim is not decidable."""
    row = results.judged({"costa2018:temporal-alike": Evidence(None)}).iloc[0]
    assert row["verdict"] == "not decidable"
    assert row["holds"] == "below 1.1"
