"""The keyframe inspector, driven from Python."""

from __future__ import annotations

import asyncio
import os
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from tests.browser.chromium import chromium_path
from workbench.dashboards import KeyframeInspector, inspect_keyframes
from workbench.dashboards.inspection.plan import BEST
from workbench.dashboards.inspection.session import counts_to_measure
from workbench.datasets import load_space
from workbench.errors import WorkbenchError
from workbench.interpolation.slerp import Slerp
from workbench.mocap.contacts import foot_heights
from workbench.mocap.motion import Motion
from workbench.mocap.skeleton import Skeleton
from workbench.quality.animation import psnr
from workbench.selection import register_selector
from workbench.selection.saliency import Saliency
from workbench.spaces import PoseSpace

CLIP = "cmu/01_01-jump"


@pytest.fixture(scope="module")
def shared() -> Iterator[KeyframeInspector]:
    inspector = inspect_keyframes(CLIP, selector="uniform", count=8)
    yield inspector
    inspector.close()


@pytest.fixture
def inspector(shared: KeyframeInspector) -> KeyframeInspector:
    """Give the dashboard as it was first, whatever the test before did to it."""
    shared.open(CLIP)
    shared.controls.exact.value = False
    shared.contacts = False
    shared.sigma, shared.components = 10.0, None
    shared.selector, shared.count = "uniform", 8
    return shared


def test_errors_and_psnr_are_those_of_the_frames_between_the_keyframes(
    inspector: KeyframeInspector,
) -> None:
    """What is read from Python is what interpolation between the keyframes gives."""
    space = load_space(CLIP)
    np.testing.assert_array_equal(
        inspector.keyframes, np.linspace(0, len(space) - 1, 8).round().astype(int)
    )
    rebuilt = Slerp().interpolate(space.motion, inspector.keyframes)
    errors = space.errors(np.arange(len(space)), rebuilt)
    np.testing.assert_allclose(inspector.errors, errors, atol=1e-9)
    assert inspector.psnr == pytest.approx(psnr(space.motion, rebuilt), abs=1e-6)
    assert not inspector.errors[inspector.keyframes].any()


def test_own_rule_and_parameters_are_those_of_the_saliency_method(
    inspector: KeyframeInspector,
) -> None:
    """With no count, σ and k decide, as they do outside the dashboard."""
    inspector.selector, inspector.count = "saliency", None
    inspector.sigma, inspector.components = 5.0, 9
    expected = Saliency(5.0, 9).select(load_space(CLIP))
    np.testing.assert_array_equal(inspector.keyframes, expected)
    assert inspector.result is not None
    assert inspector.result.saliency.curves.shape[1] == 9
    names = [row["name"] for row in inspector.view.curves.rows]
    assert names == ["error", *(f"component {i}" for i in range(1, 10))]


def test_foot_contacts_can_be_handled(inspector: KeyframeInspector) -> None:
    """Two of the k curves become the feet's heights, and what was found on them is told."""
    inspector.selector, inspector.count = "saliency", None
    without = inspector.keyframes
    inspector.contacts, inspector.components = True, 9
    method = Saliency(10.0, 9, contacts=True)
    space = load_space(CLIP)
    np.testing.assert_array_equal(inspector.keyframes, method.select(space))
    assert not np.array_equal(inspector.keyframes, without)
    heights = foot_heights(space.motion)
    rows = [(row["name"], row.get("note", "")) for row in inspector.view.curves.rows]
    assert len(rows) == 10
    assert rows[-2:] == [("LeftFoot", "height"), ("RightFoot", "height")]
    for curve, height in zip(inspector.view.curves.values[-2:], heights.T, strict=True):
        assert np.corrcoef(curve, height)[0, 1] == pytest.approx(1.0)
    on_feet = inspector.view.curves.foot_keyframes
    assert 0 < len(on_feet) < len(inspector.keyframes)
    assert set(on_feet.tolist()) < set(inspector.keyframes.tolist())
    words = f"2 of the 9 curves are feet, {len(on_feet)} of the keyframes found on them"
    assert words in inspector.view.root.children[2].value


def test_feet_are_not_told_of_keyframes_that_they_did_not_bring(
    inspector: KeyframeInspector,
) -> None:
    """Another method's keyframes may lie where a foot is salient; that is chance."""
    inspector.contacts = True
    assert inspector.result is not None
    assert inspector.result.saliency.is_foot.sum() == 2
    assert not len(inspector.result.foot_keyframes)


