"""Render figures as PNG with the browser that is installed, within a time limit."""

from __future__ import annotations

import asyncio
import base64
import os
import signal
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from workbench.errors import WorkbenchError

if TYPE_CHECKING:
    from choreographer import Browser, Tab

#: Seconds for the browser to start, and for each figure.
START_SECONDS, FIGURE_SECONDS = 60.0, 15.0

#: Size of an image in pixels; a figure that sets its own height keeps it.
WIDTH, HEIGHT, SCALE = 1000, 500, 2

_LOADED = """
document.readyState === "complete" ||
  new Promise((done) => addEventListener("load", () => done(true)))
"""

_PAGE = f"""<!doctype html>
<meta charset="utf-8">
<script src="%s"></script>
<script>
const renderImage = (figure) =>
  Plotly.toImage(figure, {{
    format: "png", width: {WIDTH}, height: figure.layout.height || {HEIGHT}, scale: {SCALE},
  }});
</script>
"""


def write_pngs(figures: Sequence[Path], *, jobs: int = 1, seconds: float | None = None) -> str:
    """Render figures, in a process of its own that is ended when it takes too long.

    Parameters
    ----------
    figures : sequence of Path
        Figures as JSON; the PNG is written beside each.
    jobs : int
        Number of pages of the browser that render at once.
    seconds : float, optional
        Time limit; by default one minute and 15 s for each figure.

    Returns
    -------
    str
        Empty if all went well, else why there are no images, in one sentence.
    """
    if not figures:
        return ""
    limit = START_SECONDS + FIGURE_SECONDS * len(figures) if seconds is None else seconds
    process = subprocess.Popen(  # noqa: S603 - this interpreter on our own files
        [sys.executable, "-m", "workbench.reproduction.images", str(jobs), *map(str, figures)],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        errors="replace",
        start_new_session=True,  # so that the browser ends with the process
    )
    try:
        _, complaint = process.communicate(timeout=limit)
    except subprocess.TimeoutExpired:
        _end(process)
        return f"No PNG images: the browser did not finish within {limit:g} s."
    if process.returncode == 0:
        return ""
    reason = (complaint.strip().splitlines() or [f"exit status {process.returncode}"])[-1]
    return f"No PNG images: {reason}"


def _end(process: subprocess.Popen[str]) -> None:
    if hasattr(os, "killpg"):
        os.killpg(process.pid, signal.SIGKILL)
    else:
        process.kill()
    process.communicate()


async def _render(paths: Sequence[str], n_pages: int) -> None:
    """Render figures in pages that load plotly.js once.

    What plotly offers for this, kaleido, loads it anew for each figure, which takes longer than
    to draw most of them, and a typesetter from the network, which none of them needs.
    """
    import plotly
    from choreographer import Browser

    library = Path(plotly.__file__).parent / "package_data" / "plotly.min.js"
    waiting = list(reversed(paths))

    async def render_in_turn(browser: Browser, address: str) -> None:
        page = await _open(browser, address)
        while waiting:
            path = Path(waiting.pop())
            image = await _evaluate(page, f"renderImage({path.read_text(encoding='utf-8')})")
            path.with_suffix(".png").write_bytes(base64.b64decode(image.partition(",")[2]))

    with TemporaryDirectory() as folder:
        empty = Path(folder) / "page.html"
        empty.write_text(_PAGE % library.as_uri(), encoding="utf-8")
        async with Browser(headless=True) as browser:
            await asyncio.gather(
                *(render_in_turn(browser, empty.as_uri()) for _ in paths[:n_pages])
            )


async def _open(browser: Browser, address: str) -> Tab:
    """Open a page and wait until its scripts have run."""
    page = await browser.create_tab()
    await page.send_command("Page.navigate", params={"url": address})
    await _evaluate(page, _LOADED)
    return page


async def _evaluate(page: Tab, expression: str) -> str:
    """Evaluate JavaScript in a page; give what it or its promise comes to, as text."""
    wanted = {"expression": expression, "awaitPromise": True, "returnByValue": True}
    answer = await page.send_command("Runtime.evaluate", params=wanted)
    result = answer.get("result", {})
    if "exceptionDetails" in result:
        thrown = result["exceptionDetails"].get("exception", {})
        raise WorkbenchError(str(thrown.get("description") or thrown.get("value") or thrown))
    if "error" in answer:
        raise WorkbenchError(str(answer["error"].get("message", answer["error"])))
    return str(result["result"].get("value", ""))


def _main(jobs: str, *paths: str) -> int:
    """Render the figures; 1 and one line on stderr if that is not possible."""
    try:
        asyncio.run(_render(paths, int(jobs)))
    except Exception as error:  # whatever a missing or broken browser raises
        text = str(error).strip()
        if "chrome" in type(error).__name__.lower():
            text = "no Chrome or Chromium was found on this machine"
        first = (text.splitlines() or [type(error).__name__])[0]
        print(first, file=sys.stderr)  # noqa: T201 - read by write_pngs
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(_main(*sys.argv[1:]))
