"""Curves over time, errors against counts, and pictures that can be saved."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.browser.axe import violations
from tests.browser.chromium import Visit
from workbench.widgets.count_curve import CountCurve
from workbench.widgets.picture import PictureView
from workbench.widgets.time_curves import TimeCurves

pytestmark = pytest.mark.browser

_CURVES = "document.querySelector('.wb-player-time').curves"
_COUNTS = "document.querySelector('.wb-player-count').counts"
_SQUARE = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="40" height="20">'
    '<rect width="40" height="20" fill="red"/></svg>'
)


def curves(n_frames: int = 101) -> TimeCurves:
    """Make an error and one component, whose second half is salient."""
    time = np.linspace(0, 1, n_frames)
    salient = (time > 0.5) * 2.0
    return TimeCurves(
        rows=[
            {"name": "error", "kind": "amount", "unit": "rad"},
            {"name": "component 1", "kind": "curve", "unit": ""},
        ],
        values=[time, np.sin(6 * time)],
        weights=[0 * time, salient],
        candidates=[0 * time, salient > 1],
        keyframes=[0, 40, 100],
        contacts=[{"name": "LeftFoot", "side": "left", "spans": [[0, 30]]}],
        frame_time=0.01,
        channel="curves",
    )


def green_columns(page: Any) -> list[int]:
    """Give the first and the last frame at which candidates are drawn."""
    return page.evaluate(
        f"""() => {{
          const curves = {_CURVES};
          const {{ width, height }} = curves.base;
          const {{ data }} = curves.base.getContext("2d").getImageData(0, 0, width, height);
          const xs = [];
          for (let i = 0; i < data.length; i += 4)
            if (data[i + 3] === 255 && data[i + 1] > data[i] + 60 && data[i + 1] > data[i + 2] + 20)
              xs.push((i / 4) % width);
          return [curves.frameAt(Math.min(...xs)), curves.frameAt(Math.max(...xs))];
        }}"""
    )


def test_candidates_are_marked_where_they_are(mount: Callable) -> None:
    """The bar below the curve covers the candidates and no other frame."""
    page = mount(curves())
    first, last = green_columns(page)
    assert first == pytest.approx(51, abs=1)
    assert last == 100


def test_pointing_reads_the_curve_and_pressing_shows_the_frame(mount: Callable) -> None:
    """The readout tells saliency; a press is heard on the channel, without the kernel."""
    page = mount(curves())
    page.evaluate(
        "document.addEventListener('workbench-hover', ({detail}) => (window.heard = detail))"
    )
    box = page.locator(".wb-player-curves").bounding_box()
    x = page.evaluate(f"{_CURVES}.xOf(75)")
    page.mouse.move(box["x"] + x, box["y"] + 100)
    readout = page.locator(".wb-player-time > .wb-detail").nth(1)
    assert (
        readout.inner_text() == "frame 75 · 0.75 s · component 1: saliency 2.00 × mean, candidate"
    )
    page.mouse.down()
    assert page.evaluate("heard") == {"channel": "curves", "sample": 75}
    assert page.evaluate("mounted[0].model.saved") == 0
    page.mouse.up()


def test_the_curves_are_a_slider_that_follows_the_channel(mount: Callable) -> None:
    """A frame that the player shows is shown, and arrow keys step from there."""
    page = mount(curves())
    page.evaluate(
        "document.dispatchEvent(new CustomEvent('workbench-hover', "
        "{detail: {channel: 'curves', sample: 40}}))"
    )
    slider = page.get_by_role("slider", name="Frame on the curves")
    assert slider.get_attribute("aria-valuetext") == "frame 40 · 0.40 s · keyframe"
    slider.focus()
    page.keyboard.press("ArrowRight")
    assert slider.get_attribute("aria-valuenow") == "41"
    page.keyboard.press("End")
    assert slider.get_attribute("aria-valuenow") == "100"


def test_keyframes_found_on_a_foot_are_told_apart(mount: Callable) -> None:
    """They have a mark of their own, an entry in the legend, and words."""
    widget = curves()
    widget.foot_keyframes = [40]
    page = mount(widget)
    assert "▼ keyframe found on a foot" in page.locator(".wb-sides").inner_text()
    slider = page.get_by_role("slider", name="Frame on the curves")
    readings = []
    for frame in (0, 40):
        page.evaluate(f"{_CURVES}.show({frame})")
        readings.append(slider.get_attribute("aria-valuetext"))
    assert readings[0].endswith("· keyframe")
    assert readings[1].endswith("· keyframe, found on a foot")


def test_contacts_of_the_right_foot_are_open(mount: Callable) -> None:
    """As with limbs, colour is not all that tells the sides apart."""
    widget = curves()
    widget.contacts = [
        {"name": side, "side": side, "spans": [[10, 30]]} for side in ("left", "right")
    ]
    page = mount(widget)
    left, right = page.evaluate(
        f"""() => {{
          const curves = {_CURVES};
          const context = curves.base.getContext("2d");
          const [first, step] = [16, 14]; // pixels, as the module lays its rows out
          const top = first + curves.rows.length * curves.pitch;
          return [0, 1].map((row) => [1, 4, 6].map((y) =>
            [...context.getImageData(curves.xOf(20), top + row * step + y, 1, 1).data]));
        }}"""
    )
    assert left[0] == left[1] == left[2]
    assert right[0] == right[2] != right[1]


def count_curve() -> CountCurve:
    return CountCurve(
        series=[
            {"name": "scs", "counts": [3, 6, 12], "errors": [0.9, 0.4, 0.2]},
            {"name": "the best of all", "counts": [2, 3, 6], "errors": [1.0, 0.8, 0.3]},
        ],
        count=6,
        error=0.4,
    )


@pytest.mark.parametrize(
    ("key", "picked"), [("ArrowRight", 7), ("ArrowLeft", 5)], ids=["more", "fewer"]
)
def test_arrow_keys_pick_the_next_number(mount: Callable, key: str, picked: int) -> None:
    """Python gets the number that is one more or one less than the chosen one."""
    page = mount(count_curve())
    page.get_by_role("slider", name="Number of keyframes").focus()
    page.keyboard.press(key)
    assert page.evaluate("mounted[0].model.get('picked')") == picked


def tell(page: Any, **traits: Any) -> None:
    """Let Python set traits of the count curve, and wait until they are shown."""
    page.evaluate(
        """async (traits) => {
          for (const [name, value] of Object.entries(traits)) mounted[0].model.set(name, value);
          await new Promise(requestAnimationFrame);
        }""",
        traits,
    )


def shown_count(page: Any) -> int:
    slider = page.get_by_role("slider", name="Number of keyframes")
    return int(slider.get_attribute("aria-valuenow"))


def test_a_picked_number_stays_until_its_keyframes_are_there(mount: Callable) -> None:
    """Curves and keyframes of an earlier number may arrive while arrow keys go on."""
    page = mount(count_curve())
    page.get_by_role("slider", name="Number of keyframes").focus()
    page.keyboard.press("ArrowRight")
    tell(page, waiting=True)
    tell(page, series=count_curve().series[1:], message="scs is being computed")
    assert shown_count(page) == 7
    page.keyboard.press("ArrowRight")
    tell(page, count=7, error=0.38)
    assert shown_count(page) == 8
    assert page.evaluate("mounted[0].model.get('picked')") == 8
    tell(page, count=8, error=0.35, waiting=False)
    tell(page, count=5, error=0.5)
    assert shown_count(page) == 5


def test_a_number_that_is_not_found_gives_way_to_the_one_that_is_shown(mount: Callable) -> None:
    """A search that failed or was cancelled leaves the keyframes as they were."""
    page = mount(count_curve())
    page.get_by_role("slider", name="Number of keyframes").focus()
    page.keyboard.press("ArrowRight")
    tell(page, waiting=True)
    tell(page, waiting=False)
    assert shown_count(page) == 6


def test_no_more_keyframes_are_picked_than_there_can_be(mount: Callable) -> None:
    """The arrow key stops at the largest number, and goes back from there."""
    page = mount(count_curve())
    tell(page, most=8)
    page.get_by_role("slider", name="Number of keyframes").focus()
    for _ in range(4):
        page.keyboard.press("ArrowRight")
    assert shown_count(page) == 8
    page.keyboard.press("ArrowLeft")
    assert shown_count(page) == 7


def test_a_press_on_the_curve_picks_the_number_under_the_mouse(mount: Callable) -> None:
    """Pointing tells the errors of all methods there, pressing picks."""
    page = mount(count_curve())
    canvas = page.locator(".wb-player-counts")
    box = canvas.bounding_box()
    page.mouse.move(box["x"] + page.evaluate(f"{_COUNTS}.xOf(3)"), box["y"] + 60)
    words = "3 keyframes · scs 0.900 · the best of all 0.800"
    assert canvas.get_attribute("aria-valuetext") == words
    page.mouse.down()
    page.mouse.up()
    assert page.evaluate("mounted[0].model.get('picked')") == 3


def test_the_chosen_number_is_told_with_its_error(mount: Callable) -> None:
    """A screen reader gets the number and the errors there."""
    page = mount(count_curve())
    slider = page.get_by_role("slider", name="Number of keyframes")
    words = "6 keyframes · chosen 0.400 · scs 0.400 · the best of all 0.300"
    assert slider.get_attribute("aria-valuetext") == words


@pytest.mark.parametrize("kind", ["SVG", "PNG"])
def test_a_picture_is_saved_by_the_browser(mount: Callable, kind: str) -> None:
    """The SVG is what Python sent; the PNG has twice as many pixels."""
    page = mount(PictureView(svg=_SQUARE, name="square", description="a red square"))
    page.get_by_alt_text("a red square").wait_for()
    with page.expect_download() as saved:
        page.get_by_role("button", name=f"Save {kind}").click()
    content = Path(saved.value.path()).read_bytes()
    assert saved.value.suggested_filename == f"square.{kind.lower()}"
    if kind == "SVG":
        assert content.decode() == _SQUARE
    else:
        assert [int.from_bytes(content[i : i + 4], "big") for i in (16, 20)] == [80, 40]


def test_without_a_picture_nothing_can_be_saved(mount: Callable) -> None:
    """The buttons wait for a drawing."""
    page = mount(PictureView())
    assert page.get_by_role("button", name="Save PNG").is_disabled()


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_the_views_break_no_rule_of_accessibility(
    mount: Callable, visit: Visit, theme: str
) -> None:
    """Curves, counts and pictures have names, roles and contrast by the rules of axe-core."""
    visit.page.set_content("<!doctype html><title>Keyframes</title>")
    visit.page.emulate_media(color_scheme=theme)
    for widget in (curves(), count_curve(), PictureView(svg=_SQUARE, description="a square")):
        page = mount(widget)
    assert violations(page, ".wb") == []
