"""The authoring pad and Python: what is told, what waits, what is put back."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from tests.browser.authoring_page import (
    KEYS,
    MARKERS,
    PAD,
    PLOT,
    answer,
    array,
    drag,
    edit,
    pad,
    pixel,
    play_for,
    shown_angle,
)
from tests.browser.chromium import Visit
from workbench.widgets.authoring import AuthoringPad

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("calm")]

ARRAYS = [
    *["offsets", "markers", "marker_poses", "marker_roots", "marker_frames", "influence"],
    *["embedding", "points", "times", "ghost"],
]


def numbers(widget: AuthoringPad, name: str) -> tuple[str, list[float]]:
    """Give the kind of array that the browser has of a trait, and its numbers."""
    values = getattr(widget, name)
    kind = {"<f8": "Float64Array", "<f4": "Float32Array", "<i4": "Int32Array"}[values.dtype.str]
    return kind, values.ravel().tolist()


def test_without_a_motion_it_says_so(mount: Callable) -> None:
    """Nothing can be used, no key does anything; a motion that comes later is shown."""
    page = mount(AuthoringPad())
    assert page.locator(".wb-pad-message").inner_text() == "No motion yet."
    page.mouse.click(200, 200)
    page.get_by_role("button", name="Play").click(force=True)
    page.keyboard.press("Tab")
    page.keyboard.press(" ")
    assert page.evaluate(f"{PAD}.scene") is None
    later = pad()
    plain = ("parents", "sides", "joint_names", "frame_time")
    page.evaluate(
        """async ([plain, arrays]) => {
          const { model } = mounted[0];
          for (const [name, value] of Object.entries(plain)) model.set(name, value);
          for (const [name, [kind, values]] of Object.entries(arrays)) {
            model.set(name, new DataView(globalThis[kind].from(values).buffer));
          }
          await null;
        }""",
        [
            {name: getattr(later, name) for name in plain},
            {name: numbers(later, name) for name in ARRAYS},
        ],
    )
    assert page.evaluate(f"{PAD}.scene.count") == 4
    assert page.locator(".wb-pad-message").inner_text() == ""


def test_a_function_that_cannot_be_fitted_is_told(mount: Callable) -> None:
    """A sentence says why there is no pose, and nothing else breaks."""
    page = mount(pad(kernel="none such"))
    text = page.locator(".wb-pad-message").inner_text()
    assert text.startswith("No pose can be computed: there is no kernel none such.")
    page.mouse.move(*pixel(page, MARKERS[1]))
    play_for(page, 0.5)


def test_no_other_state_is_shown_before_the_answer(mount: Callable) -> None:
    """What comes before Python has taken the edit in would jump back; the answer is shown."""
    page = mount(pad(mode="markers"))
    start = pixel(page, MARKERS[1])
    drag(page, start, (start[0] + 30, start[1] - 70))
    there = edit(page)["to"]
    page.evaluate("mounted[0].model.set('embedding', mounted[0].model.get('embedding'))")
    assert array(page, "markers")[2:4].tolist() == there
    moved = MARKERS.copy()
    moved[1] = [3.0, 4.0]
    answer(page, markers=moved)
    assert array(page, "markers")[2:4].tolist() == [3.0, 4.0]


def five_markers(**traits: Any) -> AuthoringPad:
    """Make a pad of which two markers can be removed."""
    markers = np.vstack([MARKERS, [[50.0, 5.0]]])
    more = {"marker_poses": np.tile(np.eye(3), (5, 3, 1, 1)).reshape(5, -1), "influence": []}
    names = {"marker_frames": [*KEYS, -1], "marker_names": list("ABCDE")}
    return pad(markers=markers, marker_roots=np.zeros((5, 3)), **more, **names, **traits)


def remove_two(page: Any) -> None:
    """Remove two markers before Python has answered."""
    for _ in range(2):
        page.evaluate(f"{PAD}.select(0); {PAD}.removeMarker()")


def test_edits_wait_for_the_answer_to_those_before(mount: Callable) -> None:
    """Two quick edits are told one after the other: a second would take the first one's place."""
    page = mount(five_markers(revision=3))
    remove_two(page)
    assert edit(page) == {"number": 1, "kind": "remove", "marker": 0, "revision": 3}
    assert page.evaluate(f"{PAD}.scene.count") == 3
    answer(page, revision=4)
    assert edit(page) == {"number": 2, "kind": "remove", "marker": 0, "revision": 4}
    assert page.evaluate(f"{PAD}.scene.count") == 3


