"""Figures 5.6 to 5.11: motions projected in two steps."""

from __future__ import annotations

import json

import pytest

from tests.reproduction.costa2018.synthetic import results_of
from workbench.errors import WorkbenchError
from workbench.experiments.grid import run_grid
from workbench.experiments.store import ResultStore
from workbench.reproduction.costa2018 import motion_figures
from workbench.reproduction.outputs import Outputs
from workbench.reproduction.published import published

FIGURES = {figure.item: figure for figure in motion_figures.MOTION_FIGURES}
JUMP = FIGURES["costa2018:fig5.7"]


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """Run Figure 5.7 on the excerpt that stands in for its clip."""
    folder = tmp_path_factory.mktemp("results")
    runs = [
        run
        for run in motion_figures.figure_runs("quick", 0)
        if run.dataset == JUMP.clip("quick") and run.scheme in (JUMP.raw, JUMP.optimized)
    ]
    table = run_grid(runs, folder)
    return table, ResultStore(folder)


@pytest.mark.parametrize("figure", FIGURES.values(), ids=FIGURES)
def test_every_figure_has_published_ratios_of_its_clip(figure):
    """The caption's stress and error ratios are for the clip that the thesis shows."""
    printed = published(figure.item).table()
    assert printed.index.tolist() == [figure.published_clip.removeprefix("cmu/")]
    assert printed.lt(1).all(axis=None)
    assert figure.projector in published(figure.item).quantity


@pytest.mark.parametrize("figure", FIGURES.values(), ids=FIGURES)
def test_every_figure_has_an_excerpt_that_stands_in(figure):
    """Bundled data make all six figures."""
    assert figure.clip("quick") in figure.stand_ins


def test_a_figure_shows_raw_and_optimized_with_one_set_of_keyframes(made):
    """Keyframes stay where they are, and the error falls."""
    found = motion_figures.make_figure(JUMP, "quick", *made)
    assert isinstance(found, motion_figures.MadeFigure)
    raw, optimized = found.panels
    keys = raw.control_points
    assert (optimized.points[keys] == raw.points[keys]).all()
    assert (len(keys), found.n_frames) == (9, 300)
    assert found.error_ratio < 1
    table = motion_figures.ratios(found)
    assert table["published"].dropna().tolist() == [0.4, 0.57]
    assert table.loc["error", "difference"] == pytest.approx(found.error_ratio - 0.57)


def test_a_stand_in_is_named(made):
    """The caption says which clip the thesis shows and which one is drawn."""
    found = motion_figures.make_figure(JUMP, "quick", *made)
    text = motion_figures.caption(found)
    assert "01_01-jump, 300 frames" in text
    assert "The thesis shows 02_04" in text
    assert f"{found.error_ratio:.2f} of what they were" in motion_figures.alt(found)


def test_a_figure_is_saved_with_its_ratios(made, tmp_path):
    """One figure, one table."""
    outputs = Outputs(tmp_path, profile="quick", seed=0)
    drawn = motion_figures.save_figure(outputs, JUMP.item, "quick", *made)
    assert drawn is not None
    # 300 frames at 120 a second.
    assert drawn.layout.coloraxis.colorbar.ticktext == ("0 s", "1.2 s", "2.5 s")
    kinds = sorted(json.loads(path.read_text())["kind"] for path in tmp_path.glob("parts/*.json"))
    assert kinds == ["figure", "table"]


def test_a_failed_run_is_said_instead_of_a_figure(made, tmp_path):
    """The item is not silently missing."""
    table = results_of(motion_figures.figure_runs("quick", 0), lambda run: "no memory")
    outputs = Outputs(tmp_path, profile="quick", seed=0)
    assert motion_figures.save_figure(outputs, JUMP.item, "quick", table, made[1]) is None
    (part,) = tmp_path.glob("parts/*.json")
    assert json.loads(part.read_text())["caption"] == "A run failed: no memory"


def test_an_unknown_figure_is_refused(made):
    """The message lists the known ones."""
    with pytest.raises(WorkbenchError, match=r"item: got 'fig9', want one of costa2018:fig5\.6"):
        motion_figures.save_figure(Outputs(None), "fig9", "quick", *made)
