"""Control points moved in the scatter panels, without a kernel."""

from __future__ import annotations

from collections.abc import Callable
from io import StringIO
from typing import Any

import numpy as np
import pandas as pd
import pytest
from numpy.typing import NDArray

from tests.browser.scatter_page import (
    CONTROLS,
    INFLUENCE,
    POINTS,
    choose,
    floats,
    is_drawn,
    movable_panels,
    on_screen,
    saved_table,
    set_floats,
)
from workbench.projection.rbfp import RBFP
from workbench.spaces import VectorSpace

pytestmark = pytest.mark.browser

MOVE = "Move control points"


def drag(page: Any, panel: int, start: Any, end: Any, drop: bool = True) -> None:
    page.mouse.move(*on_screen(page, panel, start))
    page.mouse.down()
    page.mouse.move(*on_screen(page, panel, np.add(start, end) / 2))
    page.mouse.move(*on_screen(page, panel, end))
    if drop:
        page.mouse.up()


def shown(page: Any, panel: int) -> NDArray[np.float64]:
    """Read the positions that are shown, from the table that a person can save."""
    table = pd.read_csv(StringIO(saved_table(page)))
    title = "AB"[panel]
    return table[[f"{title} x", f"{title} y"]].to_numpy()


def moved_in(page: Any) -> NDArray[np.float64]:
    return floats(page, "moved").reshape(2, len(CONTROLS), 2)


def test_a_dropped_control_point_is_told_and_the_rest_follow(mount: Callable) -> None:
    """Positions are influence @ control positions in the panel of the drag, and only there."""
    page = mount(movable_panels())
    choose(page, MOVE)
    drag(page, 0, POINTS[4], [0.5, 0.9])
    moved = moved_in(page)
    # A pixel of the panel is a three-hundredth of it.
    np.testing.assert_allclose(moved[0], [[0, 0], [0.5, 0.9]], atol=0.004)
    assert np.isnan(moved[1]).all()
    assert page.evaluate("mounted[0].model.saved") == 1
    np.testing.assert_allclose(shown(page, 0), INFLUENCE @ moved[0], atol=1e-5)
    np.testing.assert_allclose(shown(page, 1), POINTS * [-1, 1], atol=1e-6)
    assert page.locator(".wb-tag").all_inner_texts() == ["moved", ""]


def test_the_rest_follows_while_the_mouse_still_drags(mount: Callable) -> None:
    """The middle of two control points stays the middle, and Python is not told yet."""
    page = mount(movable_panels())
    choose(page, MOVE)
    drag(page, 0, POINTS[4], [0.6, 1.0], drop=False)
    assert is_drawn(page, 0, [0.3, 0.5])
    assert not is_drawn(page, 0, POINTS[2])
    assert floats(page, "moved").size == 0
    page.mouse.up()
    assert is_drawn(page, 0, [0.3, 0.5])


def test_escape_during_a_drag_puts_all_back(mount: Callable) -> None:
    """Samples return to their own positions, not to those that the control points give."""
    page = mount(movable_panels())
    choose(page, MOVE)
    drag(page, 0, POINTS[4], [0.6, 0.9], drop=False)
    assert not is_drawn(page, 0, POINTS[1])
    page.keyboard.press("Escape")
    page.mouse.up()
    page.wait_for_function("document.querySelector('.wb-live').textContent.endsWith('put back')")
    np.testing.assert_allclose(shown(page, 0), POINTS, atol=1e-6)
    assert page.evaluate("mounted[0].model.saved") == 0


@pytest.mark.parametrize(
    "event",
    [
        "mounted[0].model.set('moved', new DataView(new ArrayBuffer(0)))",
        "mounted[0].model.set('values', new DataView(new Float32Array(10).buffer))",
        "mounted[0].model.set('panels', [{ title: 'A', detail: 'measured' }, { title: 'B' }])",
    ],
    ids=["echo of moved", "values", "panels"],
)
def test_news_from_python_do_not_end_a_drag(mount: Callable, event: str) -> None:
    """What is measured after the last drop may arrive during the next drag."""
    page = mount(movable_panels(color_by="value", values=np.ones((2, 5))))
    choose(page, MOVE)
    drag(page, 0, POINTS[4], [0.6, 0.9], drop=False)
    page.evaluate(event)
    page.mouse.move(*on_screen(page, 0, [0.5, 0.9]))
    page.mouse.up()
    np.testing.assert_allclose(moved_in(page)[0, 1], [0.5, 0.9], atol=0.004)


