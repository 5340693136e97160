"""The motion player keeps motions in step, and obeys mouse and keyboard without a kernel."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from tests.browser.chromium import Visit
from workbench.widgets.player import MotionPlayer

pytestmark = pytest.mark.browser

_PLAYER = "document.querySelector('.wb-player').player"
_PICTURE = "document.querySelector('.wb-player-stage').toDataURL()"
# Where blue limbs are drawn in each half of the stage, from that half's left.
_BLUE = """
() => {
  const canvas = document.querySelector(".wb-player-stage");
  const { data, width } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  const halves = [[], []];
  for (let i = 0; i < data.length; i += 4) {
    if (data[i + 3] < 255 || data[i + 2] < Math.max(data[i], data[i + 1]) + 60) continue;
    const [x, y] = [(i / 4) % width, Math.floor(i / 4 / width)];
    halves[x < width / 2 ? 0 : 1].push([x % (width / 2), y]);
  }
  const mean = (points, c) => points.reduce((sum, p) => sum + p[c], 0) / points.length;
  return halves.map((points) => ({ count: points.length, x: mean(points, 0), y: mean(points, 1) }));
}
"""


def waving(n_frames: int = 30, **traits: Any) -> MotionPlayer:
    """Make two equal motions of a body whose left arm, at positive x, rises."""
    positions = np.zeros((2, n_frames, 4, 3))
    rise = np.linspace(0, 2, n_frames)
    positions[:, :, 1] = [0, 2, 0]
    positions[:, :, 2] = np.stack([np.full(n_frames, 1.5), rise, 0 * rise], axis=1)
    positions[:, :, 3] = [-1, 1, 0]
    return MotionPlayer(
        **{
            "motions": ["A", "B"],
            "positions": positions,
            "parents": [-1, 0, 1, 1],
            "sides": ["middle", "middle", "left", "right"],
            "frame_time": 0.1,
            "keyframes": [0, 12, 29],
            **traits,
        }
    )


def frame(page: Any) -> int:
    return page.evaluate(f"{_PLAYER}.frame")


def play_for(page: Any, seconds: float) -> None:
    """Let time pass on the player's own clock, in pictures of 20 ms."""
    page.evaluate(
        f"""(seconds) => {{
          const player = {_PLAYER};
          player.play(true);
          for (let ms = 0; ms <= Math.round(seconds * 1000) && player.playing; ms += 20) {{
            cancelAnimationFrame(player.request);
            player.tick(1e6 + ms);
          }}
          cancelAnimationFrame(player.request);
        }}""",
        seconds,
    )


def test_equal_motions_are_drawn_equally_at_every_frame(mount: Callable) -> None:
    """Both halves of the stage show the same pose, and it changes with the frame."""
    page = mount(waving(), width=600)
    heights = []
    for place in (0, 15, 29):
        page.evaluate(f"{_PLAYER}.seek({place})")
        left, right = page.evaluate(_BLUE)
        assert left["count"] > 50
        assert left["x"] == pytest.approx(right["x"], abs=1.5)
        assert left["y"] == pytest.approx(right["y"], abs=1.5)
        heights.append(left["y"])
    assert heights[0] > heights[1] > heights[2]


@pytest.mark.parametrize(
    ("speed", "expected"), [(0.25, 2), (0.5, 5), (1.0, 10), (2.0, 20)], ids=str
)
def test_the_frame_follows_the_clock_and_the_speed(
    mount: Callable, speed: float, expected: int
) -> None:
    """After one second of 10 frames a second, at each speed, the frame is the clock's."""
    page = mount(waving(speed=speed))
    play_for(page, 1.02)
    assert frame(page) == expected


def test_a_loop_starts_again_and_its_end_is_counted(mount: Callable) -> None:
    """Three seconds of motion and half of one more end once and go on."""
    page = mount(waving())
    play_for(page, 3.52)
    assert frame(page) == 5
    assert page.evaluate("mounted[0].model.get('ends')") == 1
    assert page.evaluate(f"{_PLAYER}.playing")


def test_without_loop_it_stays_at_the_end_and_can_be_played_again(mount: Callable) -> None:
    """The last frame stays, Python knows it, and playing again starts at the first."""
    page = mount(waving(loop=False))
    play_for(page, 9)
    assert frame(page) == 29
    assert page.evaluate("mounted[0].model.get('frame')") == 29
    assert not page.evaluate(f"{_PLAYER}.playing")
    play_for(page, 0.22)
    assert frame(page) == 2


def test_playing_asks_nothing_of_the_kernel(mount: Callable) -> None:
    """Nothing is saved while it plays; pausing sends the frame once."""
    page = mount(waving())
    play_for(page, 1.02)
    assert page.evaluate("mounted[0].model.saved") == 0
    page.evaluate(f"{_PLAYER}.play(false)")
    assert page.evaluate("[mounted[0].model.saved, mounted[0].model.get('frame')]") == [1, 10]


