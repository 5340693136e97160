"""Execute one run, in whichever process, on the data and the code it was planned with."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace

from workbench.errors import WorkbenchError
from workbench.experiments.runs.base import Run, content_key, space_checksum
from workbench.experiments.runs.shared import SharedSteps
from workbench.experiments.store import Arrays, ResultStore, Row
from workbench.experiments.versions import versions


@dataclass(frozen=True, eq=False)
class PlannedRun:
    """A run that is to be executed, with all that its result depends on.

    Attributes
    ----------
    run : Run
        What to execute.
    key : str
        Content key under which the result is stored.
    checksum : str
        Checksum of the data.
    versions : dict of str to str
        Versions of what decides numerical results, where the run was planned.
    """

    run: Run
    key: str
    checksum: str
    versions: dict[str, str] = field(default_factory=versions)


@dataclass(frozen=True, eq=False)
class Outcome:
    """What became of a run.

    Attributes
    ----------
    planned : PlannedRun
        The run.
    row : dict or None
        Its values; None if it failed.
    arrays : dict of str to ndarray
        Its arrays, until they are stored.
    message : str
        Why it failed.
    """

    planned: PlannedRun
    row: Row | None
    arrays: Arrays = field(default_factory=dict)
    message: str = ""


class Workspace:
    """Execute runs and keep the shared steps of the data set that was used last.

    Runs of one data set that follow each other share its distances and projections; no more
    than one data set is held, since its distances may fill much of the memory.
    """

    def __init__(self) -> None:
        self._held: tuple[str, bool, str] | None = None
        self._shared: SharedSteps | None = None

    def execute(self, planned: PlannedRun) -> Outcome:
        """Execute a run; whatever it raises is told in the outcome.

        A run is refused if its data, its code or the versions of the packages are not those
        that it was planned with: its result would be stored under a key that promises them.

        Parameters
        ----------
        planned : PlannedRun
            The run.

        Returns
        -------
        Outcome
            With ``seconds_spent`` in its row: the time that the run took here, which
            contains a shared step only if this run was the first to ask for it.
        """
        start = time.perf_counter()
        try:
            shared = self._steps(planned)
            values, arrays = planned.run.execute(shared)
        except Exception as error:  # whatever a method raises must not stop the others
            return Outcome(planned, None, message=f"{type(error).__name__}: {error}")
        made_with = {f"version_{name}": value for name, value in versions().items()}
        row = {
            **planned.run.specification(),
            **values,
            "seconds_spent": time.perf_counter() - start,
            **made_with,
        }
        return Outcome(planned, row, arrays)

    def _steps(self, planned: PlannedRun) -> SharedSteps:
        from workbench.datasets import load_space

        run = planned.run
        wanted = (run.dataset, run.standardize, planned.checksum)
        if self._shared is None or self._held != wanted:
            # Let the memory go before more is taken.
            self._shared = None
            space = load_space(run.dataset, standardize=run.standardize)
            self._held = (run.dataset, run.standardize, space_checksum(space))
            self._shared = SharedSteps(space)
        _require_same(planned, self._held[2])
        return self._shared


def _require_same(planned: PlannedRun, checksum: str) -> None:
    if content_key(planned.run, checksum) == planned.key:
        return
    if checksum != planned.checksum:
        raise WorkbenchError(
            f"{planned.run.dataset}: the data found where the run was executed are not those "
            "found where it was planned"
        )
    here = versions()
    different = [
        f"{name} {here.get(name, 'missing')} instead of {version}"
        for name, version in planned.versions.items()
        if here.get(name) != version
    ]
    if different:
        raise WorkbenchError(
            f"the process that was to execute the run has {', '.join(different)}; install there "
            "what it was planned with"
        )
    raise WorkbenchError(
        "the process that was to execute the run has other code of workbench, under the same "
        "version number (was a file changed meanwhile?)"
    )


def keep(store: ResultStore, outcome: Outcome) -> Outcome:
    """Store a result, and let go of its arrays.

    Parameters
    ----------
    store : ResultStore
        Where to.
    outcome : Outcome
        Of a run; a failed one is passed on as it is.

    Returns
    -------
    Outcome
        Without arrays; that of a failed run if the row cannot be stored as it is.

    Raises
    ------
    WorkbenchError
        If the folder does not take it: the disk is full, say. Each further run would be
        computed in vain.
    """
    if outcome.row is None:
        return outcome
    try:
        store.write(outcome.planned.key, outcome.row, outcome.arrays)
    except OSError as error:
        raise WorkbenchError(
            f"{store.folder}: a result could not be stored ({error.strerror or error}); what "
            "was stored before is kept, so make room there and run the grid again"
        ) from None
    except (TypeError, ValueError) as error:
        return Outcome(outcome.planned, None, message=f"{type(error).__name__}: {error}")
    return replace(outcome, arrays={})


def found(store: ResultStore, planned: PlannedRun) -> Outcome | None:
    """Read the result of a run that another process may have finished meanwhile."""
    row = store.read(planned.key)
    return None if row is None else Outcome(planned, row)


@contextmanager
def one_thread(*, kernels: bool) -> Iterator[None]:
    """Let libraries compute in one thread, so that sums are rounded alike everywhere.

    Parameters
    ----------
    kernels : bool
        Whether the compiled kernels of this package keep to one thread too, as several
        processes on one machine should. Their results are the same with any number.
    """
    from threadpoolctl import threadpool_limits

    if not kernels:
        with threadpool_limits(1):
            yield
        return
    import numba

    before = numba.get_num_threads()
    numba.set_num_threads(1)
    try:
        with threadpool_limits(1):
            yield
    finally:
        numba.set_num_threads(before)
