"""The authoring pad computes what the hand does, and tells Python when it lets go."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
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
    place_at,
    play_for,
    shown_angle,
)
from tests.browser.axe import violations
from tests.browser.chromium import Visit
from workbench.authoring.trajectories import Trajectory
from workbench.widgets.export import export_html

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("calm")]


_STAGE = "document.querySelector('.wb-pad-stage').toDataURL()"


# Scrubbing.


def test_the_pose_follows_the_mouse(mount: Callable) -> None:
    """At a marker it is the marker's pose, elsewhere another; nothing is told to Python."""
    page = mount(pad())
    pictures = []
    for marker, degrees in enumerate([0.0, 30.0, 60.0, 90.0]):
        page.mouse.move(*pixel(page, MARKERS[marker]))
        assert shown_angle(page) == pytest.approx(degrees, abs=3.0)
        pictures.append(page.evaluate(_STAGE))
    assert len(set(pictures)) == 4
    assert page.evaluate("mounted[0].model.saved") == 0


def test_time_goes_from_red_over_green_to_blue_and_key_poses_have_black_borders(
    mount: Callable,
) -> None:
    """As in Costa 2018, Figure 6.1: a red start, a green middle, a blue end."""
    page = mount(pad())
    colour = """(x, y) => [...pad.plane.base.getContext("2d").getImageData(
      Math.round(x), Math.round(y), 1, 1).data].slice(0, 3)"""
    of_curve = page.evaluate(
        f"() => {{ const pad = {PAD}, colour = {colour};"
        "return [2, 18, 38].map((frame) => colour(...pad.plane.toPixel("
        "pad.scene.embedding.subarray(2 * frame, 2 * frame + 2)))); }"
    )
    assert [int(np.argmax(rgb)) for rgb in of_curve] == [0, 1, 2]
    around_marker = page.evaluate(
        f"() => {{ const pad = {PAD}, colour = {colour};"
        "const [x, y] = pad.plane.toPixel(pad.scene.marker(2));"
        "return Array.from({ length: 14 }, (_, i) => colour(x, y - i)); }"
    )
    assert max(around_marker[0]) > 90  # filled with its time's colour
    assert min(max(rgb) for rgb in around_marker[3:]) < 60


def test_leaving_the_plane_shows_the_time_again(mount: Callable) -> None:
    """The pose at the mouse is a look aside: the clock's comes back."""
    page = mount(pad(time=2.0))
    page.mouse.move(*pixel(page, [5.0, 5.0]))
    assert not page.evaluate(f"{PAD}.atTime")
    page.mouse.move(1, 1)
    assert page.evaluate(f"[{PAD}.atTime, {PAD}.place]") == [True, MARKERS[2].tolist()]


def test_a_clicked_place_is_kept_in_view(mount: Callable) -> None:
    """It comes back when the mouse has left, a marker is added there; Escape lets it go."""
    page = mount(pad())
    page.mouse.click(*pixel(page, [5.0, 8.0]))
    kept = page.evaluate(f"{PAD}.place")
    page.mouse.move(*pixel(page, [15.0, 2.0]))
    page.mouse.move(1, 1)
    assert page.evaluate(f"[{PAD}.place, {PAD}.atTime]") == [kept, False]
    page.get_by_role("button", name="Add a marker").click()
    assert [edit(page)["kind"], edit(page)["at"]] == ["add", kept]
    page.mouse.click(*pixel(page, [12.0, 8.0]))
    page.keyboard.press("Escape")
    assert page.evaluate(f"[{PAD}.pinned, {PAD}.atTime]") == [None, True]


def test_a_click_on_the_trajectory_goes_to_its_time(mount: Callable) -> None:
    """The nearest point's second is shown, and told."""
    page = mount(pad())
    page.mouse.click(*pixel(page, MARKERS[1]))
    assert page.evaluate(f"{PAD}.time") == pytest.approx(1.0)
    assert page.evaluate("mounted[0].model.get('time')") == pytest.approx(1.0)


