"""Poses that follow the mouse: back-projection, kinematics and drawing in the browser.

The time of each frame includes a read-back of a pixel, which makes the browser finish drawing.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from tests.benchmarks.measuring import Measurement
from tests.browser.chromium import Visit, open_browser
from workbench.backprojection.poses import SpatialKeyframes
from workbench.datasets import load_space
from workbench.mocap.sides import joint_sides
from workbench.spaces import PoseSpace
from workbench.widgets.module import es_module
from workbench.widgets.radial import radial_function

MARKERS = 30
FRAMES = 600
LIMIT = 0.004

_RUN = """
async ([text, given]) => {
  const names = "RadialFunction, nearestRotations, Kinematics, StickFigures";
  const source = `${text}\\nexport { ${names} };`;
  const address = URL.createObjectURL(new Blob([source], {type: "text/javascript"}));
  const parts = await import(address);
  const radial = new parts.RadialFunction({ ...given.radial,
    centers: Float64Array.from(given.radial.centers),
    coefficients: Float64Array.from(given.radial.coefficients) });
  const body = new parts.Kinematics(given.body);
  const figures = new parts.StickFigures(given.body);
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [400, 320];
  document.body.append(canvas);
  const context = canvas.getContext("2d");
  const colours = { left: "#0072b2", right: "#d55e00", middle: "#1a1a1a" };
  const frame = ([x, y], drawn) => {
    const start = performance.now();
    const pose = body.place(parts.nearestRotations(radial.at([x, y])), [0, 20, 0]);
    if (drawn) {
      context.clearRect(0, 0, 400, 320);
      figures.draw(context, [pose], 400, 320, colours);
      context.getImageData(200, 160, 1, 1);
    }
    return performance.now() - start;
  };
  figures.measure([body.place(parts.nearestRotations(radial.at([0.5, 0.5])), [0, 20, 0])]);
  return [true, false].map((drawn) => given.places.map((place) => frame(place, drawn)));
}
"""


def _given() -> dict[str, Any]:
    space = load_space("cmu/01_01-jump")
    assert isinstance(space, PoseSpace)
    rng = np.random.default_rng(0)
    keys = np.linspace(0, len(space) - 1, MARKERS).astype(int)
    radial = radial_function(SpatialKeyframes().fit(rng.random((MARKERS, 2)), space.samples[keys]))
    assert radial is not None
    skeleton = space.motion.skeleton
    ends = skeleton.end_sites
    names = [*skeleton.names, *(skeleton.names[site.joint] for site in ends)]
    offsets = np.concatenate([skeleton.offsets, [site.offset for site in ends]])
    return {
        "radial": {
            "kernel": radial.kernel,
            "epsilon": radial.epsilon,
            "centers": radial.centers.ravel().tolist(),
            "coefficients": radial.coefficients.ravel().tolist(),
        },
        "body": {
            "parents": [*skeleton.parents.tolist(), *(site.joint for site in ends)],
            "offsets": offsets.ravel().tolist(),
            "joints": skeleton.n_joints,
            "sides": joint_sides(names),
        },
        "places": rng.random((FRAMES, 2)).tolist(),
    }


def measurements() -> Iterator[Measurement]:
    """Measure the 95th percentile of frames of one figure."""
    text = es_module("back_projection", "kinematics", "stick_figure")
    with open_browser() as browser:
        if browser is None:
            return
        with Visit.to(browser) as visit:
            drawn, computed = visit.page.evaluate(_RUN, [text, _given()])
    for name, times in (("compute and draw", drawn), ("compute only", computed)):
        late = float(np.percentile(times, 95)) / 1000
        yield Measurement(
            f"{name} a pose of 31 joints from {MARKERS} markers, p95 of {FRAMES} frames",
            f"below {1000 * LIMIT:g} ms",
            late,
            "",
            None,
            0.0,
            late < LIMIT,
            f"median {np.median(times):.2f} ms, with a forced read-back where drawn",
        )
