"""The pose view and the sample details follow the hovered sample without a kernel."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from workbench.widgets import PoseView, SampleDetails, StatusLine

pytestmark = pytest.mark.browser

_HOVER = """
([channel, sample]) => document.dispatchEvent(
  new CustomEvent("workbench-hover", {detail: {channel, sample}}))
"""
_PICTURE = "document.querySelector('.wb-pose canvas').toDataURL()"
# Counts the pixels of a colour's kind: red, green or blue is the largest by far.
_COLOURED = """
(channel) => {
  const canvas = document.querySelector(".wb-pose canvas");
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  const [xs, ys] = [[], []];
  for (let i = 0; i < data.length; i += 4) {
    const others = [0, 1, 2].filter((c) => c !== channel).map((c) => data[i + c]);
    const opaque = data[i + 3] === 255;
    if (opaque && data[i + channel] > Math.max(...others) + 60) {
      xs.push((i / 4) % canvas.width);
      ys.push(Math.floor(i / 4 / canvas.width));
    }
  }
  const rim = Math.min(
    ...xs, ...ys, canvas.width - 1 - Math.max(...xs), canvas.height - 1 - Math.max(...ys));
  return { count: xs.length, mean: xs.reduce((a, b) => a + b, 0) / xs.length, rim };
}
"""
BLUE, RED = 2, 0


def hover(page: Any, channel: str, sample: int) -> None:
    page.evaluate(_HOVER, [channel, sample])


def waving_body(n_frames: int = 30) -> PoseView:
    """Make a body with one arm to each side; the left one, at positive x, rises."""
    rise = np.linspace(0, 1, n_frames)
    positions = np.zeros((n_frames, 4, 3))
    positions[:, 1] = [0, 2, 0]
    positions[:, 2] = np.stack([np.ones(n_frames), 1 + rise, 0 * rise], axis=1)
    positions[:, 3] = [-1, 1, 0]
    return PoseView(
        positions=positions,
        parents=[-1, 0, 1, 1],
        sides=["middle", "middle", "left", "right"],
        frame_time=0.1,
        channel="pose",
    )


def test_a_hovered_frame_is_drawn_at_once_without_a_message(mount: Callable) -> None:
    """The event alone changes the picture; nothing is saved for the kernel."""
    page = mount(waving_body(), width=300)
    before = page.evaluate(_PICTURE)
    hover(page, "pose", 29)
    assert page.evaluate(_PICTURE) != before
    assert page.locator(".wb-pose .wb-detail").inner_text() == "frame 29 of 30 · 2.90 s"
    assert page.evaluate("mounted[0].model.saved") == 0


@pytest.mark.parametrize(
    ("channel", "sample"), [("other", 29), ("pose", -1)], ids=["another channel", "nothing"]
)
def test_what_is_not_meant_for_it_changes_nothing(
    mount: Callable, channel: str, sample: int
) -> None:
    """Another dashboard's mouse, or one over no sample, leaves the pose as it is."""
    page = mount(waving_body(), width=300)
    before = page.evaluate(_PICTURE)
    hover(page, channel, sample)
    assert page.evaluate(_PICTURE) == before


def test_left_and_right_are_told_apart(mount: Callable) -> None:
    """Left limbs are blue and right ones red, each on its side seen from the front."""
    page = mount(waving_body(), width=300)
    left, right = page.evaluate(_COLOURED, BLUE), page.evaluate(_COLOURED, RED)
    assert left["count"] > 50
    assert right["count"] > 50
    # Who faces the viewer (towards positive z) has the left hand on the viewer's right.
    assert left["mean"] > right["mean"]


@pytest.mark.parametrize("way", ["mouse", "keyboard"])
def test_the_view_can_be_turned(mount: Callable, way: str) -> None:
    """Dragging or arrow keys show the figure from another side."""
    page = mount(waving_body(), width=300)
    before = page.evaluate(_PICTURE)
    canvas = page.locator(".wb-pose canvas")
    if way == "mouse":
        box = canvas.bounding_box()
        page.mouse.move(box["x"] + 100, box["y"] + 100)
        page.mouse.down()
        page.mouse.move(box["x"] + 160, box["y"] + 100)
        page.mouse.up()
    else:
        canvas.focus()
        page.keyboard.press("ArrowLeft")
    assert page.evaluate(_PICTURE) != before


def test_the_figure_stays_within_its_canvas(mount: Callable) -> None:
    """No limb reaches the rim, wherever the body went in the world."""
    widget = waving_body()
    widget.positions = widget.positions + np.float32([500, -30, 200])
    page = mount(widget, width=300)
    for frame in (0, 29):
        hover(page, "pose", frame)
        for channel in (BLUE, RED):
            limbs = page.evaluate(_COLOURED, channel)
            assert limbs["count"] > 50
            assert limbs["rim"] > 2


def test_details_show_the_values_and_class_of_the_hovered_row(mount: Callable) -> None:
    """Each feature is shown with its value, and a mark at its place in the range."""
    widget = SampleDetails(
        values=[[1, 10], [2, 30], [3, 20]],
        columns=["width", "height"],
        classes=[0, 1, 0],
        class_names=["round", "<i>flat</i>"],
        channel="table",
    )
    page = mount(widget, width=300)
    hover(page, "table", 1)
    assert page.locator(".wb-details .wb-detail").inner_text() == "sample 1 · <i>flat</i>"
    assert page.locator(".wb-number").all_inner_texts() == ["2", "30"]
    lefts = page.evaluate("[...document.querySelectorAll('.wb-range i')].map((i) => i.style.left)")
    assert lefts == ["50%", "100%"]


def test_the_pose_is_named_and_takes_keys(mount: Callable) -> None:
    """A screen reader gets the frame, and lets the arrow keys through."""
    page = mount(waving_body(), width=300)
    hover(page, "pose", 3)
    assert page.get_by_role("application", name="Stick figure, frame 3 of 30").count() == 1


def test_the_status_is_one_element_whose_text_changes(mount: Callable) -> None:
    """A screen reader speaks the change of an element that stays."""
    page = mount(StatusLine(value="loading"))
    page.evaluate("window.first = document.querySelector('[role=status]')")
    page.evaluate("mounted[0].model.set('value', 'a < b')")
    page.get_by_role("status").get_by_text("a < b", exact=True).wait_for()
    assert page.evaluate("document.querySelector('[role=status]') === window.first")
