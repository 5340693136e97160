"""Session files: a scene on disk, to go on with another day or on another machine.

A session is one JSON object in UTF-8. Numbers are written so that they read back as the same
ones. What was undone is not kept.

``format``
    ``"workbench authoring session"``.
``version``
    1. Other versions keep ``format``, ``version`` and ``checksum`` as they are here.
``checksum``
    SHA-256, in hexadecimal digits, of the object without this member, as JSON with sorted
    keys, without blanks and with nothing but ASCII.
``fingerprint``
    SHA-256 of the clip: its skeleton, rotations and path of the root, to six decimals. It
    tells whether a clip of that name is still the same.
``clip``
    Name of the clip in the catalogue, or path of its file.
``frame_time``
    Seconds between its frames.
``markers``
    For each spatial keyframe its ``name``, ``position`` (x, y), ``rotations`` (for each joint
    the rows of its matrix), ``root`` (x, y, z in file units) and ``frame``, null for a new
    pose.
``embedding``
    Place (x, y) of each frame of the clip.
``trajectory``
    ``points`` and ``times``, in seconds; ``points`` is null where they are the embedding's.
``follows``
    Whether they are and stay so when markers move.
``kernel``, ``epsilon``
    Of the spatial keyframes; ``epsilon`` is null for the usual width.
``keep_feet``
    Whether the feet are kept from sliding.
"""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from workbench.authoring.scene import Marker, Scene
from workbench.authoring.trajectories import Trajectory
from workbench.errors import DataError, WorkbenchError
from workbench.files import write_atomically
from workbench.mocap.fingerprint import clip_fingerprint
from workbench.mocap.motion import Motion, check_motion
from workbench.validation import as_numbers

FORMAT = "workbench authoring session"
VERSION = 1

# What content that lacks something or holds something else can cause.
_DAMAGE = (ArithmeticError, AttributeError, LookupError, RecursionError, TypeError, ValueError)


@dataclass(frozen=True, eq=False)
class Session:
    """What a session file holds.

    Attributes
    ----------
    scene : Scene
        The scene; its ``clip`` is what has to be loaded.
    fingerprint : str
        Of the clip that it was made with.
    """

    scene: Scene
    fingerprint: str

    def check(self, motion: Motion) -> None:
        """Refuse a clip other than the one that the session was made with.

        Parameters
        ----------
        motion : Motion
            What was found under the clip's name.

        Raises
        ------
        DataError
            If it has another skeleton or moves otherwise.
        """
        if clip_fingerprint(motion) != self.fingerprint:
            raise DataError(
                f"clip {self.scene.clip!r}: is not the one that the session was made with: "
                f"want {self.scene.n_frames} frames of {len(self.scene.markers[0].rotations)} "
                f"joints that move alike, got {len(motion)} of "
                f"{motion.skeleton.n_joints}"
            )


def save_session(scene: Scene, motion: Motion, path: str | Path) -> None:
    """Write a session file, replacing an older one only when the new one is whole.

    Parameters
    ----------
    scene : Scene
        The scene.
    motion : Motion
        Its clip.
    path : path-like
        The file.

    Raises
    ------
    WorkbenchError
        If the clip has other frames or joints than the scene.
    DataError
        If the file cannot be written.
    """
    content = session_bytes(scene, motion)
    path = Path(path)
    try:
        write_atomically(path, content)
    except OSError as error:
        raise DataError(f"{path}: cannot be written ({error.strerror})") from None


def session_bytes(scene: Scene, motion: Motion) -> bytes:
    """Give the content of a session file.

    Parameters
    ----------
    scene : Scene
        The scene.
    motion : Motion
        Its clip.

    Returns
    -------
    bytes

    Raises
    ------
    WorkbenchError
        If the clip has other frames or joints than the scene.

    Examples
    --------
    >>> from workbench import load_space
    >>> from workbench.authoring import scene_on_circle
    >>> jump = load_space("cmu/01_01-jump")
    >>> scene = scene_on_circle(jump, selector="uniform", count=6)
    >>> session = session_from_bytes(session_bytes(scene, jump.motion))
    >>> session.scene.equals(scene), session.check(jump.motion)
    (True, None)
    """
    check_motion(motion)
    wanted = (scene.n_frames, len(scene.markers[0].rotations))
    if np.shape(motion.rotations)[:2] != wanted:
        raise WorkbenchError(
            f"clip {motion.name!r}: got {len(motion)} frames of {motion.skeleton.n_joints} "
            f"joints, want {wanted[0]} of {wanted[1]} as the scene has"
        )
    content: dict[str, Any] = {
        "format": FORMAT,
        "version": VERSION,
        "fingerprint": clip_fingerprint(motion),
        **_scene_to_json(scene),
    }
    content["checksum"] = _checksum(content)
    return json.dumps(content, allow_nan=False).encode() + b"\n"


