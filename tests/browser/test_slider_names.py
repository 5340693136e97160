"""Handles of ipywidgets' sliders get the names that ipywidgets leaves out."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from tests.browser.chromium import Visit
from workbench.widgets.slider_names import SliderNames

pytestmark = pytest.mark.browser

# What ipywidgets makes of a slider with a description.
_SLIDER = """
(words) => {
  const box = document.createElement("div");
  box.className = "widget-slider";
  box.innerHTML = `<label class="widget-label">${words}</label>
    <div class="noUi-handle" role="slider" tabindex="0" aria-valuenow="1"
         aria-valuemin="0" aria-valuemax="2"></div>`;
  document.body.append(box);
}
"""


def test_sliders_are_named_whenever_they_come(mount: Callable, visit: Visit) -> None:
    """Those that are there, those that come later, and those whose description changes."""
    visit.page.evaluate(_SLIDER, "first")
    page = mount(SliderNames())
    page.evaluate(_SLIDER, "second")
    for name in ("first", "second"):
        page.get_by_role("slider", name=name, exact=True).wait_for(state="attached")
    page.evaluate("document.querySelector('.widget-label').textContent = 'other'")
    page.get_by_role("slider", name="other", exact=True).wait_for(state="attached")


def test_it_ends_with_its_view(mount: Callable, visit: Visit) -> None:
    """A view that was closed names nothing any more."""
    page = mount(SliderNames())
    page.evaluate("mounted[0].end()")
    page.evaluate(_SLIDER, "late")
    page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
    assert page.locator(".noUi-handle").get_attribute("aria-label") is None
