"""Tests of workbench.compact, from the file's bytes to the command line."""

from __future__ import annotations

import json

import numpy as np
import pytest

from workbench.backprojection.poses import PoseBackProjector
from workbench.backprojection.rbf import RBF
from workbench.compact import compact_motion, read_compact, write_compact
from workbench.errors import DataError, WorkbenchError
from workbench.interpolation import interpolators
from workbench.mocap import read_bvh
from workbench.mocap.rotations import geodesic_angles
from workbench.schemes import SpatialScheme, TemporalScheme
from workbench.spaces import PoseSpace, VectorSpace


@pytest.fixture(params=["pca", *interpolators.names()])
def compacted(request, waving):
    """Give a scheme's result and its compact form: one spatial, and each interpolator."""
    space = PoseSpace(waving)
    if request.param == "pca":
        result = SpatialScheme("pca", optimizer="alg12").run(space, count=12)
        return result, compact_motion(result)
    result = TemporalScheme(request.param).run(space, count=12)
    return result, compact_motion(result, request.param)


def test_the_file_rebuilds_what_was_measured(compacted, tmp_path):
    """Written, read and expanded, rotations are those of the result, to float32 rounding."""
    result, compact = compacted
    write_compact(compact, tmp_path / "clip.compact")
    motion = read_compact(tmp_path / "clip.compact").expand()
    angles = geodesic_angles(motion.rotations, result.reconstruction)
    # Between markers the back-projection amplifies the rounding of positions a little.
    assert angles.max() < 1e-5
    assert np.abs(motion.root_translation - result.space.motion.root_translation).max() < 1e-6
    keys = result.control_points
    at_keys = geodesic_angles(motion.rotations[keys], result.space.samples[keys])
    assert at_keys.max() < 4e-7


def test_skeleton_and_timing_survive(compacted, tmp_path):
    """Names, bones, ends, channels and frame time come back exactly."""
    result, compact = compacted
    write_compact(compact, tmp_path / "clip.compact")
    motion = read_compact(tmp_path / "clip.compact").expand()
    original = result.space.motion
    assert motion.skeleton.same_structure(original.skeleton)
    assert motion.skeleton.channels == original.skeleton.channels
    assert (motion.frame_time, motion.name) == (original.frame_time, original.name)


@pytest.mark.parametrize("share", [0.0, 0.3, 0.9, 0.999])
def test_truncated_files_are_refused(compacted, tmp_path, share):
    """Cut anywhere, the file is named as damaged."""
    path = tmp_path / "clip.compact"
    write_compact(compacted[1], path)
    whole = path.read_bytes()
    path.write_bytes(whole[: int(share * len(whole))])
    with pytest.raises(DataError, match=r"clip\.compact: is damaged or no compact file"):
        read_compact(path)


def test_damaged_files_never_give_another_motion(compacted, tmp_path):
    """A changed byte is refused, or stands where it does not matter (in the ZIP's own notes)."""
    path = tmp_path / "clip.compact"
    write_compact(compacted[1], path)
    whole = path.read_bytes()
    expected = read_compact(path).expand().rotations
    refused = 0
    for position in np.random.default_rng(0).choice(len(whole), 60, replace=False):
        damaged = bytearray(whole)
        damaged[position] ^= 0x55
        path.write_bytes(damaged)
        try:
            found = read_compact(path).expand().rotations
        except DataError:
            refused += 1
        else:
            assert np.array_equal(found, expected)
    assert refused > 40


def test_other_archives_and_later_versions_are_refused(compacted, tmp_path):
    """The message says which format or version was found."""
    path = tmp_path / "clip.npz"
    np.savez(path, a=np.arange(3))
    with pytest.raises(DataError, match="header"):
        read_compact(path)
    write_compact(compacted[1], path)
    with np.load(path) as archive:
        arrays = dict(archive)
    header = json.loads(arrays["header"].tobytes()) | {"version": 99}
    arrays["header"] = np.frombuffer(json.dumps(header).encode(), dtype=np.uint8)
    np.savez(path, **arrays)
    with pytest.raises(DataError, match="is of version 99, this program reads 1"):
        read_compact(path)


def test_a_failed_write_leaves_the_old_file(compacted, tmp_path, monkeypatch):
    """If the new file cannot be moved into place, the old one is as it was."""
    path = tmp_path / "clip.compact"
    path.write_bytes(b"old")

    def refuse(*_):
        raise OSError("no space left")

    monkeypatch.setattr("workbench.files.os.replace", refuse)
    with pytest.raises(OSError, match="no space left"):
        write_compact(compacted[1], path)
    assert path.read_bytes() == b"old"
    assert [p.name for p in tmp_path.iterdir()] == ["clip.compact"]


def test_what_a_file_cannot_hold_is_refused(waving):
    """Tables and results of other back-projectors have no compact form."""
    table = VectorSpace(np.random.default_rng(0).random((20, 3)))
    with pytest.raises(WorkbenchError, match="that of a table"):
        compact_motion(SpatialScheme("pca").run(table, count=5))
    other = SpatialScheme("pca", back_projector=PoseBackProjector(RBF()))
    with pytest.raises(WorkbenchError, match="want a temporal scheme's"):
        compact_motion(other.run(PoseSpace(waving), count=5))


def test_compact_and_expand_on_the_command_line(run, tmp_path):
    """A clip is compacted and expanded to a BVH file with the reported error."""
    small, rebuilt = tmp_path / "jump.compact", tmp_path / "jump.bvh"
    words = ["compact", "cmu/01_01-jump", "--projector", "pca", "--optimize", "--out", small]
    status, out, _ = run(*words, "--json")
    assert status == 0
    assert small.stat().st_size < 20_000
    assert run("expand", small, "--out", rebuilt)[0] == 0
    from workbench.datasets import load_space

    space = load_space("cmu/01_01-jump")
    errors = space.errors(np.arange(len(space)), read_bvh(rebuilt).rotations)
    assert errors.mean() == pytest.approx(json.loads(out)["error_per_frame_per_joint"], abs=1e-5)


def test_expanding_something_else_is_one_line(run, tmp_path):
    """A BVH file is no compact file, and a target must be BVH."""
    other = tmp_path / "x.compact"
    other.write_text("HIERARCHY")
    status, _, err = run("expand", other, "--out", tmp_path / "y.bvh")
    assert status == 2
    assert "is damaged or no compact file" in err
    assert err.count("\n") == 1
    assert run("expand", other, "--out", tmp_path / "y.fbx")[0] == 2


def test_expanding_something_else_gives_no_unsafe_advice(run, compacted, tmp_path):
    """A table, or a compact file whose first byte is damaged, is named as what it is."""
    other = tmp_path / "three.csv"
    write_compact(compacted[1], other)
    damaged = b"Q" + other.read_bytes()[1:]
    for content in (b"a,b,c\n1,2,3\n", b"", damaged):
        other.write_bytes(content)
        status, out, err = run("expand", other, "--out", tmp_path / "x.bvh")
        assert status == 2
        assert out == ""
        assert err.rstrip().endswith("three.csv: is damaged or no compact file (no ZIP archive)")


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
