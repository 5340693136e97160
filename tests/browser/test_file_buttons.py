"""Buttons that save files which Python makes."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from workbench.widgets.file_buttons import FileButtons

pytestmark = pytest.mark.browser

OFFERS = [
    {"want": "bvh", "text": "Save BVH", "hint": "The motion"},
    {"want": "page", "text": "Save page", "hint": "A page"},
]


def answered(page: Any, script: str) -> None:
    """Let the page's model answer what it is asked for by a script."""
    page.evaluate(f"() => {{ window.answer = {script}; }}")


def test_what_python_gives_is_saved(mount: Callable[..., Any]) -> None:
    """The file has the name and the bytes that were sent."""
    page = mount(FileButtons(offers=OFFERS))
    answered(
        page,
        "(receive) => receive({answer: 'bvh', name: 'walk.bvh', type: 'text/plain'}, "
        "[new TextEncoder().encode('HIERARCHY')])",
    )
    with page.expect_download() as saved:
        page.get_by_role("button", name="Save BVH").click()
    assert saved.value.suggested_filename == "walk.bvh"
    assert Path(saved.value.path()).read_bytes() == b"HIERARCHY"
    assert page.get_by_role("status").inner_text() == "saved: walk.bvh"


def test_a_failure_is_told_and_the_button_asks_again(mount: Callable[..., Any]) -> None:
    """The reason stands beside the buttons; a second press asks anew."""
    page = mount(FileButtons(offers=OFFERS))
    page.evaluate("window.asked = 0")
    answered(
        page, "(receive) => { asked += 1; receive({answer: 'page', failure: 'no motion yet'}); }"
    )
    for times in (1, 2):
        page.get_by_role("button", name="Save page").click()
        assert page.get_by_role("status").inner_text() == "Not saved: no motion yet"
        assert page.evaluate("asked") == times


def test_one_press_asks_once_while_the_file_is_being_made(mount: Callable[..., Any]) -> None:
    """An impatient person does not get the file twice."""
    page = mount(FileButtons(offers=OFFERS))
    page.evaluate("window.asked = 0")
    answered(page, "() => { asked += 1; }")
    for _ in range(2):
        page.get_by_role("button", name="Save BVH").click()
    assert page.evaluate("asked") == 1
    assert page.get_by_role("status").inner_text() == "Save BVH …"


def test_with_nothing_to_save_the_buttons_cannot_be_pressed(mount: Callable[..., Any]) -> None:
    """They are there and disabled."""
    page = mount(FileButtons(offers=OFFERS, enabled=False))
    assert [button.is_disabled() for button in page.get_by_role("button").all()] == [True, True]


def test_a_file_that_is_opened_is_sent_each_time(mount: Callable[..., Any]) -> None:
    """Name and bytes arrive, also of a file that was chosen before."""
    offer = {"want": "session", "text": "Open session", "hint": "A file", "takes": ".json"}
    page = mount(FileButtons(offers=[offer], enabled=False))
    page.evaluate(
        """() => {
          window.sent = [];
          mounted[0].model.send = (content, _, [bytes]) =>
            sent.push([content, new TextDecoder().decode(bytes)]);
        }"""
    )
    chosen = {"name": "jump.json", "mimeType": "application/json", "buffer": b"{}"}
    for times in (1, 2):
        with page.expect_file_chooser() as chooser:
            page.get_by_role("button", name="Open session").click()
        chooser.value.set_files(chosen)
        page.wait_for_function("(times) => sent.length === times", arg=times)
    assert page.evaluate("sent[1]") == [{"given": "session", "name": "jump.json"}, "{}"]
