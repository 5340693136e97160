"""The table of quality values."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from workbench.dashboards.comparison.jobs import PanelResult, Values
from workbench.dashboards.comparison.quality_figures import preservation_figure, shepard_figure
from workbench.dashboards.comparison.quality_table import quality_table
from workbench.dashboards.comparison.quality_view import QualityView
from workbench.quality.shepard_diagram import shepard_diagram
from workbench.quality.summary import EmbeddingQuality


def result(stress: float, trustworthiness: float) -> PanelResult:
    return PanelResult(
        embedding=np.zeros((3, 2)),
        projected=None,
        before=None,
        control_points=np.arange(2),
        errors=np.zeros(3),
        error=0.5,
        quality=EmbeddingQuality(stress, 0.1, trustworthiness, 0.9, 0.8, 7),
        local={},
        shepard=shepard_diagram(1 - np.eye(3), np.eye(3)[:, :2], n_bins=2),
        k=np.array([1, 2]),
        preservation=np.array([0.4, 0.6]),
        seconds=1.0,
        notes=(),
    )


def row(table: str, name: str) -> list[str]:
    cells = table.split(name)[1].split("</tr>")[0].split("<td")[1:]
    return [cell.split("</td>")[0].lstrip(">") for cell in cells]


def test_the_best_is_the_smallest_stress_and_the_largest_trustworthiness() -> None:
    """Each measure is marked by its own direction."""
    table = quality_table(["A", "B"], [result(7364.0, 0.7), result(2.0, 0.6)])
    assert row(table, "stress ") == ["7,360", " class=best>2"]
    assert row(table, "trustworthiness") == [" class=best>0.7", "0.6"]
    assert "k = 7" in table


def test_values_that_look_alike_are_equally_good() -> None:
    """Both are marked, since the digits that are shown do not tell them apart."""
    table = quality_table(["A", "B"], [result(1.0, 0.70001), result(2.0, 0.70002)])
    assert row(table, "trustworthiness") == [" class=best>0.7", " class=best>0.7"]


def test_nothing_is_best_without_another_to_compare() -> None:
    """A panel that is still computed shows dots, and the other is not praised."""
    table = quality_table(["A", "B"], [None, result(1.0, 0.7)])
    assert row(table, "trustworthiness") == ["…", "0.7"]
    assert quality_table(["A", "B"], [None, None]) == ""


def test_titles_are_no_markup() -> None:
    """A projector's name is shown as it is written."""
    table = quality_table(["<i>A</i>", "B"], [result(1.0, 0.7)] * 2)
    assert "<i>" not in table
    assert "&lt;i&gt;A" in table


def test_curves_are_shown_for_panels_that_have_one() -> None:
    """A panel without a result has no curve, and the others keep their places."""
    other = replace(result(1.0, 0.7), preservation=np.array([0.1, 0.2]))
    figure = preservation_figure(["A", "B", "C"], [result(1.0, 0.7), None, other])
    assert [len(trace.x) for trace in figure.data] == [2, 0, 2]
    assert [trace.showlegend for trace in figure.data] == [True, False, True]
    assert list(figure.data[2].y) == [0.1, 0.2]


def test_the_figure_is_described_for_those_who_cannot_see_it() -> None:
    """The description names the panels that have a curve."""
    view = QualityView()
    view.show(["A", "B"], [None, result(1.0, 0.7)])
    assert view.curves.description == "Neighbourhood preservation against k of B"


def values(stress: float, trustworthiness: float) -> Values:
    return Values(EmbeddingQuality(stress, 0.1, trustworthiness, 0.9, 0.8, 7), 0.5)


def test_with_seeds_the_means_decide_what_is_best() -> None:
    """A lucky seed is not praised, and rounding is no spread."""
    seeds = [[values(4.0, 0.5)], [values(1.0, 0.5)]]
    table = quality_table(["A", "B"], [result(1.0, 0.7), result(2.0, 0.7 + 1e-16)], seeds)
    assert row(table, "stress ") == [
        "1<small>2.5 ± 2.1</small>",
        " class=best>2<small>1.5 ± 0.71</small>",
    ]
    assert row(table, "continuity")[0].endswith("0.9<small>0.9 ± 0</small>")
    assert "mean ± standard deviation of 2 seeds" in table


def test_values_are_compared_until_all_panels_are_repeated() -> None:
    """A mean is not set against a single value."""
    table = quality_table(
        ["A", "B"], [result(1.0, 0.7), result(2.0, 0.6)], [[values(9.0, 0.5)], []]
    )
    assert row(table, "stress ")[0].startswith(" class=best>1")


@pytest.mark.parametrize("count", [1, 3, 6])
def test_every_panel_has_a_shepard_diagram_in_a_place_of_its_own(count: int) -> None:
    """None lies over another; a panel without a result has no density but keeps its colour."""
    results: list[PanelResult | None] = [result(1.0, 0.7)] * count
    results[-1] = None
    figure = shepard_figure(list("ABCDEF"[:count]), results)
    assert [trace.type for trace in figure.data] == ["scatter"] * count + ["heatmap"] * (count - 1)
    places = {
        (figure.layout[f"xaxis{i or ''}"].domain, figure.layout[f"yaxis{i or ''}"].domain)
        for i in [0, *range(2, count + 1)]
    }
    assert len(places) == count
    for first in places:
        for other in places - {first}:
            apart = [a[1] <= b[0] or b[1] <= a[0] for a, b in zip(first, other, strict=True)]
            assert any(apart)
