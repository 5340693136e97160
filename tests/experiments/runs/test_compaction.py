"""Runs that write compact files."""

from __future__ import annotations

import numpy as np
import pytest

from workbench import load_space
from workbench.compact import compact_motion, read_compact, write_compact
from workbench.errors import WorkbenchError
from workbench.experiments.runs.compaction import CompactionRun, MotionFormsRun
from workbench.experiments.runs.shared import SharedSteps
from workbench.mocap import read_motion
from workbench.mocap.bvh_writer import write_bvh
from workbench.schemes import SpatialScheme, TemporalScheme

CLIP = "cmu/01_01-jump"
SLERP = TemporalScheme("slerp", selector="uniform")
PCA = SpatialScheme("pca", selector="uniform", optimizer="alg12")


@pytest.fixture(scope="module")
def shared() -> SharedSteps:
    """Load a bundled clip."""
    return SharedSteps(load_space(CLIP))


@pytest.mark.parametrize(
    ("scheme", "interpolator"), [(SLERP, "slerp"), (PCA, None)], ids=["slerp", "PCA"]
)
def test_bytes_are_those_on_the_disk(tmp_path, shared, scheme, interpolator):
    """The row's bytes and error are those of a file that is written and read again."""
    row, arrays = CompactionRun(CLIP, scheme, ratio=0.03).execute(shared)
    result = scheme.run(shared.space, ratio=0.03, random_state=0)
    path = tmp_path / "clip.wbc"
    write_compact(compact_motion(result, interpolator), path)
    rebuilt = read_compact(path).rotations()
    frames = np.arange(len(shared.space))
    assert row["bytes"] == path.stat().st_size
    assert row["file_error"] == pytest.approx(shared.space.errors(frames, rebuilt).mean())
    assert row["error"] == pytest.approx(result.error)
    assert np.allclose(arrays["errors"], result.errors)


def test_positions_between_keyframes_lie_on_straight_lines(shared):
    """The plane error is that of a loop that places each frame by hand."""
    row, arrays = CompactionRun(CLIP, PCA, ratio=0.03).execute(shared)
    result = PCA.run(shared.space, ratio=0.03, random_state=0)
    keys = result.control_points
    for frame in (1, 57, 202):
        after = int(np.searchsorted(keys, frame))
        left, right = keys[after - 1], keys[after]
        share = (frame - left) / (right - left)
        place = (1 - share) * result.embedding[left] + share * result.embedding[right]
        error = shared.space.errors([frame], result.back_projector.predict(place[None]))[0]
        assert arrays["plane_errors"][frame] == pytest.approx(error)
    assert not arrays["plane_errors"][keys].any()
    assert row["plane_error"] > row["error"]


def test_a_motion_in_other_forms(tmp_path, shared):
    """BVH bytes are those of the file that the package writes; float32 counts 3·J + 3 numbers."""
    row, _ = MotionFormsRun(CLIP).execute(shared)
    write_bvh(shared.space.motion, tmp_path / "clip.bvh")
    assert row["bvh_bytes"] == (tmp_path / "clip.bvh").stat().st_size
    assert row["gzip_bytes"] < row["bvh_bytes"]
    assert row["float32_bytes"] == 4 * 96 * 300
    assert len(read_motion(tmp_path / "clip.bvh")) == row["n_samples"]


def test_tables_have_no_compact_file():
    """A table is refused with a sentence."""
    with pytest.raises(WorkbenchError, match="want a motion"):
        CompactionRun("uci/iris", PCA, ratio=0.03).execute(SharedSteps(load_space("uci/iris")))
