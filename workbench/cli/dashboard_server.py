"""The dashboards as pages: Voila with an index, and nothing from the network."""

from __future__ import annotations

import shutil
import tempfile
import webbrowser
from importlib.metadata import version
from pathlib import Path
from typing import Any

from voila.app import Voila

from workbench.cli.dashboards import DASHBOARDS, describe_dashboard
from workbench.resources import bundled

_TEMPLATES = Path(__file__).with_name("templates")


class DashboardServer(Voila):
    """Voila that shows an index of dashboards and loads nothing from the network."""

    template_paths: list[str]

    def setup_template_dirs(self) -> None:
        """Let our templates come before Voila's."""
        super().setup_template_dirs()
        self.template_paths = [str(_TEMPLATES), *self.template_paths]

    def init_settings(self) -> dict[str, Any]:
        """Tell the index what there is."""
        settings: dict[str, Any] = super().init_settings()
        paths = [Path(self.root_dir, f"{name}.ipynb") for name in DASHBOARDS]
        settings["voila_jinja2_env"].globals.update(
            dashboards=[describe_dashboard(path) for path in paths],
            version=version("workbench"),
        )
        return settings

    def launch_browser(self) -> None:
        """Open the address with its token; Voila's own opening ends at the login page."""
        webbrowser.open(self.display_url)


def serve_dashboards(options: list[str]) -> None:
    """Serve the dashboards until interrupted.

    Parameters
    ----------
    options : list of str
        Options for Voila, which come after ours.
    """
    with tempfile.TemporaryDirectory(prefix="workbench-app-") as folder:
        # A folder of their own, so that no other notebook can be run by its address.
        for name in DASHBOARDS:
            shutil.copy(bundled("notebooks") / f"{name}.ipynb", folder)
        DashboardServer.launch_instance(
            [
                folder,
                "--Voila.ip=127.0.0.1",
                "--Voila.auto_token=True",
                "--VoilaConfiguration.classic_tree=True",
                # Another template would bring its links to the network back.
                "--VoilaConfiguration.allow_template_override=NO",
                # A page that is closed leaves its kernel behind; one that is open keeps it.
                "--MappingKernelManager.cull_idle_timeout=60",
                "--MappingKernelManager.cull_interval=20",
                *options,
            ]
        )
