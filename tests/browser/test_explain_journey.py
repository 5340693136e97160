"""What a person does with the explained optimizer in JupyterLab."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest

from tests.browser.axe import violations
from tests.browser.chromium import Visit
from tests.browser.lab import Lab, choose_data, in_kernel, open_and_run

pytestmark = pytest.mark.browser

NOTEBOOK = "explain_optimizer.ipynb"
_STATE = """
import json
trace, landscape = explanation.trace, explanation.landscape
print(json.dumps({
    "sample": explanation.sample, "step": explanation.step, "optimizer": explanation.optimizer,
    "back_projector": explanation.back_projector, "data": explanation.plane.name,
    "position": trace.positions[explanation.step].tolist(),
    "errors": trace.errors.tolist(), "followed": trace.sample,
    "lowest": landscape.minimum[1], "message": explanation.message,
    "embedding": explanation.plane.embedding.tolist(),
}))
"""


def wait_until_explained(page: Any, words: str) -> None:
    """Wait until the map and all ways of what is named in words are there."""
    page.get_by_text(words).first.wait_for()
    page.wait_for_function(
        """() => {
          const ways = [...document.querySelectorAll(".wb-land-optimizers button")];
          return ways.length >= 3 && ways.every((way) => way.innerText.includes("→")) &&
            document.querySelector(".wb-land-base").style.opacity === "1" &&
            document.querySelector(".wb-land .wb-message").textContent === "" &&
            document.querySelector(".wb-status").textContent === "";
        }"""
    )


def state(page: Any) -> dict[str, Any]:
    return json.loads(in_kernel(page, _STATE))


def test_a_sample_is_picked_followed_and_rebuilt_by_another_method(lab: Lab, visit: Visit) -> None:
    """Choose a clip, pick a frame, step, hover, swap the back-projector; Python knows it all."""
    page = visit.page
    open_and_run(page, lab, NOTEBOOK)
    wait_until_explained(page, "pca with back-projector rbf")
    assert state(page)["data"] == "uci/wine"

    choose_data(page, "cmu/01_01-jump")
    wait_until_explained(page, "with back-projector spatial-keyframes")
    number = page.get_by_label("Frame", exact=True)
    number.fill("130")
    number.press("Enter")
    page.get_by_text("frame 130").first.wait_for()
    wait_until_explained(page, "with back-projector spatial-keyframes")

    page.get_by_role("button", name="Step forward").click()
    words = page.locator(".wb-land-text").inner_text()
    assert words.startswith("Iteration 1. Probes")
    page.get_by_role("button", name="Step forward").click()
    known = state(page)
    assert known["sample"] == known["followed"] == 130
    assert known["step"] == 2
    assert known["message"] == ""
    place = page.locator(".wb-land-readout").inner_text()
    assert "place {:.3f}, {:.3f}".format(*known["position"]) in place
    shown = page.locator(".wb-rec-detail").inner_text()
    error = float(f"{known['errors'][2]:.3g}")
    assert shown.startswith(f"error {error:g} at")

    plot = page.locator(".wb-land-base")
    plot.scroll_into_view_if_needed()
    box = plot.bounding_box()
    page.mouse.move(box["x"] + 0.8 * box["width"], box["y"] + 0.3 * box["height"])
    assert page.locator(".wb-rec-detail").inner_text() != shown

    # The frame that lies furthest from all others, so that the mouse can mean no other.
    embedding = np.array(known["embedding"])
    between = np.linalg.norm(embedding[:, None] - embedding, axis=2)
    np.fill_diagonal(between, np.inf)
    alone = int(between.min(axis=1).argmax())
    low, high = embedding.min(axis=0), embedding.max(axis=0)
    part = (embedding[alone] - (low + high) / 2) / (1.5 * (high - low).max()) + 0.5
    page.mouse.click(box["x"] + part[0] * box["width"], box["y"] + (1 - part[1]) * box["height"])
    page.get_by_text(f"frame {alone}").first.wait_for()
    assert in_kernel(page, "print(explanation.sample)").strip() == str(alone)

    in_kernel(page, "explanation.sample = 130")
    page.get_by_label("Back-projector", exact=True).select_option(label="knn")
    wait_until_explained(page, "with back-projector knn")
    page.get_by_role("button", name="Local search").click()
    page.wait_for_function("document.querySelector('.wb-rec-detail').textContent !== ''")
    swapped = state(page)
    assert swapped["back_projector"] == "knn"
    assert swapped["optimizer"] == "local"
    assert swapped["errors"] != known["errors"]
    assert violations(page, ".jp-OutputArea-output") == []
    assert page.get_by_text("The browser cannot evaluate this back-projector").is_visible()

    in_kernel(
        page,
        "from sklearn.neighbors import KNeighborsRegressor\n"
        "explanation.back_projector = KNeighborsRegressor(3)",
    )
    wait_until_explained(page, "with back-projector KNeighborsRegressor(n_neighbors=3)")
    assert state(page)["message"] == ""
