"""Start JupyterLab with a folder of notebooks, away from the user's own settings."""

from __future__ import annotations

import json
import os
import secrets
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import workbench

_LIMIT = 90  # seconds


@dataclass(frozen=True)
class Lab:
    """A running JupyterLab.

    Attributes
    ----------
    address : str
        Where it listens, on the loopback.
    token : str
        What lets a browser in.
    folder : Path
        Its notebooks.
    """

    address: str
    token: str
    folder: Path

    def page(self, notebook: str) -> str:
        """Address of a notebook in a workspace of its own."""
        return f"{self.address}lab/tree/{notebook}?reset&token={self.token}"


@contextmanager
def running_lab(folder: Path, notebooks: Path, environment: dict[str, str]) -> Iterator[Lab]:
    """Start JupyterLab on a folder and end it with everything that it started.

    Parameters
    ----------
    folder : Path
        An empty folder for settings and logs.
    notebooks : Path
        The notebooks to serve.
    environment : dict of str to str
        Variables for the server and its kernels, beside those of this process.
    """
    settings = folder / "config" / "labconfig"
    settings.mkdir(parents=True)
    # Asking for news would leave the machine.
    quiet = {"disabledExtensions": {"@jupyterlab/apputils-extension:announcements": True}}
    (settings / "page_config.json").write_text(json.dumps(quiet))
    env = {
        **os.environ,
        "JUPYTER_CONFIG_DIR": str(folder / "config"),
        "JUPYTER_DATA_DIR": str(folder / "data"),
        "JUPYTER_RUNTIME_DIR": str(folder / "runtime"),
        "JUPYTERLAB_SETTINGS_DIR": str(folder / "settings"),
        "JUPYTERLAB_WORKSPACES_DIR": str(folder / "workspaces"),
        "IPYTHONDIR": str(folder / "ipython"),
        "PYTHONPATH": str(Path(workbench.__file__).parents[1]),
        **environment,
    }
    token = secrets.token_hex(16)
    command = [sys.executable, "-m", "jupyterlab", "--no-browser", "--allow-root", "--port=0"]
    command += ["--ip=127.0.0.1", f"--IdentityProvider.token={token}", "--expose-app-in-browser"]
    command += [f"--ServerApp.root_dir={notebooks}"]
    with (folder / "lab.log").open("w") as log:
        process = subprocess.Popen(
            command, env=env, stdout=log, stderr=log, cwd=notebooks, start_new_session=True
        )
        try:
            address = _address(folder, process)
            yield Lab(address, token, notebooks)
        finally:
            os.killpg(process.pid, signal.SIGTERM)
            try:
                process.wait(15)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()


def _address(folder: Path, process: subprocess.Popen[bytes]) -> str:
    """Wait until the server has written down where it listens."""
    deadline = time.monotonic() + _LIMIT
    while time.monotonic() < deadline and process.poll() is None:
        for record in (folder / "runtime").glob("jpserver-*.json"):
            text = record.read_text()
            if text.endswith("}"):
                return json.loads(text)["url"].replace("localhost", "127.0.0.1")
        time.sleep(0.1)
    raise RuntimeError(f"JupyterLab did not start:\n{(folder / 'lab.log').read_text()[-2000:]}")


def open_and_run(page: Any, lab: Lab, notebook: str) -> None:
    """Open a notebook in the page and run all its cells."""
    page.set_default_timeout(_LIMIT * 1000)
    page.goto(lab.page(notebook))
    page.wait_for_function("window.jupyterapp?.shell?.currentWidget?.context?.isReady")
    page.evaluate(
        """async () => {
          await jupyterapp.shell.currentWidget.context.sessionContext.ready;
          await jupyterapp.commands.execute("notebook:run-all-cells");
        }"""
    )


def wait_for_panels(page: Any, word: str) -> None:
    """Wait until the comparison shows embeddings of samples that are called so."""
    page.locator(".wb-plot").first.wait_for()
    page.wait_for_function(
        r"""(word) => {
          const plots = [...document.querySelectorAll(".wb-plot")];
          const some = new RegExp(`\\b[1-9]\\d* ${word}s`);
          return !document.querySelector(".wb-busy, .wb-failed") &&
            plots.every((plot) => some.test(plot.getAttribute("aria-label")));
        }""",
        arg=word,
    )


def choose_data(page: Any, name: str) -> None:
    """Choose a data set in the comparison's drop-down."""
    options = page.get_by_label("Data", exact=True).locator("option").all_inner_texts()
    label = next(text for text in options if text.startswith(f"{name}:"))
    page.get_by_label("Data", exact=True).select_option(label=label)


def in_kernel(page: Any, code: str) -> str:
    """Run code in the notebook's kernel and give what it prints."""
    return page.evaluate(
        """async (code) => {
          const { kernel } = jupyterapp.shell.currentWidget.context.sessionContext.session;
          const future = kernel.requestExecute({ code });
          let printed = "";
          future.onIOPub = ({ header, content }) => {
            if (header.msg_type === "stream") printed += content.text;
            if (header.msg_type === "error") printed += `${content.ename}: ${content.evalue}`;
          };
          await future.done;
          return printed;
        }""",
        code,
    )
