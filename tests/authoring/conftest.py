"""A short clip and a scene made of it, shared by the tests of authoring."""

from __future__ import annotations

import pytest

from workbench import load_space
from workbench.authoring import scene_from_clip
from workbench.spaces import PoseSpace


@pytest.fixture(scope="package")
def jump():
    """Give a bundled jump, every sixth frame: 50 frames in 2.5 s."""
    return PoseSpace(load_space("cmu/01_01-jump").motion[::6])


@pytest.fixture(scope="package")
def scene(jump):
    """Give its scene with six markers of frames."""
    return scene_from_clip(jump, "cmu/01_01-jump", selector="uniform", count=6, projector="pca")
