"""Make the pictures of the dashboards for the README: ``python -m tests.browser.make_screenshots``.

The pictures come from JupyterLab with the notebooks and the bundled data, so that anyone can
make them again.
"""

from __future__ import annotations

import shutil
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

from tests.browser.chromium import Visit, open_browser
from tests.browser.lab import (
    Lab,
    choose_data,
    in_kernel,
    open_and_run,
    running_lab,
    wait_for_panels,
)
from tests.browser.test_author_journey import wait_for_scene
from tests.browser.test_explain_journey import wait_until_explained
from tests.browser.test_inspect_journey import wait_for_keyframes
from workbench.resources import bundled

DATA = "cmu/01_01-jump"
THEMES = {"light": "JupyterLab Light", "dark": "JupyterLab Dark"}


def main(folder: str = "docs/images") -> int:
    """Write a light and a dark picture of each dashboard to a folder."""
    target = Path(folder)
    target.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as temporary, open_browser() as browser:
        if browser is None:
            print("no chromium on this machine: cannot make pictures", file=sys.stderr)
            return 1
        notebooks = Path(temporary, "notebooks")
        shutil.copytree(bundled("notebooks"), notebooks)
        with running_lab(Path(temporary, "lab"), notebooks, {"WORKBENCH_DATA": ""}) as lab:
            for name, prepare in DASHBOARDS.items():
                viewport = {"width": 1280, "height": 2500}
                with Visit.to(browser, viewport=viewport) as visit:
                    picture_dashboard(visit.page, lab, name, prepare, target)
    return 0


def picture_dashboard(
    page: Any, lab: Lab, name: str, prepare: Callable[[Any], None], target: Path
) -> None:
    """Take pictures of a dashboard, as wide as a notebook is without the list of files."""
    open_and_run(page, lab, f"{name}.ipynb")
    page.evaluate("jupyterapp.commands.execute('application:toggle-left-area')")
    prepare(page)
    output = page.locator(".jp-OutputArea-output").first
    for name_of_theme, theme in THEMES.items():
        page.evaluate(
            "(theme) => jupyterapp.commands.execute('apputils:change-theme', { theme })", theme
        )
        wait_for_theme(page, name_of_theme)
        output.scroll_into_view_if_needed()
        output.screenshot(path=target / f"{name.replace('_', '-')}-{name_of_theme}.png")


def prepare_comparison(page: Any) -> None:
    """Show a motion, with some frames selected and one hovered."""
    wait_for_panels(page, "sample")
    choose_data(page, DATA)
    wait_for_panels(page, "frame")
    page.locator(".js-plotly-plot .gtitle").first.wait_for()
    page.locator(".wb-plot").first.scroll_into_view_if_needed()
    select_and_hover(page)


def prepare_explanation(page: Any) -> None:
    """Take the first steps of the first optimizer's way."""
    wait_until_explained(page, "pca with back-projector rbf")
    for _ in range(2):
        page.get_by_role("button", name="Step forward").click()


def prepare_inspection(page: Any) -> None:
    """Show a frame in the middle of the jump."""
    wait_for_keyframes(page, DATA)
    in_kernel(page, "await inspector.finished()")
    page.locator(".wb-player-stage").focus()
    for _ in range(4):
        page.keyboard.press("PageDown")


def prepare_authoring(page: Any) -> None:
    """Show the jump between two key poses."""
    wait_for_scene(page, DATA, "12 key poses")
    in_kernel(page, "await author.finished()")
    page.locator(".wb-pad .wb-player-bar").focus()
    for key in (*["PageDown"] * 6, "ArrowUp"):
        page.keyboard.press(key)


def wait_for_theme(page: Any, name: str) -> None:
    """Wait until the page and its plotly figures have the theme's colours."""
    light = str(name == "light").lower()
    page.wait_for_function(f"document.body.dataset.jpThemeLight === '{light}'")
    page.wait_for_function(
        """(dark) => [...document.querySelectorAll(".js-plotly-plot .gtitle")].every(
          ({ style }) => (Number(style.fill.match(/\\d+/)[0]) > 128) === dark
        )""",
        arg=name == "dark",
    )


def select_and_hover(page: Any) -> None:
    """Brush the first panel, then move to a frame with the keyboard."""
    box = page.locator(".wb-base").first.bounding_box()
    page.mouse.move(box["x"] + box["width"] * 0.05, box["y"] + box["height"] * 0.05)
    page.mouse.down()
    page.mouse.move(box["x"] + box["width"] * 0.5, box["y"] + box["height"] * 0.55, steps=4)
    page.mouse.up()
    page.mouse.move(0, 0)
    page.locator(".wb-plot").first.focus()
    page.keyboard.press("Home")
    for _ in range(16):
        page.keyboard.press("ArrowUp")


DASHBOARDS = {
    "compare_projections": prepare_comparison,
    "explain_optimizer": prepare_explanation,
    "inspect_keyframes": prepare_inspection,
    "author_motion": prepare_authoring,
}

if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
