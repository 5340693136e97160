"""The error landscape and the reconstruction in a page without a kernel."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from workbench.backprojection.rbf import RBF
from workbench.optimization.landscape import PlaneGrid, error_landscape, rebuild_grid
from workbench.spaces import VectorSpace
from workbench.widgets.landscape import LandscapeView
from workbench.widgets.radial import radial_function
from workbench.widgets.reconstruction import ReconstructionView

pytestmark = pytest.mark.browser

POINTS = np.array([[0.1, 0.1], [0.9, 0.1], [0.1, 0.9], [0.9, 0.9], [0.3, 0.6], [0.7, 0.4]])
SAMPLES = np.column_stack([POINTS, POINTS.sum(axis=1) ** 2])
CONTROLS = [0, 1, 2, 3]
MODEL = RBF().fit(POINTS[CONTROLS], SAMPLES[CONTROLS])
GRID = PlaneGrid.around([[0.0, 0.0], [1.0, 1.0]], side=21, padding=0.0)
LANDSCAPE = error_landscape(VectorSpace(SAMPLES), 4, GRID, rebuild_grid(MODEL, GRID))

_PIXEL = """
([layer, x, y]) => {
  const canvas = document.querySelector(layer);
  const at = [Math.round(x * (canvas.width - 1)), Math.round((1 - y) * (canvas.height - 1))];
  return [...canvas.getContext("2d").getImageData(...at, 1, 1).data];
}
"""
_PICTURE = "(layer) => document.querySelector(layer).toDataURL()"
_TOLD = """
() => { window.told = [];
        document.addEventListener("workbench-place", ({detail}) => told.push(detail)); }
"""


def steps(*places: tuple[float, float], name: str = "walk") -> list[dict[str, Any]]:
    return [
        {
            "iteration": i,
            "x": x,
            "y": y,
            "error": 1.0 / (1 + i),
            "text": f"{name}, step {i}",
            "tries": [[x + 0.1, y, 0.2, "probe"], [x - 0.1, y, 3.0, "probe"]] if i else [],
        }
        for i, (x, y) in enumerate(places)
    ]


TRACES = [
    {
        "name": "alg12",
        "title": "Alg. 12",
        "message": "",
        "steps": steps((0.3, 0.6), (0.4, 0.5), (0.5, 0.5)),
    },
    {
        "name": "local",
        "title": "Local search",
        "message": "",
        "steps": steps((0.3, 0.6), (0.45, 0.55), name="other"),
    },
]


def landscape(**traits: Any) -> LandscapeView:
    given = {
        "points": POINTS,
        "control_points": CONTROLS,
        "sample": 4,
        "mapped": 4,
        "errors": LANDSCAPE.errors,
        "columns": 21,
        "extent": [0.0, 1.0, 0.0, 1.0],
        "traces": TRACES,
        "active": "alg12",
        "channel": "test",
    }
    return LandscapeView(**{**given, **traits})


def reconstruction(**traits: Any) -> ReconstructionView:
    radial = radial_function(MODEL)
    given = {
        "original": SAMPLES[4],
        "columns": ["a", "b", "c"],
        "low": SAMPLES.min(axis=0),
        "high": SAMPLES.max(axis=0),
        "kernel": radial.kernel,
        "epsilon": radial.epsilon,
        "centers": radial.centers,
        "coefficients": radial.coefficients,
        "channel": "test",
    }
    return ReconstructionView(**{**given, **traits})


def trait(page: Any, name: str) -> Any:
    return page.evaluate("(name) => mounted[0].model.get(name)", name)


def at(page: Any, x: float, y: float) -> tuple[float, float]:
    """Compute where a place of the plane is in the page."""
    box = page.locator(".wb-land-base").bounding_box()
    return box["x"] + x * box["width"], box["y"] + (1 - y) * box["height"]


def test_low_errors_are_dark_and_the_lowest_is_marked(mount: Callable) -> None:
    """Lightness rises with the error; the diamond is at the grid's minimum."""
    page = mount(landscape(traces=[]))
    low, _ = LANDSCAPE.minimum
    high_row, high_column = np.unravel_index(LANDSCAPE.errors.argmax(), (21, 21))
    near = page.evaluate(_PIXEL, [".wb-land-base", *(low + 0.04)])
    far = page.evaluate(_PIXEL, [".wb-land-base", GRID.x[high_column], GRID.y[high_row]])
    assert sum(near[:3]) < sum(far[:3])
    label = page.locator(".wb-land-plot").get_attribute("aria-label")
    lowest = f"lowest error {LANDSCAPE.minimum[1]:.3g} at {low[0]:.3g}, {low[1]:.3g}"
    assert lowest in label


