"""Files that the authoring dashboard makes and reads."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np

from workbench.authoring import Scene, play, session_bytes
from workbench.dashboards.authoring.jobs import Clip
from workbench.dashboards.authoring.session import played
from workbench.dashboards.authoring.view import AuthorView
from workbench.errors import DataError, WorkbenchError
from workbench.files import write_atomically
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


def content(
    want: str, clip: Clip, scene: Scene, view: AuthorView, *, title: str = "", text: str = ""
) -> bytes:
    """Make a file.

    Parameters
    ----------
    want : {"bvh", "session", "html"}
        Which.
    clip, scene : Clip and Scene
        What is shown.
    view : AuthorView
        The views of it.
    title, text : str
        Heading of a page, and words below it; by default those of the view's fields.

    Raises
    ------
    WorkbenchError
        If there is no such kind, or the motion cannot be written.
    """
    if want == "session":
        return session_bytes(scene, clip.space.motion)
    if want == "html":
        title = title.strip() or view.title.value.strip() or f"Poses of {file_stem(scene.clip)}"
        text = text.strip() or view.text.value.strip() or _TEXT
        known = played(scene, clip.space)  # what the view has may be of the scene before
        view.pad.roots = known.roots if scene.keep_feet else np.empty(0)
        view.show_feet(clip, scene, known)
        views = [view.pad, view.feet] if len(view.feet.rows) else [view.pad]
        return html_page(views, title=title, text=text).encode()
    if want != "bvh":
        raise WorkbenchError(f"file: got {want!r}, want one of {', '.join(KINDS)}")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "motion.bvh")
        write_bvh(play(scene, clip.space), path)
        return path.read_bytes()


def save(path: str | Path, ending: str, make: Callable[[], bytes]) -> Path:
    """Write a file.

    Parameters
    ----------
    path : path-like
        Its name; a file that exists is replaced.
    ending : str
        How the name has to end.
    make : callable
        Gives what to write.

    Raises
    ------
    WorkbenchError
        If the name ends otherwise.
    DataError
        If the file cannot be written.
    """
    target = Path(path)
    if target.suffix.lower() != ending:
        raise WorkbenchError(f"path: got {str(path)!r}, want a name that ends in {ending}")
    made = make()
    try:
        write_atomically(target, made)
    except OSError as error:
        raise DataError(f"{target}: cannot be written ({error.strerror})") from None
    return target


def file_stem(clip: str) -> str:
    """Make a file's name, without its ending, of a clip's name or path."""
    last = clip.replace("\\", "/").rpartition("/")[2].partition(".")[0]
    return "".join(c if c.isalnum() or c in "-_" else "-" for c in last) or "clip"