def read_session(path: str | Path) -> Session:
    """Read a session file.

    Parameters
    ----------
    path : path-like
        The file.

    Returns
    -------
    Session
        Its scene equals the one that was saved to the last bit.

    Raises
    ------
    DataError
        If it is missing, damaged, truncated, no session or of a later version.
    """
    path = Path(path)
    try:
        content = path.read_bytes()
    except OSError as error:
        raise DataError(f"{path}: cannot be read ({error.strerror})") from None
    return session_from_bytes(content, str(path))


def session_from_bytes(content: bytes, name: str = "session") -> Session:
    """Read the content of a session file.

    Parameters
    ----------
    content : bytes
        The content.
    name : str
        What to call it in messages.

    Returns
    -------
    Session

    Raises
    ------
    DataError
        As :func:`read_session`.
    """
    try:
        parts = json.loads(content.decode(), parse_constant=_refuse_constant)
    except _DAMAGE:
        raise DataError(f"{name}: is damaged, cut off or no authoring session") from None
    if not isinstance(parts, dict) or parts.get("format") != FORMAT:
        raise DataError(f"{name}: is no authoring session")
    checksum = parts.pop("checksum", None)
    try:
        whole = checksum == _checksum(parts)
    except _DAMAGE:
        whole = False
    if not whole:
        raise DataError(f"{name}: is damaged: its content does not have its checksum")
    if parts.get("version") != VERSION:
        raise DataError(
            f"{name}: is of version {parts.get('version')!r}, this program reads {VERSION}"
        )
    try:
        return Session(_scene_from_json(parts), _text(parts["fingerprint"]))
    except WorkbenchError as error:
        raise DataError(f"{name}: holds no valid scene ({error})") from None
    except _DAMAGE as error:
        raise DataError(f"{name}: holds no valid scene ({type(error).__name__}: {error})") from None


def _scene_to_json(scene: Scene) -> dict[str, Any]:
    trajectory = scene.trajectory
    return {
        "clip": scene.clip,
        "frame_time": scene.frame_time,
        "markers": [
            {
                "name": marker.name,
                "position": marker.position.tolist(),
                "rotations": marker.rotations.tolist(),
                "root": marker.root.tolist(),
                "frame": marker.frame,
            }
            for marker in scene.markers
        ],
        "embedding": scene.embedding.tolist(),
        "trajectory": {
            "points": None if scene.follows else trajectory.points.tolist(),
            "times": trajectory.times.tolist(),
        },
        "follows": scene.follows,
        "kernel": scene.kernel,
        "epsilon": scene.epsilon,
        "keep_feet": scene.keep_feet,
    }


def _scene_from_json(parts: dict[str, Any]) -> Scene:
    embedding = as_numbers("embedding", parts["embedding"])
    points, times = parts["trajectory"]["points"], parts["trajectory"]["times"]
    markers = [
        Marker(m["position"], m["rotations"], m["root"], m["frame"], _text(m["name"]))
        for m in parts["markers"]
    ]
    return Scene(
        _text(parts["clip"]),
        parts["frame_time"],
        tuple(markers),
        embedding,
        Trajectory(embedding if points is None else points, times),
        parts["follows"],
        parts["kernel"],
        parts["epsilon"],
        parts["keep_feet"],
    )


def _checksum(parts: dict[str, Any]) -> str:
    text = json.dumps(parts, sort_keys=True, separators=(",", ":"), allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise TypeError(f"got {value!r}, want text")
    return value


def _refuse_constant(name: str) -> NoReturn:
    raise ValueError(f"{name} is no number")
