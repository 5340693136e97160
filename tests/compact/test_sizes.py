"""Tests of workbench.compact.sizes."""

from __future__ import annotations

import gzip

import pytest

from tests.conftest import find_clip
from workbench.compact import compact_bytes, compact_motion, compare_sizes
from workbench.datasets import load_space
from workbench.errors import WorkbenchError
from workbench.mocap import write_bvh
from workbench.schemes import SpatialScheme, TemporalScheme


def test_sizes_are_those_of_the_files(waving, tmp_path):
    """BVH and gzip are counted in bytes that were written, float32 by its formula."""
    path = tmp_path / "clip.bvh"
    write_bvh(waving, path)
    sizes = compare_sizes(1000, waving, path)
    assert sizes == compare_sizes(1000, waving)
    assert sizes.bvh_bytes == path.stat().st_size
    assert gzip.decompress(gzip.compress(path.read_bytes(), 9)) == path.read_bytes()
    assert sizes.gzip_bytes == len(gzip.compress(path.read_bytes(), 9, mtime=0))
    assert sizes.float32_bytes == 60 * (4 * 3 + 3) * 4
    values = sizes.as_dict()
    assert values["ratio_to_bvh"] == sizes.bvh_bytes / 1000
    assert values["ratio_to_gzip"] == sizes.gzip_bytes / 1000
    assert values["ratio_to_float32"] == 3.6


def test_no_bytes_are_refused(waving):
    """A file of no bytes has no ratio."""
    with pytest.raises(WorkbenchError, match="n_bytes: got 0"):
        compare_sizes(0, waving)


def test_a_real_clip_becomes_forty_times_smaller_than_float32():
    """05_10 at 3 %: at most a 40th of plain float32 numbers, and a 30th of its gzip."""
    path = find_clip("05_10")
    space = load_space("cmu/05_10")
    slerp = TemporalScheme("slerp").run(space, ratio=0.03)
    isomap = SpatialScheme("isomap", optimizer="alg12").run(space, ratio=0.03, random_state=0)
    for result, interpolator in ((slerp, "slerp"), (isomap, None)):
        compact = compact_motion(result, interpolator)
        assert compact.error < 1.01 * result.error
        sizes = compare_sizes(len(compact_bytes(compact)), space.motion, path)
        assert sizes.ratio_to_float32 > 40
        assert sizes.ratio_to_gzip > 28
