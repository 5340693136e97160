"""What every registered selector keeps, on random motions and tables."""

from __future__ import annotations

import warnings
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.contract.strategies import examples, poses, still_poses, tables
from workbench.errors import WorkbenchError
from workbench.schemes import choose_control_points
from workbench.selection import selectors
from workbench.spaces import PoseSpace, Space, VectorSpace

#: Selectors that need no order in time.
FOR_TABLES = {"uniform", "random", "rols"}

#: Its kernel √(1 + d²) acts on distances as they are.
DEPENDS_ON_UNITS = {"rols"}

every_selector = pytest.mark.parametrize("name", selectors.names())
pytestmark = pytest.mark.filterwarnings("ignore::UserWarning")


def check_selection(space: Space, name: str, count: int, fixed: list[int]) -> None:
    """Check one selection, and that it can be had again from untouched samples."""
    before = space.samples.copy()
    found = choose_control_points(space, name, count=count, fixed=fixed, random_state=5)
    again = choose_control_points(space, name, count=count, fixed=fixed, random_state=5)
    assert found.shape == (count,)
    assert found.dtype == np.intp
    assert np.all(np.diff(found) > 0)
    assert 0 <= found[0] <= found[-1] < len(space)
    assert set(fixed) <= set(found.tolist())
    assert np.array_equal(found, again)
    assert np.array_equal(space.samples, before)


def draw_request(draw: st.DataObject, space: Space) -> tuple[int, list[int]]:
    """Draw a count, and samples that must stay; some selectors keep both ends too."""
    count = draw.draw(st.integers(2, len(space) - 1), "count")
    inner = st.integers(1, len(space) - 2)
    return count, draw.draw(st.lists(inner, unique=True, max_size=count - 2), "fixed")


@every_selector
@examples
@given(space=poses(), draw=st.data())
def test_keyframes_are_as_many_as_wanted(name, space, draw):
    """Sorted, each once, the fixed ones among them, the same for the same seed."""
    check_selection(space, name, *draw_request(draw, space))


@every_selector
@examples
@given(space=tables(), draw=st.data())
def test_tables_are_sampled_or_refused(name, space, draw):
    """Selectors that follow time say that a table has none; the others sample it."""
    count, fixed = draw_request(draw, space)
    if name in FOR_TABLES:
        check_selection(space, name, count, fixed)
    else:
        with pytest.raises(WorkbenchError, match=r"table .*want a motion"):
            choose_control_points(space, name, count=count, fixed=fixed)


@every_selector
@examples
@given(space=still_poses(), draw=st.data())
def test_a_still_motion_has_keyframes_too(name, space, draw):
    """Where no frame tells more than another, there are as many as wanted all the same."""
    check_selection(space, name, *draw_request(draw, space))


@every_selector
@examples
@given(space=poses(3, 3))
def test_the_smallest_motion_has_two_keyframes(name, space):
    """Two of three frames."""
    check_selection(space, name, 2, [])


@pytest.mark.parametrize("name", [n for n in selectors.names() if n not in DEPENDS_ON_UNITS])
@examples
@given(space=poses(), draw=st.data())
def test_units_of_length_do_not_matter(name, space, draw):
    """A skeleton measured in units a quarter as long has the same keyframes."""
    count, fixed = draw_request(draw, space)
    found = [
        choose_control_points(s, name, count=count, fixed=fixed, random_state=1)
        for s in (space, in_other_units(space))
    ]
    assert np.array_equal(*found)


@pytest.mark.parametrize("name", [n for n in selectors if n not in FOR_TABLES | {"saliency"}])
@examples
@given(space=poses(4, 12))
def test_curves_keep_both_ends(name, space):
    """What follows a curve in time has its first and its last frame among the keys."""
    found = choose_control_points(space, name, count=3)
    assert (found[0], found[-1]) == (0, len(space) - 1)


@every_selector
def test_a_rule_of_its_own_needs_no_count(name, waving):
    """Selectors that choose how many there are say so; the others ask."""
    space = PoseSpace(waving)
    if getattr(selectors.create(name), "chooses_count", False):
        found = choose_control_points(space, name, fixed=[17])
        assert 17 in found
        assert 2 <= len(found) < len(space)
    else:
        with pytest.raises(WorkbenchError, match="count and ratio: want exactly one"):
            choose_control_points(space, name)


@pytest.mark.parametrize("name", sorted(FOR_TABLES))
def test_the_smallest_table_has_two_control_points(name):
    """Two of three rows, equal ones too."""
    for values in (np.eye(3), np.ones((3, 2))):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            check_selection(VectorSpace(values), name, 2, [])


def in_other_units(space: PoseSpace) -> PoseSpace:
    """Multiply all lengths by four, which loses no digit."""
    motion = space.motion
    sites = tuple(replace(s, offset=4.0 * s.offset) for s in motion.skeleton.end_sites)
    skeleton = replace(motion.skeleton, offsets=4.0 * motion.skeleton.offsets, end_sites=sites)
    return PoseSpace(
        replace(
            motion,
            skeleton=skeleton,
            root_translation=4.0 * motion.root_translation,
            joint_translations={j: 4.0 * t for j, t in motion.joint_translations.items()},
        )
    )
