"""Steps of the hand on the authoring pad, with 31 joints and 30 markers, in Chromium."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from math import inf
from pathlib import Path
from statistics import median, quantiles

import numpy as np

from tests.benchmarks.measuring import Measurement
from tests.browser.chromium import Visit, open_browser
from workbench.datasets import load_space
from workbench.mocap.body_nodes import body_nodes
from workbench.mocap.kinematics import end_site_positions, joint_positions
from workbench.spaces import PoseSpace
from workbench.widgets.authoring import AuthoringPad
from workbench.widgets.export import export_html

MARKERS = 30
FRAMES = 1000
SCRUB, DRAG = 0.004, 0.016

_NOTE = (
    "one pixel of each canvas that is drawn on read back within the time; Chromium draws without a "
    "graphics card"
)

# Milliseconds of each step of the mouse, as events bring it: without a button or with a marker.
_STEPS = """
(drags) => {
  const { pad } = document.querySelector(".wb-pad");
  pad.model.set("editable", true);
  pad.model.set("mode", drags ? "markers" : "scrub");
  const { plot, base, top } = pad.plane;
  const canvases = drags ? [base, top, pad.pose.canvas] : [top, pad.pose.canvas];
  const box = base.getBoundingClientRect();
  const send = (type, [x, y]) => plot.dispatchEvent(new PointerEvent(type, {
    clientX: box.left + x, clientY: box.top + y, pointerId: 1, buttons: 1, bubbles: true }));
  plot.setPointerCapture = () => {}; // there is no such pointer
  const middle = pad.plane.toPixel(pad.scene.marker(12));
  send(drags ? "pointerdown" : "pointermove", middle);
  const times = [];
  for (let step = 1; step <= 240; step++) {
    const way = [middle[0] + 90 * Math.sin(step / 9), middle[1] + 70 * Math.sin(step / 5)];
    const start = performance.now();
    send("pointermove", way);
    for (const canvas of canvases) canvas.getContext("2d").getImageData(0, 0, 1, 1);
    times.push(performance.now() - start);
  }
  if (drags) pad.input.abandon();
  return times.slice(40);
}
"""


def measurements(rounds: int = 8) -> Iterator[Measurement]:
    """Time steps that look at a pose, and steps that drag a marker.

    The best of some rounds, because other work on the machine is not the pad's doing.
    """
    with tempfile.TemporaryDirectory() as folder, open_browser() as browser:
        if browser is None:
            raise SystemExit("authoring_pad: got no chromium, want one on this machine")
        page = export_html(pad(), Path(folder, "pad.html"), title="Pad")
        with Visit.to(browser) as visit:
            visit.page.goto(page.as_uri())
            visit.page.locator(".wb-pad-plot").wait_for()
            for drags, limit in ((False, SCRUB), (True, DRAG)):
                best, middle = inf, inf
                for _ in range(rounds):
                    times = [ms / 1000 for ms in visit.page.evaluate(_STEPS, drags)]
                    best = min(best, quantiles(times, n=20)[-1])
                    middle = min(middle, median(times))
                what = (
                    f"drag one of {MARKERS} markers, {FRAMES} frames follow" if drags else "scrub"
                )
                yield Measurement(
                    f"{what}, 31 joints (95th percentile of steps)",
                    f"below {1000 * limit:g} ms",
                    best,
                    "",
                    None,
                    0.0,
                    best < limit,
                    f"median {1000 * middle:.1f} ms; {_NOTE}",
                )


def pad() -> AuthoringPad:
    """Put poses of a jump around a circle, with frames that follow from them smoothly."""
    space = load_space("cmu/01_01-jump")
    assert isinstance(space, PoseSpace)
    motion, skeleton = space.motion, space.motion.skeleton
    keys = np.linspace(0, len(space) - 1, MARKERS).astype(int)
    angle = 2 * np.pi * np.arange(MARKERS) / MARKERS
    markers = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    apart = np.linspace(0, MARKERS - 1, FRAMES)[:, None] - np.arange(MARKERS)
    influence = np.exp(-(apart**2))
    influence /= influence.sum(axis=1, keepdims=True)
    embedding = influence @ markers
    nodes = body_nodes(skeleton)
    return AuthoringPad(
        parents=nodes.parents,
        sides=nodes.sides,
        head=nodes.head,
        offsets=np.concatenate([skeleton.offsets, [site.offset for site in skeleton.end_sites]]),
        joint_names=list(skeleton.names),
        frame_time=motion.frame_time,
        markers=markers,
        marker_poses=space.samples[keys].reshape(MARKERS, -1),
        marker_roots=motion.root_translation[keys],
        marker_frames=np.full(MARKERS, -1),
        influence=influence,
        embedding=embedding,
        points=embedding,
        times=motion.frame_time * np.arange(FRAMES),
        ghost=np.concatenate([joint_positions(motion), end_site_positions(motion)], axis=1),
    )
