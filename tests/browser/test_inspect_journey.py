"""What a person does with the keyframe inspector in JupyterLab."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.browser.axe import violations
from tests.browser.chromium import Visit
from tests.browser.lab import Lab, in_kernel, open_and_run

pytestmark = pytest.mark.browser

NOTEBOOK = "inspect_keyframes.ipynb"
CLIP = "cmu/01_03-walk"


def wait_for_keyframes(page: Any, name: str, count: int | None = None) -> None:
    """Wait until pictures of so many keyframes of a clip are shown."""
    words = rf"{count or '[0-9]+'} key poses of {name} side by side"
    page.wait_for_function(
        """(words) => {
          const picture = document.querySelector(".wb-player-picture");
          return picture && !picture.hidden && new RegExp(words).test(picture.alt);
        }""",
        arg=words,
    )


def test_choose_a_clip_and_a_count_then_play_and_read_the_keyframes_back(
    lab: Lab, visit: Visit
) -> None:
    """Clip, σ and count are chosen in the page; the kernel knows them; both motions play."""
    page = visit.page
    open_and_run(page, lab, NOTEBOOK)
    wait_for_keyframes(page, "cmu/01_01-jump")

    options = page.get_by_label("Clip", exact=True).locator("option").all_inner_texts()
    walk = next(text for text in options if text.startswith(f"{CLIP}:"))
    page.get_by_label("Clip", exact=True).select_option(label=walk)
    wait_for_keyframes(page, CLIP)

    # ipywidgets makes the slider's handle a slider for the keyboard, and gives it no name.
    page.get_by_role("slider", name="σ in frames").focus()
    page.keyboard.press("ArrowLeft")
    page.get_by_text("9.5", exact=True).wait_for()
    in_kernel(page, "await inspector.finished()")

    page.get_by_label("handle foot contacts").check()
    page.get_by_text("curves are feet").wait_for()
    assert violations(page, ".jp-OutputArea-output") == []

    page.locator(".wb-player-counts").scroll_into_view_if_needed()
    page.locator(".wb-player-counts").focus()
    before = int(page.locator(".wb-player-counts").get_attribute("aria-valuenow"))
    page.keyboard.press("ArrowRight")
    picked = int(page.locator(".wb-player-counts").get_attribute("aria-valuenow"))
    assert picked == before + 1
    wait_for_keyframes(page, CLIP, picked)

    stage = page.locator(".wb-player-stage")
    stage.scroll_into_view_if_needed()
    stage.focus()
    page.keyboard.press("Home")
    page.keyboard.press(" ")
    page.wait_for_function(
        "document.querySelector('.wb-player-time') && "
        "Number(document.querySelector('.wb-player-bar').getAttribute('aria-valuenow')) > 3"
    )
    page.keyboard.press(" ")
    shown = page.locator(".wb-player-names span").all_inner_texts()
    assert shown == ["original", "reconstruction"]
    bar, curves = (
        page.locator(place).get_attribute("aria-valuenow")
        for place in (".wb-player-bar", ".wb-player-curves [role=slider]")
    )
    assert bar == curves

    page.wait_for_function("document.querySelector('.wb-player-toggle').innerText === 'Play'")
    answer = in_kernel(
        page,
        "import json; print(json.dumps([inspector.keyframes.tolist(), len(inspector.errors), "
        "inspector.psnr, inspector.sigma, inspector.count, inspector.view.player.frame, "
        "inspector.contacts]))",
    )
    keyframes, n_errors, psnr, sigma_now, count, frame, contacts = json.loads(answer)
    assert len(keyframes) == count == picked
    assert (keyframes[0], keyframes[-1]) == (0, n_errors - 1)
    assert psnr > 30
    assert sigma_now == 9.5
    assert contacts is True
    assert str(frame) == bar

    # The next keyframe after the one shown, by keyboard.
    page.keyboard.press("PageDown")
    expected = next(key for key in keyframes if key > frame)
    assert page.locator(".wb-player-bar").get_attribute("aria-valuenow") == str(expected)

    with page.expect_download() as saved:
        page.get_by_role("button", name="Save PNG").first.click()
    assert saved.value.suggested_filename == f"01_03-walk-{count}-filmstrip.png"
    assert Path(saved.value.path()).read_bytes().startswith(b"\x89PNG")
