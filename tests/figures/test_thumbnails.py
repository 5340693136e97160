"""Thumbnails put all key poses into one picture."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from dataclasses import replace

import numpy as np
import pytest

from workbench import load_space
from workbench.errors import WorkbenchError
from workbench.figures.style import BLUE
from workbench.figures.thumbnails import compose, thumbnail, thumbnail_svg, write_thumbnail

JUMP = load_space("cmu/01_01-jump").motion
KEYS = [0, 60, 120, 180, 240, 299]
SVG = "{http://www.w3.org/2000/svg}"


def luminance(color: str) -> float:
    """Compute the relative luminance of a colour as WCAG defines it."""
    parts = np.array([int(color[i : i + 2], 16) / 255 for i in (1, 3, 5)])
    linear = np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4)
    return float(linear @ [0.2126, 0.7152, 0.0722])


def test_the_first_pose_is_blue_and_the_others_darken():
    """Time is told by lightness, which every reader sees."""
    first, *greys = compose(JUMP, KEYS).colors
    assert first == BLUE
    levels = [int(grey[1:3], 16) for grey in greys]
    assert levels == sorted(levels, reverse=True)
    assert len(set(levels)) == len(levels)


def test_a_motion_that_travels_keeps_its_path():
    """Poses stand where the roots are, up to one shift of the picture."""
    figures = compose(JUMP, [0, 150, 299]).figures
    way = np.linalg.norm((JUMP.root_translation[299] - JUMP.root_translation[0])[[0, 2]])
    assert figures.roots[-1, 0] - figures.roots[0, 0] == pytest.approx(way, rel=0.05)


def test_a_motion_in_place_is_spread_out():
    """Poses of a body that stays stand beside each other, at equal steps."""
    still = replace(JUMP, root_translation=JUMP.root_translation * [0.0, 1.0, 0.0])
    steps = np.diff(compose(still, KEYS).figures.roots[:, 0])
    assert np.allclose(steps, steps[0])
    assert steps[0] > 0.2 * compose(still, KEYS).figures.body_height


def test_nothing_is_cut_off():
    """The box of the picture holds every bone and head."""
    composite = compose(JUMP, KEYS)
    bounds = composite.figures.bounds()
    left, bottom, right, top = composite.box
    assert left < bounds[:, 0, 0].min()
    assert bottom < bounds[:, 0, 1].min()
    assert right > bounds[:, 1, 0].max()
    assert top > bounds[:, 1, 1].max()


def test_the_svg_is_well_formed_and_tells_what_it_shows():
    """One group for each pose, in order, with a title and a description for all."""
    motion = replace(JUMP, name="a <jump> & more")
    root = ElementTree.fromstring(thumbnail_svg(motion, KEYS, height=90))
    assert root.tag == f"{SVG}svg"
    assert root.get("height") == "90"
    assert root.find(f"{SVG}title").text == "a <jump> & more"
    assert "6 poses" in root.find(f"{SVG}desc").text
    titles = [title.text for title in root.findall(f".//{SVG}g/{SVG}g/{SVG}title")]
    assert titles == [f"frame {key}" for key in KEYS]
    width = float(root.get("width"))
    for circle in root.iter(f"{SVG}circle"):
        assert 0 < float(circle.get("cx")) < width
        assert 0 < float(circle.get("cy")) < 90


@pytest.mark.parametrize("height", [44, 120, 220])
def test_every_size_can_be_read(height):
    """Bones are at least a pixel wide, and their colours stand out from white by 3 to 1."""
    root = ElementTree.fromstring(thumbnail_svg(JUMP, KEYS, height=height))
    drawn = root.findall(f".//{SVG}g/{SVG}g/{SVG}path")
    bones = [path for path in drawn if path.get("stroke") != "white"]
    assert len(bones) == 2 * len(KEYS)  # right limbs, and all others
    for path in bones:
        assert float(path.get("stroke-width")) >= 1.0
        assert 1.05 / (luminance(path.get("stroke")) + 0.05) >= 3.0


def test_right_limbs_differ_from_all_others():
    """In a small picture they are dashed, and open in a large one."""
    small = ElementTree.fromstring(thumbnail_svg(JUMP, KEYS, height=90))
    dashed = [path for path in small.iter(f"{SVG}path") if path.get("stroke-dasharray")]
    assert len(dashed) == len(KEYS)
    large = ElementTree.fromstring(thumbnail_svg(JUMP, KEYS, height=300))
    for pose in large.findall(f".//{SVG}g/{SVG}g"):
        *_, right, inside = pose.findall(f"{SVG}path")
        assert inside.get("stroke") == "white"
        assert inside.get("d") == right.get("d")
        assert not right.get("stroke-dasharray")


def test_the_file_is_the_svg(tmp_path):
    """What is written is small and is what the function gives."""
    target = tmp_path / "new" / "jump.svg"
    write_thumbnail(target, JUMP, KEYS)
    assert target.read_text(encoding="utf-8") == thumbnail_svg(JUMP, KEYS)
    assert target.stat().st_size < 30_000


def test_the_figure_draws_every_pose_in_its_colour():
    """Each key pose is one named trace."""
    figure = thumbnail(JUMP, KEYS)
    poses = {trace.name: trace.line.color for trace in figure.data if trace.name}
    assert poses == dict(zip((f"frame {k}" for k in KEYS), compose(JUMP, KEYS).colors, strict=True))


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: thumbnail_svg(JUMP, KEYS, height=0), "height"),
        (lambda: thumbnail_svg(JUMP, [400]), "frames"),
        (lambda: write_thumbnail("jump.png", JUMP, KEYS), "svg"),
    ],
    ids=["no height", "no such frame", "another format"],
)
def test_what_cannot_be_drawn_is_refused(call, message):
    """The message names the argument."""
    with pytest.raises(WorkbenchError, match=message):
        call()
