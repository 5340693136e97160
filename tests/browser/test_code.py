"""The view of code that is to be copied."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from workbench.widgets.code import CodeView

pytestmark = pytest.mark.browser


def test_the_button_copies_or_selects_the_code(mount: Callable[..., Any]) -> None:
    """Where the clipboard is closed to the page, the code is selected and the page says so."""
    page = mount(CodeView(code="a = '<b>'\nb = 2\n"))
    assert page.locator(".wb-code-text").inner_text() == "a = '<b>'\nb = 2\n"
    page.evaluate(
        """() => {
          window.copied = [];
          const clipboard = { writeText: async (text) => window.copied.push(text) };
          Object.defineProperty(navigator, "clipboard", { value: clipboard, configurable: true });
        }"""
    )
    page.get_by_role("button", name="Copy").click()
    page.get_by_text("copied").wait_for()
    assert page.evaluate("window.copied") == ["a = '<b>'\nb = 2\n"]
    page.evaluate(
        """() => Object.defineProperty(navigator, "clipboard", {
          value: { writeText: () => Promise.reject(new Error("no")) }, configurable: true })"""
    )
    page.get_by_role("button", name="Copy").click()
    page.get_by_text("press Ctrl+C").wait_for()
    assert page.evaluate("getSelection().toString().trim()") == "a = '<b>'\nb = 2"
    page.evaluate("mounted[0].model.set('code', 'c = 3')")
    page.wait_for_function("document.querySelector('.wb-code-text').textContent === 'c = 3'")
