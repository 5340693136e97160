"""Read motion files as bytes and lines, refusing what is not text."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from pathlib import Path

from workbench.errors import DataError, MotionFormatError

_LINE = re.compile(rb"([^\r\n]*)(\r\n|\n|\r|\Z)")
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)
_BYTE_ORDER_MARK = b"\xef\xbb\xbf"


def read_text_bytes(path: str | Path, kind: str) -> bytes:
    """Read a file that must hold text.

    Parameters
    ----------
    path : path-like
        The file.
    kind : str
        What it should be, as used in messages ("a BVH file").

    Returns
    -------
    bytes
        Without a byte order mark.

    Raises
    ------
    DataError
        If there is no such file or it cannot be read.
    MotionFormatError
        If it is empty or binary.
    """
    try:
        data = Path(path).read_bytes()
    except FileNotFoundError:
        raise DataError(f"{path}: there is no such file") from None
    except IsADirectoryError:
        raise DataError(f"{path}: is a folder, want {kind}") from None
    except (OSError, ValueError) as error:  # ValueError: a NUL in the path
        reason = getattr(error, "strerror", None) or error
        raise DataError(f"{path}: cannot be read ({reason})") from None
    data = data.removeprefix(_BYTE_ORDER_MARK)
    if not data.strip():
        raise MotionFormatError(path, 1, "an empty file", kind)
    if b"\0" in data:
        line = data.count(b"\n", 0, data.index(b"\0")) + 1
        raise MotionFormatError(path, line, "binary data", f"{kind}, which is text")
    return data


def lines_of(data: bytes, start: int = 0) -> Iterator[tuple[str, int]]:
    r"""Split text into lines lazily, at ``\n``, ``\r\n`` and ``\r`` alike.

    Yields
    ------
    line : str
        Without surrounding blanks; bytes that are no UTF-8 are read as Latin-1.
    end : int
        Offset of the byte after the line and its ending.
    """
    while start < len(data):
        match = _LINE.match(data, start)
        assert match is not None  # the pattern matches at every position
        raw, start = match.group(1), match.end()
        try:
            line = raw.decode("utf-8")
        except UnicodeDecodeError:
            line = raw.decode("latin-1")
        yield line.strip(), start


def words_of(line: str) -> list[str]:
    """Split a line into words, without the comment after a ``#`` that begins a word.

    Inside of a word it is none: "-1.#IND" is a broken number, not "-1." with a remark.
    """
    words = line.split()
    if "#" in line:
        comment = next((i for i, word in enumerate(words) if word[0] == "#"), len(words))
        del words[comment:]
    return words


def parse_number(text: str) -> float | None:
    """Read a finite decimal number, or tell by None that it is not one.

    Python's own ``float`` also takes "nan", "inf" and "1_000".
    """
    if not _NUMBER.fullmatch(text):
        return None
    value = float(text)
    return value if math.isfinite(value) else None


def quoted(text: str) -> str:
    """Quote a piece of a file for a message, cut to a readable length."""
    return repr(text if len(text) <= 40 else text[:37] + "...")