def test_a_body_without_feet_is_told_and_loses_nothing(inspector: KeyframeInspector) -> None:
    """Where no feet are found, contacts cannot be handled; what was shown stays."""
    names = ("Hips", "Spine", "Neck")
    rotations = np.tile(np.eye(3), (30, 3, 1, 1))
    angles = np.sin(np.linspace(0, 9, 30))
    rotations[:, 1, :2, :2] = np.moveaxis(
        np.array([[np.cos(angles), -np.sin(angles)], [np.sin(angles), np.cos(angles)]]), 2, 0
    )
    channels = (("Zrotation", "Xrotation", "Yrotation"),) * 3
    skeleton = Skeleton(names, np.array([-1, 0, 1]), np.eye(3), (), channels)
    motion = Motion(skeleton, rotations, np.zeros((30, 3)), 0.01, name="worm")
    inspector.open(PoseSpace(motion))
    before = inspector.keyframes
    inspector.contacts = True
    assert "feet of 'worm'" in inspector.message
    np.testing.assert_array_equal(inspector.keyframes, before)
    inspector.contacts = False
    assert inspector.message == ""


def test_other_methods_take_as_many_as_saliency_finds(inspector: KeyframeInspector) -> None:
    """Without a count, methods are compared at equal numbers."""
    inspector.count = None
    assert len(inspector.keyframes) == len(Saliency(10.0).select(load_space(CLIP)))


def test_the_error_curve_is_that_of_the_method_and_never_below_the_best(
    inspector: KeyframeInspector,
) -> None:
    """At each number the curve has the error of so many keyframes; none beats the best."""
    inspector.controls.exact.value = True
    curve, best = inspector.error_curves["uniform"], inspector.error_curves[BEST]
    np.testing.assert_array_equal(curve.counts, counts_to_measure(300))
    least = dict(zip(best.counts.tolist(), best.errors.tolist(), strict=True))
    for count, error in zip(curve.counts.tolist(), curve.errors.tolist(), strict=True):
        assert error >= least[count] - 1e-9
    assert np.all(np.diff(best.errors) < 0)
    inspector.count = int(curve.counts[3])
    assert inspector.errors.mean() == pytest.approx(curve.errors[3])


def test_a_number_picked_on_the_curve_is_taken(inspector: KeyframeInspector) -> None:
    """The same number can be picked again after another was set."""
    for _ in range(2):
        inspector.view.counts.picked = 11
        assert inspector.count == len(inspector.keyframes) == 11
        assert inspector.view.counts.picked == 0
        inspector.count = 5


@pytest.mark.parametrize(
    ("wrong", "words"),
    [("uci/iris", "want a motion"), ("cmu/none", "cmu/none"), ("/no/such.bvh", "no/such")],
    ids=["a table", "an unknown name", "a missing file"],
)
def test_a_wrong_clip_loses_nothing(inspector: KeyframeInspector, wrong: str, words: str) -> None:
    """The reason is told in words, and what was shown stays."""
    before = inspector.keyframes
    inspector.open(wrong)
    assert words in inspector.message
    assert f"still shown: {CLIP}" in inspector.message
    np.testing.assert_array_equal(inspector.keyframes, before)
    inspector.open(CLIP)
    assert inspector.message == ""


def test_a_method_that_fails_is_told_and_the_last_keyframes_stay(
    inspector: KeyframeInspector,
) -> None:
    """A user's own selector may fail in any way."""

    class Broken:
        def select(self, space: object, count: int) -> None:
            raise ZeroDivisionError("nothing to divide")

    before = inspector.keyframes
    register_selector("broken", Broken)
    inspector.selector = "broken"
    assert "ZeroDivisionError: nothing to divide" in inspector.message
    np.testing.assert_array_equal(inspector.keyframes, before)
    inspector.selector = "uniform"
    assert inspector.message == ""


def test_a_registered_selector_is_offered_and_used(inspector: KeyframeInspector) -> None:
    """What the notebook's user registers works like any other method."""

    class Early:
        def select(self, space: object, count: int) -> np.ndarray:
            return np.arange(count)

    register_selector("early", Early)
    inspector.selector = "early"
    assert "early" in inspector.controls.selector.options
    assert inspector.keyframes.tolist() == list(range(8))


