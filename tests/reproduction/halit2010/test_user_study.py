"""The user study is reproduced from what was printed, and from answers where there are any."""

from __future__ import annotations

import json

import numpy as np
import pandas as pd
import pytest
from scipy import stats

from workbench.errors import DataError
from workbench.reproduction.claims import claim_by_id, verdict
from workbench.reproduction.halit2010 import user_study
from workbench.reproduction.halit2010 import user_study_figures as drawn
from workbench.reproduction.halit2010 import user_study_tables as tables
from workbench.reproduction.halit2010.user_study import RATED, RatedMotion
from workbench.reproduction.halit2010.user_study_report import save
from workbench.reproduction.items import select_items
from workbench.reproduction.outputs import Outputs, read_parts
from workbench.study.answers import REQUIRED_COLUMNS, check_answers
from workbench.study.published_tests import contradictions

#: Stimuli of the first motion, with errors in an order that the ratings below contradict.
STIMULI = {"original": 0.0, "saliency": 0.3, "decimation": 0.1, "simplification": 0.5}


def answers(n=12, motion="basketball", lift=0, **errors):
    """Make answers of n participants to one motion; saliency is rated ``lift`` points higher."""
    rng = np.random.default_rng(0)
    rows = [
        (
            person,
            "methods",
            motion,
            name,
            int(rng.integers(3, 7)) + (lift if name == "saliency" else 0),
            json.dumps({"error": error} if errors.get("told", True) else {}),
        )
        for person in range(1, n + 1)
        for name, error in STIMULI.items()
    ]
    return check_answers(pd.DataFrame(rows, columns=[*REQUIRED_COLUMNS, "parameters"]))


@pytest.fixture
def study(tmp_path):
    path = tmp_path / "study.csv"
    answers().to_csv(path, index=False)
    return path


@pytest.mark.parametrize("rated", RATED, ids=lambda rated: rated.title)
def test_each_printed_table_has_all_pairs(rated: RatedMotion):
    """Three or four stimuli are compared each with each, the original first."""
    pairs = user_study.printed_table(rated)
    stimuli = list(dict.fromkeys(name for pair in pairs for name in pair))
    assert len(pairs) == len(stimuli) * (len(stimuli) - 1) // 2
    assert len(stimuli) == (4 if rated.test_case == "methods" else 3)
    assert stimuli[0] == "original"


@pytest.mark.parametrize("rated", RATED, ids=lambda rated: rated.title)
def test_printed_p_values_are_one_sided(rated: RatedMotion):
    """Equal means are printed with p = 0.5, no p is above it: only one-sided ones are so."""
    for mean, p in user_study.printed_table(rated).values():
        assert (p == 0.5) == (mean == 0)
        assert p <= 0.5


def test_only_table_5_9_contradicts_itself():
    """All printed means add up; the p values of one table cannot all be right."""
    wrong = {
        rated.number: contradictions(user_study.printed_table(rated), 20)
        for rated in RATED
        if contradictions(user_study.printed_table(rated), 20)
    }
    assert list(wrong) == [9]
    assert len(wrong[9]) == 1
    assert "p = 0.008 implies that original − regular saliency" in wrong[9][0]


@pytest.mark.parametrize("sides", [1, 2], ids=["one-sided", "two-sided"])
def test_table_5_9_contradicts_itself_as_an_unpaired_test_too(sides):
    """No variances of the three ratings give the printed p values, as the notebook says."""
    variances = {
        pair: 20 * (mean / stats.t.isf(p / sides, 38)) ** 2
        for pair, (mean, p) in user_study.printed_table(RATED[8]).items()
    }
    # Sums of two variances each: what the pair with the contact handling leaves for the third.
    small = variances["original", "contact handling"]
    third = variances["original", "regular saliency"] - small
    assert third > variances["contact handling", "regular saliency"]


def test_pages_and_places_are_those_of_the_items():
    """The tables of the module are items of the reproduction, made by its notebook."""
    ids = [item for rated in RATED for item in (rated.figure_id, rated.table_id)]
    assert {item.notebook for item in select_items(ids)} == {"halit2010_user_study"}


def test_without_answers_the_published_values_stand_alone():
    """Nothing of ours is made up: the tables have no column of ours, the figure says why."""
    result = user_study.results(None)[0]
    table = tables.differences_table(result)
    assert table.columns.tolist() == [
        ("mean difference", "published"),
        ("p, one-sided", "published"),
    ]
    assert table.loc["saliency − decimation"].tolist() == [-0.4, "0.044"]
    assert list(drawn.figures(result)) == [""]
    assert "raw answers were not published" in drawn.figure_caption(result)
    assert "original − saliency: 1.20 (0.35 to 2.05)" in drawn.figure_alt(result)


