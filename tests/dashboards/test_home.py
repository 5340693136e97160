"""What other threads ask of a dashboard."""

from __future__ import annotations

import asyncio
import threading

from workbench.dashboards.shared.home import Home


def test_calls_from_another_thread_are_done_in_the_first_one() -> None:
    """They wait for their turn there, in the order in which they came."""
    calls: list[tuple[int, int]] = []

    async def main() -> None:
        done = asyncio.Event()

        def note(number: int) -> None:
            calls.append((number, threading.get_ident()))
            if number == 2:
                done.set()

        act = Home().here(note)
        act(0)
        other = threading.Thread(target=lambda: (act(1), act(2)))
        other.start()
        other.join()
        assert len(calls) == 1
        await asyncio.wait_for(done.wait(), 10)

    asyncio.run(main())
    assert calls == [(number, threading.get_ident()) for number in range(3)]


def test_without_a_loop_calls_are_done_at_once() -> None:
    """A script has one thread only."""
    calls: list[int] = []
    Home().here(calls.append)(1)
    assert calls == [1]
