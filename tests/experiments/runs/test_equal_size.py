"""Runs that look for equally large files."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from workbench import load_space
from workbench.experiments.runs.compaction import CompactionRun
from workbench.experiments.runs.equal_size import EqualSizeRun, largest_count
from workbench.experiments.runs.shared import SharedSteps
from workbench.schemes import SpatialScheme, TemporalScheme

CLIP = "cmu/01_01-jump"
SLERP = TemporalScheme("slerp", selector="uniform")
PCA = SpatialScheme("pca", selector="uniform", optimizer="alg12")


@pytest.fixture(scope="module")
def shared() -> SharedSteps:
    """Load a bundled clip."""
    return SharedSteps(load_space(CLIP))


def test_slerp_has_as_many_keyframes_as_fit(shared):
    """Its file is no larger than the other scheme's, and one keyframe more makes it larger."""
    row, _ = EqualSizeRun(CLIP, SLERP, PCA, 0.03).execute(shared)
    other, _ = CompactionRun(CLIP, PCA, ratio=0.03).execute(shared)
    here, next_ = (
        CompactionRun(CLIP, SLERP, count=row["n_control_points"] + more).execute(shared)[0]
        for more in (0, 1)
    )
    assert (row["reference_bytes"], row["reference_file_error"]) == (
        other["bytes"],
        other["file_error"],
    )
    assert here["bytes"] == row["bytes"] <= other["bytes"] < next_["bytes"]
    assert row["n_control_points"] > other["n_control_points"]


@given(
    slope=st.integers(1, 50),
    limit=st.integers(0, 3000),
    start=st.integers(3, 200),
    most=st.integers(200, 300),
)
def test_the_largest_count_is_found_from_anywhere(slope, limit, start, most):
    """Whatever the start, it is that of a search through all counts."""
    best = max([c for c in range(3, most + 1) if slope * c <= limit], default=3)
    tried = []
    found = largest_count(lambda count: tried.append(count) or slope * count, limit, start, most)
    assert found == best
    assert found in tried
    assert all(3 <= count <= most for count in tried)


def test_a_run_reads_as_a_sentence():
    """Messages name both schemes."""
    assert str(EqualSizeRun(CLIP, SLERP, PCA, 0.03)) == (
        f"{CLIP}, slerp, uniform as large as pca + alg12, uniform at 3 %, seed 0"
    )