@pytest.mark.parametrize(
    ("argument", "value", "words"),
    [
        ("selector", "best", "selector: got 'best'"),
        ("sigma", 0.5, "sigma: got 0.5"),
        ("components", 31, "components: got 31"),
        ("contacts", "yes", "contacts: got 'yes'"),
        ("count", 1, "count: got 1"),
        ("random_state", -1, "random_state: got -1"),
    ],
    ids=["selector", "sigma", "components", "contacts", "count", "random_state"],
)
def test_arguments_are_checked(argument: str, value: object, words: str) -> None:
    """The message names the argument and what it got."""
    with pytest.raises(WorkbenchError, match=words):
        inspect_keyframes(CLIP, **{argument: value})


def test_the_views_show_the_same_keyframes(inspector: KeyframeInspector) -> None:
    """Player, curves, count curve and pictures agree, and contacts are marked in two of them."""
    view, keys = inspector.view, inspector.keyframes.tolist()
    assert view.player.keyframes.tolist() == view.curves.keyframes.tolist() == keys
    assert view.counts.count == 8
    assert view.counts.error == pytest.approx(inspector.errors.mean())
    assert view.player.motions == ["original", "reconstruction"]
    assert [foot["side"] for foot in view.player.contacts] == ["left", "right"]
    assert view.curves.contacts == view.player.contacts
    original, rebuilt = view.player.positions
    np.testing.assert_allclose(original[keys], rebuilt[keys], atol=1e-4)
    assert np.abs(original - rebuilt).max() > 1.0
    for picture in (view.filmstrip, view.thumbnail):
        assert picture.svg.startswith("<svg")
        assert picture.name == f"01_01-jump-8-{picture.title.lower()}"


def test_pictures_are_saved_as_svg(inspector: KeyframeInspector, tmp_path: Path) -> None:
    """The file holds what is shown; other endings are refused."""
    strip = inspector.save_filmstrip(tmp_path / "strip.svg")
    assert strip.read_text() == inspector.view.filmstrip.svg
    assert inspector.save_thumbnail(tmp_path / "small.svg").stat().st_size > 1000
    with pytest.raises(WorkbenchError, match=r"ends in \.svg or \.png"):
        inspector.save_filmstrip(tmp_path / "strip.gif")


@pytest.mark.browser
def test_pictures_are_saved_as_png(inspector: KeyframeInspector, tmp_path: Path) -> None:
    """The picture has two pixels for each of the drawing, and shows the blue of left limbs."""
    if chromium_path() is None:
        assert os.environ.get("CI") != "true", "no chromium in CI"
        pytest.skip("no chromium on this machine: no PNG can be made")
    strip = inspector.save_filmstrip(tmp_path / "strip.png")
    with Image.open(strip) as image:
        assert image.width == 2000
        pixels = np.asarray(image.convert("RGB")).reshape(-1, 3).astype(int)
    assert (np.abs(pixels - [0x00, 0x72, 0xB2]).max(axis=1) < 8).sum() > 500


def test_a_computation_can_be_cancelled_and_repeated(inspector: KeyframeInspector) -> None:
    """Cancelling tells so and keeps the keyframes; computing again brings the result."""

    class Slow:
        def select(self, space: object, count: int) -> np.ndarray:
            time.sleep(0 if count == 8 else 60)
            return np.arange(count)

    register_selector("slow", Slow)

    async def main() -> None:
        inspector.selector = "slow"
        while inspector.keyframes.tolist() != list(range(8)):
            await asyncio.sleep(0.05)
        inspector.cancel()
        await asyncio.wait_for(inspector.finished(), 20)
        assert inspector.view.counts.message == "slow: cancelled"
        assert inspector.keyframes.tolist() == list(range(8))
        inspector.selector = "uniform"
        inspector.recompute()
        await asyncio.wait_for(inspector.finished(), 60)

    asyncio.run(main())
    assert inspector.message == ""
    assert "uniform" in inspector.error_curves


def test_what_failed_of_another_clip_does_not_hold_up_computing_again(
    inspector: KeyframeInspector,
) -> None:
    """One press of "again" computes anew, though a clip before it could not be shown."""
    inspector.open("/no/such/clip.bvh")
    assert inspector.message
    inspector.open(CLIP)
    before = inspector.result
    inspector.recompute()
    assert inspector.result is not None
    assert inspector.result is not before


@pytest.mark.parametrize(("n_frames", "most"), [(3, 2), (13, 12), (300, 30), (5000, 60)], ids=str)
def test_counts_of_a_curve_rise_and_can_be_chosen(n_frames: int, most: int) -> None:
    """They are different, at least 2, and fewer than there are frames."""
    counts = counts_to_measure(n_frames)
    assert np.all(np.diff(counts) > 0)
    assert counts[0] >= 2
    assert counts[-1] == most < n_frames
