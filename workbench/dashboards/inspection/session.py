"""What the keyframe inspector computes beside the kernel."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.dashboards.inspection.jobs import (
    Clip,
    CountErrors,
    ErrorCurve,
    Extraction,
    Job,
    KeyframeResult,
    LeastErrors,
    Method,
    Selectors,
)
from workbench.dashboards.inspection.pictures import (
    FILMSTRIP,
    THUMBNAIL,
    fitting_keyframes,
    keyframe_svg,
)
from workbench.dashboards.shared.background import Report
from workbench.dashboards.shared.remarks import said_by_warnings
from workbench.dashboards.shared.sources import Source, load_source
from workbench.errors import WorkbenchError
from workbench.mocap.foot_contacts import foot_contacts
from workbench.quality.animation import psnr
from workbench.schemes import TemporalScheme
from workbench.selection.optimal import Optimal
from workbench.selection.saliency import Saliency
from workbench.spaces import PoseSpace

#: Numbers of keyframes on an error curve, and the range of the largest.
_POINTS, _FEW, _MANY, _SHARE = 12, 12, 60, 0.1


class InspectorSession:
    """Do the inspector's jobs, remembering the clip."""

    def __init__(self) -> None:
        self._source: Source | None = None
        self._space: PoseSpace | None = None

    def answer(self, job: Job, methods: Selectors, *, report: Report) -> Any:
        """Do a job; see :mod:`workbench.dashboards.inspection.jobs` for what each gives."""
        if isinstance(job, Source):
            return self.load(job, report=report)
        if isinstance(job, Extraction):
            return self.extract(job, methods, report=report)
        if isinstance(job, CountErrors):
            return self.measure_counts(job, methods, report=report)
        return self.least_errors(job, report=report)

    def load(self, source: Source, *, report: Report) -> Clip:
        """Load a motion.

        Raises
        ------
        WorkbenchError
            If it is none.
        """
        space = self._load(source, report)
        report("finding the feet", 0.8)
        notes: tuple[str, ...] = ()
        try:
            contacts = foot_contacts(space.motion)
        except WorkbenchError:
            contacts, notes = [], ("no contacts are marked: the feet were not found",)
        return Clip(source.name, space.motion, contacts, notes)

    def extract(self, job: Extraction, methods: Selectors, *, report: Report) -> KeyframeResult:
        """Choose keyframes and rebuild the clip from them."""
        space = self._load(job.source, report)
        with said_by_warnings() as said:
            report("measuring saliency", 0.1)
            by_saliency = Saliency(
                job.method.sigma, job.method.n_components, contacts=job.method.contacts
            )
            saliency = by_saliency.measure(space.motion)
            count = job.count
            if count is None and job.method.selector != "saliency":
                count = len(by_saliency.select(space))
            report(f"choosing keyframes by {job.method.selector}", 0.3)
            result = _scheme(job.method, methods).run(
                space, count=count, random_state=job.method.seed
            )
        rebuilt = replace(space.motion, rotations=result.reconstruction)
        try:
            ratio = psnr(space.motion, result.reconstruction)
        except WorkbenchError as error:
            ratio = float("nan")
            said.append(f"no PSNR: {error}")
        report("drawing the keyframes", 0.7)
        keyframes = result.control_points
        shown = fitting_keyframes(keyframes)
        if len(shown) < len(keyframes):
            said.append(f"pictures show {len(shown)} of {len(keyframes)} keyframes")
        # The first and the last frame are keyframes whatever the feet do.
        inner = keyframes[1:-1] if job.method.selector == "saliency" else keyframes[:0]
        drawing = (space.motion, keyframes, job.source.name)
        return KeyframeResult(
            keyframes=keyframes,
            reconstruction=rebuilt,
            errors=result.errors,
            psnr=ratio,
            saliency=saliency,
            foot_keyframes=inner[saliency.foot_candidates[inner]],
            filmstrip=keyframe_svg(FILMSTRIP, *drawing),
            thumbnail=keyframe_svg(THUMBNAIL, *drawing),
            seconds=result.timings.total,
            notes=tuple(dict.fromkeys(said)),
        )

    def measure_counts(self, job: CountErrors, methods: Selectors, *, report: Report) -> ErrorCurve:
        """Rebuild the clip from several numbers of keyframes."""
        space = self._load(job.source, report)
        scheme = _scheme(job.method, methods)
        counts = counts_to_measure(len(space))
        errors = []
        with said_by_warnings():
            for done, count in enumerate(counts.tolist()):
                report(f"error of {count} keyframes by {job.method.selector}", done / len(counts))
                result = scheme.run(space, count=count, random_state=job.method.seed)
                errors.append(result.error)
        return ErrorCurve(counts, np.array(errors))

    def least_errors(self, job: LeastErrors, *, report: Report) -> ErrorCurve:
        """Find the best keyframes for every number at once."""
        space = self._load(job.source, report)
        most = int(counts_to_measure(len(space))[-1])
        report("finding the best keyframes of all, for comparison", None)
        path = Optimal().path(space, most)
        return ErrorCurve(path.counts, path.objectives / len(space))

    def _load(self, source: Source, report: Report) -> PoseSpace:
        if self._space is None or source != self._source:
            report(f"loading {source.name}", None)
            space, _ = load_source(source)
            if not isinstance(space, PoseSpace):
                raise WorkbenchError(f"{source.name}: got a table, want a motion")
            self._source, self._space = source, space
        return self._space


def counts_to_measure(n_frames: int) -> NDArray[np.intp]:
    """Choose numbers of keyframes for a curve, closer together where they are small.

    Up to a tenth of the frames, but at least 12 and at most 60.
    """
    most = min(n_frames - 1, max(_FEW, min(_MANY, round(_SHARE * n_frames))))
    return np.unique(np.geomspace(min(3, most), most, _POINTS).round().astype(np.intp))


def _scheme(method: Method, methods: Selectors) -> TemporalScheme:
    if method.selector == "saliency":
        selector = methods.registry.create(
            "saliency",
            sigma=method.sigma,
            n_components=method.n_components,
            contacts=method.contacts,
        )
    else:
        selector = methods.registry.create(method.selector)
    return TemporalScheme("slerp", selector)