def test_a_change_of_width_gives_a_drag_up(mount: Callable) -> None:
    """Pixels mean other positions then; nothing is moved, and the next drag works."""
    page = mount(movable_panels())
    choose(page, MOVE)
    drag(page, 0, POINTS[4], [0.6, 0.9], drop=False)
    before = page.evaluate("document.querySelector('.wb-base').width")
    page.evaluate("mounted[0].el.style.width = '600px'")
    page.wait_for_function("(w) => document.querySelector('.wb-base').width !== w", arg=before)
    page.mouse.move(*on_screen(page, 0, [0.5, 0.9]))
    page.mouse.up()
    np.testing.assert_allclose(shown(page, 0), POINTS, atol=1e-6)
    drag(page, 0, POINTS[4], [0.5, 0.9])
    np.testing.assert_allclose(moved_in(page)[0, 1], [0.5, 0.9], atol=0.005)


def test_reset_brings_the_positions_back(mount: Callable) -> None:
    """After a reset all panels show their own positions and the trait is empty."""
    page = mount(movable_panels())
    choose(page, MOVE)
    drag(page, 0, POINTS[4], [0.5, 0.9])
    drag(page, 0, [0, 0], [0.2, 0.1])
    choose(page, "Reset control points")
    assert floats(page, "moved").size == 0
    np.testing.assert_allclose(shown(page, 0), POINTS, atol=1e-6)
    assert page.get_by_role("button", name="Reset control points").is_disabled()


def test_a_second_drag_starts_where_the_first_ended(mount: Callable) -> None:
    """Both moves are in the trait, also when the second is in a panel that was refitted."""
    page = mount(movable_panels())
    choose(page, MOVE)
    drag(page, 0, POINTS[4], [0.5, 0.9])
    drag(page, 0, [0, 0], [0.2, 0.1])
    moved = moved_in(page)
    np.testing.assert_allclose(moved[0], [[0.2, 0.1], [0.5, 0.9]], atol=0.008)
    np.testing.assert_allclose(shown(page, 0), INFLUENCE @ moved[0], atol=1e-5)


def test_a_control_point_dropped_outside_is_seen_again(mount: Callable) -> None:
    """A panel whose samples left it shows all of them after the drop."""
    page = mount(movable_panels())
    choose(page, MOVE)
    drag(page, 0, POINTS[0], [-0.02, -0.1])
    x, y = moved_in(page)[0, 0]
    low, extent = np.array([min(x, 0), y]), 1 - y
    centre = (np.array([x, y]) + 1) / 2
    frame = (np.array([x, y]) - centre) / extent + 0.5
    assert low[1] < -0.05
    assert is_drawn(page, 0, frame)


def test_control_points_move_by_keyboard(mount: Callable) -> None:
    """Arrows lead to a control point, Enter picks it up, arrows move it, Enter drops it."""
    page = mount(movable_panels())
    choose(page, MOVE)
    page.locator(".wb-plot").first.focus()
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowRight")
    assert page.locator(".wb-live").inner_text() == "sample 4 · control point"
    page.keyboard.press("Enter")
    assert page.locator(".wb-live").inner_text() == "sample 4 · control point, picked up"
    for key in ("ArrowLeft", "ArrowLeft", "ArrowDown", "Shift+ArrowRight"):
        page.keyboard.press(key)
    page.keyboard.press("Enter")
    unit = page.evaluate("document.querySelector('.wb-base').clientWidth") - 24
    expected = [[0, 0], [1 - 15 / unit, 1 - 8 / unit]]
    np.testing.assert_allclose(moved_in(page)[0], expected, atol=1e-5)