def test_the_legend_has_the_numbers_of_the_errors(mount: Callable) -> None:
    """It begins with the lowest error and says that bright is above its end."""
    page = mount(landscape())
    texts = page.locator(".wb-land-ticks span").all_inner_texts()
    assert texts[0] == f"{LANDSCAPE.errors.min():.3g}"
    assert texts[-1].startswith("≥ ")
    assert len(texts) > 2


def test_a_clicked_sample_is_picked_and_python_is_told(mount: Callable) -> None:
    """The sample next to the click is picked, and its map is faint until it comes."""
    page = mount(landscape())
    page.mouse.click(*at(page, 0.7, 0.4))
    assert trait(page, "sample") == 5
    assert trait(page, "step") == 0
    assert page.locator(".wb-land-base").evaluate("(canvas) => canvas.style.opacity") == "0.35"


@pytest.mark.parametrize(
    ("keys", "sample"),
    [
        (["ArrowRight"], 5),
        (["ArrowLeft", "ArrowLeft"], 2),
        (["ArrowUp"], 5),
        (["Home"], 0),
        (["End"], 5),
    ],
    ids=["next", "back", "ten on", "first", "last"],
)
def test_keys_pick_samples(mount: Callable, keys: list[str], sample: int) -> None:
    """Arrow keys move from sample to sample and stop at the ends."""
    page = mount(landscape())
    page.locator(".wb-land-plot").focus()
    for key in keys:
        page.keyboard.press(key)
    assert trait(page, "sample") == sample


def test_a_click_elsewhere_keeps_the_place(mount: Callable) -> None:
    """The clicked place stays when the mouse leaves, until Escape."""
    page = mount(landscape())
    page.evaluate(_TOLD)
    page.mouse.click(*at(page, 0.55, 0.8))
    page.mouse.move(1, 1)
    np.testing.assert_allclose(trait(page, "place"), [0.55, 0.8], atol=0.01)
    assert trait(page, "sample") == 4
    np.testing.assert_allclose(page.evaluate("told.at(-1).place"), [0.55, 0.8], atol=0.01)
    page.locator(".wb-land-plot").focus()
    page.keyboard.press("Escape")
    assert trait(page, "place") == []
    np.testing.assert_allclose(page.evaluate("told.at(-1).place"), [0.3, 0.6], atol=1e-6)


def test_the_place_moves_by_keys_too(mount: Callable) -> None:
    """Shift and arrows move the place from where the sample is."""
    page = mount(landscape())
    page.locator(".wb-land-plot").focus()
    page.keyboard.press("Shift+ArrowRight")
    page.keyboard.press("Shift+ArrowUp")
    np.testing.assert_allclose(trait(page, "place"), [0.32, 0.62], atol=1e-6)
    assert "place 0.320, 0.620" in page.locator(".wb-land-readout").inner_text()


