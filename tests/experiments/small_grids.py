"""Small grids for tests, what of their tables does not depend on the clock, and processes."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import pandas as pd

from workbench.experiments.runs.schemes import SchemeRun
from workbench.schemes import SpatialScheme

RAW = SpatialScheme("pca", selector="random")
OPTIMIZED = SpatialScheme("pca", selector="random", optimizer="alg12")
PAIR = [SchemeRun("uci/iris", RAW, ratio=0.05), SchemeRun("uci/iris", OPTIMIZED, ratio=0.05)]
TIMES = ("seconds_", "version_")


def untimed(table: pd.DataFrame) -> pd.DataFrame:
    """Leave out of a table what differs from one time to the next."""
    return table[[name for name in table.columns if not name.startswith(TIMES)]]


def in_fresh_process(code: str, *arguments: object, **options: Any) -> subprocess.Popen:
    """Start Python with the tests' helpers at hand."""
    return subprocess.Popen(
        [sys.executable, "-c", code, *map(str, arguments)],
        cwd=Path(__file__).parents[2],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        **options,
    )
