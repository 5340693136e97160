"""A small body with markers on a plane, mounted as an authoring pad, and what a person does."""

from __future__ import annotations

from typing import Any

import numpy as np

from workbench.mocap.rotations import axis_rotation
from workbench.widgets.authoring import AuthoringPad

PAD = "document.querySelector('.wb-pad').pad"
PLOT = ".wb-pad-plot"
N_FRAMES = 41
#: Places of the four key poses, which are frames 0, 10, 20 and 40.
MARKERS = np.array([[0.0, 0.0], [10.0, 0.0], [20.0, 10.0], [40.0, 0.0]])
KEYS = [0, 10, 20, 40]


def pad(**traits: Any) -> AuthoringPad:
    """Make a pad with a body of three joints whose frames lie evenly between the markers."""
    poses = np.tile(np.eye(3), (4, 3, 1, 1))
    poses[:, 1] = axis_rotation("Z", [0.0, 30.0, 60.0, 90.0])
    influence = np.zeros((N_FRAMES, 4))
    for frame in range(N_FRAMES):
        after = int(np.searchsorted(KEYS, frame))
        if KEYS[after] == frame:
            influence[frame, after] = 1.0
            continue
        share = (frame - KEYS[after - 1]) / (KEYS[after] - KEYS[after - 1])
        influence[frame, [after - 1, after]] = 1 - share, share
    embedding = influence @ MARKERS
    ghost = np.zeros((N_FRAMES, 4, 3), dtype=np.float32)
    ghost[:, 1:] = [[0, 1, 0], [0, 2, 0], [0, 3, 0]]
    return AuthoringPad(
        **{
            "parents": [-1, 0, 1, 2],
            "sides": ["middle", "middle", "left", "left"],
            "offsets": [[0, 0, 0], [0, 1, 0], [0, 1, 0], [0, 1, 0]],
            "joint_names": ["hips", "chest", "arm"],
            "frame_time": 0.1,
            "markers": MARKERS,
            "marker_poses": poses.reshape(4, -1),
            "marker_roots": MARKERS[:, [0, 1, 1]],
            "marker_frames": KEYS,
            "marker_names": ["A", "B", "C", "D"],
            "influence": influence,
            "embedding": embedding,
            "points": embedding,
            "times": 0.1 * np.arange(N_FRAMES),
            "ghost": ghost,
            **traits,
        }
    )


def pixel(page: Any, place: Any) -> tuple[float, float]:
    """Say where a place of the plane is in the window."""
    box = page.locator(PLOT).locator("canvas").first.bounding_box()
    x, y = page.evaluate(f"{PAD}.plane.toPixel({list(map(float, place))})")
    return box["x"] + x, box["y"] + y


def place_at(page: Any, at: tuple[float, float]) -> list[float]:
    """Say which place of the plane is at a point of the window."""
    box = page.locator(PLOT).locator("canvas").first.bounding_box()
    return list(page.evaluate(f"{PAD}.plane.toPlace([{at[0] - box['x']}, {at[1] - box['y']}])"))


def drag(page: Any, start: tuple[float, float], end: tuple[float, float], steps: int = 4) -> None:
    """Drag the mouse from one point of the window to another."""
    page.mouse.move(*start)
    page.mouse.down()
    page.mouse.move(*end, steps=steps)
    page.mouse.up()


def edit(page: Any) -> dict[str, Any]:
    """Give the last edit that Python was told."""
    return dict(page.evaluate("mounted[0].model.get('edit')"))


def array(page: Any, name: str) -> np.ndarray:
    """Give an array of what the pad shows."""
    return np.array(page.evaluate(f"[...{PAD}.scene.{name}]"))


def answer(page: Any, **traits: Any) -> None:
    """Let Python answer the last edit; arrays are given as lists of doubles."""
    page.evaluate(
        """async (traits) => {
          const { model } = mounted[0];
          for (const [name, value] of Object.entries(traits)) {
            const bytes = () => new DataView(Float64Array.from(value.flat()).buffer);
            model.set(name, Array.isArray(value) ? bytes() : value);
          }
          model.set("answered", model.get("edit").number ?? 0);
          await null;
        }""",
        {
            name: value.tolist() if isinstance(value, np.ndarray) else value
            for name, value in traits.items()
        },
    )


def shown_angle(page: Any) -> float:
    """Degrees about z by which the middle joint of the shown pose is turned."""
    turned = page.evaluate(f"[...{PAD}.scene.poseAt({PAD}.place).rotations]")
    return float(np.degrees(np.arctan2(turned[9 + 3], turned[9])))


def play_for(page: Any, seconds: float) -> None:
    """Let time pass on the pad's own clock, in pictures of 20 ms."""
    page.evaluate(
        f"""(seconds) => {{
          const pad = {PAD};
          pad.play(true);
          for (let ms = 0; ms <= Math.round(seconds * 1000) && pad.playing; ms += 20) {{
            cancelAnimationFrame(pad.request);
            pad.tick(1e6 + ms);
          }}
          cancelAnimationFrame(pad.request);
        }}""",
        seconds,
    )