@pytest.mark.parametrize("place", [".wb-player-stage", ".wb-player-bar"], ids=["stage", "bar"])
def test_keys_move_in_time(mount: Callable, place: str) -> None:
    """Arrows step, Home and End go to the ends, Page keys to keyframes; Python knows where."""
    page = mount(waving(frame=10))
    page.locator(place).focus()
    steps = {
        "ArrowRight": 11,
        "ArrowLeft": 10,
        "PageDown": 12,
        "ArrowUp": 22,
        "ArrowDown": 12,
        "PageUp": 0,
        "End": 29,
        "Home": 0,
    }
    for key, expected in steps.items():
        page.keyboard.press(key)
        assert (key, frame(page)) == (key, expected)
        assert page.evaluate("mounted[0].model.get('frame')") == expected
    page.keyboard.press("ArrowLeft")
    assert frame(page) == 0


def test_space_plays_and_pauses_once(mount: Callable) -> None:
    """On the stage it toggles; on a button it presses that button and nothing else."""
    page = mount(waving())
    page.locator(".wb-player-stage").focus()
    page.keyboard.press(" ")
    assert page.evaluate(f"{_PLAYER}.playing")
    page.get_by_role("button", name="Pause").focus()
    page.keyboard.press(" ")
    assert not page.evaluate(f"{_PLAYER}.playing")


@pytest.mark.parametrize("way", ["mouse", "keyboard"])
def test_the_view_turns_and_zooms(mount: Callable, way: str) -> None:
    """Dragging and wheel, or Shift with arrows and +, show other pictures of the same frame."""
    page = mount(waving())
    stage = page.locator(".wb-player-stage")
    stage.focus()
    pictures = [page.evaluate(_PICTURE)]
    if way == "mouse":
        stage.hover(position={"x": 200, "y": 100})
        page.mouse.down()
        page.mouse.move(300, 130)
        page.mouse.up()
        pictures.append(page.evaluate(_PICTURE))
        page.evaluate(
            "document.querySelector('.wb-player-stage').dispatchEvent("
            "new WheelEvent('wheel', { deltaY: -200, cancelable: true }))"
        )
    else:
        page.keyboard.press("Shift+ArrowLeft")
        pictures.append(page.evaluate(_PICTURE))
        page.keyboard.press("+")
    pictures.append(page.evaluate(_PICTURE))
    assert len(set(pictures)) == 3
    assert frame(page) == 0
    page.get_by_role("button", name="Reset view").click()
    assert page.evaluate(_PICTURE) == pictures[0]


def test_dragging_on_the_bar_scrubs(mount: Callable) -> None:
    """The frame follows the mouse, and is told to Python when the button is let go."""
    page = mount(waving())
    box = page.locator(".wb-player-bar").bounding_box()
    page.mouse.move(box["x"] + box["width"] / 4, box["y"] + 10)
    page.mouse.down()
    page.mouse.move(box["x"] + box["width"] - 10, box["y"] + 10)
    assert frame(page) == 29
    assert page.evaluate("mounted[0].model.saved") == 0
    page.mouse.up()
    assert page.evaluate("mounted[0].model.get('frame')") == 29


def test_views_of_one_channel_show_the_same_frame(mount: Callable) -> None:
    """A frame that is announced elsewhere is shown, one of another channel is not."""
    mount(waving(channel="one"))
    page = mount(waving(channel="one"))
    page.evaluate("document.querySelectorAll('.wb-player')[1].player.seek(7)")
    assert frame(page) == 7
    page.evaluate(
        "document.dispatchEvent(new CustomEvent('workbench-hover', "
        "{detail: {channel: 'two', sample: 3}}))"
    )
    assert frame(page) == 7


def test_overlaid_motions_share_one_place(mount: Callable) -> None:
    """One figure stands in the middle, and the first is called the faint one."""
    page = mount(waving(), width=600)
    page.get_by_role("button", name="Draw the motions over each other").click()
    assert page.locator(".wb-player-names span").all_inner_texts() == ["A (faint)", "B"]
    assert page.evaluate("mounted[0].model.get('overlaid')")
    assert sum(half["count"] for half in page.evaluate(_BLUE)) > 50


def test_the_bar_is_a_slider_that_says_where_it_is(mount: Callable) -> None:
    """A screen reader gets the frame, the time, and that it is a keyframe."""
    page = mount(waving(frame=12))
    bar = page.get_by_role("slider", name="Time")
    assert bar.get_attribute("aria-valuetext") == "frame 12 of 30 · 1.20 s · keyframe"
    assert bar.get_attribute("aria-valuemax") == "29"


@pytest.mark.parametrize("motion", ["no-preference", "reduce"])
def test_it_starts_by_itself_only_if_that_is_wanted(
    mount: Callable, visit: Visit, motion: str
) -> None:
    """Autoplay gives way to a person's wish for reduced motion."""
    visit.page.emulate_media(reduced_motion=motion)
    page = mount(waving(autoplay=True))
    assert page.evaluate(f"{_PLAYER}.playing") == (motion == "no-preference")


def test_positions_that_do_not_fit_leave_a_message(mount: Callable) -> None:
    """A player without a motion says so, and draws as soon as there is one."""
    page = mount(waving(positions=[]))
    page.get_by_text("no motion yet").wait_for()
    assert page.get_by_role("button", name="Play").is_disabled()
