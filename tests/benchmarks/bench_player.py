"""Frames of the motion player, with two motions of 31 joints, in Chromium."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from dataclasses import replace
from math import inf
from pathlib import Path
from statistics import median, quantiles

from tests.benchmarks.measuring import Measurement
from tests.browser.chromium import Visit, open_browser
from workbench.datasets import load_space
from workbench.schemes import TemporalScheme
from workbench.widgets.export import export_html
from workbench.widgets.player import MotionPlayer, motion_traits

_CLIP, _FRAME = "cmu/01_03-walk", 0.004

_NOTE = (
    "one pixel of each canvas read back within the time, so that drawing counts; Chromium draws "
    "without a graphics card"
)

# Milliseconds of each frame while the clip is played once, as the player's clock does it.
_PLAY = """
() => {
  const { player } = document.querySelector(".wb-player");
  const canvases = [...document.querySelectorAll(".wb-player canvas")];
  const times = [];
  for (let frame = 0; frame < 2 * player.frames; frame++) {
    const start = performance.now();
    player.show(frame % player.frames);
    for (const canvas of canvases) canvas.getContext("2d").getImageData(0, 0, 1, 1);
    times.push(performance.now() - start);
  }
  return times.slice(player.frames);
}
"""


def measurements(rounds: int = 12) -> Iterator[Measurement]:
    """Time frames side by side and over each other.

    The best of some rounds, because other work on the machine is not the player's doing.
    """
    with tempfile.TemporaryDirectory() as folder, open_browser() as browser:
        if browser is None:
            raise SystemExit("player: got no chromium, want one on this machine")
        for overlaid in (False, True):
            page = export_html(player(overlaid), Path(folder, "player.html"), title="Player")
            best, middle = inf, inf
            with Visit.to(browser) as visit:
                visit.page.goto(page.as_uri())
                visit.page.locator(".wb-player-stage").wait_for()
                for _ in range(rounds):
                    times = [ms / 1000 for ms in visit.page.evaluate(_PLAY)]
                    best = min(best, quantiles(times, n=20)[-1])
                    middle = min(middle, median(times))
            way = "over each other" if overlaid else "side by side"
            yield Measurement(
                f"a frame of two motions {way}, 31 joints (95th percentile)",
                f"below {1000 * _FRAME:g} ms",
                best,
                "",
                None,
                0.0,
                best < _FRAME,
                f"median {1000 * middle:.1f} ms; {_NOTE}",
            )


def player(overlaid: bool) -> MotionPlayer:
    """Show a walk and what its keyframes rebuild."""
    space = load_space(_CLIP)
    result = TemporalScheme("slerp", "saliency").run(space)
    rebuilt = replace(space.motion, rotations=result.reconstruction)
    return MotionPlayer(
        **motion_traits({"original": space.motion, "reconstruction": rebuilt}),
        keyframes=result.control_points,
        overlaid=overlaid,
    )