def test_what_is_seen_is_the_persons_choice(mount: Callable) -> None:
    """Wheel and drag with Shift change it, Python's answers do not; "Show all" goes back."""
    page = mount(pad())
    first = pixel(page, MARKERS[0])
    page.locator(PLOT).focus()
    page.mouse.move(*first)
    page.mouse.wheel(0, -400)
    page.wait_for_function(f"{PAD}.plane.view.zoom > 1.5")
    assert pixel(page, MARKERS[0]) == pytest.approx(first, abs=1)
    page.keyboard.down("Shift")
    drag(page, first, (first[0] + 40, first[1] - 30))
    page.keyboard.up("Shift")
    assert pixel(page, MARKERS[0]) == pytest.approx((first[0] + 40, first[1] - 30), abs=1)
    answer(page, markers=MARKERS)
    assert pixel(page, MARKERS[0]) == pytest.approx((first[0] + 40, first[1] - 30), abs=1)
    page.keyboard.press("f")
    assert pixel(page, MARKERS[0]) == pytest.approx(first, abs=1)
    assert edit(page) == {}


# Markers.


def test_frames_follow_a_dragged_marker(mount: Callable) -> None:
    """While it is held nothing is told; frames are influence times markers; then "move" is."""
    page = mount(pad(mode="markers"))
    start = pixel(page, MARKERS[2])
    end = (start[0] + 60, start[1] + 40)
    page.mouse.move(*start)
    page.mouse.down()
    page.mouse.move(*end, steps=3)
    assert edit(page) == {}
    page.mouse.up()
    told = edit(page)
    assert told["kind"] == "move"
    assert told["marker"] == 2
    moved = MARKERS.copy()
    moved[2] = told["to"]
    np.testing.assert_allclose(told["to"], place_at(page, end), atol=0.3)
    expected = np.asarray(pad().influence).reshape(-1, 4) @ moved
    np.testing.assert_allclose(array(page, "points").reshape(-1, 2), expected, atol=1e-9)
    assert page.evaluate("mounted[0].model.get('selected')") == 2


def test_a_dragged_marker_keeps_its_pose(mount: Callable) -> None:
    """The function is refitted: at its new place the marker gives its own pose."""
    page = mount(pad(mode="markers"))
    start = pixel(page, MARKERS[1])
    drag(page, start, (start[0] + 30, start[1] - 70))
    page.evaluate(f"{PAD}.look({edit(page)['to']})")
    assert shown_angle(page) == pytest.approx(30.0, abs=1e-6)


def test_escape_puts_a_marker_back(mount: Callable) -> None:
    """Everything is as it was, and nothing is told."""
    page = mount(pad(mode="markers"))
    start = pixel(page, MARKERS[1])
    page.mouse.move(*start)
    page.mouse.down()
    page.mouse.move(start[0] + 50, start[1] - 50, steps=3)
    page.locator(PLOT).focus()
    page.keyboard.press("Escape")
    page.mouse.up()
    assert array(page, "markers").tolist() == MARKERS.ravel().tolist()
    assert edit(page) == {}


def test_a_double_click_adds_the_nearest_frame(mount: Callable) -> None:
    """Near the clip's curve it is a frame, at the frame's place."""
    page = mount(pad(mode="markers"))
    x, y = pixel(page, [30.0, 5.0])
    page.mouse.dblclick(x, y - 4)
    told = edit(page)
    assert (told["kind"], told["frame"]) == ("add", 30)
    assert told["at"] == pytest.approx([30.0, 5.0])
    assert len(told["rotations"]) == 27
    assert len(told["root"]) == 3