def test_what_was_done_upon_a_refused_edit_is_put_back(mount: Callable) -> None:
    """It would be done to another marker: it is not told, nor what the hand still holds."""
    page = mount(five_markers(mode="markers"))
    remove_two(page)
    page.evaluate(f"{PAD}.tell('undo')")
    start = pixel(page, [20.0, 10.0])
    page.mouse.move(*start)
    page.mouse.down()
    page.mouse.move(start[0] + 30, start[1] - 40, steps=3)
    answer(page, message="No marker can be removed.")
    page.mouse.up()
    assert edit(page)["number"] == 1
    expected = np.vstack([MARKERS, [[50.0, 5.0]]])
    assert array(page, "markers").tolist() == expected.ravel().tolist()
    drag(page, start, (start[0] + 30, start[1] - 40))
    assert [edit(page)[key] for key in ("number", "kind", "marker")] == [2, "move", 2]


@pytest.mark.parametrize(
    ("mode", "place", "kind"),
    [("markers", MARKERS[1], "move"), ("deform", [15.0, 5.0], "deform")],
    ids=["markers", "deform"],
)
def test_an_edit_says_which_scene_its_gesture_began_with(
    mount: Callable, mode: str, place: Any, kind: str
) -> None:
    """A scene that comes after the press waits and is not the one that the hand was laid on."""
    page = mount(pad(mode=mode, revision=4))
    start = pixel(page, place)
    page.mouse.move(*start)
    page.mouse.down()
    answer(page, revision=5, markers=MARKERS[::-1])
    page.mouse.move(start[0] + 30, start[1] - 40, steps=3)
    answer(page, revision=6)
    page.mouse.up()
    assert [edit(page)["kind"], edit(page)["revision"]] == [kind, 4]
    assert edit(page).get("marker", 1) == 1
    answer(page, revision=7, markers=MARKERS)
    drag(page, start, (start[0] + 30, start[1] - 40))
    assert edit(page)["revision"] == 7


def test_a_gesture_upon_an_edit_says_the_scene_that_answered_it(mount: Callable) -> None:
    """Not the one before the edit, nor what the optimizer makes of it in the meantime."""
    page = mount(five_markers(mode="markers", revision=1))
    page.evaluate(f"{PAD}.select(4); {PAD}.removeMarker()")
    start = pixel(page, MARKERS[1])
    page.mouse.move(*start)
    page.mouse.down()
    answer(page, revision=2)
    answer(page, revision=3)
    page.mouse.move(start[0] + 30, start[1] - 40, steps=3)
    page.mouse.up()
    assert [edit(page)["number"], edit(page)["revision"]] == [2, 2]


def test_a_gesture_begun_before_an_undo_says_the_scene_before_it(mount: Callable) -> None:
    """What undo brings is not in sight before Python shows it."""
    page = mount(pad(mode="markers", revision=1, undo_label="deform"))
    page.locator(PLOT).focus()
    page.keyboard.press("Control+z")
    start = pixel(page, MARKERS[1])
    page.mouse.move(*start)
    page.mouse.down()
    answer(page, revision=2)
    page.mouse.move(start[0] + 30, start[1] - 40, steps=3)
    page.mouse.up()
    assert [edit(page)["kind"], edit(page)["revision"]] == ["move", 1]


def test_a_refused_edit_is_put_back(mount: Callable) -> None:
    """An answer that changes nothing but the message shows what was there before."""
    page = mount(pad(mode="markers"))
    start = pixel(page, MARKERS[1])
    drag(page, start, (start[0] + 30, start[1] - 70))
    answer(page, message="There is a marker already.")
    assert array(page, "markers").tolist() == MARKERS.ravel().tolist()
    assert page.locator(".wb-pad-message").inner_text() == "There is a marker already."


