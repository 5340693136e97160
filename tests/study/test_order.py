"""Each participant's order is random, balanced over participants, and the same every time."""

from __future__ import annotations

from collections import Counter
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from workbench.errors import WorkbenchError
from workbench.study.order import (
    balanced_order,
    participant_code,
    participant_of,
    presentations,
)

seeds = st.integers(0, 2**31 - 1)


@given(sizes=st.lists(st.integers(1, 6), max_size=8), participant=st.integers(1, 999), seed=seeds)
def test_each_participant_sees_everything_once(
    sizes: list[int], participant: int, seed: int
) -> None:
    """No item and no stimulus is left out or comes twice, and asking again gives the same."""
    shown = presentations(sizes, participant, seed)
    assert sorted(one.item for one in shown) == list(range(len(sizes)))
    for one in shown:
        assert sorted(one.order) == list(range(sizes[one.item]))
    assert presentations(sizes, participant, seed) == shown


@given(n=st.integers(2, 9), block=st.integers(0, 20), purpose=st.text(max_size=5))
def test_places_are_balanced_over_a_block(n: int, block: int, purpose: str) -> None:
    """Over n participants, each thing comes once at each place."""
    orders = [balanced_order(n, block * n + turn, purpose) for turn in range(n)]
    for place in range(n):
        assert sorted(order[place] for order in orders) == list(range(n))


@given(n=st.integers(2, 9), block=st.integers(0, 20), purpose=st.text(max_size=5))
def test_neighbours_are_balanced_over_a_block(n: int, block: int, purpose: str) -> None:
    """Over n participants, 2 n where n is odd, each thing follows each other equally often."""
    period = n * (1 + n % 2)
    pairs = Counter(
        pair
        for turn in range(period)
        for order in [balanced_order(n, block * period + turn, purpose)]
        for pair in pairwise(order)
    )
    assert set(pairs.values()) == {1 + n % 2}
    assert len(pairs) == n * (n - 1)


def test_orders_are_drawn_at_random() -> None:
    """Over many seeds the first participant meets each order of three equally often."""
    seen = Counter(tuple(balanced_order(3, 0, f"{seed}")) for seed in range(3000))
    assert len(seen) == 6
    # Six times the standard deviation of a count of 3000 draws with chance 1/6.
    assert all(abs(count - 500) < 6 * (3000 * 5 / 36) ** 0.5 for count in seen.values())


def test_places_of_different_items_are_drawn_apart() -> None:
    """Whether the original is on the left of one item tells nothing of the next item."""
    left = Counter(
        (first.order, second.order)
        for seed in range(400)
        for first, second in [sorted(presentations([2, 2], 1, seed), key=lambda one: one.item)]
    )
    assert len(left) == 4
    assert all(abs(count - 100) < 6 * (400 * 3 / 16) ** 0.5 for count in left.values())


def test_an_order_is_the_same_in_later_versions() -> None:
    """A study that is continued with a later version goes on with the same orders."""
    assert [one.item for one in presentations([4, 4, 4, 4], 7, 2010)] == [2, 0, 3, 1]
    assert participant_code(7, "2010") == "7-XKK"


@given(number=st.integers(1, 999_999_999), study_id=st.text(max_size=20))
def test_a_code_leads_back_to_its_participant(number: int, study_id: str) -> None:
    """However it is typed."""
    code = participant_code(number, study_id)
    assert participant_of(f"  {code.lower().replace('-', ' ')} ", study_id) == number


@pytest.mark.parametrize("code", ["", "7", "7-", "x-ABC", "0-ABC", "7-ABCD", "-7-ABC"], ids=repr)
def test_what_is_no_code_is_refused(code: str) -> None:
    """The message says where a code comes from."""
    with pytest.raises(WorkbenchError, match=r"code: got .*want the number and the three letters"):
        participant_of(code, "a study")


def test_a_mistyped_number_is_nobodys_code() -> None:
    """The letters of one participant's code do not fit another's."""
    letters = participant_code(7, "0").partition("-")[2]
    wrong = [n for n in range(1, 100) if n != 7 and participant_code(n, "0") == f"{n}-{letters}"]
    assert wrong == []