def test_a_double_click_elsewhere_adds_the_pose_shown_there(mount: Callable) -> None:
    """Far from the curve it is no frame, and its pose is what was seen."""
    page = mount(pad(mode="markers"))
    # Double clicks come in whole pixels, moves do not.
    x, y = pixel(page, [5.0, 8.0])
    spot = (round(x), round(y))
    page.mouse.move(*spot)
    seen = page.evaluate(f"[...{PAD}.scene.poseAt({PAD}.place).rotations]")
    page.mouse.dblclick(*spot)
    told = edit(page)
    assert (told["kind"], told["frame"]) == ("add", None)
    assert told["at"] == pytest.approx(place_at(page, spot), abs=0.2)
    np.testing.assert_allclose(told["rotations"], seen, atol=1e-9)


def test_delete_removes_the_selected_marker(mount: Callable) -> None:
    """By key and by button, until three are left."""
    page = mount(pad(mode="markers"))
    page.mouse.click(*pixel(page, MARKERS[1]))
    page.locator(PLOT).focus()
    page.keyboard.press("Delete")
    assert {k: edit(page)[k] for k in ("kind", "marker")} == {"kind": "remove", "marker": 1}
    assert page.evaluate(f"{PAD}.scene.count") == 3
    page.evaluate("mounted[0].model.set('selected', 0)")
    assert page.get_by_role("button", name="Delete the selected marker").is_disabled()


# Deforming and drawing.


def test_a_dragged_curve_is_that_of_python(mount: Callable) -> None:
    """The edit has what Python needs to get the very points that are shown, to 1e-9."""
    page = mount(pad(mode="deform", radius=12.5))
    start = pixel(page, [15.0, 5.0])
    drag(page, start, (start[0] + 20, start[1] - 90))
    told = edit(page)
    assert (told["kind"], told["index"], told["radius"]) == ("deform", 15, 12.5)
    path = Trajectory(np.asarray(pad().points).reshape(-1, 2), np.asarray(pad().times))
    expected = path.dragged(told["index"], told["to"], told["radius"]).points
    np.testing.assert_allclose(array(page, "points").reshape(-1, 2), expected, rtol=0, atol=1e-9)
    assert page.evaluate(f"{PAD}.scene.follows") is False
    assert array(page, "markers").tolist() == MARKERS.ravel().tolist()


def test_the_wheel_and_the_slider_set_the_radius(mount: Callable) -> None:
    """The wheel makes it larger or smaller, the slider shows it, and the edit has it."""
    page = mount(pad(mode="deform", radius=12.5))
    page.locator(PLOT).focus()
    page.mouse.move(*pixel(page, [15.0, 5.0]))
    page.mouse.wheel(0, -300)
    page.wait_for_function(f"{PAD}.radius > 13")
    wide = page.evaluate(f"{PAD}.radius")
    slider = page.get_by_label("Radius of the deformation")
    slider.fill("10")
    assert page.evaluate(f"{PAD}.radius") < 12.5 < wide
    assert page.locator(".wb-pad-amount").inner_text() != ""


def test_drawing_records_its_timing(mount: Callable) -> None:
    """Points and growing seconds are told at the end, and shown in place of the trajectory."""
    page = mount(pad(mode="draw"))
    corners = [pixel(page, place) for place in ([0, 0], [10, 8], [30, 8], [40, 2])]
    page.mouse.move(*corners[0])
    page.mouse.down()
    for corner in corners[1:]:
        page.mouse.move(*corner, steps=5)
        page.evaluate("new Promise((done) => setTimeout(done, 80))")
    assert edit(page) == {}
    page.mouse.up()
    told = edit(page)
    times = np.array(told["times"])
    assert told["kind"] == "draw"
    assert times[0] == 0
    assert np.all(np.diff(times) > 0)
    assert times[-1] > 0.2
    assert told["points"][0] == pytest.approx([0, 0], abs=0.3)
    assert told["points"][-1] == pytest.approx([40, 2], abs=0.3)
    np.testing.assert_array_equal(array(page, "points").reshape(-1, 2), told["points"])
    assert page.evaluate(f"{PAD}.scene.follows") is False


