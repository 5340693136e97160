"""Computing in a process beside the kernel."""

from __future__ import annotations

import asyncio
import os
import signal
import threading
import time
from collections.abc import Iterator
from typing import Any

import pytest

from workbench.dashboards.shared.background import Background, Report, Stopped
from workbench.errors import WorkbenchError


class Calculator:
    """What the tests let compute."""

    def __init__(self) -> None:
        self.calls = 0

    def apply(self, function: Any, value: Any, *, report: Report) -> tuple[int, Any]:
        self.calls += 1
        report("applying", 0.5)
        return self.calls, function(value)


@pytest.fixture(scope="module")
def shared() -> Iterator[Background]:
    background = Background(Calculator)
    yield background
    background.stop()


def call(background: Background, function: Any, value: Any = None) -> tuple[int, Any]:
    return asyncio.run(background.call("apply", function, value, report=lambda *_: None))


def test_functions_of_a_notebook_travel(shared: Background) -> None:
    """A function that no module has, with what it encloses, is computed elsewhere."""
    offset = 5

    def add(value: int) -> tuple[int, int]:
        return value + offset, os.getpid()

    _, (result, process) = call(shared, add, 37)
    assert result == 42
    assert process != os.getpid()


def test_the_object_and_its_process_are_kept(shared: Background) -> None:
    """A second call meets the same object, so that it can remember things."""
    first, process = call(shared, lambda _: os.getpid())
    assert call(shared, lambda _: os.getpid()) == (first + 1, process)


def test_progress_is_reported_and_the_kernel_answers_meanwhile(shared: Background) -> None:
    """Reports arrive and other tasks run before the result is there."""
    reports, turns = [], []

    async def count_turns() -> None:
        while True:
            turns.append(time.monotonic())
            await asyncio.sleep(0.01)

    async def main() -> None:
        other = asyncio.create_task(count_turns())
        await shared.call("apply", time.sleep, 0.3, report=lambda *args: reports.append(args))
        other.cancel()

    asyncio.run(main())
    assert reports == [("applying", 0.5)]
    assert len(turns) > 5


@pytest.mark.parametrize(
    ("error", "words"),
    [(WorkbenchError("want more"), "^want more$"), (KeyError("x"), "^KeyError: 'x'$")],
    ids=["refusal", "failure"],
)
def test_errors_come_back_in_plain_words(shared: Background, error: Exception, words: str) -> None:
    """A refusal is told as it is, any other error with its kind; the process survives both."""
    before, _ = call(shared, lambda _: None)

    def fail(_: Any) -> None:
        raise error

    with pytest.raises(WorkbenchError, match=words):
        call(shared, fail)
    assert call(shared, lambda _: None)[0] == before + 2


def test_what_cannot_be_sent_is_told(shared: Background) -> None:
    """An object that belongs to this process only is refused with a reason."""
    with pytest.raises(WorkbenchError, match="beside the kernel"):
        call(shared, lambda lock: lock, threading.Lock())


def test_stopping_ends_a_computation_at_once_and_the_next_call_works() -> None:
    """A call that would take a minute ends when it is stopped; a new process takes over."""
    background = Background(Calculator)

    async def main() -> None:
        call = asyncio.create_task(
            background.call("apply", time.sleep, 60, report=lambda *_: started.set())
        )
        await asyncio.wait_for(started.wait(), 60)
        background.stop()
        with pytest.raises(Stopped):
            await asyncio.wait_for(call, 5)

    started = asyncio.Event()
    asyncio.run(main())
    assert call(background, abs, -3) == (1, 3)
    background.stop()


def test_a_process_that_dies_is_told_and_replaced() -> None:
    """A crash, as for want of memory, is an error in words; the next call works."""
    background = Background(Calculator)
    with pytest.raises(WorkbenchError, match="ended by itself"):
        call(background, os._exit, 1)
    assert call(background, abs, -3) == (1, 3)
    background.stop()


@pytest.mark.parametrize("way", ["cancelled", "report fails"])
def test_a_call_that_ends_early_leaves_no_answer_to_the_next(way: str) -> None:
    """The next call gets its own result, not the one that nobody waited for."""
    background = Background(Calculator)

    async def cancel() -> None:
        started = asyncio.Event()
        early = asyncio.create_task(
            background.call("apply", time.sleep, 0.1, report=lambda *_: started.set())
        )
        await asyncio.wait_for(started.wait(), 60)
        early.cancel()
        with pytest.raises(asyncio.CancelledError):
            await early

    def fail(*_: Any) -> None:
        raise OSError("the page is gone")

    if way == "cancelled":
        asyncio.run(cancel())
    else:
        with pytest.raises(OSError, match="the page is gone"):
            asyncio.run(background.call("apply", abs, -1, report=fail))
    assert call(background, abs, -42)[1] == 42
    background.stop()


def test_a_result_that_cannot_be_sent_is_told(shared: Background) -> None:
    """It is an error in words, not an end of the process."""
    before, _ = call(shared, abs, 0)
    with pytest.raises(WorkbenchError, match="cannot pickle"):
        call(shared, lambda _: threading.Lock())
    assert call(shared, abs, 0)[0] == before + 2


def test_an_interrupt_of_the_kernel_ends_nothing(shared: Background) -> None:
    """The signal that reaches the whole process group is left to the kernel."""

    def interrupted(value: int) -> int:
        os.kill(os.getpid(), signal.SIGINT)
        return value + 1

    assert call(shared, interrupted, 41)[1] == 42
