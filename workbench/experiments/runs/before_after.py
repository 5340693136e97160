"""Runs of an optimized scheme that also measure what it was like before optimization."""

from __future__ import annotations

import warnings
from dataclasses import dataclass, replace

from workbench.errors import WorkbenchError
from workbench.experiments.runs.schemes import SchemeRun
from workbench.experiments.runs.shared import SharedSteps
from workbench.experiments.store import Arrays, Row
from workbench.schemes import SpatialScheme


@dataclass(frozen=True)
class BeforeAfterRun(SchemeRun):
    """An optimized spatial scheme, and its error before optimization.

    Projecting in two steps starts from the control points, so that nothing is shared with a
    run of the scheme without an optimizer, which would project once more. One run that
    measures both halves the work, and compares them from the very same positions.

    Parameters
    ----------
    dataset, scheme, ratio, count, seed, standardize
        As for :class:`~workbench.experiments.runs.schemes.SchemeRun`.

    Raises
    ------
    WorkbenchError
        If the scheme has no optimizer, or has its own choice of markers.

    Examples
    --------
    >>> scheme = SpatialScheme("pca", selector="rols", two_step="rbfp", optimizer="alg12")
    >>> print(BeforeAfterRun("uci/iris", scheme, ratio=0.03))
    uci/iris, pca + alg12, rbfp, rols, 3 %, seed 0
    """

    def __post_init__(self) -> None:
        super().__post_init__()
        scheme = self.scheme
        if not isinstance(scheme, SpatialScheme) or not scheme.optimizer or scheme.markers:
            raise WorkbenchError(
                f"run on {self.dataset!r}: got {scheme}, want a spatial scheme with an optimizer "
                "that leaves the markers"
            )

    def execute(self, shared: SharedSteps) -> tuple[Row, Arrays]:
        """Execute the run.

        Parameters
        ----------
        shared : SharedSteps
            The space and what is known of it already.

        Returns
        -------
        row : dict
            As for :class:`~workbench.experiments.runs.schemes.SchemeRun`, and
            ``projected_error``, the mean error before optimization.
        arrays : dict of str to ndarray
            Likewise, and ``projected_errors`` (n_samples,).
        """
        row, arrays = super().execute(shared)
        assert isinstance(self.scheme, SpatialScheme)
        unoptimized = replace(self.scheme, optimizer=None, two_step=None)
        with warnings.catch_warnings():
            # What there is to warn of was told when the optimized scheme ran.
            warnings.simplefilter("ignore")
            before = unoptimized.run(
                shared.space,
                ratio=self.ratio,
                count=self.count,
                random_state=self.seed,
                projected=arrays["projected"],
            )
        row["projected_error"] = before.error
        arrays["projected_errors"] = before.errors
        return row, arrays
