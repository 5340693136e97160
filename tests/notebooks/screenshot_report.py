"""Take pictures of a reproduction report.

python -m tests.notebooks.screenshot_report OUT PNG [WIDTH [HEIGHT [dark]]]
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

from tests.browser.chromium import open_browser

LOCAL = ("file:", "data:", "blob:", "about:")


def open_report(browser: Any, out: Path, *, width: int = 1280, dark: bool = False) -> Any:
    """Open the report of an output folder from ``file://`` and wait until its figures are drawn.

    Returns
    -------
    page
        Its attribute ``complaints`` lists errors on the console and requests that left the
        folder; it is empty for a good page.
    """
    page = browser.new_page(
        viewport={"width": width, "height": 1000}, color_scheme="dark" if dark else "light"
    )
    page.complaints = []

    def note(text: str, *, good: bool) -> None:
        if not good:
            page.complaints.append(text)

    page.on("console", lambda message: note(message.text, good=message.type != "error"))
    page.on("pageerror", lambda error: note(str(error), good=False))
    page.on("request", lambda request: note(request.url, good=request.url.startswith(LOCAL)))
    page.goto((out / "index.html").resolve().as_uri())
    for plot in page.locator(".plot").all():
        plot.scroll_into_view_if_needed()
        plot.locator(".main-svg").first.wait_for(timeout=30_000)
    page.evaluate("window.scrollTo(0, 0)")
    return page


def screenshot_report(
    out: Path,
    picture: Path,
    *,
    width: int = 1280,
    height: int | None = None,
    dark: bool = False,
) -> list[str]:
    """Take a picture of the report of an output folder.

    Parameters
    ----------
    out : Path
        The output folder of a reproduction.
    picture : Path
        The PNG to write.
    width : int
        Width of the window in pixels.
    height : int, optional
        Height of the part that is shown, from the top; the whole page if None.
    dark : bool
        Whether the reader prefers dark pages.

    Returns
    -------
    list of str
        What went wrong on the page, see :func:`open_report`.
    """
    with open_browser() as browser:
        if browser is None:
            return ["no chromium on this machine"]
        page = open_report(browser, out, width=width, dark=dark)
        if height is not None:
            page.set_viewport_size({"width": width, "height": height})
        page.screenshot(path=str(picture), full_page=height is None)
        return list(page.complaints)


if __name__ == "__main__":
    problems = screenshot_report(
        Path(sys.argv[1]),
        Path(sys.argv[2]),
        width=int(sys.argv[3]) if len(sys.argv) > 3 else 1280,
        height=int(sys.argv[4]) if len(sys.argv) > 4 else None,
        dark="dark" in sys.argv[5:],
    )
    sys.exit("\n".join(problems))
