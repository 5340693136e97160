"""Stick figures in the browser: readable when small, the same look as in Python."""

from __future__ import annotations

import json
import re
from typing import Any

import numpy as np
import pytest

from tests.browser.chromium import Visit
from workbench.datasets import load_space
from workbench.figures import stick_look
from workbench.mocap.body_nodes import body_nodes, node_positions
from workbench.widgets.module import es_module

PARTS = es_module("stick_figure", "orbit")
JUMP = load_space("cmu/01_01-jump").motion
BODY = body_nodes(JUMP.skeleton)
POSITIONS = node_positions(JUMP)
PAPERS = {"light": "#ffffff", "dark": "#111111"}

_LOAD = """
async ({module, body}) => {
  const text = `${module}\\nexport { StickFigures, stickColours, sideKey, orbitByKey };`;
  const address = URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
  Object.assign(window, await import(address), { body });
}
"""
# Draws one pose on its paper; gives, for each bone, the pixels along it and across its middle.
_DRAW = """
({positions, tall, theme, paper, ratio}) => {
  const figures = new StickFigures(body);
  figures.measure([positions]);
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [tall * ratio, tall * ratio];
  const context = canvas.getContext("2d");
  context.scale(ratio, ratio);
  context.fillStyle = paper;
  context.fillRect(0, 0, tall, tall);
  const colours = stickColours({ name: theme, ground: paper });
  figures.draw(context, [positions], tall, tall, colours);
  const see = figures.camera(positions, tall / 2, tall, tall);
  const at = (node) => see(...positions.slice(3 * node, 3 * node + 3)).map((v) => v * ratio);
  const { data, width } = context.getImageData(0, 0, canvas.width, canvas.height);
  const pixel = (x, y) => {
    const first = 4 * (Math.floor(y) * width + Math.floor(x));
    return [...data.slice(first, first + 3)];
  };
  const bones = body.parents.map((parent, node) => {
    if (parent < 0 || node === body.head) return null;
    const [from, to] = [at(parent), at(node)];
    const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
    if (length < 4 * ratio) return null;
    const across = [-(to[1] - from[1]) / length, (to[0] - from[0]) / length];
    const row = (part) => Array.from({ length: 9 }, (_, i) => [0, 1].map((axis) =>
      from[axis] + part * (to[axis] - from[axis]) + ((i - 4) / 2) * ratio * across[axis]));
    const steps = Array.from({ length: 21 }, (_, i) => 0.1 + (0.8 * i) / 20);
    const rows = steps.map((part) => row(part).map(([x, y]) => pixel(x, y)));
    return { side: body.sides[node], rows };
  }).filter(Boolean);
  const head = at(body.head).map((v, axis) => (v + at(body.parents[body.head])[axis]) / 2);
  return { bones, head: pixel(...head), rim: pixel(1, 1), width: figures.limbWidth(see) };
}
"""


@pytest.fixture
def drawing(visit: Visit) -> Any:
    """Load the module, with a body, into a page."""
    body = {"parents": BODY.parents, "sides": BODY.sides, "head": BODY.head}
    visit.page.evaluate(_LOAD, {"module": PARTS, "body": body})

    def draw(theme: str, tall: int, *, frame: int = 150, ratio: int = 1) -> dict[str, Any]:
        return visit.page.evaluate(
            _DRAW,
            {
                "positions": POSITIONS[frame].ravel().tolist(),
                "tall": tall,
                "theme": theme,
                "paper": PAPERS[theme],
                "ratio": ratio,
            },
        )

    draw.page = visit.page  # type: ignore[attr-defined]  # for those who need no drawing
    return draw


def luminance(pixels: Any) -> np.ndarray:
    """Compute relative luminance as WCAG defines it, of colours along the last axis."""
    parts = np.asarray(pixels, dtype=float) / 255
    linear = np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4)
    return np.asarray(linear @ [0.2126, 0.7152, 0.0722])


def contrast(pixels: Any, paper: Any) -> np.ndarray:
    """Compute the contrast of colours with their paper, 1 to 21."""
    one, other = luminance(pixels) + 0.05, luminance(paper) + 0.05
    return np.maximum(one, other) / np.minimum(one, other)


def test_python_and_browser_have_one_look() -> None:
    """Numbers and colours of both are the same."""
    text = re.search(r"const STICK_LOOK = (\{.*?\n\});", PARTS, re.DOTALL)
    assert text is not None
    look = json.loads(text[1])
    colors = {
        theme: {name: color.lower() for name, color in named.items()}
        for theme, named in stick_look.COLORS.items()
    }
    assert look == {
        "head_radius": stick_look.HEAD_RADIUS,
        "limb_width": stick_look.LIMB_WIDTH,
        "trunk": stick_look.TRUNK,
        "least_width": stick_look.LEAST_WIDTH,
        "open_from": stick_look.OPEN_FROM,
        "open_share": stick_look.OPEN_SHARE,
        "dash": list(stick_look.DASH),
        "colors": colors,
    }