def test_escape_cancels_drawing(mount: Callable) -> None:
    """The trajectory stays, and nothing is told."""
    page = mount(pad(mode="draw"))
    before = array(page, "points")
    page.mouse.move(*pixel(page, [0, 0]))
    page.mouse.down()
    page.mouse.move(*pixel(page, [30, 8]), steps=5)
    page.locator(PLOT).focus()
    page.keyboard.press("Escape")
    page.mouse.up()
    assert edit(page) == {}
    np.testing.assert_array_equal(array(page, "points"), before)


def test_a_dot_is_no_trajectory(mount: Callable) -> None:
    """A click in drawing mode changes nothing and says why."""
    page = mount(pad(mode="draw"))
    page.mouse.click(*pixel(page, [3, 3]))
    assert edit(page) == {}
    assert "Too short" in page.locator(".wb-pad-message").inner_text()


# Turning joints.


def test_a_turned_joint_shows_live_and_is_told_at_the_end(mount: Callable) -> None:
    """The marker's pose turns about the joint's own axes; one edit on release."""
    page = mount(pad(mode="markers", selected=1))
    page.get_by_label("Joint", exact=True).select_option("1")
    slider = page.get_by_label("Turn about z, degrees")
    slider.evaluate(
        "(node) => { node.value = '25'; node.dispatchEvent(new Event('input', {bubbles: true})); }"
    )
    assert shown_angle(page) == pytest.approx(55.0, abs=1e-6)
    assert edit(page) == {}
    slider.evaluate("(node) => node.dispatchEvent(new Event('change', {bubbles: true}))")
    told = edit(page)
    told.pop("number")
    turn = {"kind": "turn", "marker": 1, "joint": 1, "angles": [0, 0, 25], "place": None}
    assert told == {**turn, "revision": 0}


def test_turning_by_keys_is_one_edit(mount: Callable) -> None:
    """Steps of the arrow keys add up; Escape puts the joint back, leaving tells."""
    page = mount(pad(mode="markers", selected=1))
    page.get_by_label("Joint", exact=True).select_option("1")
    slider = page.get_by_label("Turn about z, degrees")
    slider.focus()
    for _ in range(3):
        page.keyboard.press("ArrowRight")
    assert shown_angle(page) == pytest.approx(33.0, abs=1e-6)
    page.keyboard.press("Escape")
    assert shown_angle(page) == pytest.approx(30.0, abs=1e-6)
    for _ in range(5):
        page.keyboard.press("ArrowLeft")
    assert edit(page) == {}
    page.keyboard.press("Tab")
    assert edit(page)["angles"] == [0, 0, -5]
    assert edit(page)["number"] == 1


@pytest.mark.parametrize(("choice", "place"), [("here", [7.0, 3.0]), ("best", "best")])
def test_a_turned_pose_can_be_a_new_marker(mount: Callable, choice: str, place: Any) -> None:
    """It goes where was looked at or where the optimizer wants; the old marker stays."""
    page = mount(pad(mode="markers", selected=1))
    page.evaluate(f"{PAD}.pin([7, 3])")
    page.mouse.move(1, 1)
    page.get_by_label("Joint", exact=True).select_option("2")
    page.get_by_label("What turning changes").select_option(choice)
    field = page.get_by_label("Degrees about x")
    field.fill("-40")
    field.press("Tab")
    told = edit(page)
    assert (told["kind"], told["joint"], told["angles"]) == ("turn", 2, [-40, 0, 0])
    assert told["place"] == place
    before = np.asarray(pad().marker_poses)
    np.testing.assert_array_equal(array(page, "poses"), before.ravel())


def test_a_click_picks_the_nearest_joint(mount: Callable) -> None:
    """The joint under the mouse is chosen in the list."""
    page = mount(pad(selected=0))
    box = page.locator(".wb-pad-stage").bounding_box()
    x, y = page.evaluate(f"{PAD}.pose.jointPixel(2)")
    page.mouse.click(box["x"] + x + 3, box["y"] + y - 3)
    assert page.get_by_label("Joint", exact=True).input_value() == "2"


