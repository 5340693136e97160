"""Samples that travel between embeddings in the scatter panels, without a kernel."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from tests.browser.scatter_page import (
    POINTS,
    choose,
    is_drawn,
    movable_panels,
    on_screen,
)

pytestmark = pytest.mark.browser

UNKNOWN = np.full_like(POINTS, np.nan)
# Samples 1 and 2 are elsewhere, in the same square.
ELSEWHERE = POINTS + np.array([[0, 0], [0.0, 0.3], [0.3, -0.3], [0, 0], [0, 0]])
LONG = 100_000  # milliseconds, beside which a frame is nothing

_SET_POINTS = """
(values) => mounted[0].model.set("points", new DataView(Float32Array.from(values).buffer))
"""


def pass_time(page: Any, part: float) -> None:
    """Let a part of a travel's time pass, and a frame."""
    page.clock.fast_forward(int(part * LONG))
    page.clock.run_for(40)


@pytest.fixture
def frozen(visit: Any, mount: Callable) -> Callable[..., Any]:
    """Mount panels in a page whose time passes only when told."""

    def render(**traits: Any) -> Any:
        page = visit.page
        page.clock.install()
        mount(movable_panels(**{"transition": LONG, "control_points": [], **traits}))
        page.clock.pause_at(page.evaluate("Date.now() + 1000"))
        return page

    return render


def test_new_positions_are_reached_through_those_between(frozen: Callable) -> None:
    """Half of the time after a change, samples are half way; in the end, they are there."""
    page = frozen()
    page.evaluate(_SET_POINTS, np.stack([ELSEWHERE, POINTS * [-1, 1]]).ravel().tolist())
    pass_time(page, 0.5)
    middle = (POINTS + ELSEWHERE) / 2
    for sample in (1, 2):
        assert is_drawn(page, 0, middle[sample])
        assert not is_drawn(page, 0, ELSEWHERE[sample])
    pass_time(page, 0.6)
    for sample in (1, 2):
        assert is_drawn(page, 0, ELSEWHERE[sample])
        assert not is_drawn(page, 0, middle[sample])


def test_selection_and_hover_are_right_on_the_way(frozen: Callable) -> None:
    """A travelling sample is marked, and found by the mouse, where it is now."""
    page = frozen(raw_points=[ELSEWHERE, UNKNOWN], selection=[2])
    choose(page, "Before optimization")
    pass_time(page, 0.5)
    now = (POINTS[2] + ELSEWHERE[2]) / 2
    assert is_drawn(page, 0, now, ".wb-marks")
    assert not is_drawn(page, 0, POINTS[2], ".wb-marks")
    page.mouse.move(*on_screen(page, 0, now))
    assert page.locator(".wb-hover").inner_text() == "sample 2"


def test_positions_before_the_optimization_are_shown_and_left_again(mount: Callable) -> None:
    """The tool bar leads to the raw positions and back; a panel without them says nothing."""
    page = mount(
        movable_panels(
            panels=[{"title": "A", "detail": "stress 0.1"}, {"title": "B", "detail": "stress 0.2"}],
            raw_points=[ELSEWHERE, UNKNOWN],
        )
    )
    button = page.get_by_role("button", name="Before optimization")
    button.focus()
    page.keyboard.press("Enter")
    assert button.get_attribute("aria-pressed") == "true"
    assert is_drawn(page, 0, ELSEWHERE[1])
    assert page.locator(".wb-tag").all_inner_texts() == ["before optimization", ""]
    captions = page.locator(".wb-panel .wb-detail").all_inner_texts()
    assert captions == ["optimized: stress 0.1", "stress 0.2"]
    choose(page, "Optimized")
    assert not is_drawn(page, 0, ELSEWHERE[1])
    assert page.locator(".wb-tag").all_inner_texts() == ["", ""]


@pytest.mark.parametrize("raw", [[], [UNKNOWN, UNKNOWN]], ids=["none", "unknown in all panels"])
def test_without_raw_positions_there_is_nothing_to_choose(mount: Callable, raw: Any) -> None:
    """The choice appears only if a panel has positions before the optimization."""
    page = mount(movable_panels(raw_points=raw))
    assert page.get_by_role("button", name="Before optimization").count() == 0


def test_reduced_motion_shows_no_travel(frozen: Callable, visit: Any) -> None:
    """Where the system asks for it, samples are at their new places at once."""
    visit.page.emulate_media(reduced_motion="reduce")
    page = frozen(raw_points=[ELSEWHERE, UNKNOWN])
    choose(page, "Before optimization")
    assert is_drawn(page, 0, ELSEWHERE[2])


def test_samples_without_a_position_do_not_travel(frozen: Callable) -> None:
    """A panel that gets its first positions shows them at once."""
    page = frozen(points=[UNKNOWN, POINTS])
    page.evaluate(_SET_POINTS, np.stack([ELSEWHERE, POINTS]).ravel().tolist())
    page.clock.run_for(20)
    assert is_drawn(page, 0, ELSEWHERE[2])


def test_the_first_drag_lets_samples_travel_to_where_control_points_put_them(
    frozen: Callable,
) -> None:
    """Samples go to influence @ control positions by and by, and follow the mouse meanwhile."""
    page = frozen(control_points=[0, 4])
    choose(page, "Move control points")
    page.mouse.move(*on_screen(page, 0, POINTS[4]))
    page.mouse.down()
    page.mouse.move(*on_screen(page, 0, [0.8, 1.0]))
    pass_time(page, 0.5)
    # Sample 1 goes from (0.25, 0.6) to a quarter of the way between the control points, and
    # follows a quarter of the drag.
    assert is_drawn(page, 0, [0.25 - 0.05, (0.6 + 0.25) / 2])
    pass_time(page, 0.6)
    assert is_drawn(page, 0, [0.25 - 0.05, 0.25])
    page.mouse.up()


def test_a_selection_changed_on_the_way_does_not_stop_it(frozen: Callable) -> None:
    """Samples arrive although colours and panels are changed while they travel."""
    page = frozen(raw_points=[ELSEWHERE, UNKNOWN])
    choose(page, "Before optimization")
    pass_time(page, 0.5)
    page.evaluate("mounted[0].model.set('color_by', 'time')")
    page.evaluate("mounted[0].model.set('selection', new DataView(Int32Array.of(1).buffer))")
    pass_time(page, 0.6)
    assert is_drawn(page, 0, ELSEWHERE[2])


def test_positions_set_while_samples_travel_are_reached(frozen: Callable) -> None:
    """A travel that is overtaken by another ends at the last positions."""
    page = frozen(raw_points=[ELSEWHERE, UNKNOWN])
    choose(page, "Before optimization")
    pass_time(page, 0.5)
    choose(page, "Optimized")
    pass_time(page, 1.1)
    assert is_drawn(page, 0, POINTS[1])
    assert not is_drawn(page, 0, ELSEWHERE[1])
