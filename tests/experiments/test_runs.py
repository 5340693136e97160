"""Runs and their content keys."""

from __future__ import annotations

import hashlib
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from sklearn.decomposition import PCA

from workbench.errors import WorkbenchError
from workbench.experiments.runs import base
from workbench.experiments.runs.base import content_key, space_checksum
from workbench.experiments.runs.schemes import SchemeRun
from workbench.experiments.versions import code_digest, digest_of_code, versions
from workbench.mocap.motion import Motion
from workbench.schemes import SpatialScheme, TemporalScheme
from workbench.spaces import PoseSpace, VectorSpace

RUN = SchemeRun("uci/iris", SpatialScheme("pca", selector="random"), ratio=0.03)

CHANGES = {
    "dataset": {"dataset": "uci/wine"},
    "projector": {"scheme": SpatialScheme("mds", selector="random")},
    "optimizer": {"scheme": SpatialScheme("pca", selector="random", optimizer="alg12")},
    "two steps": {"scheme": SpatialScheme("pca", selector="random", two_step="rbfp")},
    "dimensions": {"scheme": SpatialScheme("pca", selector="random", dimensions=3)},
    "markers": {"scheme": SpatialScheme("pca", selector="random", markers="move")},
    "kind": {"scheme": TemporalScheme("slerp", selector="random")},
    "ratio": {"ratio": 0.04},
    "count": {"ratio": None, "count": 4},
    "seed": {"seed": 1},
    "standardize": {"standardize": True},
}


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES.keys())
def test_key_changes_with_every_part_of_a_run(change):
    """Two runs that differ in anything have different keys."""
    assert content_key(replace(RUN, **change), "data") != content_key(RUN, "data")


def test_key_changes_with_the_data_the_code_and_the_versions(monkeypatch):
    """A result of other data, other code or another numpy is not taken for this one's."""
    key = content_key(RUN, "data")
    assert content_key(RUN, "other data") != key
    with monkeypatch.context() as patch:
        patch.setattr(base, "code_digest", lambda: "other code")
        assert content_key(RUN, "data") != key
    for package in ("workbench", "numpy", "scikit-learn", "umap-learn"):
        with monkeypatch.context() as patch:
            patch.setattr(base, "versions", lambda package=package: {**versions(), package: "0"})
            assert content_key(RUN, "data") != key
    assert content_key(RUN, "data") == key


def test_key_is_the_same_in_every_process(monkeypatch):
    """The key is the known SHA-256 of known content, not something of this process."""
    monkeypatch.setattr(base, "versions", lambda: {"numpy": "2.4"})
    monkeypatch.setattr(base, "code_digest", lambda: "def")
    monkeypatch.setattr(base, "_digest_of_kind", lambda module: "ghi")
    text = (
        '{"code":["def","ghi"],"data":"abc","kind":"workbench.experiments.runs.schemes.SchemeRun",'
        '"run":{"back_projector":null,"count":null,"dataset":"uci/iris","dimensions":null,'
        '"kind":"spatial","markers":null,"optimizer":null,"projector":"pca","ratio":0.03,'
        '"scheme":"pca, random","seed":0,"selector":"random","standardize":false,'
        '"two_step":null},"versions":{"numpy":"2.4"}}'
    )
    assert content_key(RUN, "abc") == hashlib.sha256(text.encode()).hexdigest()


@pytest.mark.parametrize(
    ("module", "decides"),
    [
        ("kernels.py", True),
        ("projection/pca.py", True),
        ("optimization/objective.py", True),
        ("experiments/runs/new.py", True),
        ("experiments/grid.py", False),
        ("reproduction/report.py", False),
        ("figures/style.py", False),
        ("cli/new.py", False),
        ("compact/new.py", True),
    ],
)
def test_digest_notices_code_that_computes(tmp_path: Path, module: str, decides: bool):
    """A changed line of a projector changes the digest; one of the report does not."""
    package = tmp_path / "workbench"
    source = Path(base.__file__).parents[2]
    shutil.copytree(source, package, ignore=shutil.ignore_patterns("__pycache__"))
    before = digest_of_code(package)
    assert before == code_digest()
    path = package / module
    path.write_text((path.read_text() if path.exists() else "") + "x = 1\n")
    assert (digest_of_code(package) != before) == decides


def test_checksum_notices_one_changed_bit():
    """The checksum of a table changes with the last bit of one number."""
    values = np.arange(12.0).reshape(4, 3)
    changed = values.copy()
    changed[2, 1] = np.nextafter(changed[2, 1], np.inf)
    assert space_checksum(VectorSpace(values)) == space_checksum(VectorSpace(values.copy()))
    assert space_checksum(VectorSpace(values)) != space_checksum(VectorSpace(changed))


def test_checksum_of_a_motion_depends_on_its_skeleton(waving: Motion):
    """Longer bones weigh joints differently, so the same rotations are other data."""
    longer = replace(waving.skeleton, offsets=2.5 * waving.skeleton.offsets)
    stretched = replace(waving, skeleton=longer)
    assert space_checksum(PoseSpace(waving)) != space_checksum(PoseSpace(stretched))


def test_methods_must_be_names():
    """An object cannot be stored with a result; the message says what to do."""
    with pytest.raises(WorkbenchError, match="projector of a run: got PCA, want a registered name"):
        SchemeRun("uci/iris", SpatialScheme(PCA()), ratio=0.03)


@pytest.mark.parametrize("amount", [{}, {"ratio": 0.1, "count": 3}], ids=["neither", "both"])
def test_exactly_one_of_ratio_and_count(amount):
    """A run without a number of control points, or with two, is refused."""
    with pytest.raises(WorkbenchError, match="exactly one"):
        SchemeRun("uci/iris", SpatialScheme("pca"), **amount)


def test_a_run_reads_as_a_sentence():
    """Messages name a run so that it can be recognised."""
    run = SchemeRun("cmu/05_10", TemporalScheme("slerp", selector="uniform"), count=24, seed=3)
    assert str(run) == "cmu/05_10, slerp, uniform, 24 control points, seed 3"