def test_steps_can_be_gone_through_by_buttons_keys_and_slider(mount: Callable) -> None:
    """Each way shows the step's words, and Python knows the step."""
    page = mount(landscape())
    text = page.locator(".wb-land-text")
    assert text.inner_text() == "walk, step 0"
    page.get_by_role("button", name="Step forward").click()
    assert text.inner_text() == "walk, step 1"
    page.locator(".wb-land-plot").focus()
    page.keyboard.press(".")
    assert text.inner_text() == "walk, step 2"
    assert trait(page, "step") == 2
    assert page.get_by_role("button", name="Step forward").is_disabled()
    page.get_by_label("Step", exact=True).focus()
    page.keyboard.press("ArrowLeft")
    assert text.inner_text() == "walk, step 1"
    page.get_by_role("button", name="First step").click()
    assert trait(page, "step") == 0


def test_probes_and_the_way_are_drawn(mount: Callable) -> None:
    """A step shows its probes: filled in the way's colour where the error is lower."""
    page = mount(landscape())
    page.get_by_role("button", name="Step forward").click()
    assert page.evaluate(_PIXEL, [".wb-land-ways", 0.5, 0.5])[:3] == [255, 255, 255]
    hollow = page.evaluate(_PIXEL, [".wb-land-ways", 0.3, 0.5])
    assert max(hollow[:3]) < 60
    assert hollow[3] == 255


def test_playing_goes_to_the_last_step_and_stops(mount: Callable) -> None:
    """Play runs through all steps by itself; the button offers to play again."""
    page = mount(landscape())
    page.get_by_label("Speed").select_option(label="fast")
    page.get_by_role("button", name="Play the steps").click()
    page.get_by_role("button", name="Pause").wait_for()
    page.wait_for_function("mounted[0].model.get('step') === 2")
    page.get_by_role("button", name="Play the steps").wait_for()
    assert page.locator(".wb-land-text").inner_text() == "walk, step 2"


def test_the_other_optimizer_is_chosen_by_its_button(mount: Callable) -> None:
    """Its steps are shown from the start, and Python is told."""
    page = mount(landscape(step=2))
    page.get_by_role("button", name="Local search 1 → 0.5").click()
    assert trait(page, "active") == "local"
    assert page.locator(".wb-land-text").inner_text() == "other, step 0"
    pressed = page.locator(".wb-land-optimizers [aria-pressed=true]").inner_text()
    assert pressed.startswith("Local search")


def test_why_there_are_no_steps_is_said(mount: Callable) -> None:
    """A trace without steps shows its message, and its buttons rest."""
    page = mount(landscape(traces=[{**TRACES[0], "steps": [], "message": "A control point."}]))
    assert page.locator(".wb-land-text").inner_text() == "A control point."
    assert page.get_by_role("button", name="Play the steps").is_disabled()


def test_the_reconstruction_follows_the_mouse_without_a_message(mount: Callable) -> None:
    """Hovering rebuilds the row in the browser, to the numbers of Python's."""
    page = mount(landscape())
    mount(reconstruction(), width=320)
    page.evaluate(_TOLD)
    page.mouse.move(*at(page, 0.62, 0.35))
    place = page.evaluate("told.at(-1).place")
    np.testing.assert_allclose(place, [0.62, 0.35], atol=0.01)
    shown = page.evaluate("[...document.querySelector('.wb-rec').reconstruction.shown]")
    np.testing.assert_allclose(shown, MODEL.predict([place])[0], atol=1e-6)
    error = np.linalg.norm(MODEL.predict([place])[0] - SAMPLES[4])
    assert page.locator(".wb-rec-detail").inner_text().startswith(f"error {error:.3g} at 0.6")
    cells = page.locator(".wb-rec td.wb-number").all_inner_texts()
    assert float(cells[1]) == pytest.approx(shown[0], rel=1e-3)
    assert page.evaluate("mounted.map(({model}) => model.saved)") == [0, 0]


def test_the_reconstruction_follows_the_sample_on_its_way(mount: Callable) -> None:
    """Without a mouse over the plane it is that of the step's position."""
    page = mount(landscape())
    mount(reconstruction(), width=320)
    page.get_by_role("button", name="Last step").click()
    shown = page.evaluate("[...document.querySelector('.wb-rec').reconstruction.shown]")
    np.testing.assert_allclose(shown, MODEL.predict([[0.5, 0.5]])[0], atol=1e-6)


