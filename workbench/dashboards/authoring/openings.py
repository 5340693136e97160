"""Sessions of files, on the way into the authoring dashboard."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from workbench.authoring import Session
from workbench.dashboards.authoring.jobs import Clip
from workbench.dashboards.authoring.state import Opening, Step
from workbench.dashboards.shared.sources import source_of
from workbench.errors import DataError

#: Stands in a script for a session of a file that a script cannot read.
UPLOADED = "# scene: the one of {name!r}, a session that was uploaded"


def opening_of(session: Session, path: str, shown: Clip | None, *, uploaded: bool) -> Opening:
    """Say what opening a session needs, and how its scene is made.

    Parameters
    ----------
    session : Session
        What the file holds.
    path : str
        The file, or its name if it was uploaded.
    shown : Clip or None
        The clip that is shown. It may be in memory only, or have had another path when the
        session was saved.
    uploaded : bool
        Whether the file came from the browser.

    Returns
    -------
    Opening
    """
    scene = session.scene
    code = [UPLOADED.format(name=path) if uploaded else f"scene = read_session({path!r}).scene"]
    if shown is not None and shown.source.name != scene.clip and _is_of(session, shown):
        scene = replace(scene, clip=shown.source.name)
        code.append(f"scene = replace(scene, clip={scene.clip!r})")
    same = shown is not None and shown.source.name == scene.clip
    source = shown.source if shown is not None and same else source_of(scene.clip)
    step = Step("\n".join(code), None)
    return Opening(source, scene, session.check, f"open {Path(path).name}", step)


def _is_of(session: Session, clip: Clip) -> bool:
    try:
        session.check(clip.space.motion)
    except DataError:
        return False
    return True
