"""What an optimizer does, in plain words."""

from __future__ import annotations

from collections import Counter
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from workbench.optimization.trace import Step, Trace, Try

_DIRECTIONS = (
    "east",
    "north-east",
    "north",
    "north-west",
    "west",
    "south-west",
    "south",
    "south-east",
)
_TITLES = {"alg12": "Alg. 12", "local": "Local search", "global": "Global search"}
_STAGES = {
    "coarse": "coarse points, its share of a grid that all samples use",
    "scout": "coarse points, all of them: it is a scout",
    "start": "starts of descents",
    "probe": "probes",
    "vertex": "lowest points of parabolas through the probes",
    "step": "steps of descents",
    "neighbor": "positions of its neighbours",
    "": "places",
}


def title_of(optimizer: str) -> str:
    """Give an optimizer's name for people: names of the user's own stay as they are."""
    return _TITLES.get(optimizer, optimizer)


def told(trace: Trace) -> list[str]:
    """Say what happens in each step of a trace.

    Parameters
    ----------
    trace : Trace
        Of one sample.

    Returns
    -------
    list of str
        One for each step.
    """
    start = f"Start: where the projection put it. The error is {_number(trace.errors[0])}."
    texts = [start]
    texts += [_step(before, step) for before, step in pairwise(trace.steps)]
    ended = f" The optimization ended after iteration {trace.iterations}: {trace.reason}."
    texts[-1] += ended
    return texts


def _step(before: Step, step: Step) -> str:
    if step.returned:
        return (
            f"Back to iteration {step.iteration}, which had the lowest error of all samples "
            f"together: its error is {_number(step.error)} again."
        )
    stages = [tried.stage for tried in step.tries]
    begin = f"Iteration {step.iteration}. "
    if stages == ["probe"] * 4 + ["step"]:
        return begin + _sweep(before, step)
    if stages == ["probe"] * 4 + ["vertex"]:
        return begin + _pattern(before, step)
    if len(stages) == 1 and step.tries[0].predicted is not None:
        return begin + _model_step(before, step)
    return begin + _others(before, step)


def _sweep(before: Step, step: Step) -> str:
    """Tell a sweep of Alg. 12."""
    probes = step.tries[:4]
    lower = [p for p in probes if p.error < before.error]
    text = _probes(before, probes)
    if not lower:
        return text + "None is lower, so it stays."
    if not step.moved:
        return text + "The differences cancel out, so it stays."
    text += f"It goes {_way(before, step.position)}, against the differences, and finds "
    if step.error < before.error:
        return text + f"{_number(step.error)}: lower."
    return text + f"{_number(step.error)}: not lower, but Alg. 12 does not check its steps."


def _pattern(before: Step, step: Step) -> str:
    """Tell an iteration of the search without derivatives."""
    vertex = step.tries[4]
    text = _probes(before, step.tries[:4])
    if np.array_equal(vertex.position, before.position):
        text += "The parabolas through them are lowest here. "
    else:
        text += f"The parabolas through them are lowest {_way(before, vertex.position)}: "
        text += f"{_number(vertex.error)}. "
    if not step.moved:
        return text + "Nothing is lower, so it stays, and probes half as far next."
    return text + f"The lowest of all is taken: {_number(step.error)}."


def _model_step(before: Step, step: Step) -> str:
    """Tell a step of the trust-region method."""
    tried = step.tries[0]
    assert tried.predicted is not None
    text = (
        f"From the slope and the bend of the error it models a bowl, and tries "
        f"{_way(before, tried.position)}, where {_number(tried.predicted)} is to be expected. "
    )
    if step.moved:
        return text + f"It finds {_number(tried.error)}, lower than {_number(before.error)}: taken."
    return text + (
        f"It finds {_number(tried.error)}, not lower than {_number(before.error)}: it stays, "
        "and its next step is at most a third as long."
    )


def _others(before: Step, step: Step) -> str:
    """Tell what was tried by its kinds, for searches that try many things at once."""
    if not step.tries:
        return "Nothing is tried for it."
    counts = Counter(tried.stage for tried in step.tries)
    parts = []
    for stage, count in counts.items():
        lowest = min(tried.error for tried in step.tries if tried.stage == stage)
        parts.append(f"{count} × {_STAGES.get(stage, stage)} (lowest {_number(lowest)})")
    text = f"It measures {', '.join(parts)}, against {_number(before.error)}. "
    if not step.moved:
        return text + "None is better, so it stays."
    return text + f"It goes {_way(before, step.position)}: {_number(step.error)}."


def _probes(before: Step, probes: tuple[Try, ...]) -> str:
    far = float(np.linalg.norm(probes[0].position - before.position))
    errors = ", ".join(
        f"{_direction(p.position - before.position)} {_number(p.error)}"
        f"{' (lower)' if p.error < before.error else ''}"
        for p in probes
    )
    return f"Probes {_number(far)} away, against {_number(before.error)} here: {errors}. "


def _way(before: Step, place: NDArray[np.float64]) -> str:
    offset = place - before.position
    return f"{_number(float(np.linalg.norm(offset)))} to the {_direction(offset)}"


def _direction(offset: NDArray[np.float64]) -> str:
    turn = np.arctan2(offset[1], offset[0]) / (np.pi / 4)
    return _DIRECTIONS[int(np.round(turn)) % 8]


def _number(value: float) -> str:
    return f"{value:.4g}"
