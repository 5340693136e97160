"""The experiments on the saliency method, from results whose values are known."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from workbench.errors import WorkbenchError
from workbench.experiments.grid import run_grid
from workbench.experiments.runs.keyframes import KeyframeRun
from workbench.experiments.runs.saliency_readings import SaliencyReadingRun
from workbench.reproduction.halit2010 import (
    comparison,
    contacts,
    motions,
    parameters,
    readings,
    running_time,
    saliency_curves,
    selector_ranks,
)
from workbench.reproduction.halit2010.motions import CALM, DYNAMIC, STRETCHING

WALK, JUMP = "cmu/01_03-walk", "cmu/01_01-jump"


def results(values):
    """Make a result table from runs and the values that they are to have."""
    rows = [
        {"status": "done", "message": "", **run.specification(), "n_samples": 400, **row}
        for run, row in values
    ]
    return pd.DataFrame(rows)


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("cmu/05_01", CALM),
        ("cmu/07_05", CALM),
        (STRETCHING, CALM),
        ("cmu-amc/14_14", CALM),
        ("cmu/01_01-turn", CALM),
        ("cmu/06_02", DYNAMIC),
        ("cmu/05_10", DYNAMIC),
        ("cmu/09_06", DYNAMIC),
        ("cmu/01_03-climb-up", DYNAMIC),
        ("mine.bvh", DYNAMIC),
    ],
    ids=str,
)
def test_kinds_of_motion(name, kind):
    """Walking and stretching are calm; basketball, dancing, running and the unknown are not."""
    assert motions.kind_of_motion(name) == kind


def test_plans_share_their_runs():
    """A run that two notebooks want is one run, and no plan lists a run twice."""
    plans = [
        set(module.planned_runs("quick", clips=[WALK, JUMP]))
        for module in (parameters, comparison, readings)
    ]
    for module, plan in zip((parameters, comparison, readings), plans, strict=True):
        assert len(module.planned_runs("quick", clips=[WALK, JUMP])) == len(plan)
    assert plans[0] & plans[1] & plans[2]
    assert KeyframeRun(WALK, parameters=motions.recommended(WALK)) in plans[0] & plans[2]
    assert all(run.dataset == WALK for run in plans[1] if run.curves == "positions")


def test_the_quick_profile_is_part_of_the_full_one():
    """Values of quick parameters are found in tables by the full list of them."""
    for varied in parameters.VARIED:
        for clip in (WALK, JUMP):
            quick = parameters.varied_runs(clip, varied, "quick")
            full = parameters.varied_runs(clip, varied, "full")
            assert quick.items() <= full.items()


@pytest.fixture
def varied():
    """Give ratios that fall by 2 dB per component lost and by 1 dB per frame of σ."""
    values = []
    for clip, start in ((WALK, 50.0), (JUMP, 40.0)):
        for k, run in parameters.varied_runs(clip, "n_components", "full").items():
            values.append((run, {"psnr": start + 2 * min(k, 7), "n_control_points": 10 + k}))
        fixed = 7 if clip == WALK else 10
        for sigma, run in parameters.varied_runs(clip, "sigma", "full").items():
            # The same run varies both; it has one result.
            if sigma != dict(run.parameters)["sigma"] or sigma not in (3, 10):
                values.append((run, {"psnr": start + 14 - sigma, "n_control_points": fixed}))
    return results(values)


def test_gains_are_differences_of_ratios(varied):
    """Medians over the motions, of one kind or all; units are motions."""
    assert parameters.gain(varied, "n_components", 7, 3).estimate.value == pytest.approx(8.0)
    assert parameters.gain(varied, "n_components", 10, 7).estimate.value == 0.0
    dynamic = parameters.gain(varied, "sigma", 5, 7, DYNAMIC).estimate
    assert (dynamic.value, dynamic.n_units) == (pytest.approx(2.0), 1)
    assert parameters.level(varied, 9, CALM).estimate.value == pytest.approx(55.0)


def test_missing_runs_are_no_evidence(varied):
    """Without results there is no number, and it is said."""
    nothing = varied.assign(status="failed")
    found = parameters.gain(nothing, "n_components", 7, 3)
    assert found.estimate is None
    assert found.note
    assert parameters.chart_panels(nothing) == []


def test_panels_show_errors_in_degrees(varied):
    """40 dB are 3.6°; four panels, the letters of the thesis."""
    panels = parameters.chart_panels(varied)
    assert [panel.title[0] for panel in panels] == list("abcd")
    assert panels[1].curves.loc[WALK, 1] == pytest.approx(360 / 10 ** (52 / 20))
    assert panels[3].band == (7.0, 10.0)
    assert "b. calm motions, σ = 10 from 0.9 at 1 to" in parameters.describe_panel(panels[1])
    assert parameters.describe_examples(panels).startswith("Examples: ")
    assert parameters.describe_examples([]) == ""
    table = parameters.parameter_table(varied)
    assert table.loc["k = 3", (CALM, "PSNR, dB")] == pytest.approx(56.0)
    assert table.loc["k = 3", (CALM, "keyframes, %")] == pytest.approx(100 * 13 / 400)


def test_growth_is_the_slope_of_logarithms():
    """Times that grow with the square of the frames have exponent 2."""
    frames = np.array([10_000, 30_000, 100_000])
    seconds = pd.DataFrame([1e-9 * frames**2.0, 2e-9 * frames**2.0], columns=frames)
    found = running_time.growth(seconds)
    assert found.estimate.value == pytest.approx(2.0)
    assert (found.estimate.n_units, found.units) == (2, "repetitions")
    assert running_time.growth(pd.DataFrame()).estimate is None
    table = running_time.time_table(seconds)
    assert table.loc[10_000, "microseconds per frame"] == pytest.approx(15.0)


def _compared(clips, saliency, chord, pb):
    """Make the results of the three methods on clips."""
    values = []
    for clip in clips:
        for name, ratio in (
            ("Saliency", saliency),
            ("Curve simplification", chord),
            ("Frame decimation", pb),
        ):
            row = {"psnr": ratio, "n_control_points": 32, "body_error": ratio / 1000}
            values.append((comparison.method_run(clip, name), row))
            if clip == WALK:
                positions = comparison.method_run(clip, name, "positions")
                values.append((positions, {"n_control_points": 20, "body_error": ratio / 2000}))
    return results(values)


def test_ours_stands_beside_the_published_values():
    """Ours, published and the difference; motions without a clip have none of ours."""
    table = _compared([WALK, JUMP], 42.0, 40.0, 46.0)
    ratios = comparison.comparison_table(table, "psnr")
    assert ratios.loc["Saliency", ("Walking", "ours")] == 42.0
    assert ratios.loc["Saliency", ("Walking", "published")] == 64.27
    assert ratios.loc["Saliency", ("Walking", "difference")] == pytest.approx(42.0 - 64.27)
    assert repr(ratios.loc["frames", ("Walking", "ours")]) == "400"
    assert ratios.loc["keyframes, % of frames", ("Walking", "ours")] == pytest.approx(8.0)
    assert ratios.loc["keyframes, % of frames", ("Boxing", "published")] == pytest.approx(
        100 * 311 / 3000
    )
    assert pd.isna(ratios.loc["Saliency", ("Boxing", "ours")])
    errors = comparison.comparison_table(table, "body_error")
    name = "Body coordinates: Frame decimation, error × 1000"
    assert errors.loc[name, ("Walking", "ours")] == pytest.approx(23.0)
    assert errors.loc[name, ("Walking", "published")] == pytest.approx(0.08)
    assert "no clip of Stretching, Basketball, Boxing" in comparison.describe_stand_ins(table)


def test_stretching_is_the_clip_of_the_thesis():
    """Of the clips with side twists it is taken although a longer one is there."""
    found = comparison.stand_ins(["cmu-amc/14_14", STRETCHING, "cmu/07_01", "cmu/05_01"])
    assert found == {"Stretching": STRETCHING, "Walking": "cmu/05_01"}


def test_a_clip_without_a_skeleton_has_angles_only():
    """Its rows of body coordinates and of Eq. 4.1 are empty, its counts are there."""
    table = _compared([STRETCHING], 42.0, 40.0, 46.0).drop(columns="body_error")
    errors = comparison.comparison_table(table, "body_error")
    assert errors.loc["frames", ("Stretching", "ours")] == 400
    assert errors.loc["Euler angles: keyframes", ("Stretching", "ours")] == 32
    assert errors["Stretching", "ours"].drop(index=["frames"]).notna().sum() == 2
    assert "Stretching is the clip of the thesis" in comparison.describe_stand_ins(table)


def test_differences_are_paired():
    """On each motion at the same count; motions with a missing method are left out."""
    table = _compared([WALK, JUMP, "cmu/05_10"], 42.0, 40.0, 46.0)
    table.loc[(table["dataset"] == JUMP) & (table["selector"] == "pb"), "status"] = "failed"
    found = comparison.difference(table, "Frame decimation", "Saliency").estimate
    assert (found.value, found.n_units) == (4.0, 2)
    assert comparison.share_of_keyframes(table).estimate.value == pytest.approx(8.0)
    rows = comparison.difference_table(table)
    assert rows["motions", ""].to_dict() == {"all": 2, CALM: 1, DYNAMIC: 1}
    assert rows.loc["all", ("minus saliency, dB", "Curve simplification, 95 %")] == "−2.00 to −2.00"


def test_contact_ratios_compare_counts_at_equal_error():
    """Without handling the error is 1 / count; with it, that of twice as many keyframes."""
    values = []
    for sigma in range(1, 16):
        [run] = contacts.contact_runs(WALK, [sigma], contacts=False)
        values.append((run, {"n_control_points": 160 // sigma, "body_error": sigma / 160.0}))
        [run] = contacts.contact_runs(WALK, [sigma], contacts=True)
        values.append((run, {"n_control_points": 64 // sigma, "body_error": sigma / 128.0}))
    ratios = contacts.contact_ratios(results(values))
    assert ratios[WALK] == pytest.approx(0.5, rel=0.1)
    assert contacts.contact_table(ratios).loc[CALM, "fewer on"] == "1 of 1"
    assert contacts.evidence(ratios).estimate.n_units == 1
    assert contacts.evidence(pd.Series(dtype=float)).estimate is None


def _read(clip):
    """Make results of all readings, the count told by the cluster limit alone."""
    plan = readings.planned_runs("quick", clips=[clip])
    return results(
        (run, {"n_keyframes": 127 if run.cluster_width == 4 else 210, "psnr": 42.8})
        for run in plan
        if isinstance(run, SaliencyReadingRun)
    )


def test_readings_are_listed_by_distance_to_the_published_values():
    """On the clip of the thesis, nearest first; elsewhere no difference is claimed."""
    table = _read(STRETCHING)
    listed = readings.reading_table(table)
    assert len(listed) == 72
    assert listed.loc[1, "keyframes − published"] == -4
    assert listed.loc[72, "longest cluster"] == "2σ"
    assert readings.default_reading(table) == (127, 42.8)
    assert readings.published_target() == (131, 42.9)
    other = _read(JUMP)
    assert readings.reading_clip(other) != STRETCHING
    assert "keyframes − published" not in readings.reading_table(other)
    assert "13_29.amc in WORKBENCH_DATA" in readings.describe_target(other)


def test_each_choice_is_told_over_all_readings_that_make_it():
    """Half of the readings have clusters of 2σ, a third each threshold."""
    table = readings.choice_table(_read(STRETCHING))
    assert table.loc["longest cluster: 2σ", ["readings", "keyframes, median"]].tolist() == [36, 210]
    assert table.loc["threshold: summed", "readings"] == 24
    assert table.loc["threshold: summed", "keyframes, range"] == "127 to 210"
    points = readings.reading_points(_read(STRETCHING))
    assert len(points) == 6
    assert all(len(group) == 12 for group in points.values())


def test_without_a_reading_it_is_said():
    """A table of failed runs is no result."""
    with pytest.raises(WorkbenchError, match="no reading"):
        readings.reading_table(_read(JUMP).assign(status="failed"))


def test_selectors_are_ranked_and_compared_in_pairs():
    """PSNR: higher is better; D_q: lower; a table of angles has no D_q."""
    levels = {name: index for index, name in enumerate(selector_ranks.SELECTORS)}
    table = results(
        (
            selector_ranks.selector_run(clip, name),
            {"psnr": 40.0 + level, "n_control_points": 30}
            | ({"error": 1.0 / (1 + level)} if clip != STRETCHING else {}),
        )
        for clip in (WALK, JUMP, STRETCHING)
        for name, level in levels.items()
        if clip != STRETCHING or name != "Exact, D_q"
    )
    differences = selector_ranks.against_saliency(table, "psnr")
    assert differences["PB"].tolist() == [4.0, 4.0, 4.0]
    assert len(differences["Exact, D_q"]) == 2
    assert selector_ranks.against_saliency(table, "error")["PB"].tolist() == [0.2, 0.2]
    rows = selector_ranks.selector_table(table)
    assert rows["PSNR", "mean rank"].tolist() == [7, 6, 5, 4, 3, 2, 1]
    assert rows["D_q error", "mean rank"].tolist() == [7, 6, 5, 4, 3, 2, 1]
    assert rows.loc["PB", ("PSNR", "better on")] == "3 of 3"
    stretching = selector_ranks.stretching_table(table)
    assert stretching.loc["PB", "difference"] == pytest.approx(44.0 - 46.42)
    assert selector_ranks.stretching_table(table[table["dataset"] == WALK]) is None
    assert selector_ranks.points_on(table, STRETCHING)["Uniform"] == (30, 41.0)


def test_a_joint_curve_of_the_bundled_walk():
    """Some frames are candidates, in units of the mean; joints are checked by name."""
    curve = saliency_curves.joint_curve(saliency_curves.walk_of("quick"))
    assert curve.saliency.mean() == pytest.approx(1.0)
    assert 0 < curve.candidates.sum() < len(curve.seconds)
    assert np.ptp(curve.degrees) > 30
    with pytest.raises(WorkbenchError, match="joint: got 'Knee', want one of Hips"):
        saliency_curves.joint_curve(WALK, "Knee")
    with pytest.raises(WorkbenchError, match="is a table"):
        saliency_curves.joint_curve("uci/iris")


def test_a_small_grid_end_to_end(tmp_path):
    """Runs of the plan give tables and evidence; all that is wanted is finished."""
    runs = [run for run in comparison.planned_runs("quick", clips=[JUMP]) if run.dataset == JUMP]
    table = run_grid(runs, tmp_path)
    assert set(table["status"]) == {"done"}
    assert len(comparison.method_values(table)) == 1
    assert len(contacts.contact_ratios(table)) <= 1
    assert "1 dynamic (01_01-jump)" in motions.describe_motions(table)
