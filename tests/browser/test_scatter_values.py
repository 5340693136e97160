"""Local values as colours of the scatter panels, without a kernel."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from tests.browser.scatter_page import movable_panels, on_screen, place
from workbench.widgets import ScatterPanels

pytestmark = pytest.mark.browser

N = 100
POINTS = np.column_stack([np.arange(N) % 10, np.arange(N) // 10]) / 9.0
VALUES = np.stack([np.arange(N) / 100.0, np.arange(N) / 200.0])

_COLOUR = """
([panel, x, y]) => {
  const canvas = document.querySelectorAll(".wb-base")[panel];
  return [...canvas.getContext("2d").getImageData(Math.round(x), Math.round(y), 1, 1).data];
}
"""


def value_panels(values: Any = VALUES, **traits: Any) -> ScatterPanels:
    given = {"values": values, "value_name": "stress", "color_by": "value", **traits}
    return movable_panels(points=[POINTS, POINTS], control_points=[], **given)


def colour(page: Any, panel: int, sample: int) -> tuple[int, ...]:
    return tuple(page.evaluate(_COLOUR, [panel, *place(page, panel, POINTS[sample])])[:3])


def lightness(colours: NDArray[np.float64]) -> NDArray[np.float64]:
    """Oklab's lightness of sRGB colours with values up to 255."""
    parts = np.asarray(colours) / 255
    linear = np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4)
    cones = linear @ np.array(
        [
            [0.4122214708, 0.2119034982, 0.0883024619],
            [0.5363325363, 0.6806995451, 0.2817188376],
            [0.0514459929, 0.1073969566, 0.6299787005],
        ]
    )
    return np.cbrt(cones) @ [0.2104542553, 0.7936177850, -0.0040720468]


def test_the_legend_tells_numbers_and_which_end_is_better(mount: Callable) -> None:
    """One range for all panels, from the 2nd to the 98th percentile, with the name."""
    page = mount(value_panels())
    low, high = np.quantile(VALUES, [0.02, 0.98])
    text = page.locator(".wb-ramp").inner_text()
    found = re.fullmatch(r"stress\s+better ≤ (\S+)\s+≥ (\S+) worse", text)
    assert found is not None
    assert np.allclose([float(found[1]), float(found[2])], [low, high], atol=0.006)


def test_a_narrow_range_has_digits_enough(mount: Callable) -> None:
    """Ends that differ in the fourth digit are told apart, and so are hovered values."""
    page = mount(value_panels(0.999 + VALUES / 1000, value_best="high"))
    text = page.locator(".wb-ramp").inner_text()
    low, high = (float(number) for number in re.findall(r"\d\.\d+", text))
    expected = np.quantile(0.999 + VALUES.astype(np.float32) / 1000, [0.02, 0.98])
    assert np.allclose([low, high], expected, atol=1e-5)
    page.mouse.move(*on_screen(page, 0, POINTS[37]))
    assert page.locator(".wb-hover").inner_text() == "sample 37 · stress 0.99937"


def test_a_few_extreme_values_do_not_stretch_the_range(mount: Callable) -> None:
    """One value a thousand times as large changes no other sample's colour."""
    plain = mount(value_panels())
    before = [colour(plain, 0, i) for i in range(0, N, 7)]
    extreme = VALUES.copy()
    extreme[0, 99] = 1000.0
    plain.evaluate("mounted[0].end(); document.body.replaceChildren(); mounted.pop()")
    page = mount(value_panels(extreme))
    assert [colour(page, 0, i) for i in range(0, N, 7)] == before


def test_equal_values_have_equal_colours_in_all_panels(mount: Callable) -> None:
    """0.2 is the same colour in both panels, wherever it is."""
    page = mount(value_panels())
    assert colour(page, 0, 20) == colour(page, 1, 40)
    assert colour(page, 0, 20) != colour(page, 1, 20)


def test_the_worse_end_has_the_same_colour_whichever_end_it_is(mount: Callable) -> None:
    """Where high values are better, the colours are the other way round, as the legend says."""
    page = mount(value_panels())
    worst = colour(page, 0, 99)
    page.evaluate("mounted[0].model.set('value_best', 'high')")
    assert colour(page, 0, 99) != worst
    assert colour(page, 0, 0) == worst
    assert re.search(r"worse.*better", page.locator(".wb-ramp").inner_text(), re.DOTALL)


def test_unknown_values_are_grey_and_in_the_legend(mount: Callable) -> None:
    """A sample without a value is drawn, in a colour that is no value's."""
    values = VALUES.copy()
    values[0, 55] = np.nan
    page = mount(value_panels(values))
    red, green, blue = colour(page, 0, 55)
    assert red == green == blue > 0
    assert "unknown" in page.locator(".wb-legend").inner_text()
    page.mouse.move(*on_screen(page, 0, POINTS[55]))
    assert page.locator(".wb-hover").inner_text() == "sample 55 · stress unknown"


def test_the_hovered_sample_tells_the_value_of_its_panel(mount: Callable) -> None:
    """The same sample has another value in the other panel."""
    page = mount(value_panels())
    for panel, value in ((0, "0.37"), (1, "0.185")):
        page.mouse.move(*on_screen(page, panel, POINTS[37]))
        assert page.locator(".wb-hover").inner_text() == f"sample 37 · stress {value}"


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_lightness_rises_along_the_colours(mount: Callable, visit: Any, scheme: str) -> None:
    """Steps of value are steps of lightness, so that colour-blind readers see them too."""
    visit.page.emulate_media(color_scheme=scheme)
    page = mount(value_panels())
    style = page.locator(".wb-ramp i").get_attribute("style")
    colours = np.array(re.findall(r"rgb\((\d+) (\d+) (\d+)\)", style), dtype=float)
    steps = np.diff(lightness(colours))
    assert len(colours) == 64
    assert (steps > 0).all()
    assert lightness(colours[[0, -1]]) @ [-1, 1] > 0.3


@pytest.mark.parametrize(
    "values",
    [[], VALUES[:, :7], np.full_like(VALUES, np.nan)],
    ids=["none", "of others", "unknown"],
)
def test_without_values_all_samples_have_one_colour(mount: Callable, values: Any) -> None:
    """What does not fit the samples is not shown."""
    page = mount(value_panels(values))
    assert {colour(page, 0, i) for i in (0, 50, 99)} == {colour(page, 1, 3)}
    assert page.locator(".wb-ramp").count() == 0


def test_the_legend_says_when_values_are_of_other_positions(mount: Callable) -> None:
    """Before the optimization, the colours are those of the optimized positions."""
    page = mount(value_panels(raw_points=[POINTS[::-1], POINTS[::-1]]))
    assert "optimized positions" not in page.locator(".wb-legend").inner_text()
    page.get_by_role("button", name="Before optimization").click()
    assert "values of the optimized positions" in page.locator(".wb-legend").inner_text()
