"""The keyframe inspector: how keyframes of a motion are found, and what they rebuild."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.dashboards.inspection.controls import COMPONENTS, SIGMAS
from workbench.dashboards.inspection.jobs import ErrorCurve, KeyframeResult
from workbench.dashboards.inspection.live import LiveInspector
from workbench.dashboards.inspection.pictures import (
    FILMSTRIP,
    THUMBNAIL,
    check_picture_path,
    write_keyframes,
)
from workbench.dashboards.shared.sources import source_of
from workbench.errors import WorkbenchError
from workbench.spaces import PoseSpace
from workbench.validation import whole_number

Data = str | Path | PoseSpace


def inspect_keyframes(
    clip: Data = "cmu/01_01-jump",
    *,
    selector: str = "saliency",
    sigma: float = 10.0,
    components: int | None = None,
    contacts: bool = False,
    count: int | None = None,
    random_state: int = 0,
) -> KeyframeInspector:
    """Inspect keyframes of a motion in a dashboard.

    Parameters
    ----------
    clip : str, path-like or PoseSpace
        A motion's name, a file's path, or a motion in memory.
    selector : str
        Name of a selector.
    sigma : float
        σ of the saliency method in frames, 1 to 30. The thesis takes 7 to 10 for slow and at
        most 3 for fast motions, at 120 frames a second.
    components : int, optional
        k, its number of principal components, 1 to 30; by default as many as keep 90 % of the
        variance, but at least 7.
    contacts : bool
        Whether the saliency method handles moments at which a foot touches the ground: the
        heights of the feet are then two of the k curves, with a window of their own.
    count : int, optional
        How many keyframes; by default as many as the saliency method finds by its own rule.
    random_state : int
        Seed of a selector that draws at random.

    Returns
    -------
    KeyframeInspector
        Shown by a notebook as the last expression of a cell.

    Raises
    ------
    WorkbenchError
        If an argument is not valid. A clip that cannot be loaded is told in the dashboard.
    """
    return KeyframeInspector(
        clip,
        selector=selector,
        sigma=sigma,
        components=components,
        contacts=contacts,
        count=count,
        random_state=random_state,
    )


class KeyframeInspector:
    """A dashboard with the keyframes of a motion and what they rebuild.

    It computes beside the kernel; :meth:`finished` waits for that. Outside a notebook, where
    nothing could show progress, each change is computed before it returns.

    Parameters
    ----------
    clip, selector, sigma, components, contacts, count, random_state
        As for :func:`inspect_keyframes`.

    Attributes
    ----------
    controls : InspectorControls
        What can be chosen.
    view : InspectorView
        What is shown.
    """

    def __init__(
        self,
        clip: Data = "cmu/01_01-jump",
        *,
        selector: str = "saliency",
        sigma: float = 10.0,
        components: int | None = None,
        contacts: bool = False,
        count: int | None = None,
        random_state: int = 0,
    ) -> None:
        self._live = LiveInspector(source_of(clip))
        self.controls, self.view = self._live.controls, self._live.view
        self.selector, self.sigma, self.components = selector, sigma, components
        self.contacts, self.count = contacts, count
        self.controls.seed.value = whole_number("random_state", random_state, at_least=0)
        self._live.start()

    def _repr_mimebundle_(self, **kwargs: Any) -> Any:
        self._live.offer()
        return self.view.root._repr_mimebundle_(**kwargs)

    # What a notebook reads and sets.

    @property
    def result(self) -> KeyframeResult | None:
        """What is shown; None as long as there are no keyframes."""
        return self._live.plan.last

    @property
    def keyframes(self) -> NDArray[np.intp]:
        """The chosen frames, sorted; empty as long as there are none."""
        return (
            np.empty(0, dtype=np.intp)
            if self._live.plan.last is None
            else self._live.plan.last.keyframes
        )

    @property
    def errors(self) -> NDArray[np.float64]:
        """Error of each rebuilt frame per joint, in radians; empty as long as there are none."""
        return np.empty(0) if self._live.plan.last is None else self._live.plan.last.errors

    @property
    def psnr(self) -> float:
        """Peak signal-to-noise ratio of the joint angles in dB; not a number if unknown."""
        return float("nan") if self._live.plan.last is None else self._live.plan.last.psnr

    @property
    def error_curves(self) -> dict[str, ErrorCurve]:
        """Errors against the number of keyframes, by method, as far as they are there."""
        return self._live.plan.curves

    @property
    def message(self) -> str:
        """Why what was asked for is not shown; empty if it is."""
        return "; ".join(self._live.plan.told())

    @property
    def selector(self) -> str:
        """Name of the method; set it to choose another."""
        chosen: str = self.controls.selector.value
        return chosen

    @selector.setter
    def selector(self, name: str) -> None:
        self._live.selectors.factory(name)  # refuses it and says which there are
        self._live.offer()
        self.controls.selector.value = name

    @property
    def sigma(self) -> float:
        """σ of the saliency method, in frames."""
        sigma: float = self.controls.sigma.value
        return sigma

    @sigma.setter
    def sigma(self, sigma: float) -> None:
        if not isinstance(sigma, (int, float)) or not SIGMAS[0] <= sigma <= SIGMAS[1]:
            raise WorkbenchError(f"sigma: got {sigma!r}, want {SIGMAS[0]:g} to {SIGMAS[1]:g}")
        self.controls.sigma.value = sigma

    @property
    def components(self) -> int | None:
        """Number k of components of the saliency method; None if 90 % of the variance decides."""
        return self.controls.method.n_components

    @components.setter
    def components(self, components: int | None) -> None:
        if components is not None and not (
            COMPONENTS[0] <= whole_number("components", components) <= COMPONENTS[1]
        ):
            low, high = COMPONENTS
            raise WorkbenchError(f"components: got {components}, want {low} to {high}, or None")
        self.controls.set_components(components)

    @property
    def contacts(self) -> bool:
        """Whether the saliency method handles moments at which a foot touches the ground."""
        handled: bool = self.controls.contacts.value
        return handled

    @contacts.setter
    def contacts(self, contacts: bool) -> None:
        if not isinstance(contacts, (bool, np.bool_)):
            raise WorkbenchError(f"contacts: got {contacts!r}, want True or False")
        self.controls.contacts.value = bool(contacts)

    @property
    def count(self) -> int | None:
        """How many keyframes are wanted; None for as many as saliency finds."""
        return self.controls.wanted_count

    @count.setter
    def count(self, count: int | None) -> None:
        if count is not None:
            whole_number("count", count, at_least=2)
        self.controls.set_count(count)

    # What a notebook and a person do.

    async def finished(self) -> None:
        """Wait until everything is computed: ``await inspector.finished()``."""
        await self._live.finished()

    def open(self, clip: Data) -> None:
        """Show another clip; the one shown now stays if the new one cannot be loaded."""
        self._live.want(source_of(clip))

    def cancel(self) -> None:
        """End what is being computed; what is complete stays."""
        self._live.cancel()

    def recompute(self) -> None:
        """Compute what failed or was cancelled, or everything anew if nothing did.

        A file that was edited meanwhile is read again.
        """
        self._live.recompute()

    def save_filmstrip(self, path: str | Path) -> Path:
        """Write the filmstrip as SVG or PNG, by the name's ending; a file there is replaced."""
        return self._save(path, FILMSTRIP)

    def save_thumbnail(self, path: str | Path) -> Path:
        """Write the thumbnail as SVG or PNG, by the name's ending; a file there is replaced."""
        return self._save(path, THUMBNAIL)

    def close(self) -> None:
        """End the processes that compute, and take the dashboard out of the page."""
        self._live.close()

    def _save(self, path: str | Path, kind: str) -> Path:
        target = check_picture_path(path)
        clip, result = self._live.plan.clip, self._live.plan.last
        if clip is None or result is None:
            raise WorkbenchError("keyframes: got none so far, want some to draw")
        write_keyframes(target, kind, clip.motion, result.keyframes, clip.name)
        return target
