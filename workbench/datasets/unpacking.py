"""Unpack what the UCI repository serves: zip archives and Unix ``compress`` files."""

from __future__ import annotations

import io
import zipfile

from workbench.errors import DataError

_MAGIC = b"\x1f\x9d"
_CLEAR = 256


def unpack(content: bytes, member: str = "") -> bytes:
    """Take the data file out of a download.

    Parameters
    ----------
    content : bytes
        What the server sent: a plain file, a zip archive or a ``.Z`` file.
    member : str
        Name of the wanted file inside an archive.

    Returns
    -------
    bytes
        The plain file.

    Raises
    ------
    DataError
        If the archive is damaged or lacks the file.
    """
    if member:
        try:
            with zipfile.ZipFile(io.BytesIO(content)) as archive:
                content = archive.read(member)
        except (zipfile.BadZipFile, KeyError, OSError, EOFError) as error:
            raise DataError(f"the archive is damaged or lacks {member} ({error})") from None
    return expand_lzw(content) if content.startswith(_MAGIC) else content


def expand_lzw(content: bytes) -> bytes:
    """Expand a ``.Z`` file, the LZW format of Unix ``compress``.

    Page blocks is published in this format, which the standard library does not read
    (Welch 1984, "A Technique for High-Performance Data Compression", with codes of 9 to 16
    bits, least significant bit first, written in groups of eight).

    Parameters
    ----------
    content : bytes
        The compressed file.

    Returns
    -------
    bytes
        The original.

    Raises
    ------
    DataError
        If the content is not in this format or is damaged.
    """
    if len(content) < 3 or not content.startswith(_MAGIC) or not 9 <= content[2] & 0x1F <= 16:
        raise DataError("found no .Z file, expected the format of Unix compress")
    widest = content[2] & 0x1F
    reserved = [b""] if content[2] & 0x80 else []  # the clear code takes a place in the table
    table = [bytes([i]) for i in range(256)] + reserved
    width, position, group = 9, 24, 24
    previous = b""
    out: list[bytes] = []
    while True:
        if len(table) >= 1 << width and width < widest:
            position = group = _end_of_group(position, group, width)
            width += 1
        if position + width > 8 * len(content):
            return b"".join(out)
        window = int.from_bytes(content[position >> 3 : (position >> 3) + 4], "little")
        code = (window >> (position & 7)) & ((1 << width) - 1)
        position += width
        if reserved and code == _CLEAR:
            position = group = _end_of_group(position, group, width)
            table, width, previous = table[:257], 9, b""
            continue
        if code < len(table):
            entry = table[code]
        elif code == len(table) and previous:
            entry = previous + previous[:1]  # the one code that is used as it is made
        else:
            raise DataError("the .Z file is damaged")
        out.append(entry)
        if previous and len(table) < 1 << widest:
            table.append(previous + entry[:1])
        previous = entry


def _end_of_group(position: int, group: int, width: int) -> int:
    """Skip the padding: codes of one width come in groups of eight."""
    size = 8 * width
    return group + -(-(position - group) // size) * size
