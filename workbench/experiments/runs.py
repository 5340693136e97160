"""Runs: one scheme on one data set, described so that a result can be found again."""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.errors import WorkbenchError
from workbench.experiments.versions import code_digest, versions
from workbench.schemes import SpatialScheme, TemporalScheme
from workbench.spaces import PoseSpace, Space

Scheme = TemporalScheme | SpatialScheme


@dataclass(frozen=True)
class Run:
    """One scheme on one data set, at one number of control points, from one seed.

    Parameters
    ----------
    dataset : str
        Name that :func:`workbench.load_space` knows, or the path of a file.
    scheme : TemporalScheme or SpatialScheme
        Its methods are given by their registered names: an object could not be stored with
        the result, nor told apart from another when the result is looked up.
    ratio : float, optional
        Share of the samples that become control points, between 0 and 1.
    count : int, optional
        Their number, in place of a ratio.
    seed : int
        Seed of the selector, the projector and the optimizer, where they take one.
    standardize : bool
        Whether the columns of a table are brought to unit variance first.

    Raises
    ------
    WorkbenchError
        If a method is not a name, or not exactly one of ratio and count is given.

    Examples
    --------
    >>> print(Run("uci/iris", SpatialScheme("pca", optimizer="alg12"), ratio=0.03))
    uci/iris, pca + alg12, 3 %, seed 0
    """

    dataset: str
    scheme: Scheme
    ratio: float | None = None
    count: int | None = None
    seed: int = 0
    standardize: bool = False

    def __post_init__(self) -> None:
        if (self.ratio is None) == (self.count is None):
            raise WorkbenchError(f"run on {self.dataset!r}: want exactly one of ratio and count")
        for step, method in asdict(self.scheme).items():
            # The number of dimensions is no method.
            if step != "dimensions" and not (method is None or isinstance(method, str)):
                raise WorkbenchError(
                    f"{step} of a run: got {type(method).__name__}, want a registered name "
                    "(see workbench.register_projector and its like)"
                )

    def __str__(self) -> str:
        amount = f"{self.count} control points" if self.ratio is None else f"{self.ratio:.4g}"
        if self.ratio is not None:
            amount = f"{100 * self.ratio:.4g} %"
        scaling = ", standardized" if self.standardize else ""
        return f"{self.dataset}{scaling}, {scheme_name(self.scheme)}, {amount}, seed {self.seed}"

    def specification(self) -> dict[str, Any]:
        """Describe the run by plain values, as stored with its result."""
        return {
            "dataset": self.dataset,
            "kind": "temporal" if isinstance(self.scheme, TemporalScheme) else "spatial",
            **asdict(self.scheme),
            "ratio": self.ratio,
            "count": self.count,
            "seed": self.seed,
            "standardize": self.standardize,
        }


def scheme_name(scheme: Scheme) -> str:
    """Name a scheme after its methods.

    Examples
    --------
    >>> scheme_name(SpatialScheme("tsne", selector="uniform", optimizer="alg12"))
    'tsne + alg12, uniform'
    """
    if isinstance(scheme, TemporalScheme):
        return f"{scheme.interpolator}, {scheme.selector}"
    parts = [f"{scheme.projector} + {scheme.optimizer}" if scheme.optimizer else scheme.projector]
    parts += [part for part in (scheme.two_step, scheme.selector, scheme.back_projector) if part]
    if scheme.dimensions is not None:
        parts.append(f"{scheme.dimensions}-D")
    if scheme.markers:
        parts.append(f"{scheme.markers} markers")
    return ", ".join(str(part) for part in parts)


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
    content = {
        "run": run.specification(),
        "data": checksum,
        "code": code_digest(),
        "versions": versions(),
    }
    canonical = json.dumps(content, sort_keys=True, separators=(",", ":"), ensure_ascii=True)
    return hashlib.sha256(canonical.encode()).hexdigest()


def space_checksum(space: Space) -> str:
    """Compute a checksum of the samples of a space and of what their distance depends on.

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
        parts.append(space.weights)
    for part in parts:
        digest.update(str(part.shape).encode())
        digest.update(np.ascontiguousarray(part, dtype="<f8").tobytes())
    return digest.hexdigest()
