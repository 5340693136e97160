"""Do what a page asks for in the thread in which its dashboard was made.

JupyterLab sends what people do with widgets to a thread beside the one that runs cells. Two
threads that change one dashboard would get in each other's way.
"""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Callable
from typing import Any


class Home:
    """The thread, and its event loop, in which a dashboard was made."""

    def __init__(self) -> None:
        self._thread = threading.get_ident()
        self._loop = running_loop()

    def here(self, act: Callable[..., None]) -> Callable[..., None]:
        """Make a function that is called anywhere and done in this thread.

        Parameters
        ----------
        act : callable
            What to do.

        Returns
        -------
        callable
            Does it at once in this thread, and soon from another one.
        """

        def call(*args: Any) -> None:
            if self._loop is None or threading.get_ident() == self._thread:
                act(*args)
            else:
                self._loop.call_soon_threadsafe(act, *args)

        return call


def running_loop() -> asyncio.AbstractEventLoop | None:
    """Give the event loop that runs in this thread, or None."""
    try:
        return asyncio.get_running_loop()
    except RuntimeError:
        return None
