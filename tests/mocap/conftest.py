"""Fixtures of the tests of motion capture."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest

_BVH = """HIERARCHY
ROOT Hips
{
    OFFSET 0 0 0
    CHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation Xrotation
    JOINT Leg
    {
        OFFSET 0 -1 0
        CHANNELS 3 Zrotation Xrotation Yrotation
        End Site
        {
            OFFSET 0 -2 0
        }
    }
}
MOTION
Frames: 2
Frame Time: 0.01
1 2 3 10 20 30 40 50 60
1 2 4 11 21 31 41 51 61
"""


@pytest.fixture
def bvh_text() -> str:
    """Give the text of a small BVH file: two joints, nine channels, two frames."""
    return _BVH


@pytest.fixture
def write_file(tmp_path: Path) -> Callable[..., Path]:
    """Give a function that writes a file as it stands and returns its path."""

    def write(content: str | bytes, name: str = "clip.bvh") -> Path:
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    return write


@pytest.fixture
def real_mocap() -> Path:
    """Give a folder with bvh/ and asf_amc/ of the CMU database."""
    for folder in os.environ.get("WORKBENCH_DATA", "").split(os.pathsep):
        mocap = Path(folder) / "mocap"
        if folder and (mocap / "asf_amc").is_dir() and (mocap / "bvh").is_dir():
            return mocap
    pytest.skip("needs mocap/bvh and mocap/asf_amc in a folder named by WORKBENCH_DATA")
