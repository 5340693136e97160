"""Fixtures of the tests of compact motions."""

from __future__ import annotations

import pytest

from workbench.compact import compact_motion
from workbench.interpolation import interpolators
from workbench.schemes import SpatialScheme, TemporalScheme
from workbench.spaces import PoseSpace


@pytest.fixture(params=["pca", *interpolators.names()])
def compacted(request, waving):
    """Give a scheme's result and its compact form: one spatial, and each interpolator."""
    space = PoseSpace(waving)
    if request.param == "pca":
        result = SpatialScheme("pca", optimizer="alg12").run(space, count=12)
        return result, compact_motion(result)
    result = TemporalScheme(request.param).run(space, count=12)
    return result, compact_motion(result, request.param)