def test_escape_by_keyboard_puts_back_and_keeps_the_selection(mount: Callable) -> None:
    """The first Escape gives the move up, only the next one clears the selection."""
    page = mount(movable_panels(selection=[2]))
    choose(page, MOVE)
    page.locator(".wb-plot").first.focus()
    for key in ("Home", "Enter", "ArrowUp", "Escape"):
        page.keyboard.press(key)
    np.testing.assert_allclose(shown(page, 0), POINTS, atol=1e-6)
    assert page.locator(".wb-count").inner_text() == "1 of 5 samples selected"
    page.locator(".wb-plot").first.focus()
    page.keyboard.press("Escape")
    assert page.locator(".wb-count").inner_text() == ""


def test_positions_set_from_python_are_shown(mount: Callable) -> None:
    """Setting the trait moves the samples of its panels; setting it empty moves them back."""
    page = mount(movable_panels())
    moved = np.full((2, 2, 2), np.nan)
    moved[1] = [[0.0, 0.0], [0.4, 0.8]]
    set_floats(page, "moved", moved)
    np.testing.assert_allclose(shown(page, 1), INFLUENCE @ moved[1], atol=1e-6)
    assert page.locator(".wb-tag").all_inner_texts() == ["", "moved"]
    set_floats(page, "moved", [])
    np.testing.assert_allclose(shown(page, 1), POINTS * [-1, 1], atol=1e-6)


def test_a_caption_says_when_its_values_are_of_other_positions(mount: Callable) -> None:
    """Until Python has measured the moved positions, the caption is said to be older."""
    page = mount(movable_panels(panels=[{"title": "A", "detail": "stress 0.1"}, {"title": "B"}]))
    caption = page.locator(".wb-panel .wb-detail").first
    choose(page, MOVE)
    drag(page, 0, POINTS[4], [0.5, 0.9])
    assert caption.inner_text() == "before moving: stress 0.1"
    choose(page, "Reset control points")
    assert caption.inner_text() == "stress 0.1"
    drag(page, 0, POINTS[4], [0.5, 0.9])
    page.evaluate("""mounted[0].model.set(
        "panels", [{ title: "A", detail: "stress 0.2" }, { title: "B" }])""")
    assert caption.inner_text() == "stress 0.2"
    choose(page, "Reset control points")
    assert caption.inner_text() == "while moved: stress 0.2"
    drag(page, 1, [0, 1], [0.3, 0.8])
    choose(page, "Reset control points")
    assert caption.inner_text() == "while moved: stress 0.2"


@pytest.mark.parametrize(
    "traits",
    [{"movable": False}, {"influence": []}, {"influence": INFLUENCE[:3]}],
    ids=["not movable", "no influence", "influence of other samples"],
)
def test_without_influence_nothing_can_be_moved(mount: Callable, traits: dict[str, Any]) -> None:
    """The mode is offered only when the samples can follow."""
    page = mount(movable_panels(**traits))
    assert page.get_by_role("button", name=MOVE).count() == 0


def test_moved_samples_agree_with_rbfp(mount: Callable) -> None:
    """The browser's placement of 150 vectors is that of RBFP with the same control points."""
    generator = np.random.default_rng(0)
    vectors = generator.normal(size=(150, 4))
    controls = np.arange(0, 150, 15)
    space = VectorSpace(vectors)
    units = [
        RBFP().fit(space, controls, np.repeat(row[:, None], 2, axis=1)).transform(vectors)[:, 0]
        for row in np.eye(len(controls))
    ]
    positions = vectors[:, :2]
    page = mount(
        movable_panels(
            points=[positions, positions],
            control_points=controls,
            influence=np.stack(units, axis=1),
        )
    )
    moved = np.full((2, len(controls), 2), np.nan)
    moved[0] = positions[controls] + generator.normal(size=(len(controls), 2))
    set_floats(page, "moved", moved)
    expected = RBFP().fit(space, controls, moved[0]).transform(vectors)
    extent = np.ptp(expected, axis=0).max()
    np.testing.assert_allclose(shown(page, 0), expected, atol=1e-5 * extent)
