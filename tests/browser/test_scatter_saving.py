"""Pictures, tables and pages saved from the scatter panels, without a kernel."""

from __future__ import annotations

from collections.abc import Callable
from io import BytesIO, StringIO
from typing import Any

import numpy as np
import pandas as pd
import pytest
from numpy.typing import NDArray
from PIL import Image

from tests.browser.scatter_page import POINTS, choose, movable_panels, saved_table

pytestmark = pytest.mark.browser

VALUES = np.array([[0.1, 0.25, np.nan, 1 / 3, 2.0], [1.0, 2.0, 3.0, 4.0, 5.0]])


def palette(scheme: str) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Give the first two colours of classes in a theme."""
    light = (0x00, 0x72, 0xB2), (0xD5, 0x5E, 0x00)
    dark = (0x4D, 0xA6, 0xE0), (0xFF, 0x85, 0x40)
    return light if scheme == "light" else dark


def saved_picture(page: Any) -> NDArray[np.uint8]:
    choose(page, "Save")
    with page.expect_download() as waiting:
        choose(page, "Picture (PNG)")
    content = waiting.value.path().read_bytes()
    return np.asarray(Image.open(BytesIO(content)).convert("RGB"))


def test_the_table_has_what_is_shown(mount: Callable) -> None:
    """Read back by pandas, positions and values are those of the traits, to the last bit."""
    page = mount(
        movable_panels(
            selection=[1, 3],
            classes=[0, 0, 1, 1, 1],
            class_names=['a, "quoted"', "b"],
            values=VALUES,
            value_name="stress",
            sample_word="frame",
        )
    )
    table = pd.read_csv(StringIO(saved_table(page)))
    assert list(table.columns) == [
        *("frame", "class", "selected", "control_point"),
        *("A x", "A y", "A stress", "B x", "B y", "B stress"),
    ]
    assert table["frame"].tolist() == [0, 1, 2, 3, 4]
    assert table["class"].tolist() == ['a, "quoted"'] * 2 + ["b"] * 3
    assert table["selected"].tolist() == [0, 1, 0, 1, 0]
    assert table["control_point"].tolist() == [1, 0, 0, 0, 1]
    for panel, title in enumerate("AB"):
        expected = (POINTS * [-1, 1] if panel else POINTS).astype(np.float32)
        found = table[[f"{title} x", f"{title} y"]].to_numpy(dtype=np.float32)
        np.testing.assert_array_equal(found, expected)
        values = table[f"{title} stress"].to_numpy(dtype=np.float32)
        np.testing.assert_array_equal(values, VALUES[panel].astype(np.float32))


def test_panels_of_one_title_have_columns_of_their_own(mount: Callable) -> None:
    """A second panel with the same title is numbered; one without positions is empty."""
    unknown = np.full_like(POINTS, np.nan)
    page = mount(movable_panels(panels=[{"title": "A"}, {"title": "A"}], points=[POINTS, unknown]))
    table = pd.read_csv(StringIO(saved_table(page)))
    assert list(table.columns[-4:]) == ["A x", "A y", "A (2) x", "A (2) y"]
    assert table["A (2) x"].isna().all()


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_the_picture_has_all_panels_on_the_ground_of_the_theme(
    mount: Callable, visit: Any, scheme: str
) -> None:
    """At twice the size, with the colours of both classes in each panel and in the legend."""
    visit.page.emulate_media(color_scheme=scheme)
    page = mount(movable_panels(classes=[0, 0, 1, 1, 1], class_names=["a", "b"], color_by="class"))
    picture = saved_picture(page)
    size = page.evaluate("document.querySelector('.wb-base').clientWidth")
    assert picture.shape[1] == 2 * (2 * size + 48)
    ground = {"light": 255, "dark": 22}[scheme]
    assert (picture[0, 0] == ground).all()
    blue, orange = palette(scheme)
    left, right = np.split(picture, [picture.shape[1] // 2], axis=1)
    below = picture[2 * (16 + 42 + size) :]
    for part in (left, right, below):
        for colour in (blue, orange):
            assert (part == colour).all(axis=2).sum() > 20


def test_the_picture_fades_what_is_not_selected(mount: Callable) -> None:
    """With a selection, the colour of the other class is no longer there in full."""
    traits = {"classes": [0, 0, 1, 1, 1], "class_names": ["a", "b"], "color_by": "class"}
    page = mount(movable_panels(selection=[0, 1], **traits))
    blue, orange = palette("light")
    size = page.evaluate("document.querySelector('.wb-base').clientWidth")
    panels = saved_picture(page)[: 2 * (16 + 42 + size)]
    assert (panels == blue).all(axis=2).sum() > 20
    assert not (panels == orange).all(axis=2).any()


def test_the_menu_works_by_keyboard(mount: Callable) -> None:
    """Enter opens it, Tab leads through it, Escape closes it and returns to its button."""
    page = mount(movable_panels())
    page.get_by_role("button", name="Save").focus()
    page.keyboard.press("Enter")
    page.keyboard.press("Tab")
    focused = "document.activeElement.textContent"
    assert page.evaluate(focused) == "Picture (PNG)"
    page.keyboard.press("Tab")
    assert page.evaluate(focused) == "Table (CSV)"
    page.keyboard.press("Escape")
    assert page.evaluate(focused) == "Save"
    assert page.locator(".wb-menu-list").is_hidden()


_ANSWER = """
(content) => {
  window.answer = (receive) => receive(content, [new TextEncoder().encode("<p>page</p>")]);
}
"""


def test_a_page_comes_from_python(mount: Callable) -> None:
    """What Python answers is offered as a download with the name it gave."""
    page = mount(movable_panels(offers_html=True))
    page.evaluate(_ANSWER, {"kind": "html", "name": "wine.html"})
    choose(page, "Save")
    with page.expect_download() as waiting:
        choose(page, "Interactive page (HTML)")
    assert waiting.value.suggested_filename == "wine.html"
    assert waiting.value.path().read_text(encoding="utf-8") == "<p>page</p>"
    assert page.locator(".wb-remark").inner_text() == ""


def test_a_page_that_cannot_be_made_is_told(mount: Callable) -> None:
    """The reason stands above the panels."""
    page = mount(movable_panels(offers_html=True))
    page.evaluate(_ANSWER, {"kind": "failure", "text": "no views"})
    choose(page, "Save")
    choose(page, "Interactive page (HTML)")
    assert page.locator(".wb-remark").inner_text() == "The page cannot be made: no views"
