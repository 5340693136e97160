r"""The compact file, byte by byte.

All numbers are little-endian.

======  =====  ==============================================================================
offset  bytes  content
======  =====  ==============================================================================
0       8      signature ``89 57 42 43 0D 0A 1A 0A``, in which line ends and the eighth bit
               show what a transfer as text has done
8       2      version, 2
10      …      DEFLATE stream with zlib's frame
end−4   4      CRC-32 of all bytes before
======  =====  ==============================================================================

Every version begins with the first two and ends with the last. So no damage of up to 32 bits
in a row goes unseen, and what is of a later version is known to be whole.

The stream holds the length of the header in 4 bytes, the header, and the arrays, one after
the other. The header is JSON in UTF-8:

``name``, ``frame_time``
    The clip's name; seconds between frames.
``skeleton``
    ``names``, ``parents`` (−1 for the root), ``offsets`` in file units, ``channels`` (BVH
    channel names of each joint, or the number of an earlier joint that has the same),
    ``end_sites`` (joint, offset and name of each), ``unit_cm`` or null.
``interpolator``
    A name, or null where frames are rebuilt from positions.
``back_projector``
    Parameters of the spatial keyframes: ``kernel``, ``epsilon``, ``smoothing``, ``centers``.
``moved_joints``
    Joints, other than the root, whose positions are kept.
``scheme_error``, ``error``
    Error per frame per joint before rounding and of what the file gives.
``arrays``
    For each array its ``name``, ``shape`` (rows, columns), ``step``, ``bound`` (the most by
    which a number differs from what it was: half a step, or 0 for frame numbers), ``origin``
    if that is not 0, and how its bytes were made: ``differences`` and ``width``, see
    :class:`workbench.compact.coding.Coded`.

The arrays are ``keyframes`` (frame numbers), ``keys``, ``path`` and, where there is no
interpolator, ``embedding``, as :class:`workbench.compact.motion.CompactMotion` describes
them. A number is its column's origin plus a whole number of steps.
"""

from __future__ import annotations

import json
import struct
import zlib
from pathlib import Path
from typing import Any

import numpy as np

from workbench.backprojection.poses import SpatialKeyframes
from workbench.compact.coding import Coded, decode, encode
from workbench.compact.motion import CompactMotion
from workbench.compact.quantization import Quantized
from workbench.errors import DataError
from workbench.files import write_atomically
from workbench.interpolation import interpolators
from workbench.mocap.skeleton import EndSite, Skeleton
from workbench.validation import as_embedding, control_point_indices

SIGNATURE = b"\x89WBC\r\n\x1a\n"
VERSION = 2

