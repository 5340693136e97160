"""Take pictures of a reproduction report: python screenshot_report.py OUT PNG [WIDTH] [dark]."""

from __future__ import annotations

import sys
from pathlib import Path

CHROMIUM = "/usr/bin/chromium"
FLAGS = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]
LOCAL = ("file:", "data:", "blob:")


def screenshot_report(
    out: Path,
    picture: Path,
    *,
    width: int = 1280,
    height: int | None = None,
    dark: bool = False,
) -> list[str]:
    """Open ``index.html`` of an output folder from ``file://`` and take a picture of it.

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
        Errors on the console and requests that left the folder: empty for a good page.
    """
    from playwright.sync_api import sync_playwright

    complaints: list[str] = []
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        page = browser.new_page(
            viewport={"width": width, "height": height or 1000},
            color_scheme="dark" if dark else "light",
        )
        page.on("console", lambda m: complaints.append(m.text) if m.type == "error" else None)
        page.on("pageerror", lambda error: complaints.append(str(error)))
        page.on(
            "request",
            lambda r: None if r.url.startswith(LOCAL) else complaints.append(r.url),
        )
        page.goto((out / "index.html").resolve().as_uri())
        for plot in page.locator(".plot").all():
            plot.scroll_into_view_if_needed()
            plot.locator(".main-svg").first.wait_for(timeout=30_000)
        page.evaluate("window.scrollTo(0, 0)")
        page.screenshot(path=str(picture), full_page=height is None)
        browser.close()
    return complaints


if __name__ == "__main__":
    found = screenshot_report(
        Path(sys.argv[1]),
        Path(sys.argv[2]),
        width=int(sys.argv[3]) if len(sys.argv) > 3 else 1280,
        dark="dark" in sys.argv[4:],
    )
    sys.exit("\n".join(found))
