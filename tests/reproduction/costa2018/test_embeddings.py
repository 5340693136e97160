"""Curves of motions: which runs are drawn, how rough they are and whether they close."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from workbench.errors import WorkbenchError
from workbench.experiments.grid import run_grid
from workbench.experiments.runs.schemes import SchemeRun
from workbench.experiments.store import ResultStore
from workbench.reproduction.claims import claim_by_id, verdict
from workbench.reproduction.costa2018 import embeddings, keyframe_errors
from workbench.schemes import SpatialScheme

CLIP = "cmu/01_03-walk"


def test_runs_of_all_clips_are_those_of_table_5_1():
    """A reproduction computes them once: only the figures' own runs are added."""
    mine = {str(run) for run in embeddings.planned_runs("quick", 0)}
    theirs = {str(run) for run in keyframe_errors.planned_runs("quick", 0)}
    shown = embeddings.shown_clip("quick").name
    assert mine - theirs
    assert all(text.startswith(shown) for text in mine - theirs)
    assert len(mine) == len(embeddings.planned_runs("quick", 0))


def test_panels_are_those_of_the_captions():
    """Eight panels in Figure 6.2, five in Figures 3.4 and 4.1, in the order of the captions."""
    assert [title.partition(",")[0] for title in embeddings.FIGURE_6_2][:4] == [
        "Force",
        "MDS",
        "PCA",
        "t-SNE",
    ]
    assert [t for t in embeddings.FIGURE_6_2 if t.startswith("LLE")] == [
        "LLE, US",
        "LLE, SCS",
        "LLE, PB",
        "LLE, ROLS",
    ]
    assert list(embeddings.FIGURE_3_4) == list(embeddings.FIGURE_4_1)
    assert len(embeddings.FIGURE_3_4) == 5


def test_panels_are_read_from_the_store(tmp_path):
    """Figure 6.2 shows projections, Figure 4.1 the same after the optimizer, on the same keys."""
    run = SchemeRun(CLIP, embeddings.OPTIMIZED["PCA"], ratio=0.03)
    table = run_grid([run], tmp_path, n_jobs=1)
    store = ResultStore(tmp_path)
    (raw,) = embeddings.panels(table, store, CLIP, embeddings.FIGURE_6_2)
    (optimized,) = embeddings.panels(table, store, CLIP, embeddings.FIGURE_4_1)
    assert (raw.title, optimized.title) == ("PCA, US", "PCA")
    keys = raw.control_points
    assert np.array_equal(raw.points[keys], optimized.points[keys])
    assert not np.array_equal(raw.points, optimized.points)
    ratios = embeddings.roughness_ratios(table, store)
    expected = embeddings.roughness(optimized.points) / embeddings.roughness(raw.points)
    assert ratios.loc[CLIP, "PCA"] == pytest.approx(expected)
    with pytest.raises(WorkbenchError, match="no run"):
        embeddings.panels(table, store, "cmu/01_01-turn", embeddings.FIGURE_6_2)


def test_roughness_of_known_curves():
    """A straight motion has 0, there and back 2, independent points about √3."""
    assert embeddings.roughness(np.arange(10.0)[:, None] * [3.0, 4.0]) == pytest.approx(0)
    points = np.random.default_rng(0).normal(size=(20_000, 2))
    assert embeddings.roughness(points) == pytest.approx(np.sqrt(3), rel=0.02)
    assert np.isnan(embeddings.roughness(np.zeros((5, 2))))


def test_the_cycle_of_a_circle_is_found_and_closed():
    """A point that goes around in 40 frames closes after 40."""
    angle = 2 * np.pi * np.arange(130) / 40
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    distances = np.linalg.norm(circle[:, None] - circle[None], axis=2)
    assert embeddings.cycle_length(distances) == 40
    assert embeddings.closure(circle, 40) == pytest.approx(0, abs=1e-12)


def test_a_motion_that_goes_on_has_no_cycle():
    """A straight line never comes back."""
    line = np.arange(50.0)
    assert embeddings.cycle_length(np.abs(line[:, None] - line[None])) is None


def test_evidence_for_scattering_is_the_median_of_medians():
    """Each clip counts once, by the median of its projectors; incomplete clips do not."""
    ratios = pd.DataFrame(
        {name: np.linspace(1.2, 1.9, 8) for name in keyframe_errors.RAW},
        index=[f"clip {i}" for i in range(8)],
    )
    ratios.iloc[0, 0] = np.nan
    found = embeddings.scatter_evidence(ratios)
    assert found.estimate.value == pytest.approx(1.6)
    assert found.estimate.n_units == 7
    assert verdict(claim_by_id("costa2018:optimizer-scatters"), found) == "reproduced"


def test_evidence_for_closing_leaves_out_clips_without_a_cycle():
    """What has no cycle says nothing about cycles, and the note tells how many."""
    column = "one cycle apart / half a cycle apart"
    found = embeddings.cyclic_evidence(pd.DataFrame({column: [0.1, 0.2, 0.3, np.nan]}))
    assert found.estimate.value == pytest.approx(0.2)
    assert "In 1 of them" in found.note
    nothing = embeddings.cyclic_evidence(pd.DataFrame({column: [np.nan]}))
    assert nothing.estimate is None


def test_failed_runs_are_left_out():
    """A table in which all runs failed gives empty tables and no panel."""
    scheme = SpatialScheme("mds", selector="uniform", optimizer="alg12")
    table = pd.DataFrame(
        [{"status": "failed", "dataset": CLIP, "scheme": "mds + alg12, uniform", "key": "x"}]
    )
    assert embeddings.OPTIMIZED["MDS"] == scheme
    assert embeddings.roughness_ratios(table, None).empty
    assert embeddings.closures(table, None, "quick").empty