# Time.


@pytest.mark.parametrize(("speed", "expected"), [(0.25, 0.25), (1.0, 1.0), (2.0, 2.0)], ids=str)
def test_the_clock_keeps_time(mount: Callable, speed: float, expected: float) -> None:
    """After one second, at each speed, the trajectory is where it is then."""
    page = mount(pad(speed=speed))
    play_for(page, 1.0)
    assert page.evaluate(f"{PAD}.time") == pytest.approx(expected, abs=0.05)
    assert page.evaluate("mounted[0].model.saved") == 0


def test_a_loop_starts_again(mount: Callable) -> None:
    """With it time goes round, without it the end stays and Python knows."""
    page = mount(pad())
    play_for(page, 4.5)
    assert page.evaluate(f"{PAD}.time") == pytest.approx(0.5, abs=0.05)
    page.evaluate(f"{PAD}.pause(); mounted[0].model.set('loop', false)")
    play_for(page, 9.0)
    assert page.evaluate(f"[{PAD}.playing, mounted[0].model.get('time')]") == [False, 4.0]


def test_the_original_is_a_ghost_that_can_be_hidden(mount: Callable) -> None:
    """At a time where the pose differs from it, it is seen until its button is pressed."""
    page = mount(pad())
    page.evaluate(f"{PAD}.seek(4.0)")
    button = page.get_by_role("button", name="Draw the original behind the pose")
    with_ghost = page.evaluate(_STAGE)
    button.click()
    page.wait_for_function("before => " + _STAGE + " !== before", arg=with_ghost)
    assert button.get_attribute("aria-pressed") == "false"
    button.click()
    page.wait_for_function("before => " + _STAGE + " === before", arg=with_ghost)


def test_feet_of_python_move_the_root(mount: Callable) -> None:
    """At a time the root is where Python wants it; at a place it is the markers'."""
    roots = np.zeros((41, 3))
    roots[20] = [7.0, 8.0, 9.0]
    page = mount(pad(roots=roots))
    page.evaluate(f"{PAD}.seek(2.0)")
    assert page.evaluate(f"[...{PAD}.pose.shown].slice(0, 3)") == [7, 8, 9]
    page.evaluate(f"{PAD}.look([20, 10])")
    root = page.evaluate(f"[...{PAD}.pose.shown].slice(0, 3)")
    assert root == pytest.approx([20, 10, 10])


def test_between_frames_the_root_goes_on_as_the_pose_does(mount: Callable) -> None:
    """It is on the line from frame to frame; after the last frame it stays."""
    roots = np.zeros((41, 3))
    roots[:, 0] = np.arange(41) ** 2
    page = mount(pad(roots=roots))
    for seconds, x in {2.0: 400, 2.05: 420.5, 2.075: 430.75, 4.0: 1600}.items():
        page.evaluate(f"{PAD}.seek({seconds})")
        assert page.evaluate(f"{PAD}.pose.shown[0]") == pytest.approx(x)


def test_it_plays_on_while_a_marker_is_dragged(mount: Callable) -> None:
    """The pose stays the clock's, on the trajectory that follows the marker."""
    page = mount(pad(mode="markers"))
    page.evaluate(f"{PAD}.seek(1.0)")
    page.evaluate(f"{PAD}.play(true); cancelAnimationFrame({PAD}.request)")
    start = pixel(page, MARKERS[1])
    page.mouse.move(*start)
    page.mouse.down()
    page.mouse.move(start[0] + 30, start[1] - 40, steps=3)
    page.evaluate(f"{PAD}.tick(1e6); cancelAnimationFrame({PAD}.request)")
    moved = array(page, "markers")[2:4].tolist()
    assert moved != MARKERS[1].tolist()
    assert page.evaluate(f"[{PAD}.atTime, {PAD}.place]") == [True, moved]
    page.mouse.up()


