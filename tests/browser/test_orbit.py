"""Figures are turned and zoomed by mouse, keys and buttons wherever they are shown."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from tests.browser.test_hover_views import waving_body
from tests.browser.test_landscape import reconstruction
from tests.browser.test_player import waving

pytestmark = pytest.mark.browser

# Turns the wheel over the figures; tells whether the page was kept from scrolling.
_WHEEL = """
([ctrlKey, focus]) => {
  const canvas = document.querySelector("canvas[role=application]");
  if (focus) canvas.focus(); else canvas.blur();
  const event = new WheelEvent("wheel", { deltaY: -300, cancelable: true, ctrlKey });
  canvas.dispatchEvent(event);
  return event.defaultPrevented;
}
"""
_PICTURE = "document.querySelector('canvas[role=application]').toDataURL()"


def rebuilt_pose() -> Any:
    """Show two joints and an end site, with a head, as they are and turned."""
    turned = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    return reconstruction(
        original=np.stack([np.eye(3), np.eye(3)]).ravel(),
        rebuilt=np.stack([np.eye(3), turned]).ravel(),
        rebuilt_at=[0.5, 0.5],
        columns=[],
        parents=[-1, 0, 1],
        sides=["middle", "left", "middle"],
        head=2,
        offsets=[[0, 0, 0], [0.2, 1, 0], [0, 1, 0]],
        root=[0, 0, 0],
        weights=[1, 1],
        kernel="",
    )


WIDGETS = {"pose": waving_body, "reconstruction": rebuilt_pose, "player": waving}


@pytest.fixture(params=WIDGETS, ids=WIDGETS)
def page(mount: Callable, request: pytest.FixtureRequest) -> Any:
    """Show one of the widgets that draw figures."""
    return mount(WIDGETS[request.param](), width=500)


def test_buttons_zoom_and_put_back(page: Any) -> None:
    """Each press changes the picture, and one button looks as at first."""
    pictures = [page.evaluate(_PICTURE)]
    for name in ("Zoom in", "Zoom in", "Zoom out"):
        page.get_by_role("button", name=name).click()
        pictures.append(page.evaluate(_PICTURE))
    assert len(set(pictures)) == 3
    assert pictures[1] == pictures[3]
    page.get_by_role("button", name="Reset view").click()
    assert page.evaluate(_PICTURE) == pictures[0]


def test_keys_do_the_same(page: Any) -> None:
    """Plus and minus zoom, 0 looks as at first."""
    first = page.evaluate(_PICTURE)
    page.locator("canvas[role=application]").focus()
    page.keyboard.press("+")
    assert page.evaluate(_PICTURE) != first
    page.keyboard.press("-")
    assert page.evaluate(_PICTURE) == first
    page.keyboard.press("Shift+ArrowLeft")
    assert page.evaluate(_PICTURE) != first
    page.keyboard.press("0")
    assert page.evaluate(_PICTURE) == first


@pytest.mark.parametrize(
    ("ctrl", "focus", "zooms"),
    [(False, False, False), (True, False, True), (False, True, True)],
    ids=["in passing", "with Ctrl", "at work"],
)
def test_the_wheel_zooms_only_if_it_is_meant(
    page: Any, *, ctrl: bool, focus: bool, zooms: bool
) -> None:
    """Who scrolls past does not change the view; who works there, or holds Ctrl, zooms."""
    first = page.evaluate(_PICTURE)
    assert page.evaluate(_WHEEL, [ctrl, focus]) == zooms
    assert (page.evaluate(_PICTURE) != first) == zooms
