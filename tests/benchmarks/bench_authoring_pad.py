"""Steps of the hand on the authoring pad, with 31 joints and 30 markers, in Chromium."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
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

# Milliseconds of each step of the mouse, as events bring it.
_STEPS = """
(what) => {
  const { pad } = document.querySelector(".wb-pad");
  pad.model.set("editable", true);
  pad.model.set("mode", what === "drag" ? "markers" : "scrub");
  const { plot, base, top } = pad.plane;
  const { bar, curve } = pad.clock;
  const canvases = {
    look: [top, pad.pose.canvas],
    time: [top, pad.pose.canvas, bar.canvas, curve.canvas],
    drag: [base, top, pad.pose.canvas],
  }[what];
  const target = what === "time" ? bar.canvas : plot;
  const box = target.getBoundingClientRect();
  const send = (type, [x, y]) => target.dispatchEvent(new PointerEvent(type, {
    clientX: box.left + x, clientY: box.top + y, pointerId: 1, buttons: 1, bubbles: true }));
  target.setPointerCapture = () => {}; // there is no such pointer
  const middle = what === "time"
    ? [box.width / 2, box.height / 2]
    : pad.plane.toPixel(pad.scene.marker(12));
  if (what !== "look") send("pointerdown", middle);
  const times = [];
  for (let step = 1; step <= 240; step++) {
    const way = what === "time"
      ? [box.width * (0.5 + 0.45 * Math.sin(step / 9)), middle[1]]
      : [middle[0] + 90 * Math.sin(step / 9), middle[1] + 70 * Math.sin(step / 5)];
    const start = performance.now();
    send("pointermove", way);
    for (const canvas of canvases) canvas.getContext("2d").getImageData(0, 0, 1, 1);
    times.push(performance.now() - start);
  }
  if (what === "time" && !pad.scene.rootAt(pad.time)) throw new Error("roots are not used");
  if (what === "time") send("pointerup", middle);
  if (what === "drag") pad.input.abandon();
  return times.slice(40);
}
"""

_WHAT = {
    "look": ("look at a pose", SCRUB),
    "time": ("scrub through time, feet kept", SCRUB),
    "drag": (f"drag one of {MARKERS} markers, {FRAMES} frames follow", DRAG),
}


def measurements(rounds: int = 9) -> Iterator[Measurement]:
    """Time steps that look at a pose, that scrub through time, and that drag a marker.

    The median of what rounds give: one round may meet other work on the machine.
    """
    with tempfile.TemporaryDirectory() as folder, open_browser() as browser:
        if browser is None:
            raise SystemExit("authoring_pad: got no chromium, want one on this machine")
        page = export_html(pad(), Path(folder, "pad.html"), title="Pad")
        with Visit.to(browser) as visit:
            visit.page.goto(page.as_uri())
            visit.page.locator(".wb-pad-plot").wait_for()
            for what, (words, limit) in _WHAT.items():
                late, usual = [], []
                for _ in range(rounds):
                    times = [ms / 1000 for ms in visit.page.evaluate(_STEPS, what)]
                    late.append(quantiles(times, n=20)[-1])
                    usual.append(median(times))
                yield Measurement(
                    f"{words}, 31 joints (95th percentile of steps)",
                    f"below {1000 * limit:g} ms",
                    median(late),
                    "",
                    None,
                    0.0,
                    median(late) < limit,
                    f"median of {rounds} rounds, from {1000 * min(late):.1f} to "
                    f"{1000 * max(late):.1f} ms; half of the steps below "
                    f"{1000 * median(usual):.1f} ms; {_NOTE}",
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
        roots=motion.root_translation[np.arange(FRAMES) % len(space)],
        ghost=np.concatenate([joint_positions(motion), end_site_positions(motion)], axis=1),
    )
