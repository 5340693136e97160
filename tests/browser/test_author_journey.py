"""What a person does with the authoring dashboard in JupyterLab."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest

from tests.browser.authoring_page import PAD, PLOT, drag, pixel
from tests.browser.axe import violations
from tests.browser.chromium import Visit
from tests.browser.lab import Lab, in_kernel, open_and_run
from workbench.datasets import load

pytestmark = pytest.mark.browser

NOTEBOOK = "author_motion.ipynb"
CLIP = "cmu/01_03-walk"


def wait_for_scene(page: Any, *words: str) -> None:
    """Wait until the line above the pad says all of these words."""
    page.wait_for_function(
        """(words) => {
          const line = document.querySelector(".wb-author-about");
          return line && document.querySelector(".wb-pad")?.pad?.scene &&
            words.every((word) => line.innerText.includes(word));
        }""",
        arg=list(words),
    )


def test_load_drag_draw_export_and_read_back(lab: Lab, visit: Visit) -> None:
    """What is saved as BVH is what the dashboard plays, after a drag and a drawn trajectory.

    Undo works by keyboard, and the saved page without a kernel.
    """
    page = visit.page
    page.emulate_media(reduced_motion="reduce")
    open_and_run(page, lab, NOTEBOOK)
    wait_for_scene(page, "cmu/01_01-jump", "12 key poses")

    options = page.get_by_label("Clip", exact=True).locator("option").all_inner_texts()
    walk = next(text for text in options if text.startswith(f"{CLIP}:"))
    page.get_by_label("Clip", exact=True).select_option(label=walk)
    wait_for_scene(page, CLIP)

    page.locator(PLOT).scroll_into_view_if_needed()
    page.locator("[data-mode=markers]").click()
    start = pixel(page, page.evaluate(f"[...{PAD}.scene.markers.subarray(8, 10)]"))
    drag(page, start, (start[0] + 40, start[1] - 30))
    wait_for_scene(page, CLIP, "before the optimizer")
    dragged = page.evaluate(f"[...{PAD}.scene.markers.subarray(8, 10)]")
    told = "import json; print(json.dumps([author.scene.positions[4].tolist(), "
    told += "author.view.pad.undo_label, author.refined.before, author.refined.after]))"
    position, label, before, after = json.loads(in_kernel(page, told))
    np.testing.assert_allclose(position, dragged, atol=1e-12)
    assert label.startswith("move frame")
    assert after < before

    page.locator("[data-mode=draw]").click()
    box = page.locator(PLOT).bounding_box()
    page.mouse.move(box["x"] + 0.3 * box["width"], box["y"] + 0.4 * box["height"])
    page.mouse.down()
    for step in range(1, 25):
        x, y = 0.3 + 0.016 * step, 0.4 + 0.2 * np.sin(step / 5)
        page.mouse.move(box["x"] + x * box["width"], box["y"] + y * box["height"])
        page.evaluate("() => new Promise(requestAnimationFrame)")
    page.mouse.up()
    wait_for_scene(page, CLIP, "is yours")
    page.get_by_label("keep the feet from sliding").check()
    page.wait_for_function(f"{PAD}.model.get('roots').byteLength > 0")

    with page.expect_download() as saved:
        page.get_by_role("button", name="Save BVH").click()
    assert saved.value.suggested_filename == "01_03-walk.bvh"
    path = lab.folder / "drawn.bvh"
    saved.value.save_as(path)
    compared = in_kernel(
        page,
        "import numpy as np\n"
        "from workbench.datasets import load\n"
        f"read, motion = load({str(path)!r}), author.motion\n"
        "print(json.dumps([len(read), len(motion), author.scene.keep_feet,\n"
        "    float(np.abs(read.rotations - motion.rotations).max()),\n"
        "    float(np.abs(read.root_translation - motion.root_translation).max())]))",
    )
    n_read, n_frames, keep_feet, turned, moved = json.loads(compared)
    assert n_read == n_frames == len(load(str(path))) > 10
    assert keep_feet
    assert turned < 1e-8
    assert moved < 1e-8

    # Undo twice by keyboard: the trajectory is the clip's own again.
    page.locator(PLOT).focus()
    page.keyboard.press("Control+z")
    page.keyboard.press("Control+z")
    wait_for_scene(page, CLIP, "the clip’s own")
    assert in_kernel(page, "print(author.view.pad.redo_label, author.scene.keep_feet)") == (
        "draw False\n"
    )
    assert violations(page, ".jp-OutputArea-output:has(.wb-pad)") == []

    # The saved page needs neither kernel nor server: poses follow the mouse there, too.
    saved_page = lab.folder / "page.html"
    in_kernel(page, f"author.export_html({str(saved_page)!r}, title='A walk')")
    page.goto(saved_page.as_uri())
    assert page.get_by_role("heading", level=1).inner_text() == "A walk"
    page.locator(PLOT).scroll_into_view_if_needed()
    stage = "document.querySelector('.wb-pad-stage').toDataURL()"
    pictures = []
    for marker in (0, 4):
        place = f"[...{PAD}.scene.markers.subarray({2 * marker}, {2 * marker + 2})]"
        page.mouse.move(*pixel(page, page.evaluate(place)))
        pictures.append(page.evaluate(stage))
    assert pictures[0] != pictures[1]
    assert page.get_by_role("button", name="Undo").count() == 0
