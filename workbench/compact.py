"""The compact file of a motion: what is needed to rebuild it from its keyframes.

The file is a ZIP archive of NumPy arrays (``numpy.load`` opens it) with these members:

``header``
    JSON in UTF-8 bytes: ``format`` ("workbench compact motion"), ``version`` (1), ``name``,
    ``frame_time`` in seconds, ``n_frames``, ``interpolator`` (a name, or null where the
    frames are rebuilt from positions), ``names``, ``channels``, ``unit_cm``,
    ``end_site_names``.
``parents``, ``offsets``, ``end_site_joints``, ``end_site_offsets``
    The skeleton; offsets in file units as float64.
``keyframes``
    Frame numbers, int32.
``keys``
    float32, one row for each keyframe: what the interpolator keeps, or rotation vectors in
    radians.
``root_translation``
    float32, one row for each frame, in file units.
``embedding``
    float32, one row for each frame; missing where an interpolator is named.

Rounding to float32 changes rotations by at most 4e-7 radians and positions by 6e-8 of their
size.
"""

from __future__ import annotations

import io
import json
import zipfile
import zlib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.backprojection.poses import SpatialKeyframes
from workbench.errors import DataError, WorkbenchError
from workbench.files import write_atomically
from workbench.interpolation import Interpolator, interpolators
from workbench.mocap.motion import Motion
from workbench.mocap.rotations import rotation_vectors, rotations_from_vectors
from workbench.mocap.skeleton import EndSite, Skeleton
from workbench.results import Result, SpatialResult
from workbench.spaces import PoseSpace
from workbench.validation import as_embedding, control_point_indices

FORMAT = "workbench compact motion"
VERSION = 1

_ZIP_START = b"PK\x03\x04"
# What NumPy and zipfile raise on damaged archives; a changed flag asks for a password
# (RuntimeError) or for an unknown compression (NotImplementedError).
_DAMAGE = (
    OSError,
    EOFError,
    KeyError,
    TypeError,
    ValueError,
    RuntimeError,
    NotImplementedError,
    zipfile.BadZipFile,
    zlib.error,
)


@dataclass(frozen=True, eq=False)
class CompactMotion:
    """A motion reduced to keyframes and what tells the other frames.

    Attributes
    ----------
    skeleton : Skeleton
        The joints.
    frame_time : float
        Time between frames, in seconds.
    name : str
        The clip's name.
    root_translation : ndarray of shape (n_frames, 3)
        World position of the root, in file units.
    keyframes : ndarray of shape (n_keys,)
        Sorted frame indices.
    keys : ndarray of shape (n_keys, n_values)
        What the interpolator keeps, or rotation vectors of all joints in radians.
    interpolator : str or None
        Registered name; None where the frames are rebuilt from their positions.
    embedding : ndarray of shape (n_frames, n_dimensions) or None
        Position of each frame.
    """

    skeleton: Skeleton
    frame_time: float
    name: str
    root_translation: NDArray[np.float64]
    keyframes: NDArray[np.intp]
    keys: NDArray[np.float64]
    interpolator: str | None
    embedding: NDArray[np.float64] | None

    def expand(self) -> Motion:
        """Rebuild all frames.

        Returns
        -------
        Motion
        """
        n_frames = len(self.root_translation)
        if self.interpolator is not None:
            interpolator: Interpolator = interpolators.create(self.interpolator)
            rotations = interpolator.decode(self.keys, self.keyframes, n_frames, self.skeleton)
        else:
            assert self.embedding is not None
            poses = rotations_from_vectors(self.keys.reshape(len(self.keys), -1, 3))
            markers = self.embedding[self.keyframes]
            rotations = SpatialKeyframes().fit(markers, poses).predict(self.embedding)
            rotations[self.keyframes] = poses
        return Motion(
            self.skeleton, rotations, self.root_translation, self.frame_time, name=self.name
        )


def compact_motion(result: Result, interpolator: str | None = None) -> CompactMotion:
    """Take from the result of a scheme what is needed to rebuild the motion.

    Parameters
    ----------
    result : Result
        Of a spatial scheme with spatial keyframes, or of a temporal one.
    interpolator : str, optional
        The temporal scheme's interpolator.

    Returns
    -------
    CompactMotion

    Raises
    ------
    WorkbenchError
        If the result is no motion's, was made by another back-projector, or the motion
        moves joints other than the root.
    """
    if not isinstance(result.space, PoseSpace):
        raise WorkbenchError("result: got that of a table, want that of a motion")
    motion, keyframes = result.space.motion, result.control_points
    if motion.joint_translations:
        raise WorkbenchError(
            f"motion {motion.name!r}: moves joints other than the root, "
            "which a compact file does not hold"
        )
    embedding = None
    if interpolator is not None:
        keys = interpolators.create(interpolator).encode(motion, keyframes)
    elif isinstance(result, SpatialResult) and isinstance(result.back_projector, SpatialKeyframes):
        keys = rotation_vectors(motion.rotations[keyframes]).reshape(len(keyframes), -1)
        embedding = result.embedding
    else:
        raise WorkbenchError("result: want a temporal scheme's, or one of spatial keyframes")
    return CompactMotion(
        motion.skeleton,
        motion.frame_time,
        motion.name,
        motion.root_translation,
        keyframes,
        keys,
        interpolator,
        embedding,
    )


