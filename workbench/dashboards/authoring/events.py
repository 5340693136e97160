"""What people do with the controls of the authoring dashboard."""

from __future__ import annotations

from typing import Any

from workbench.authoring import read_session, session_from_bytes
from workbench.dashboards.authoring.files import KINDS, content, file_stem
from workbench.dashboards.authoring.live import LiveAuthor, in_words
from workbench.dashboards.shared.home import Home
from workbench.dashboards.shared.sources import source_of


class AuthorEvents:
    """Pass on what people do, in the thread in which the dashboard was made.

    Parameters
    ----------
    live : LiveAuthor
        Who does it.
    """

    def __init__(self, live: LiveAuthor) -> None:
        self._live = live
        self._controls = live.controls
        here, controls, view = Home().here, live.controls, live.view
        view.pad.observe(here(lambda change: live.edit(change["new"])), "edit")
        view.files.on_msg(here(self._on_file))
        view.progress.cancel.on_click(here(lambda _: live.worker.cancel()))
        view.progress.again.on_click(here(lambda _: live.recompute()))
        controls.data.observe(here(self._on_clip), "value")
        controls.open.on_click(here(lambda _: self._open(controls.path.value)))
        controls.place.on_click(here(lambda _: live.place_anew()))
        controls.refine.observe(here(self._on_refine), "value")
        controls.keep_feet.observe(here(self._on_keep_feet), "value")
        controls.kernel.observe(here(self._on_kernel), "value")
        controls.follow.on_click(here(lambda _: self._on_follow()))
        controls.open_session.on_click(here(lambda _: self._on_session()))

    def _on_file(self, _: Any, message: dict[str, Any], buffers: list[memoryview]) -> None:
        if message.get("want") in KINDS:
            self._give(message["want"])
        elif message.get("given") and buffers:
            name, made = str(message.get("name")), bytes(buffers[0])
            live = self._live
            live.attempt(
                lambda: live.open_session(session_from_bytes(made, name), name, uploaded=True)
            )

    def _give(self, want: str) -> None:
        live, files = self._live, self._live.view.files
        try:
            made = content(want, live.clip, live.scene, live.view)
        except Exception as error:  # the person must be told, whatever it is
            files.fail(want, in_words(error))
            return
        ending, kind = KINDS[want]
        files.give(want, f"{file_stem(live.scene.clip)}{ending}", made, kind)

    def _on_clip(self, change: Any) -> None:
        if not self._controls.quiet:
            self._open(change["new"])

    def _open(self, name: str) -> None:
        if name.strip():
            self._live.want_placing(source_of(name))

    def _on_refine(self, change: Any) -> None:
        self._live.state.refines = change["new"]
        self._live.wake()

    def _on_keep_feet(self, change: Any) -> None:
        if not self._controls.quiet and self._live.state.scene is not None:
            self._live.attempt(lambda: self._live.keep_feet(change["new"]))

    def _on_kernel(self, change: Any) -> None:
        if not self._controls.quiet and self._live.state.scene is not None:
            self._live.set_kernel(change["new"])

    def _on_follow(self) -> None:
        if self._live.state.scene is not None:
            self._live.follow_clip()

    def _on_session(self) -> None:
        path = self._controls.session.value.strip()
        if path:
            self._live.attempt(lambda: self._live.open_session(read_session(path), path))