def test_a_state_that_comes_during_a_gesture_waits(mount: Callable) -> None:
    """The held marker stays in the hand; what came is shown when it is put back."""
    page = mount(pad(mode="markers"))
    start = pixel(page, MARKERS[1])
    page.mouse.move(*start)
    page.mouse.down()
    page.mouse.move(start[0] + 30, start[1] - 40, steps=3)
    held = array(page, "markers")[2:4].tolist()
    moved = MARKERS.copy()
    moved[3] = [44.0, 4.0]
    answer(page, markers=moved)
    assert array(page, "markers")[2:4].tolist() == held
    assert array(page, "markers")[6:].tolist() == MARKERS[3].tolist()
    page.locator(PLOT).focus()
    page.keyboard.press("Escape")
    page.mouse.up()
    assert array(page, "markers").tolist() == moved.ravel().tolist()


def test_markers_at_one_place_are_told_and_give_a_pose(mount: Callable) -> None:
    """Their mean pose is shown, a sentence says so, and nothing is not a number."""
    markers = MARKERS.copy()
    markers[2] = markers[1]
    page = mount(pad(markers=markers, influence=[]))
    page.evaluate(f"{PAD}.look([10, 0])")
    assert shown_angle(page) == pytest.approx(45.0, abs=1e-6)
    text = page.locator(".wb-pad-message").inner_text()
    assert text.startswith("B and C are at the same place")


def test_what_python_sends_is_glided_to(mount: Callable, visit: Visit) -> None:
    """Markers are on their way at first and there at the end; a new gesture ends the way."""
    visit.page.emulate_media(reduced_motion="no-preference")
    page = mount(pad(mode="markers"))
    moved = MARKERS.copy()
    moved[1, 1] += 6.0
    answer(page, markers=moved)
    page.wait_for_function(f"{PAD}.glide.goal === null")
    assert array(page, "markers").tolist() == moved.ravel().tolist()
    answer(page, markers=MARKERS)
    assert page.evaluate(f"{PAD}.glide.goal !== null")
    page.evaluate(f"{PAD}.hold()")
    assert array(page, "markers").tolist() == MARKERS.ravel().tolist()


def test_undo_and_redo_are_told(mount: Callable) -> None:
    """By button and by key, each only where there is something."""
    page = mount(pad(undo_label="deform", redo_label=""))
    assert page.get_by_role("button", name="Nothing to redo").is_disabled()
    page.get_by_role("button", name="Undo: deform").click()
    assert edit(page)["kind"] == "undo"
    page.locator(PLOT).focus()
    answer(page, undo_label="", redo_label="deform")
    page.keyboard.press("Control+z")
    assert edit(page)["number"] == 1
    page.keyboard.press("Control+Shift+z")
    assert edit(page) == {"number": 2, "kind": "redo"}


@pytest.mark.parametrize(
    ("label", "told"),
    [
        ("Speed", "undo"),
        ("Joint", "undo"),
        ("What turning changes", "undo"),
        ("Turn about z, degrees", "undo"),
        ("Degrees about z", None),
    ],
    ids=["speed", "joint", "place", "slider", "number"],
)
def test_undo_goes_by_key_but_where_text_is_typed(
    mount: Callable, label: str, told: str | None
) -> None:
    """Lists and sliders have nothing of their own to undo; fields undo what was typed."""
    page = mount(pad(selected=1, undo_label="deform"))
    page.get_by_label("Joint", exact=True).select_option("1")
    page.get_by_label(label, exact=True).focus()
    page.keyboard.press("Control+z")
    assert edit(page).get("kind") == told


def test_undo_puts_back_a_joint_that_is_being_turned(mount: Callable) -> None:
    """It is what was done last; nothing before it is undone."""
    page = mount(pad(mode="markers", selected=1, undo_label="deform"))
    page.get_by_label("Joint", exact=True).select_option("1")
    page.get_by_label("Turn about z, degrees").focus()
    page.keyboard.press("ArrowRight")
    page.keyboard.press("Control+z")
    page.keyboard.press("Tab")
    assert shown_angle(page) == pytest.approx(30.0, abs=1e-6)
    assert edit(page) == {}
