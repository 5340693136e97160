"""A grid whose third projection waits for a file, for tests that interrupt it.

python -m tests.experiments.slow_grid RESULTS LOG GO
"""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path

import pandas as pd

from workbench.experiments.grid import run_grid
from workbench.experiments.runs.schemes import SchemeRun
from workbench.projection import register_projector
from workbench.projection.pca import PCA
from workbench.schemes import SpatialScheme

#: Seeds tell the runs apart.
SEEDS = range(5)
RUNS = [
    SchemeRun("uci/iris", SpatialScheme("logged", selector="random"), ratio=0.05, seed=s)
    for s in SEEDS
]


def run(results: Path, log: Path, go: Path) -> pd.DataFrame:
    """Run the grid in this process; each projection leaves a line in the log."""

    class Logged(PCA):
        def _project(self, X):
            with log.open("a") as file:
                file.write(f"{os.getpid()}\n")
            if len(log.read_text().splitlines()) == 3:
                while not go.exists():
                    time.sleep(0.02)
            return super()._project(X)

    register_projector("logged", Logged)
    return run_grid(RUNS, results)


if __name__ == "__main__":
    run(*map(Path, sys.argv[1:4]))
