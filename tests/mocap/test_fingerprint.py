"""Fingerprints of clips: what tells one from another, and what does not."""

from __future__ import annotations

from dataclasses import replace

import pytest

from workbench.mocap.fingerprint import clip_fingerprint
from workbench.mocap.rotations import axis_rotation


def test_it_does_not_depend_on_last_digits(waving):
    """Computers differ in the last digits of sines."""
    other = replace(waving, rotations=waving.rotations * (1.0 + 1e-15))
    assert clip_fingerprint(other) == clip_fingerprint(waving)


@pytest.mark.parametrize("part", ["names", "bones", "pose", "path", "length"])
def test_every_part_of_a_clip_counts(waving, part):
    """Another name, bone, pose, place or number of frames gives another fingerprint."""
    skeleton = waving.skeleton
    other = {
        "names": lambda: replace(waving, skeleton=replace(skeleton, names=(*"abcd",))),
        "bones": lambda: replace(waving, skeleton=replace(skeleton, offsets=2 * skeleton.offsets)),
        "pose": lambda: replace(waving, rotations=waving.rotations @ axis_rotation("X", 0.01)),
        "path": lambda: replace(waving, root_translation=waving.root_translation + 0.001),
        "length": lambda: waving[:-1],
    }[part]()
    assert clip_fingerprint(other) != clip_fingerprint(waving)