def test_with_answers_ours_stand_beside_the_published(study):
    """Means of ours, of the thesis and their difference, pair by pair."""
    read = user_study.read_study_file(study)
    result = user_study.results(read)[0]
    ratings = read.pivot_table(index="participant", columns="stimulus", values="rating")
    table = tables.differences_table(result)["mean difference"]
    ours = ratings["original"].mean() - ratings["saliency"].mean()
    assert table.loc["original − saliency"].tolist() == pytest.approx([ours, 1.2, ours - 1.2])
    assert list(drawn.figures(result)) == ["", "differences"]
    assert "12 participants" in drawn.figure_caption(result)
    assert "original − saliency" in drawn.figure_alt(result, "differences")
    assert f"saliency {ratings['saliency'].mean():.2f}" in drawn.figure_alt(result)


def test_the_tests_of_ours_are_scipys(study):
    """The second table holds the paired t tests of the answers."""
    read = user_study.read_study_file(study)
    result = user_study.results(read)[0]
    ratings = read.pivot_table(index="participant", columns="stimulus", values="rating")
    theirs = stats.ttest_rel(ratings["original"], ratings["decimation"])
    row = tables.comparisons_table(result.ours).loc["original − decimation"]
    assert row["t"] == pytest.approx(theirs.statistic)
    assert float(row["p, two-sided"]) == pytest.approx(theirs.pvalue, rel=0.05)
    assert row["participants"] == 12


def test_motions_without_answers_keep_the_published_values(study):
    """A study of one motion leaves the others as printed, and says so."""
    other = user_study.results(user_study.read_study_file(study))[1]
    assert other.ours == ()
    assert "has no answers to this motion" in drawn.figure_caption(other)
    assert "has no answers to this motion" in tables.differences_caption(other)


def test_one_participant_is_drawn_but_not_tested():
    """A single answer of each has no spread: the figure shows it, the caption says why no test."""
    result = user_study.results(answers(n=1))[0]
    assert list(drawn.figures(result)) == [""]
    assert "want at least 2" in tables.differences_caption(result)


def test_equal_answers_are_said_to_leave_the_test_undefined():
    """The note of a degenerate comparison reaches the caption."""
    same = answers()
    same["rating"] = 5
    result = user_study.results(same)[0]
    caption = tables.comparisons_caption(result)
    assert "the t test is undefined" in caption
    assert tables.comparisons_table(result.ours)["t"].isna().all()


def test_the_overview_counts_what_holds():
    """Table 5.2: two differences below 5 % as printed, one two-sided, none corrected."""
    table = tables.overview(user_study.results(None))
    assert len(table) == 9
    assert table.iloc[1].tolist() == [6, 2, 1, 0, 0]
    assert table["contradictions"].tolist() == [0] * 8 + [1]
    with_ours = tables.overview(user_study.results(answers()))
    assert with_ours["ours, two-sided, Holm"].notna().tolist() == [True] + [False] * 8


def test_a_file_of_another_study_is_refused(tmp_path):
    """The message lists the test cases and motions of the thesis."""
    answers(motion="swimming").to_csv(tmp_path / "other.csv", index=False)
    with pytest.raises(DataError, match="want some of methods / basketball; methods / boxing"):
        user_study.read_study_file(tmp_path / "other.csv")
    assert user_study.read_study_file(None) is None


CLAIM = "halit2010:rated-better-at-higher-error"


@pytest.mark.parametrize(
    ("given", "judged", "says"),
    [
        (None, "not decidable", "were not published"),
        (answers(told=False), "not decidable", "tells no different errors"),
        (answers(lift=3), "reproduced", "saliency − "),
        (answers(n=2, lift=3), "not decidable", "saliency − "),
        (answers(), "not decidable", "the largest of 6 pairs"),
    ],
    ids=["no answers", "errors not told", "rated better", "two participants", "no difference"],
)
def test_the_claim_is_judged_by_answers_alone(given, judged, says):
    """Only ratings of a stimulus above that of one with a lower error decide the claim."""
    evidence = user_study.rated_better_evidence(given)
    assert verdict(claim_by_id(CLAIM), evidence) == judged
    assert says in evidence.note


def test_a_choice_among_more_pairs_has_a_wider_interval():
    """The best of six pairs is not judged as if it had been the only one."""
    given = answers(lift=1)
    best = user_study.rated_better_evidence(given)
    pair = best.note.partition(": ")[2].partition(";")[0].split(user_study.MINUS)
    alone = user_study.rated_better_evidence(given[given["stimulus"].isin(pair)])
    assert alone.estimate.value == best.estimate.value
    assert best.estimate.low < alone.estimate.low < alone.estimate.high < best.estimate.high


def test_everything_is_saved_under_its_id(study, tmp_path):
    """One motion leaves two figures and two tables, whose texts are whole sentences."""
    result = user_study.results(user_study.read_study_file(study))[0]
    shown = save(Outputs(tmp_path / "out"), result)
    parts = read_parts(tmp_path / "out")
    assert len(shown) == len(parts) == 4
    assert {part["item"] for part in parts} == {"halit2010:fig5.1", "halit2010:tab5.1"}
    assert all(part["caption"].endswith((".", ")")) for part in parts)
    assert all(part["alt"].endswith(".") for part in parts if part["kind"] == "figure")
