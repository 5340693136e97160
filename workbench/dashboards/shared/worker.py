"""Do what is wanted, one job after the other, beside the kernel."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Hashable, Sequence
from typing import Any, Generic, TypeVar

from workbench.dashboards.shared.background import Background, Report, Stopped
from workbench.dashboards.shared.home import running_loop
from workbench.errors import WorkbenchError

Job = TypeVar("Job", bound=Hashable)


class Worker(Generic[Job]):
    """Keep results for what is wanted: compute what is missing, end what no longer is.

    Inside a running loop, as in a notebook, it works beside the kernel; outside, where nothing
    could show progress, :meth:`wake` returns when everything is done.

    Parameters
    ----------
    background : Background
        Where jobs are done; its object has ``answer(job, *context, report=)``.
    missing : callable
        Lists the jobs that are wanted and neither done nor failed, the most urgent first.
    failures : dict of Job to str
        Gets why jobs have no result, in plain words.
    prepare : callable
        Turns a job into what is sent, and what else belongs to it; it may fail.
    done : callable
        Gets a job, as it was prepared, and its result.
    changed : callable
        Is called whenever there is something new to show.
    report : callable
        Gets the progress of the current job.

    Attributes
    ----------
    current : Job or None
        What is being computed.
    """

    def __init__(
        self,
        background: Background,
        *,
        missing: Callable[[], Sequence[Job]],
        failures: dict[Job, str],
        prepare: Callable[[Job], tuple[Job, Any]],
        done: Callable[[Job, Any], None],
        changed: Callable[[], None],
        report: Report,
    ) -> None:
        self.current: Job | None = None
        self._failures = failures
        self._background = background
        self._missing = missing
        self._prepare = prepare
        self._done = done
        self._changed = changed
        self._report = report
        self._working = False
        # Kept, because a loop holds its tasks only weakly.
        self._task: asyncio.Task[None] | None = None

    def wake(self) -> None:
        """Compute what is missing, and end what is no longer wanted."""
        if self.current is not None and self.current not in self._missing():
            self._background.stop()
        self._changed()
        if self._working:
            return
        self._working = True
        loop = running_loop()
        if loop is None:
            asyncio.run(self._work())
        else:
            self._task = loop.create_task(self._work())

    def cancel(self) -> None:
        """End what is being computed, and let all that is missing be."""
        for job in self._missing():
            self._failures[job] = "cancelled"
        self._background.stop()
        self._changed()

    async def finished(self) -> None:
        """Wait until nothing is missing."""
        while self._working and self._task is not None:
            # Shielded, because who gives up waiting does not cancel the computation.
            await asyncio.shield(self._task)

    async def _work(self) -> None:
        try:
            while missing := self._missing():
                self.current = missing[0]
                await self._do(missing[0])
        finally:
            self._working = False
            self.current = None
            self._changed()

    async def _do(self, job: Job) -> None:
        self._changed()
        try:
            prepared, context = self._prepare(job)
            result = await self._background.call("answer", prepared, context, report=self._report)
            self._done(prepared, result)
        except Stopped:
            pass
        except WorkbenchError as error:
            self._failures[job] = str(error)
        except Exception as error:  # told in its place: nobody awaits the task
            self._failures[job] = f"{type(error).__name__}: {error}"
