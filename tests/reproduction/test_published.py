"""Published values agree with what the theses say about them."""

from __future__ import annotations

import pytest

from workbench.errors import WorkbenchError
from workbench.reproduction.items import ITEMS, select_items
from workbench.reproduction.published import published, published_ids


def test_table_5_1_is_whole():
    """Ten schemes with six values each, ordered as box plots are."""
    table = published("costa2018:tab5.1").table()
    assert table.shape == (10, 6)
    quantiles = table[["W_bot", "Q1", "Q2", "Q3", "W_top"]].to_numpy()
    assert (quantiles[:, 1:] > quantiles[:, :-1]).all()


def test_table_5_1_supports_its_text():
    """All temporal medians exceed all spatial ones, and t-SNE's is 30 % below slerp's."""
    medians = published("costa2018:tab5.1").table()["Q2"]
    temporal = medians[["Hermitian", "Linear", "Slerp", "1D-RBF"]]
    spatial = medians.drop(temporal.index)
    assert temporal.min() > spatial.max()
    assert spatial.idxmin() == "t-SNE"
    assert 1 - medians["t-SNE"] / medians["Slerp"] == pytest.approx(0.30, abs=0.005)


def test_table_5_3_is_whole():
    """Seven tables and six projectors; only Yeast with MDS got worse."""
    table = published("costa2018:tab5.3").table()
    ratios = table.drop(columns="Attributes")
    assert ratios.shape == (7, 6)
    worse = ratios.stack()
    assert worse[worse > 1].index.tolist() == [("Yeast", "MDS")]


FIGURES = {
    "5.12": ("Ionosphere", "MDS"),
    "5.14": ("Seeds", "LLE"),
    "5.15": ("Wine", "Force"),
    "5.16": ("Page blocks", "PCA"),
    "5.17": ("Yeast", "t-SNE"),
}


@pytest.mark.parametrize(("number", "cell"), FIGURES.items(), ids=FIGURES)
def test_captions_round_table_5_3(number, cell):
    """The ratio in a caption is the table's in whole per cent."""
    ratio = published("costa2018:tab5.3").table().loc[cell]
    assert published(f"costa2018:fig{number}").value == pytest.approx(ratio, abs=0.0051)


def test_the_caption_of_figure_5_13_fits_another_projector():
    """The table has the caption's 55 % for MDS on Iris, not for Isomap, and we say so."""
    row = published("costa2018:tab5.3").table().loc["Iris"]
    figure = published("costa2018:fig5.13")
    assert figure.value == pytest.approx(row["MDS"], abs=0.0051)
    assert abs(figure.value - row["Isomap"]) > 0.3
    assert "disagrees with itself" in figure.note


def test_places_of_items_agree_with_published_values():
    """An item and its published values name the same place."""
    for item in ITEMS:
        if item.id in published_ids():
            assert published(item.id).source == item.place


def test_unknown_ids_are_refused_with_the_known_ones():
    """Both look-ups list what exists."""
    with pytest.raises(WorkbenchError, match=r"costa2018:tab5\.1"):
        published("costa2018:fig9.9")
    with pytest.raises(WorkbenchError, match=r"id: got 'costa2018:fig9\.9', want one of costa2018"):
        select_items(["costa2018:fig9.9"])


def test_a_single_value_is_no_table():
    """Asking a caption's ratio for rows is an error that names its place."""
    with pytest.raises(WorkbenchError, match=r"Figure 5\.12, page 34: is a single value"):
        published("costa2018:fig5.12").table()