@pytest.mark.browser
@pytest.mark.parametrize("theme", PAPERS)
@pytest.mark.parametrize("frame", [0, 150, 250])
def test_a_small_figure_can_be_read(drawing: Any, theme: str, frame: int) -> None:
    """In a picture 44 pixels high bones stand out by 3 to 1, right ones between gaps."""
    drawn = drawing(theme, 44, frame=frame)
    assert drawn["width"] >= 1.0
    assert len(drawn["bones"]) >= 6
    assert contrast(drawn["head"], drawn["rim"]) > 10
    for bone in drawn["bones"]:
        seen = contrast(bone["rows"], drawn["rim"]).max(axis=1) >= 3.0
        # Dashes leave gaps; a solid limb may be under another that is no less visible.
        assert seen.mean() >= (0.5 if bone["side"] == "right" else 0.95), bone["side"]


@pytest.mark.browser
@pytest.mark.parametrize("theme", PAPERS)
def test_right_limbs_are_open_where_they_are_wide(drawing: Any, theme: str) -> None:
    """Across most of a right limb there are two lines with paper between; left ones are solid."""
    drawn = drawing(theme, 400, ratio=2, frame=0)
    opened = {"left": [], "right": []}
    for bone in drawn["bones"]:
        if bone["side"] in opened:
            seen = contrast(bone["rows"], drawn["rim"])
            opened[bone["side"]].append(np.mean(seen[:, 4] < 1.6))
    assert np.median(opened["right"]) > 0.8
    assert max(opened["left"]) < 0.5


@pytest.mark.browser
def test_feet_stand_on_the_ground(drawing: Any) -> None:
    """The lowest node of a clip is on the ground's plane, whatever the view."""
    below = drawing.page.evaluate(
        """(frames) => {
          const figures = new StickFigures(body);
          figures.measure(frames);
          const gaps = [];
          for (const [turn, tilt, zoom] of [[0, 0, 1], [2, 0.7, 2], [-1, 1.3, 0.6]]) {
            Object.assign(figures, { turn, tilt, zoom });
            const least = Math.min(...frames.map((p) => {
              const see = figures.camera(p, 100, 200, 200);
              return Math.min(...body.parents.map((_, i) => {
                const [x, y, z] = p.slice(3 * i, 3 * i + 3);
                return see(x, figures.floor, z)[1] - see(x, y, z)[1];
              }));
            }));
            gaps.push(least);
          }
          return gaps;
        }""",
        POSITIONS[::10].reshape(-1, POSITIONS[0].size).tolist(),
    )
    np.testing.assert_allclose(below, 0.0, atol=1e-9)


@pytest.mark.browser
def test_zooming_keeps_the_middle_and_stays_within_limits(drawing: Any) -> None:
    """Twice as near is twice as large; a thousand wheel steps lose nothing."""
    answer = drawing.page.evaluate(
        """(p) => {
          const figures = new StickFigures(body);
          figures.measure([p]);
          const size = () => figures.camera(p, 100, 200, 200).scale;
          const before = size();
          figures.zoomBy(2);
          const twice = size() / before;
          for (let i = 0; i < 1000; i++) figures.zoomBy(1.2);
          const most = size() / before;
          for (let i = 0; i < 1000; i++) figures.zoomBy(1 / 1.2);
          const least = size() / before;
          figures.turnBy(1, 1);
          figures.resetView();
          return [twice, most, least, size() / before, figures.turn];
        }""",
        POSITIONS[0].ravel().tolist(),
    )
    np.testing.assert_allclose(answer, [2, 5, 0.6, 1, 0.6])


@pytest.mark.browser
def test_a_body_without_head_sides_or_colours_is_drawn(drawing: Any) -> None:
    """What is not known is left out; nothing else is needed."""
    count = drawing.page.evaluate(
        """() => {
          const figures = new StickFigures({ parents: [-1, 0, 1], sides: [] });
          const p = [0, 0, 0, 0, 1, 0, 0.5, 2, 0];
          figures.measure([p]);
          const context = document.createElement("canvas").getContext("2d");
          figures.draw(context, [p, []], 300, 150, { left: "red", right: "red", middle: "blue" });
          const { data } = context.getImageData(0, 0, 300, 150);
          let [blue, other] = [0, 0];
          for (let i = 0; i < data.length; i += 4) {
            if (data[i + 2] > 200 && data[i] < 50 && data[i + 3] === 255) blue += 1;
            if (data[i] > 200 && data[i + 2] < 50) other += 1;
          }
          return [blue, other];
        }"""
    )
    assert count[0] > 100
    assert count[1] == 0
