"""Render figures as PNG with the browser that is installed, within a time limit."""

from __future__ import annotations

import asyncio
import base64
import json
import os
import signal
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from workbench.errors import WorkbenchError
from workbench.files import write_atomically

if TYPE_CHECKING:
    from choreographer import Browser, Tab

#: Seconds for the browser or a page of it to start, and for each figure.
START_SECONDS, FIGURE_SECONDS = 60.0, 15.0

#: Size of an image in pixels; a figure that sets its own height keeps it.
WIDTH, HEIGHT, SCALE = 1000, 500, 2

#: So many figures take longer to render than another page takes to load plotly.js, and more
#: pages than the most take memory that other programs may need.
_WORTH_A_PAGE, _MOST_PAGES = 12, 8

_LOADED = """
new Promise((done) => {
  const tell = () => done(typeof Plotly === "object" ? "loaded" : "");
  if (document.readyState === "complete") tell();
  else addEventListener("load", tell);
})
"""

_PAGE = f"""<!doctype html>
<meta charset="utf-8">
<script src="%s"></script>
<script>
const renderImage = (figure) =>
  Plotly.toImage(figure, {{
    format: "png", width: {WIDTH}, height: figure.layout?.height || {HEIGHT}, scale: {SCALE},
  }});
</script>
"""


def write_pngs(figures: Sequence[Path], *, jobs: int = 1, seconds: float | None = None) -> str:
    """Render figures, in a process of its own that is ended when it takes too long.

    A figure that cannot be rendered does not keep the others from it.

    Parameters
    ----------
    figures : sequence of Path
        Figures as JSON; the PNG is written beside each, in place of an earlier one.
    jobs : int
        Number of pages of the browser that may render at once.
    seconds : float, optional
        Time limit; by default one minute and 15 s for each figure.

    Returns
    -------
    str
        Empty if all went well, else which images there are not and why, in one sentence.
    """
    if not figures:
        return ""
    limit = START_SECONDS + FIGURE_SECONDS * len(figures) if seconds is None else seconds
    n_pages = max(1, min(jobs, len(figures) // _WORTH_A_PAGE, _MOST_PAGES))
    images = [figure.with_suffix(".png") for figure in figures]
    for image in images:
        image.unlink(missing_ok=True)
    process = subprocess.Popen(  # noqa: S603 - this interpreter on our own files
        [sys.executable, "-m", "workbench.reproduction.images", str(n_pages), *map(str, figures)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        errors="replace",
        start_new_session=True,  # the browser, in another session, ends when its pipe closes
    )
    try:
        answer, complaint = process.communicate(timeout=limit)
    except subprocess.TimeoutExpired:
        _end(process)
        reason = f"the browser did not finish within {limit:g} s."
    else:
        if process.returncode == 0:
            reason = "".join(json.loads(answer)[:1])
        else:
            lines = complaint.strip().splitlines()
            reason = lines[-1] if lines else f"exit status {process.returncode}"
    n_missing = sum(not image.exists() for image in images)
    if not n_missing:
        return ""
    if n_missing == len(images):
        return f"No PNG images: {reason}"
    return f"{n_missing} of {len(images)} PNG images are missing: {reason}"


def _end(process: subprocess.Popen[str]) -> None:
    if hasattr(os, "killpg"):
        os.killpg(process.pid, signal.SIGKILL)
    else:
        process.kill()
    process.communicate()


async def _render(paths: Sequence[str], n_pages: int) -> list[str]:
    """Render figures in pages that load plotly.js once; give what could not be rendered, and why.

    What plotly offers for this, kaleido, loads it anew for each figure, which takes longer than
    to draw most of them, and a typesetter from the network, which none of them needs.
    """
    import plotly
    from choreographer import Browser
    from choreographer.utils import TmpDirectory

    library = Path(plotly.__file__).parent / "package_data" / "plotly.min.js"
    waiting = [Path(path) for path in reversed(paths)]
    complaints = []

    async def render_in_turn(browser: Browser, address: str) -> None:
        page: Tab | None = None
        while waiting:
            path = waiting.pop()
            try:
                if page is None:
                    page = await asyncio.wait_for(_open(browser, address), START_SECONDS)
                image = await asyncio.wait_for(_image(page, path), FIGURE_SECONDS)
                write_atomically(path.with_suffix(".png"), image)
            except (WorkbenchError, OSError, ValueError) as error:
                complaints.append(f"{path.stem}: {_reason(error)}")
                page = None

    async with Browser(headless=True) as browser:
        # Some browsers may not read the system's folder of temporary files.
        folder = TmpDirectory(sneak=browser.is_isolated())
        try:
            empty = Path(folder.path) / "page.html"
            empty.write_text(_PAGE % library.as_uri(), encoding="utf-8")
            address = empty.as_uri()
            await asyncio.gather(*(render_in_turn(browser, address) for _ in range(n_pages)))
        finally:
            folder.clean()
    return complaints


async def _open(browser: Browser, address: str) -> Tab:
    """Open a page and wait until its scripts have run."""
    page = await browser.create_tab()
    answer = await page.send_command("Page.navigate", params={"url": address})
    failed = answer.get("result", {}).get("errorText")
    if failed:
        raise WorkbenchError(f"the browser cannot open a file of this user ({failed})")
    if not await _evaluate(page, _LOADED):
        raise WorkbenchError("the browser cannot read plotly.js")
    return page


async def _image(page: Tab, figure: Path) -> bytes:
    described = figure.read_text(encoding="utf-8")
    image = await _evaluate(page, f"renderImage({described})")
    content = base64.b64decode(image.partition(",")[2])
    if not content:
        raise WorkbenchError("plotly.js gave no image")
    return content


async def _evaluate(page: Tab, expression: str) -> str:
    """Evaluate JavaScript in a page; give what it or its promise comes to, as text."""
    wanted = {"expression": expression, "awaitPromise": True, "returnByValue": True}
    answer = await page.send_command("Runtime.evaluate", params=wanted)
    result = answer.get("result", {})
    if "exceptionDetails" in result:
        details = result["exceptionDetails"]
        thrown = details.get("exception", {})
        raise WorkbenchError(
            str(thrown.get("description") or thrown.get("value") or details.get("text"))
        )
    if "error" in answer:
        raise WorkbenchError(str(answer["error"].get("message", answer["error"])))
    return str(result["result"].get("value", ""))


def _reason(error: BaseException) -> str:
    """Say in a line what kept figures from being rendered."""
    name = type(error).__name__
    if name == "ChromeNotFoundError":
        return "no Chrome or Chromium was found on this machine"
    # Whoever waits for an answer when the browser ends is cancelled.
    if name in ("CancelledError", "ChannelClosedError", "BrowserClosedError"):
        return "the browser ended by itself"
    if isinstance(error, TimeoutError):
        return "the browser gave no answer in time"
    lines = str(error.args[0]).strip().splitlines() if error.args else []
    return lines[0] if lines else name


def _main(n_pages: str, *paths: str) -> int:
    """Print complaints as JSON; or end with 1 and a line on stderr if nothing can be rendered."""
    try:
        complaints = asyncio.run(_render(paths, int(n_pages)))
    except (Exception, asyncio.CancelledError) as error:  # whatever a missing browser raises
        print(_reason(error), file=sys.stderr)  # noqa: T201 - read by write_pngs
        return 1
    print(json.dumps(complaints))  # noqa: T201 - read by write_pngs
    return 0


if __name__ == "__main__":
    sys.exit(_main(*sys.argv[1:]))