_START = struct.Struct("<8sH")
_LENGTH = struct.Struct("<I")
# What a header that lacks something or holds something else can cause.
_DAMAGE = (
    OSError,
    ArithmeticError,
    AttributeError,
    LookupError,
    RecursionError,
    TypeError,
    ValueError,
    struct.error,
    zlib.error,
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
    content = compact_bytes(compact)
    write_atomically(Path(path), content)
    return len(content)


def compact_bytes(compact: CompactMotion) -> bytes:
    """Give the content of a compact file.

    Parameters
    ----------
    compact : CompactMotion
        What it holds.

    Returns
    -------
    bytes
    """
    arrays = {
        "keyframes": Quantized(compact.keyframes.astype(np.int64)[:, None], 1.0, np.zeros(1)),
        "keys": compact.keys,
        "path": compact.path,
    }
    if compact.embedding is not None:
        arrays["embedding"] = compact.embedding
    entries, parts = [], []
    for name, array in arrays.items():
        coded = encode(array.counts)
        entries.append(_entry(name, array, coded))
        parts.append(coded.content)
    header = {
        "name": compact.name,
        "frame_time": compact.frame_time,
        "skeleton": _skeleton_to_json(compact.skeleton),
        "interpolator": compact.interpolator,
        "back_projector": dict(compact.back_projector),
        "moved_joints": list(compact.moved_joints),
        "scheme_error": compact.scheme_error,
        "error": compact.error,
        "arrays": entries,
    }
    text = json.dumps(header, separators=(",", ":"), ensure_ascii=False, allow_nan=False).encode()
    body = zlib.compress(b"".join([_LENGTH.pack(len(text)), text, *parts]), 9)
    content = _START.pack(SIGNATURE, VERSION) + body
    return content + _LENGTH.pack(zlib.crc32(content))


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
        If it is missing, damaged, truncated, no compact file, of a later version, or made
        with an interpolator that is not registered here.
    """
    path = Path(path)
    try:
        content = path.read_bytes()
        if content[: len(SIGNATURE)] != SIGNATURE:
            raise ValueError("another signature")
        if len(content) < _START.size + _LENGTH.size:
            raise ValueError("it ends too early")
        (checksum,) = _LENGTH.unpack(content[-_LENGTH.size :])
        if zlib.crc32(content[: -_LENGTH.size]) != checksum:
            raise ValueError("another checksum")
        _, version = _START.unpack_from(content)
        if version != VERSION:
            raise DataError(f"{path}: is of version {version}, this program reads {VERSION}")
        return _parse(content[_START.size : -_LENGTH.size], path)
    except FileNotFoundError:
        raise DataError(f"{path}: there is no such file") from None
    except DataError:
        raise
    except _DAMAGE as error:
        reason = getattr(error, "strerror", None) or str(error).partition("\n")[0]
        raise DataError(
            f"{path}: is damaged or no compact file ({reason or type(error).__name__})"
        ) from None


def _parse(stream: bytes, path: Path) -> CompactMotion:
    """Put a compact motion together from a file's parts, checking that they fit."""
    body = memoryview(zlib.decompress(stream))
    (length,) = _LENGTH.unpack_from(body)
    start = _LENGTH.size + length
    header = json.loads(bytes(body[_LENGTH.size : start]))
    arrays: dict[str, Quantized] = {}
    for entry in header["arrays"]:
        n_rows, n_columns = entry["shape"]
        end = start + n_rows * n_columns * entry["width"]
        coded = Coded(bytes(body[start:end]), entry["differences"], entry["width"])
        origin = np.array(entry.get("origin", [0.0] * n_columns), dtype=np.float64)
        counts = decode(coded, (n_rows, n_columns))
        arrays[entry["name"]] = Quantized(counts, float(entry["step"]), origin)
        start = end
    if start != len(body):
        raise ValueError("more bytes than the header tells of")

    skeleton = _skeleton_from_json(header["skeleton"])
    keys, track = arrays["keys"], arrays["path"]
    n_frames, moved = len(track.counts), tuple(header["moved_joints"])
    keyframes = control_point_indices(arrays["keyframes"].counts[:, 0], n_frames)
    interpolator, embedding = header["interpolator"], None
    if interpolator is None:
        embedding = arrays["embedding"]
        as_embedding(embedding.values, n=n_frames)
        SpatialKeyframes(**header["back_projector"])  # which refuses what it does not know
    elif interpolator not in interpolators:
        known = ", ".join(interpolators.names())
        raise DataError(f"{path}: needs interpolator {interpolator!r}, here are {known}")
    fits = len(keys.counts) == len(keyframes) and track.counts.shape[1] == 3 * (1 + len(moved))
    if not fits or (interpolator is None and keys.counts.shape[1] != 3 * skeleton.n_joints):
        raise ValueError("the numbers of frames, keyframes or joints do not fit each other")
    return CompactMotion(
        skeleton,
        float(header["frame_time"]),
        str(header["name"]),
        keyframes,
        keys,
        track,
        embedding,
        interpolator,
        header["back_projector"],
        moved,
        float(header["scheme_error"]),
        float(header["error"]),
    )


def _entry(name: str, array: Quantized, coded: Coded) -> dict[str, Any]:
    entry = {
        "name": name,
        "shape": array.counts.shape,
        "step": array.step,
        "bound": 0.0 if name == "keyframes" else array.bound,
        "differences": coded.differences,
        "width": coded.width,
    }
    if array.origin.any():
        entry["origin"] = array.origin.tolist()
    return entry


def _skeleton_to_json(skeleton: Skeleton) -> dict[str, Any]:
    first = {own: joint for joint, own in reversed(list(enumerate(skeleton.channels)))}
    return {
        "names": skeleton.names,
        "parents": skeleton.parents.tolist(),
        "offsets": skeleton.offsets.tolist(),
        "channels": [
            own if first[own] == joint else first[own]
            for joint, own in enumerate(skeleton.channels)
        ],
        "end_sites": [[site.joint, site.offset.tolist(), site.name] for site in skeleton.end_sites],
        "unit_cm": skeleton.unit_cm,
    }


def _skeleton_from_json(parts: dict[str, Any]) -> Skeleton:
    channels: list[tuple[str, ...]] = []
    for own in parts["channels"]:
        channels.append(channels[own] if isinstance(own, int) else tuple(own))
    return Skeleton(
        names=tuple(parts["names"]),
        parents=np.array(parts["parents"], dtype=np.intp),
        offsets=np.array(parts["offsets"], dtype=np.float64),
        end_sites=tuple(
            EndSite(joint, np.array(offset, dtype=np.float64), name)
            for joint, offset, name in parts["end_sites"]
        ),
        channels=tuple(channels),
        unit_cm=parts["unit_cm"],
    )