def test_views_of_one_channel_show_the_same_frame(mount: Callable) -> None:
    """A frame announced elsewhere is gone to, and the pad announces its own."""
    page = mount(pad(channel="one"))
    page.evaluate(
        "document.addEventListener('workbench-hover', (e) => (window.told = e.detail.sample))"
    )
    page.evaluate(f"{PAD}.seek(2.5)")
    assert page.evaluate("window.told") == 25
    page.evaluate(
        "document.dispatchEvent(new CustomEvent('workbench-hover', "
        "{detail: {channel: 'one', sample: 10}}))"
    )
    assert page.evaluate(f"{PAD}.time") == pytest.approx(1.0)


def test_a_dragged_handle_changes_the_timing(mount: Callable) -> None:
    """Its point comes at another time, times grow, the ends stay."""
    page = mount(pad())
    box = page.locator(".wb-pad-curve").bounding_box()
    at = f"{PAD}.clock.curve"
    x, y = page.evaluate(f"{at}.pixel(2.0, {at}.along[20])")
    later = page.evaluate(f"{at}.pixel(2.8, 0)")[0]
    page.locator(".wb-pad-curve").scroll_into_view_if_needed()
    box = page.locator(".wb-pad-curve").bounding_box()
    drag(page, (box["x"] + x, box["y"] + y), (box["x"] + later, box["y"] + y))
    told = edit(page)
    times = np.array(told["times"])
    assert told["kind"] == "retime"
    assert times[20] == pytest.approx(2.8, abs=0.05)
    assert times[[0, 40]].tolist() == [0.0, 4.0]
    assert np.all(np.diff(times) > 0)
    assert array(page, "times").tolist() == times.tolist()


def test_with_shift_all_that_is_later_moves_along(mount: Callable) -> None:
    """A handle dragged with Shift makes the motion longer by as much."""
    page = mount(pad())
    page.locator(".wb-pad-curve").scroll_into_view_if_needed()
    box = page.locator(".wb-pad-curve").bounding_box()
    curve = f"{PAD}.clock.curve"
    x, y = page.evaluate(f"{curve}.pixel(1.0, {curve}.along[10])")
    later = page.evaluate(f"{curve}.pixel(1.5, 0)")[0]
    page.keyboard.down("Shift")
    drag(page, (box["x"] + x, box["y"] + y), (box["x"] + later, box["y"] + y))
    page.keyboard.up("Shift")
    times = edit(page)["times"]
    assert times[10] == pytest.approx(1.5, abs=0.05)
    assert times[40] - 4.0 == pytest.approx(times[10] - 1.0)


# Keyboard.


def test_modes_have_keys(mount: Callable) -> None:
    """Each letter chooses its mode, and the buttons show it."""
    page = mount(pad())
    page.locator(PLOT).focus()
    for key, mode in {"m": "Markers", "d": "Deform", "p": "Draw", "s": "Scrub"}.items():
        page.keyboard.press(key)
        pressed = page.locator(".wb-pad-tools button[aria-pressed='true']").all_inner_texts()
        assert pressed == [mode]


def test_a_marker_is_moved_by_keys(mount: Callable) -> None:
    """Arrows lead to it, Enter picks it up and drops it; eight pixels for each arrow."""
    page = mount(pad(mode="markers"))
    page.locator(PLOT).focus()
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowRight")
    before = pixel(page, MARKERS[1])
    for key in ["Enter", "ArrowRight", "ArrowRight", "Shift+ArrowDown", "Enter"]:
        page.keyboard.press(key)
    told = edit(page)
    assert (told["kind"], told["marker"]) == ("move", 1)
    assert told["to"] == pytest.approx(place_at(page, (before[0] + 16, before[1] + 1)))


