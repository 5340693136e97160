"""Render figures as PNG with the browser that is installed, within a time limit."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

#: Seconds for the browser to start, and for each figure.
START_SECONDS, FIGURE_SECONDS = 60.0, 15.0

#: Size of an image in pixels; a figure that sets its own height keeps it.
WIDTH, HEIGHT, SCALE = 1000, 500, 2


def write_pngs(figures: Sequence[Path], *, seconds: float | None = None) -> str:
    """Render figures, in a process of its own that is ended when it takes too long.

    Parameters
    ----------
    figures : sequence of Path
        Figures as JSON; the PNG is written beside each.
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
        [sys.executable, "-m", "workbench.reproduction.images", *map(str, figures)],
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


def _render(paths: Sequence[str]) -> int:
    """Render the figures; 1 and one line on stderr if that is not possible."""
    import plotly.io

    figures = [plotly.io.from_json(Path(path).read_text(encoding="utf-8")) for path in paths]
    images = [str(Path(path).with_suffix(".png")) for path in paths]
    heights = [figure.layout.height or HEIGHT for figure in figures]
    try:
        plotly.io.write_images(figures, images, width=WIDTH, height=heights, scale=SCALE)
    except Exception as error:  # whatever a missing or broken browser raises
        text = str(error).strip()
        if "chrome" in type(error).__name__.lower() or "kaleido requires" in text.lower():
            text = "no Chrome or Chromium was found on this machine"
        first = (text.splitlines() or [type(error).__name__])[0]
        print(first, file=sys.stderr)  # noqa: T201 - read by write_pngs
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(_render(sys.argv[1:]))
