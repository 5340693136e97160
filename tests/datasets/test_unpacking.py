"""Unpacking, with an encoder of its own and the system's gzip as the second opinion."""

from __future__ import annotations

import contextlib
import shutil
import subprocess

import pytest
from hypothesis import given
from hypothesis import strategies as st

from workbench.datasets.unpacking import expand_lzw, unpack
from workbench.errors import DataError
from workbench.resources import bundled


def compress(data: bytes, widest: int = 16, clear_when_full: bool = False) -> bytes:
    """Write the format of Unix compress, in block mode."""
    codes: list[tuple[int, int]] = []  # code and width
    table = {bytes([i]): i for i in range(256)}
    size, width, word = 257, 9, b""

    def emit(code: int) -> None:
        codes.append((code, width))

    for value in data:
        longer = word + bytes([value])
        if longer in table:
            word = longer
            continue
        emit(table[word])
        if size < 1 << widest:
            table[longer] = size
            size += 1
            # The reader learns each entry one code later than it is made here.
            if size > 1 << width and width < widest:
                width += 1
        elif clear_when_full:
            emit(256)
            table = {bytes([i]): i for i in range(256)}
            size, width = 257, 9
        word = bytes([value])
    if word:
        emit(table[word])

    out, group, group_width = bytearray(b"\x1f\x9d" + bytes([0x80 | widest])), 0, 9
    bits, n_bits = 0, 0

    def pad() -> None:
        nonlocal bits, n_bits, group
        n_bits += group_width * (-group % 8)
        while n_bits > 0:
            out.append(bits & 255)
            bits >>= 8
            n_bits -= 8
        bits, n_bits, group = 0, 0, 0

    for i, (code, code_width) in enumerate(codes):
        if code_width != group_width or (i and codes[i - 1][0] == 256):
            pad()
            group_width = code_width
        bits |= code << n_bits
        n_bits += code_width
        group += 1
    while n_bits > 0:
        out.append(bits & 255)
        bits >>= 8
        n_bits -= 8
    return bytes(out)


YEAST = (bundled("datasets") / "uci" / "yeast.data").read_bytes()
MOTION = (bundled("datasets") / "mocap" / "bvh" / "01_01.bvh").read_bytes()[:400_000]
CASES = [
    pytest.param(YEAST, 16, False, id="growing codes"),
    pytest.param(MOTION, 16, False, id="full table"),
    pytest.param(YEAST, 12, False, id="12 bits"),
    pytest.param(YEAST, 12, True, id="cleared table"),
    pytest.param(MOTION, 16, True, id="cleared table of 16 bits"),
    pytest.param(b"aaaaaaaaaaaaaaaa", 16, False, id="code used as it is made"),
    pytest.param(b"", 16, False, id="empty"),
]


@pytest.mark.parametrize(("data", "widest", "clear"), CASES)
def test_expands_what_was_compressed(data: bytes, widest: int, clear: bool) -> None:
    """Real files come back byte for byte, with every way of the format to grow its codes."""
    assert expand_lzw(compress(data, widest, clear)) == data


@pytest.mark.parametrize(("data", "widest", "clear"), CASES)
def test_agrees_with_gzip(data: bytes, widest: int, clear: bool) -> None:
    """The system's gzip, which reads this format too, expands the same files to the same."""
    gzip = shutil.which("gzip")
    if gzip is None:
        pytest.skip("needs the gzip program")
    packed = compress(data, widest, clear)
    result = subprocess.run([gzip, "-dc"], input=packed, capture_output=True, check=True)
    assert result.stdout == expand_lzw(packed)


@given(st.binary(max_size=3000), st.sampled_from([9, 10, 16]), st.booleans())
def test_expands_anything(data: bytes, widest: int, clear: bool) -> None:
    """Any bytes come back."""
    assert expand_lzw(compress(data, widest, clear)) == data


@given(st.binary(max_size=300))
def test_damage_is_an_error_or_other_content(data: bytes) -> None:
    """Arbitrary bytes after the header end in content or in a DataError, nothing else."""
    with contextlib.suppress(DataError):
        assert isinstance(expand_lzw(b"\x1f\x9d\x90" + data), bytes)


@pytest.mark.parametrize("content", [b"", b"\x1f\x9d", b"\x1f\x9d\x88x", b"plain"])
def test_refuses_other_formats(content: bytes) -> None:
    """What does not begin like a .Z file is refused."""
    with pytest.raises(DataError, match="expected the format of Unix compress"):
        expand_lzw(content)


def test_plain_content_passes() -> None:
    """A plain file is left as it is."""
    assert unpack(YEAST) == YEAST


def test_damaged_archive_is_refused() -> None:
    """An archive that is cut short is a DataError."""
    with pytest.raises(DataError, match="damaged or lacks"):
        unpack(b"PK\x03\x04 cut", "file")