def test_the_trajectory_is_deformed_by_keys(mount: Callable) -> None:
    """Arrows lead along it, Enter picks it up and drops it, brackets set the radius."""
    page = mount(pad(mode="deform", radius=12.0))
    page.locator(PLOT).focus()
    for key in [*["ArrowRight"] * 6, "]", "Enter", "ArrowUp", "Enter"]:
        page.keyboard.press(key)
    told = edit(page)
    assert (told["kind"], told["index"]) == ("deform", 5)
    assert told["radius"] == pytest.approx(12.0 * 1.15)


def test_a_trajectory_is_drawn_by_keys(mount: Callable) -> None:
    """Enter starts and ends; the arrows' times are recorded."""
    page = mount(pad(mode="draw"))
    page.locator(PLOT).focus()
    page.keyboard.press("Enter")
    for _ in range(4):
        page.keyboard.press("ArrowRight")
        page.evaluate("new Promise((done) => setTimeout(done, 70))")
    page.keyboard.press("Enter")
    told = edit(page)
    assert told["kind"] == "draw"
    assert len(told["points"]) >= 5
    assert told["points"][-1][0] > told["points"][0][0]


def test_timing_is_changed_by_keys(mount: Callable) -> None:
    """Arrows lead from handle to handle, Enter picks one up; arrows move it by frames."""
    page = mount(pad())
    page.locator(".wb-pad-curve").focus()
    for key in ["ArrowRight", "Enter", "ArrowRight", "ArrowRight", "Enter"]:
        page.keyboard.press(key)
    told = edit(page)
    assert told["kind"] == "retime"
    assert told["times"][KEYS[1]] == pytest.approx(1.2)


def test_nothing_of_the_keyboard_reaches_the_notebook(mount: Callable) -> None:
    """Keys that the pad uses stop there: JupyterLab would delete cells."""
    page = mount(pad(mode="markers"))
    page.evaluate("document.addEventListener('keydown', (e) => (window.heard ??= []).push(e.key))")
    page.locator(PLOT).focus()
    for key in ["x", "d", "m", "a", "Enter", "Escape", "ArrowDown", " ", "Delete"]:
        page.keyboard.press(key)
    page.get_by_label("Speed").focus()
    page.keyboard.press("ArrowDown")
    assert page.evaluate("window.heard ?? []") in ([], ["Escape"])


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_the_pad_breaks_no_rule_of_accessibility(mount: Callable, visit: Visit, theme: str) -> None:
    """Names, roles and contrast, with a marker selected and deforming chosen."""
    visit.page.set_content("<!doctype html><title>A widget</title>")
    visit.page.emulate_media(color_scheme=theme)
    page = mount(pad(mode="deform", selected=1, undo_label="deform"))
    assert violations(page, ".wb") == []


# Without Python.


def test_an_exported_page_scrubs_and_plays_without_editing(visit: Any, tmp_path: Path) -> None:
    """From a file, the pose follows the mouse and time passes; there is nothing to edit with."""
    path = export_html(pad(undo_label="deform", mode="markers"), tmp_path / "pad.html", title="Pad")
    page = visit.page
    page.goto(path.as_uri())
    page.locator(PLOT).wait_for()
    page.mouse.move(*pixel(page, MARKERS[3]))
    assert shown_angle(page) == pytest.approx(90.0, abs=3.0)
    play_for(page, 1.0)
    assert page.evaluate(f"{PAD}.time") == pytest.approx(1.0, abs=0.05)
    for name in ("Undo: deform", "Markers", "Add marker"):
        assert page.get_by_role("button", name=name).count() == 0
    assert "handle" not in page.locator(".wb-pad-curve").get_attribute("aria-label")
    page.locator(".wb-pad-curve").focus()
    for key in ["Home", "ArrowRight", "Enter", "ArrowRight"]:
        page.keyboard.press(key)
    assert array(page, "times").tolist() == pad().times.tolist()
    page.locator(PLOT).focus()
    page.keyboard.press("m")
    assert page.evaluate(f"{PAD}.mode") == "scrub"
