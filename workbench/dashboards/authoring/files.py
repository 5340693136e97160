"""Files that the authoring dashboard makes and reads."""

from __future__ import annotations

import tempfile
from pathlib import Path

from workbench.authoring import Scene, play, session_bytes
from workbench.dashboards.authoring.jobs import Clip
from workbench.dashboards.authoring.view import AuthorView
from workbench.errors import WorkbenchError
from workbench.mocap.bvh_writer import write_bvh
from workbench.widgets.export import html_page

#: What there is to save: the ending of its name, and its media type.
KINDS = {
    "bvh": (".bvh", "text/plain"),
    "session": (".session.json", "application/json"),
    "html": (".html", "text/html"),
}

_TEXT = (
    "Each point of the plane is a pose: move the mouse over it to see which. Black-bordered "
    "markers are key poses; the curve, coloured by time, is the motion that plays."
)


def content(want: str, clip: Clip, scene: Scene, view: AuthorView) -> bytes:
    """Make a file.

    Parameters
    ----------
    want : {"bvh", "session", "html"}
        Which.
    clip, scene : Clip and Scene
        What is shown.
    view : AuthorView
        The views of it.

    Raises
    ------
    WorkbenchError
        If there is no such kind, or the motion cannot be written.
    """
    if want == "session":
        return session_bytes(scene, clip.space.motion)
    if want == "html":
        title = view.title.value.strip() or f"Poses of {file_stem(scene.clip)}"
        views = [view.pad, view.feet] if len(view.feet.rows) else [view.pad]
        return html_page(views, title=title, text=view.text.value.strip() or _TEXT).encode()
    if want != "bvh":
        raise WorkbenchError(f"file: got {want!r}, want one of {', '.join(KINDS)}")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "motion.bvh")
        write_bvh(play(scene, clip.space), path)
        return path.read_bytes()


def file_stem(clip: str) -> str:
    """Make a file's name, without its ending, of a clip's name or path."""
    last = clip.replace("\\", "/").rpartition("/")[2].partition(".")[0]
    return "".join(c if c.isalnum() or c in "-_" else "-" for c in last) or "clip"
