"""Tests of the commands compact and expand."""

from __future__ import annotations

import gzip
import json

import numpy as np
import pytest

from tests.conftest import find_clip
from workbench.compact import compact_motion, write_compact
from workbench.datasets import load, load_space
from workbench.mocap import read_bvh, write_bvh
from workbench.schemes import TemporalScheme
from workbench.spaces import PoseSpace


def test_compact_and_expand_give_the_reported_error(run, tmp_path):
    """A clip is compacted and expanded to a BVH file with the error and size reported."""
    small, rebuilt = tmp_path / "jump.compact", tmp_path / "jump.bvh"
    words = ["compact", "cmu/01_01-jump", "--projector", "pca", "--optimize", "--out", small]
    status, out, _ = run(*words, "--json")
    values = json.loads(out)
    assert status == 0
    assert small.stat().st_size == values["bytes"] < 8000
    assert run("expand", small, "--out", rebuilt)[0] == 0
    space = load_space("cmu/01_01-jump")
    errors = space.errors(np.arange(len(space)), read_bvh(rebuilt).rotations)
    assert errors.mean() == pytest.approx(values["expanded_error_per_frame_per_joint"], abs=1e-7)
    assert errors.mean() <= 1.01 * values["error_per_frame_per_joint"]


def test_sizes_are_compared_with_the_file_that_the_clip_came_from(run):
    """A whole clip's BVH file counts as it is; the size is the same without --out."""
    path = find_clip("01_01")
    words = ["compact", "cmu/01_01", "--interpolator", "slerp", "--ratio", 0.01, "--json"]
    values = json.loads(run(*words)[1])
    assert values["bvh_bytes"] == path.stat().st_size
    assert values["gzip_bytes"] == len(gzip.compress(path.read_bytes(), 9, mtime=0))
    assert values["float32_bytes"] == 4 * 96 * 2751
    for name in ("bvh", "gzip", "float32"):
        assert values[f"ratio_to_{name}"] == values[f"{name}_bytes"] / values["bytes"]
    own = json.loads(run("compact", path, *words[2:])[1])
    assert own["bvh_bytes"] == path.stat().st_size


def test_every_kind_of_scheme_can_be_compacted(run, tmp_path):
    """Selectors, frames to keep, two steps, three dimensions and each optimizer, by name."""
    clip = tmp_path / "jump.bvh"
    write_bvh(load("cmu/01_01-jump")[::3], clip)
    common = ["compact", clip, "--count", 8, "--json", "--out", tmp_path / "x"]
    for words in (
        ["--interpolator", "hermite", "--selector", "optimal"],
        ["--interpolator", "hermite-keys", "--selector", "scs", "--keep", 7, "--keep", 20],
        ["--projector", "pca", "--dimensions", 3, "--optimizer", "local"],
        ["--projector", "pca", "--two-step", "--optimizer", "global", "--selector", "pb"],
        ["--projector", "isomap", "--control-point-projector", "lamp"],
        ["--projector", "pca", "--optimizer", "local", "--markers", "move", "--keep", 7],
        ["--projector", "pca", "--optimizer", "local", "--markers", "exchange"],
    ):
        status, out, err = run(*common, *words)
        values = json.loads(out)
        assert status == 0, err
        assert len(values["keyframes"]) == 8
        assert {word for word in words if word in (7, 20)} <= set(values["keyframes"])
        added = values["expanded_error_per_frame_per_joint"] - values["error_per_frame_per_joint"]
        assert added <= 0.01 * values["error_per_frame_per_joint"]
        assert run("expand", tmp_path / "x", "--out", tmp_path / "x.bvh")[0] == 0


def test_expanding_something_else_is_one_line(run, tmp_path):
    """A BVH file is no compact file, and a target must be BVH."""
    other = tmp_path / "x.compact"
    other.write_text("HIERARCHY")
    status, _, err = run("expand", other, "--out", tmp_path / "y.bvh")
    assert status == 2
    assert "is damaged or no compact file" in err
    assert err.count("\n") == 1
    assert run("expand", other, "--out", tmp_path / "y.fbx")[0] == 2


def test_expanding_something_else_says_so(run, waving, tmp_path):
    """A table, or a compact file whose first byte is damaged, is named as what it is."""
    other = tmp_path / "three.csv"
    result = TemporalScheme("slerp").run(PoseSpace(waving), count=12)
    write_compact(compact_motion(result, "slerp"), other)
    damaged = b"Q" + other.read_bytes()[1:]
    for content in (b"a,b,c\n1,2,3\n", b"", damaged):
        other.write_bytes(content)
        status, out, err = run("expand", other, "--out", tmp_path / "x.bvh")
        assert status == 2
        assert out == ""
        assert err.rstrip().endswith("three.csv: is damaged or no compact file (another signature)")


def test_expanding_a_missing_file_or_a_folder_is_one_line(run, tmp_path):
    """What is no file is said so."""
    status, _, err = run("expand", tmp_path / "none.compact", "--out", tmp_path / "x.bvh")
    assert (status, err.count("\n")) == (2, 1)
    assert "there is no such file" in err
    status, _, err = run("expand", tmp_path, "--out", tmp_path / "x.bvh")
    assert (status, err.count("\n")) == (2, 1)
    assert "is damaged or no compact file" in err


def test_a_folder_as_output_is_refused_before_computing(run, tmp_path, monkeypatch):
    """No scheme runs when its result could not be written under the given name."""

    def compute(*_, **__):
        pytest.fail("computed before the output was checked")

    monkeypatch.setattr(TemporalScheme, "run", compute)
    words = ["compact", "cmu/01_01-jump", "--interpolator", "slerp", "--out", tmp_path]
    status, _, err = run(*words)
    assert status == 2
    assert f"--out: got the folder {str(tmp_path)!r}, want the name of a file" in err
    assert err.count("\n") == 1


def test_a_file_that_cannot_be_written_is_named(run, tmp_path, monkeypatch):
    """The line names the file that was asked for, not a temporary one."""

    def refuse(*_):
        raise OSError(28, "No space left on device", "some.part")

    monkeypatch.setattr("workbench.files.write_atomically", refuse)
    for words in (
        ["compact", "cmu/01_01-jump", "--interpolator", "slerp", "--out", tmp_path / "x.compact"],
        ["project", "uci/iris", "--out", tmp_path / "x.csv"],
    ):
        status, out, err = run(*words)
        assert (status, out) == (2, "")
        assert err.endswith(f"{words[-1]}: cannot be written (No space left on device)\n")
    assert not list(tmp_path.iterdir())
