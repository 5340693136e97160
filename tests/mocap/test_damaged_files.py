"""Tests that damage of any kind to a motion file ends in a motion or in a clear refusal."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from workbench.errors import MotionFormatError
from workbench.mocap import read_amc, read_asf, read_bvh

_ASF = """:units
length 0.45
:root
order TX TY TZ RX RY RZ
axis XYZ
:bonedata
begin
name hip
direction 1 0 0
length 2
axis 0 0 90 XYZ
dof rx rz
limits (-160.0 20.0)
       (-70.0 70.0)
end
:hierarchy
begin
root hip
end
"""
_AMC = (
    ":FULLY-SPECIFIED\n:DEGREES\n1\nroot 1 2 3 10 20 30\nhip 4 5\n2\nroot 1 2 3 10 20 30\nhip 4 5\n"
)
_PIECES = st.one_of(
    st.sampled_from(
        ["", "{", "}", "\n", "\r", " ", "#", ":", "-", "1e999", "nan", "root", "ROOT", "End Site"]
    ),
    st.sampled_from(
        ["CHANNELS", "MOTION", "begin", "end", "dof", "9" * 400, "2", "٣", "²", "\x0b"]
    ),
    st.text(max_size=3),
)


@st.composite
def _edits(draw: st.DrawFn) -> list[tuple[float, int, str]]:
    """Draw up to four replacements: where, of how many characters, by what."""
    edit = st.tuples(st.floats(0, 1), st.integers(0, 20), _PIECES)
    return draw(st.lists(edit, min_size=1, max_size=4))


def _damage(text: str, edits: list[tuple[float, int, str]]) -> bytes:
    for place, length, piece in edits:
        start = int(place * len(text))
        text = text[:start] + piece + text[start + length :]
    return text.encode("utf-8", "surrogatepass")


_QUICK = settings(
    max_examples=300,
    deadline=None,
    # The folder is only written to, and every example overwrites the file of the one before.
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)


def _read_or_refuse(read, path):
    """Give what a reader returns or the error by which it refuses; nothing else may escape."""
    try:
        return read(path)
    except MotionFormatError as refusal:
        return refusal


def _assert_clear(refusal, path):
    assert refusal.line >= 1
    assert "\n" not in str(refusal).removeprefix(str(path))


@_QUICK
@given(edits=_edits())
def test_damaged_bvh(bvh_text, write_file, edits):
    """A damaged BVH file is refused, or read as a motion of finite numbers."""
    path = write_file(_damage(bvh_text, edits))
    result = _read_or_refuse(read_bvh, path)
    if isinstance(result, MotionFormatError):
        _assert_clear(result, path)
    else:
        assert np.isfinite(result.rotations).all()
        assert np.isfinite(result.root_translation).all()


@pytest.mark.parametrize(("read", "text"), [(read_asf, _ASF), (read_amc, _AMC)], ids=["asf", "amc"])
@_QUICK
@given(edits=_edits())
def test_damaged_acclaim_files(write_file, read, text, edits):
    """A damaged ASF or AMC file is refused, or read."""
    path = write_file(_damage(text, edits), "file")
    result = _read_or_refuse(read, path)
    if isinstance(result, MotionFormatError):
        _assert_clear(result, path)
