"""Runs that leave a line in a log and wait where told, for tests of workers elsewhere."""

from __future__ import annotations

import os
import signal
import time
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from workbench.experiments.runs.shared import SharedSteps


@dataclass(frozen=True)
class LoggedRun:
    """Project a data set, having written number and process to a log.

    ``waits`` stays in the run until the file ``go`` is there; ``dies`` ends the process.
    """

    dataset: str
    number: int
    folder: str
    act: str = ""
    standardize: bool = False

    def __str__(self) -> str:
        return f"run {self.number}"

    def specification(self) -> dict[str, Any]:
        return asdict(self)

    def execute(self, shared: SharedSteps) -> tuple[dict[str, Any], dict[str, Any]]:
        folder = Path(self.folder)
        with (folder / "log").open("a") as file:
            file.write(f"{self.number} {os.getpid()}\n")
        if self.act == "waits":
            while not (folder / "go").exists():
                time.sleep(0.02)
        if self.act == "dies":
            os.kill(os.getpid(), signal.SIGKILL)
        projection = shared.projection("pca", self.number % 2)
        row = {"n_samples": len(shared.space), "stress": projection.quality.stress}
        return row, {"embedding": projection.embedding}


def log_lines(folder: Path) -> list[tuple[int, int]]:
    """Read number and process of each run that was begun."""
    log = folder / "log"
    lines = log.read_text().splitlines() if log.exists() else []
    return [(int(number), int(process)) for number, process in map(str.split, lines)]
