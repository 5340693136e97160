"""Start Debian's Chromium without a word to the outside, and watch a page."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any
from urllib.parse import urlsplit

FLAGS = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]
_LOCAL = {"data", "blob", "about", "file"}


def chromium_path() -> str | None:
    """Find Chromium on this machine."""
    return shutil.which("chromium") or shutil.which("chromium-browser")


def page_browser_path() -> str | None:
    """Find what pages are opened with, best Debian's Chromium without windows.

    It takes a third of the time of Chromium, which gets a toolbar ready for each page.
    """
    return shutil.which("chromium-headless-shell") or chromium_path()


@contextmanager
def open_browser() -> Iterator[Any]:
    """Start Chromium, or give None if there is none."""
    path = page_browser_path()
    if path is None:
        yield None
        return
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=FLAGS)
        yield browser
        browser.close()


@dataclass
class Visit:
    """A page, the requests that left the machine, and what its console complained about."""

    page: Any
    strayed: list[str] = field(default_factory=list)
    complaints: list[str] = field(default_factory=list)

    @classmethod
    @contextmanager
    def to(cls, browser: Any, **options: Any) -> Iterator[Visit]:
        """Open an empty page in a fresh profile."""
        options.setdefault("viewport", {"width": 1280, "height": 900})
        context = browser.new_context(**options)
        context.set_default_timeout(15_000)
        visit = cls(context.new_page())
        context.on("request", lambda request: visit.note_request(request.url))
        visit.page.on("websocket", lambda socket: visit.note_request(socket.url))
        visit.page.on("console", visit.note_message)
        visit.page.on("pageerror", lambda error: visit.complaints.append(str(error)))
        try:
            yield visit
        finally:
            context.close()

    def note_request(self, address: str) -> None:
        """Keep the address of a request that is not for this machine."""
        parts = urlsplit(address)
        if parts.scheme not in _LOCAL and parts.hostname != "127.0.0.1":
            self.strayed.append(address)

    def note_message(self, message: Any) -> None:
        """Keep an error from the console."""
        if message.type == "error":
            self.complaints.append(f"{message.text} ({message.location.get('url', '')})")
