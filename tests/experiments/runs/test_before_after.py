"""Runs that measure a scheme before and after optimization."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from workbench import load_space
from workbench.errors import WorkbenchError
from workbench.experiments.runs.base import content_key
from workbench.experiments.runs.before_after import BeforeAfterRun
from workbench.experiments.runs.schemes import SchemeRun
from workbench.experiments.runs.shared import SharedSteps
from workbench.schemes import SpatialScheme, TemporalScheme

ONE_STEP = SpatialScheme("pca", selector="rols", optimizer="alg12")
TWO_STEPS = replace(ONE_STEP, two_step="rbfp")


@pytest.mark.parametrize("scheme", [ONE_STEP, TWO_STEPS], ids=["one step", "two steps"])
def test_before_and_after_are_the_two_schemes(scheme):
    """Both errors are those of separate runs without and with the optimizer."""
    shared = SharedSteps(load_space("uci/iris", standardize=True))
    row, arrays = BeforeAfterRun("uci/iris", scheme, ratio=0.05, seed=3).execute(shared)
    for optimizer, name in ((None, "projected_error"), ("alg12", "error")):
        alone, errors = SchemeRun(
            "uci/iris", replace(scheme, optimizer=optimizer), ratio=0.05, seed=3
        ).execute(shared)
        assert row[name] == pytest.approx(alone["error"], rel=1e-12)
        assert np.allclose(arrays[f"{name}s"], errors["errors"], rtol=1e-9, atol=1e-12)
    assert row["error"] < row["projected_error"]


def test_it_is_not_taken_for_a_run_of_the_scheme_alone():
    """The same scheme as another kind of run has another key."""
    both, alone = (kind("uci/iris", ONE_STEP, ratio=0.03) for kind in (BeforeAfterRun, SchemeRun))
    assert both != alone
    assert content_key(both, "data") != content_key(alone, "data")


@pytest.mark.parametrize(
    "scheme",
    [replace(ONE_STEP, optimizer=None), replace(ONE_STEP, markers="move"), TemporalScheme()],
    ids=["no optimizer", "moved markers", "temporal"],
)
def test_schemes_without_a_before_and_after_are_refused(scheme):
    """The message says what is wanted."""
    with pytest.raises(WorkbenchError, match="want a spatial scheme with an optimizer"):
        BeforeAfterRun("uci/iris", scheme, ratio=0.03)
