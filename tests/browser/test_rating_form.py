"""The rating form can be used with mouse and keyboard, and claims nothing that is not stored."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from tests.browser.axe import violations
from tests.browser.chromium import Visit
from workbench.widgets.rating_form import RatingForm
from workbench.widgets.tab_memory import TabMemory

pytestmark = pytest.mark.browser

_GET = "(name) => mounted[0].model.get(name)"
_SET = "([name, value]) => mounted[0].model.set(name, value)"


def form(**traits: Any) -> RatingForm:
    settings: dict[str, Any] = {
        "heading": "Movement 1 of 3",
        "question": "How good?",
        "letters": ["A", "B", "C"],
        "stored": [0, 0, 0],
        "ready": True,
        "waiting": "Watch first.",
        "onward": "Next movement",
    }
    return RatingForm(**(settings | traits))


def store(page: Any) -> None:
    """Answer as Python does that what was chosen is stored."""
    page.evaluate("mounted[0].model.set('stored', [...mounted[0].model.get('chosen')])")


def press(page: Any, rating: str, figure: int = 0) -> None:
    """Press a number with the mouse."""
    scale = page.locator("fieldset").nth(figure)
    scale.get_by_role("radio", name=rating, exact=True).click()


def checked(page: Any) -> list[str]:
    return page.evaluate(
        "[...document.querySelectorAll('.wb-rating input:checked')].map((input) => input.value)"
    )


def test_figures_are_rated_by_keyboard_alone(mount: Callable) -> None:
    """Tab goes from figure to figure; digits and arrows choose; the button is pressed."""
    page = mount(form())
    page.get_by_role("group", name="Quality of motion A").get_by_label("1", exact=True).focus()
    page.keyboard.press("7")
    store(page)
    page.keyboard.press("Tab")
    page.keyboard.press("0")
    page.keyboard.press("ArrowLeft")
    store(page)
    page.keyboard.press("Tab")
    page.keyboard.press(" ")
    assert page.evaluate(_GET, "chosen") == [7, 9, 1]
    onward = page.get_by_role("button", name="Next movement")
    assert onward.is_disabled()
    store(page)
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    assert page.evaluate(_GET, "finished") == 1
    assert onward.is_disabled()  # until the next item is here


def test_figures_are_rated_by_mouse(mount: Callable) -> None:
    """A press on a number chooses it, another one replaces it."""
    page = mount(form())
    for rating in ("4", "10"):
        press(page, rating, figure=1)
    assert page.evaluate(_GET, "chosen") == [0, 10, 0]
    assert checked(page) == ["10"]


def test_a_rating_counts_as_stored_only_when_python_says_so(mount: Callable) -> None:
    """Until then it is marked as on its way, and the person cannot go on."""
    page = mount(form(letters=["A"], stored=[0]))
    press(page, "5")
    state = page.locator(".wb-rating-state")
    assert state.get_attribute("title") == "being stored"
    assert page.locator(".wb-rating-onward").is_disabled()
    store(page)
    page.wait_for_function("document.querySelector('.wb-rating-state').title === 'stored'")
    assert page.locator(".wb-rating-onward").is_enabled()
    press(page, "6")
    assert state.get_attribute("title") == "being stored"
    assert page.locator(".wb-rating-onward").is_disabled()


def test_choices_that_follow_each_other_fast_are_all_told(mount: Callable) -> None:
    """What is sent last holds all that was chosen before."""
    page = mount(form())
    for index, rating in enumerate(("2", "3", "4")):
        press(page, rating, figure=index)
    assert page.evaluate(_GET, "chosen") == [2, 3, 4]


def test_what_was_refused_is_not_shown_as_chosen(mount: Callable) -> None:
    """The message is spoken, the rating before is back, and the next choice is sent again."""
    page = mount(form(stored=[4, 0, 0]))
    press(page, "9")
    page.evaluate(_SET, ["message", "That did not work."])
    page.evaluate(_SET, ["chosen", [4, 0, 0]])
    page.get_by_role("alert").get_by_text("That did not work.").wait_for()
    assert checked(page) == ["4"]
    press(page, "9")
    assert page.evaluate(_GET, "chosen") == [9, 0, 0]
    assert checked(page) == ["9"]


def test_a_rating_that_is_not_stored_for_long_is_told(mount: Callable, visit: Visit) -> None:
    """A kernel that has ended says nothing; the page does."""
    visit.page.clock.install()
    page = mount(form())
    press(page, "9")
    assert page.locator(".wb-rating-message").inner_text() == ""
    page.clock.run_for(16_000)
    assert "reload the page" in page.locator(".wb-rating-message").inner_text()
    store(page)
    page.wait_for_function("!document.querySelector('.wb-rating-message').textContent")


def test_nothing_can_be_chosen_before_it_was_seen(mount: Callable) -> None:
    """The form says what to do first; mouse and keys change nothing."""
    page = mount(form(ready=False))
    assert page.get_by_text("Watch first.").is_visible()
    assert page.evaluate("document.querySelector('.wb-rating fieldset').disabled")
    number = (
        page.locator("fieldset").first.get_by_role("radio", name="9", exact=True).bounding_box()
    )
    page.mouse.click(number["x"] + 5, number["y"] + 5)
    assert page.evaluate(_GET, "chosen") == []
    page.evaluate(_SET, ["ready", True])
    page.wait_for_function("!document.querySelector('.wb-rating fieldset').disabled")
    assert not page.get_by_text("Watch first.").is_visible()


def test_the_next_item_has_the_focus(mount: Callable) -> None:
    """A screen reader speaks its heading, and ratings that were there are shown."""
    page = mount(form())
    page.wait_for_function("document.activeElement.textContent === 'Movement 1 of 3'")
    page.evaluate(_SET, ["stored", [0, 8, 0]])
    page.evaluate(_SET, ["heading", "Movement 2 of 3"])
    page.wait_for_function("document.activeElement.textContent === 'Movement 2 of 3'")
    assert checked(page) == ["8"]


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_the_form_is_accessible(mount: Callable, visit: Visit, scheme: str) -> None:
    """By the rules of axe-core, in both themes and with every state shown."""
    visit.page.emulate_media(color_scheme=scheme)
    page = mount(form(stored=[4, 0, 0], message="That did not work.", note="Your code is 1-ABC."))
    assert violations(page, ".wb-rating") == []


def test_a_tab_remembers_a_word_over_a_reload(mount: Callable, visit: Visit) -> None:
    """Under its name only; an empty word is forgotten."""
    visit.page.route("http://127.0.0.1:9/", lambda route: route.fulfill(body="<title>x</title>"))
    visit.page.goto("http://127.0.0.1:9/")  # a page without an address has no memory
    page = mount(TabMemory(name="study", word="7-KFM"))
    page.reload()
    page = mount(TabMemory(name="study"))
    assert page.evaluate(_GET, "recalled") == "7-KFM"
    page = mount(TabMemory(name="another"))
    assert page.evaluate("mounted[1].model.get('recalled')") == ""
    page.evaluate("mounted[0].model.set('word', '7-KFM'); mounted[0].model.set('word', '')")
    page.wait_for_function("sessionStorage.length === 0")
