"""The saliency method, read otherwise."""

from __future__ import annotations

import numpy as np
import pytest

from workbench import load_space
from workbench.datasets.catalogue import lookup
from workbench.datasets.loaders import status
from workbench.errors import WorkbenchError
from workbench.experiments.runs.saliency_readings import SaliencyReadingRun
from workbench.experiments.runs.saliency_times import SaliencyTimeRun, played_forth_and_back
from workbench.experiments.runs.shared import SharedSteps
from workbench.mocap.motion_saliency import motion_saliency
from workbench.reproduction.halit2010.motions import STRETCHING
from workbench.spaces import VectorSpace


@pytest.fixture(scope="module")
def shared():
    """Give smooth curves with shared and own parts."""
    rng = np.random.default_rng(0)
    frames = np.arange(500)[:, None]
    values = np.sin(frames * rng.uniform(0.01, 0.2, 12) + 6 * rng.random(12)) @ rng.normal(
        size=(12, 9)
    )
    return SharedSteps(VectorSpace(values))


def keyframes(shared, **reading):
    """Run a reading; give its keyframes without the ends that rebuilding adds."""
    run = SaliencyReadingRun("mine", sigma=6.0, n_components=5, **reading)
    row, arrays = run.execute(shared)
    assert len(arrays["control_points"]) == row["n_control_points"]
    return run._keyframes(shared.space.samples)


@pytest.mark.parametrize("curvature", ["slope", "value"])
@pytest.mark.parametrize("unit_variance", [True, False])
@pytest.mark.parametrize("width", [2.0, 4.0])
def test_the_readings_of_the_library_are_computed_alike(shared, curvature, unit_variance, width):
    """Normalised and compared in two places, the same maps lead to the same frames."""
    expected = motion_saliency(
        shared.space.samples,
        6.0,
        5,
        curvature=curvature,
        standardize=unit_variance,
        cluster_width=width,
    ).keyframes
    found = keyframes(shared, curvature=curvature, unit_variance=unit_variance, cluster_width=width)
    assert np.array_equal(found, expected)


def test_a_common_factor_of_a_curve_changes_no_candidate_of_its_own(shared):
    """Stretching maps over one curve or over all differs only where curves are compared."""
    same = [keyframes(shared, normalization=name) for name in ("curve", "motion")]
    assert np.array_equal(*same)
    differ = [keyframes(shared, normalization=n, threshold="motion") for n in ("curve", "motion")]
    assert not np.array_equal(*differ)


def test_unknown_readings_are_refused():
    """The message lists those that are known."""
    with pytest.raises(WorkbenchError, match="normalization: got 'all', want one of curve"):
        SaliencyReadingRun("mine", normalization="all")
    with pytest.raises(WorkbenchError, match="threshold: got 'mean', want one of curve"):
        SaliencyReadingRun("mine", threshold="mean")


def test_the_default_reaches_the_published_numbers():
    """On "stretching" within 10 % of 131 keyframes and 1.5 dB of 42.90 dB; 2σ is far off."""
    if status(lookup(STRETCHING)).state != "available":  # it is not downloaded for a test
        pytest.skip("needs mocap/asf_amc/13_29.amc in a folder named by WORKBENCH_DATA")
    steps = SharedSteps(load_space(STRETCHING))
    row, _ = SaliencyReadingRun(STRETCHING).execute(steps)
    assert row["n_keyframes"] == pytest.approx(131, rel=0.1)
    assert row["psnr"] == pytest.approx(42.90, abs=1.5)
    printed, _ = SaliencyReadingRun(STRETCHING, cluster_width=2.0).execute(steps)
    assert printed["n_keyframes"] > 1.3 * 131


def test_long_motions_have_no_jump():
    """A clip played forth and back moves by no more than one step of the clip at a time."""
    values = np.random.default_rng(0).normal(size=(7, 2))
    long = played_forth_and_back(values, 50)
    assert long.shape == (50, 2)
    assert np.abs(np.diff(long, axis=0)).max() == np.abs(np.diff(values, axis=0)).max()
    assert np.array_equal(played_forth_and_back(values, 4), values[:4])


def test_time_runs_time_the_whole_motion(shared):
    """Twice the frames have about twice the keyframes; the time is a column of seconds."""
    short, long = (SaliencyTimeRun("mine", n).execute(shared)[0] for n in (2000, 4000))
    assert long["n_control_points"] == pytest.approx(2 * short["n_control_points"], rel=0.15)
    assert long["seconds_total"] > 0
