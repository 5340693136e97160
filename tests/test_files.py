"""Tests of workbench.files, on a disk that is really full."""

from __future__ import annotations

import subprocess

import pytest

from workbench.compact import compact_motion, write_compact
from workbench.errors import DataError
from workbench.files import write_atomically
from workbench.mocap import write_bvh
from workbench.schemes import TemporalScheme
from workbench.spaces import PoseSpace


@pytest.fixture
def small_disk(tmp_path):
    """Mount a file system of 16 kB, which needs root."""
    place = tmp_path / "disk"
    place.mkdir()
    words = ["mount", "-t", "tmpfs", "-o", "size=16k", "tmpfs", str(place)]
    try:
        mounted = subprocess.run(words, capture_output=True, text=True)
    except FileNotFoundError:
        pytest.skip("this machine has no mount")
    if mounted.returncode:
        pytest.skip(f"needs to mount a small disk: {mounted.stderr.strip()}")
    yield place
    subprocess.run(["umount", str(place)], check=True)


def test_a_full_disk_keeps_the_old_file(small_disk):
    """What does not fit is an error; the old content stays and no part is left behind."""
    path = small_disk / "file"
    write_atomically(path, b"old")
    with pytest.raises(OSError, match="No space left"):
        write_atomically(path, b"x" * 100_000)
    assert path.read_bytes() == b"old"
    assert list(small_disk.iterdir()) == [path]
    write_atomically(path, b"new")
    assert path.read_bytes() == b"new"


def test_motions_on_a_full_disk_are_refused_in_one_line(small_disk, waving):
    """A BVH file that does not fit leaves nothing behind; a compact one neither."""
    (small_disk / "filler").write_bytes(b"x" * 16_000)
    with pytest.raises(DataError, match=r"clip\.bvh: cannot be written \(No space left"):
        write_bvh(waving, small_disk / "clip.bvh")
    result = TemporalScheme().run(PoseSpace(waving), count=40)
    with pytest.raises(OSError, match="No space left"):
        write_compact(compact_motion(result, "slerp"), small_disk / "clip.compact")
    assert [path.name for path in small_disk.iterdir()] == ["filler"]
