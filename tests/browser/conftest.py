"""Chromium for tests: a page that must stay on this machine and out of trouble."""

from __future__ import annotations

import base64
import os
import shutil
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from tests.browser.chromium import Visit, open_browser
from tests.browser.lab import Lab, running_lab
from workbench.resources import bundled


@pytest.fixture(scope="package")
def browser() -> Iterator[Any]:
    """Start Chromium; a missing one fails in CI and is a reported skip elsewhere.

    It ends with the package because Playwright keeps an event loop running, in which other
    tests could start none.
    """
    with open_browser() as found:
        if found is None:
            reason = "no chromium on this machine: the browser tests cannot run"
            if os.environ.get("CI") == "true":
                pytest.fail(reason)
            pytest.skip(reason)
        yield found


@pytest.fixture(scope="package")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Lab]:
    """Start JupyterLab on a copy of all notebooks, with the bundled data only."""
    notebooks = tmp_path_factory.mktemp("all") / "notebooks"
    shutil.copytree(bundled("notebooks"), notebooks)
    folder = tmp_path_factory.mktemp("lab")
    environment = {"WORKBENCH_DATA": "", "WORKBENCH_CACHE": str(folder / "cache")}
    with running_lab(folder, notebooks, environment) as lab:
        yield lab


@pytest.fixture
def visit(browser: Any) -> Iterator[Visit]:
    """Open a page, and check at the end that it left no trace outside or in the console."""
    with Visit.to(browser) as visit:
        yield visit
        assert visit.strayed == []
        assert visit.complaints == []


@pytest.fixture
def calm(visit: Visit) -> None:
    """Let nothing glide: what Python sends is shown at once."""
    visit.page.emulate_media(reduced_motion="reduce")


_MOUNT = """
async ({esm, css, state, width}) => {
  const style = document.createElement("style");
  style.textContent = css;
  document.head.append(style);
  for (const [name, text] of Object.entries(state.binary)) {
    const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    // Bytes in a message start anywhere, so they do here.
    const padded = new Uint8Array(bytes.length + 3);
    padded.set(bytes, 3);
    state.plain[name] = new DataView(padded.buffer, 3);
  }
  const listeners = {};
  const model = {
    saved: 0,
    get: (name) => state.plain[name],
    set(name, value) {
      state.plain[name] = value;
      for (const act of listeners[`change:${name}`] ?? []) act();
    },
    save_changes() { this.saved += 1; },
    on: (event, act) => (listeners[event] ??= []).push(act),
    send: () => listeners["msg:custom"].slice().forEach((receive) => window.answer(receive)),
    off: (event, act) => { listeners[event] = (listeners[event] ?? []).filter((a) => a !== act); },
  };
  const el = document.createElement("div");
  el.style.width = `${width}px`;
  document.body.append(el);
  const address = URL.createObjectURL(new Blob([esm], {type: "text/javascript"}));
  const module = await import(address);
  const end = await module.default.render({model, el});
  (window.mounted ??= []).push({model, el, end});
  await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
}
"""


@pytest.fixture
def mount(visit: Visit) -> Callable[..., Any]:
    """Render widgets in the page with models that need no kernel."""

    def render(widget: Any, width: int = 700) -> Any:
        plain, binary = {}, {}
        for name, value in widget.get_state().items():
            if isinstance(value, bytes):
                binary[name] = base64.b64encode(value).decode()
            elif not name.startswith("_") and name not in ("layout", "tabbable", "tooltip"):
                plain[name] = value
        state = {"plain": plain, "binary": binary}
        css = str(getattr(widget, "_css", ""))
        arguments = {"esm": str(widget._esm), "css": css, "state": state, "width": width}
        visit.page.evaluate(_MOUNT, arguments)
        return visit.page

    return render