def write_compact(compact: CompactMotion, path: str | Path) -> int:
    """Write a compact file, replacing an older one only when the new one is whole.

    Parameters
    ----------
    compact : CompactMotion
        What to write.
    path : path-like
        The file.

    Returns
    -------
    int
        Size of the file in bytes.
    """
    skeleton = compact.skeleton
    header = {
        "format": FORMAT,
        "version": VERSION,
        "name": compact.name,
        "frame_time": compact.frame_time,
        "n_frames": len(compact.root_translation),
        "interpolator": compact.interpolator,
        "names": skeleton.names,
        "channels": skeleton.channels,
        "unit_cm": skeleton.unit_cm,
        "end_site_names": [site.name for site in skeleton.end_sites],
    }
    arrays: dict[str, NDArray[Any]] = {
        "header": np.frombuffer(json.dumps(header).encode(), dtype=np.uint8),
        "parents": skeleton.parents.astype(np.int32),
        "offsets": skeleton.offsets,
        "end_site_joints": np.array([site.joint for site in skeleton.end_sites], dtype=np.int32),
        "end_site_offsets": np.array([s.offset for s in skeleton.end_sites]).reshape(-1, 3),
        "keyframes": compact.keyframes.astype(np.int32),
        "keys": compact.keys.astype(np.float32),
        "root_translation": compact.root_translation.astype(np.float32),
    }
    if compact.embedding is not None:
        arrays["embedding"] = compact.embedding.astype(np.float32)
    buffer = io.BytesIO()
    np.savez_compressed(buffer, allow_pickle=False, **arrays)
    write_atomically(Path(path), buffer.getvalue())
    return buffer.getbuffer().nbytes


def read_compact(path: str | Path) -> CompactMotion:
    """Read a compact file.

    Parameters
    ----------
    path : path-like
        The file.

    Returns
    -------
    CompactMotion

    Raises
    ------
    DataError
        If it is missing, damaged, truncated, no compact file, or of a later version.
    """
    path = Path(path)
    try:
        with path.open("rb") as file:
            # NumPy takes what does not begin so for a pickle, and advises to load it unsafely.
            if file.read(len(_ZIP_START)) != _ZIP_START:
                raise DataError(f"{path}: is damaged or no compact file (no ZIP archive)")
        # Members carry a checksum, so damage does not go unseen.
        with np.load(path, allow_pickle=False) as archive:
            arrays = {name: archive[name] for name in archive.files}
        header = json.loads(arrays["header"].tobytes())
        if header["format"] != FORMAT:
            raise DataError(f"{path}: is of format {header['format']!r}, want {FORMAT!r}")
        if header["version"] != VERSION:
            raise DataError(
                f"{path}: is of version {header['version']}, this program reads {VERSION}"
            )
        return _assemble(header, arrays)
    except FileNotFoundError:
        raise DataError(f"{path}: there is no such file") from None
    except DataError:
        raise
    except _DAMAGE as error:
        reason = str(error).partition("\n")[0] or type(error).__name__
        raise DataError(f"{path}: is damaged or no compact file ({reason})") from None


def _assemble(header: dict[str, Any], arrays: dict[str, NDArray[Any]]) -> CompactMotion:
    """Put a compact motion together from a file's parts, checking that they fit."""
    sites = zip(
        arrays["end_site_joints"].tolist(),
        arrays["end_site_offsets"],
        header["end_site_names"],
        strict=True,
    )
    skeleton = Skeleton(
        names=tuple(header["names"]),
        parents=arrays["parents"].astype(np.intp),
        offsets=arrays["offsets"],
        end_sites=tuple(EndSite(*site) for site in sites),
        channels=tuple(tuple(channels) for channels in header["channels"]),
        unit_cm=header["unit_cm"],
    )
    n_frames = header["n_frames"]
    keyframes = control_point_indices(arrays["keyframes"], n_frames)
    keys = arrays["keys"].astype(np.float64)
    root_translation = arrays["root_translation"].astype(np.float64)
    interpolator, embedding = header["interpolator"], None
    if interpolator is None:
        embedding = as_embedding(arrays["embedding"], n=n_frames)
    else:
        interpolators.factory(interpolator)
    if keys.ndim != 2 or len(keys) != len(keyframes) or root_translation.shape != (n_frames, 3):
        raise ValueError("the number of frames or keyframes is not that of the header")
    return CompactMotion(
        skeleton,
        header["frame_time"],
        header["name"],
        root_translation,
        keyframes,
        keys,
        interpolator,
        embedding,
    )
