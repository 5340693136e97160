"""What a run is, and the key under which its result is found again."""

from __future__ import annotations

import hashlib
import json
import sys
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from workbench.experiments.runs.shared import SharedSteps
from workbench.experiments.store import Arrays, Row
from workbench.experiments.versions import code_digest, versions
from workbench.spaces import PoseSpace, Space


class Run(Protocol):
    """Something to compute on one data set, described so that its result can be found again.

    A run is a frozen dataclass of plain values: it is hashed, compared, sent to another
    process, and its values are stored with its result.
    """

    @property
    def dataset(self) -> str:
        """Name that :func:`workbench.load_space` knows, or the path of a file."""

    @property
    def standardize(self) -> bool:
        """Whether the columns of a table are brought to unit variance first."""

    def __hash__(self) -> int:
        """Hash the values."""

    def specification(self) -> dict[str, Any]:
        """Describe the run by values that JSON can hold, which become columns of the table."""

    def execute(self, shared: SharedSteps) -> tuple[Row, Arrays]:
        """Compute the values of the run, and arrays that do not fit a row of a table."""


def content_key(run: Run, checksum: str) -> str:
    """Compute the key under which a run's result is stored.

    It changes with everything that may change the result: the run, the data, the code of
    this package that computes, and the versions of the packages that it computes with. A
    method registered from outside under the same name with other code behind it is not
    noticed; give it another name.

    Parameters
    ----------
    run : Run
        The run.
    checksum : str
        Checksum of the data, see :func:`space_checksum`.

    Returns
    -------
    str
        SHA-256 in hexadecimal digits.
    """
    kind = type(run)
    content = {
        "kind": f"{kind.__module__}.{kind.__qualname__}",
        "run": run.specification(),
        "data": checksum,
        "code": [code_digest(), _digest_of_kind(kind.__module__)],
        "versions": versions(),
    }
    canonical = json.dumps(content, sort_keys=True, separators=(",", ":"), ensure_ascii=True)
    return hashlib.sha256(canonical.encode()).hexdigest()


def _digest_of_kind(module: str) -> str:
    """Compute a digest of the module of a kind of run that is not of this package.

    Those of this package are among the code that counts for every run; a kind that was typed
    into a notebook has no module.
    """
    source = getattr(sys.modules[module], "__file__", None)
    if module.startswith("workbench.") or not source:
        return ""
    return hashlib.sha256(Path(source).read_bytes()).hexdigest()


def space_checksum(space: Space) -> str:
    """Compute a checksum of the samples of a space and of what a run can know of them.

    Parameters
    ----------
    space : Space
        The samples.

    Returns
    -------
    str
        SHA-256 in hexadecimal digits.
    """
    digest = hashlib.sha256(type(space).__name__.encode())
    parts: list[NDArray[np.float64]] = [space.samples]
    if isinstance(space, PoseSpace):
        motion = space.motion
        skeleton = motion.skeleton
        parts += [space.weights, skeleton.offsets, motion.root_translation]
        parts.append(np.array([motion.frame_time]))
    for part in parts:
        digest.update(str(part.shape).encode())
        digest.update(np.ascontiguousarray(part, dtype="<f8").tobytes())
    return digest.hexdigest()