def test_what_python_rebuilt_is_shown_where_the_browser_cannot(mount: Callable) -> None:
    """Without a kernel's name, the numbers that were sent are shown with their place."""
    page = mount(
        reconstruction(
            kernel="", rebuilt=[1.0, 2.0, 3.0], rebuilt_at=[0.25, 0.5], note="click to ask"
        )
    )
    assert page.locator(".wb-rec td.wb-number").all_inner_texts()[1::2] == ["1", "2", "3"]
    assert page.locator(".wb-rec-detail").inner_text().endswith("at 0.250, 0.500")
    assert page.get_by_text("click to ask").is_visible()


def arm(**traits: Any) -> ReconstructionView:
    """Make a shoulder and an elbow with a hand, rebuilt with a bent elbow."""
    straight = np.stack([np.eye(3), np.eye(3)])
    bent = straight.copy()
    bent[1] = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
    given = {
        "original": straight,
        "parents": [-1, 0, 1],
        "sides": ["left", "left", "left"],
        "offsets": [[0, 0, 0], [2, 0, 0], [1, 0, 0]],
        "root": [0.0, 1.0, 0.0],
        "weights": [3.0, 1.0],
        "rebuilt": bent,
        "rebuilt_at": [0.0, 0.0],
        "channel": "test",
    }
    return ReconstructionView(**{**given, **traits})


def test_poses_are_drawn_beside_each_other(mount: Callable) -> None:
    """Both halves hold a figure, and the error is the weighted angle per joint."""
    page = mount(arm(), width=400)
    quarter_turn = np.pi / 2 / 2
    assert page.locator(".wb-rec-detail").inner_text().startswith(f"error {quarter_turn:.3g}")
    halves = page.evaluate(
        """() => {
          const canvas = document.querySelector(".wb-rec canvas");
          const half = canvas.width / 2;
          const context = canvas.getContext("2d");
          const blue = ({ data }) => data.filter((value, i) => i % 4 === 2 && value > 150).length;
          return [0, half].map((x) => blue(context.getImageData(x, 0, half, canvas.height)));
        }"""
    )
    assert min(halves) > 50


@pytest.mark.parametrize("way", ["mouse", "keyboard"])
def test_the_figures_can_be_turned(mount: Callable, way: str) -> None:
    """Dragging or arrow keys show them from another side."""
    page = mount(arm(), width=400)
    canvas = page.locator(".wb-rec canvas")
    before = page.evaluate(_PICTURE, ".wb-rec canvas")
    if way == "mouse":
        box = canvas.bounding_box()
        page.mouse.move(box["x"] + 100, box["y"] + 100)
        page.mouse.down()
        page.mouse.move(box["x"] + 160, box["y"] + 100)
        page.mouse.up()
    else:
        canvas.focus()
        page.keyboard.press("ArrowLeft")
    assert page.evaluate(_PICTURE, ".wb-rec canvas") != before


@pytest.mark.parametrize("width", [640, 320], ids=["wide", "narrow"])
def test_nothing_overflows(mount: Callable, width: int) -> None:
    """All parts stay within the width that they are given."""
    page = mount(landscape(), width=width)
    over = page.evaluate(
        """(width) => [...document.querySelectorAll(".wb-land :not(.wb-live)")]
          .filter((node) => node.getBoundingClientRect().right > width + 10)
          .map((node) => node.className)""",
        width,
    )
    assert over == []


def test_an_empty_view_says_why(mount: Callable) -> None:
    """Before there are data, the message is shown and nothing fails."""
    page = mount(LandscapeView(message="computing …"))
    mount(ReconstructionView(), width=300)
    assert page.locator(".wb-land .wb-message").inner_text() == "computing …"
    page.locator(".wb-land-plot").focus()
    page.keyboard.press("ArrowRight")
    page.keyboard.press(" ")
    assert trait(page, "sample") == -1
