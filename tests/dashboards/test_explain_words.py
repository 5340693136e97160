"""What is said of an optimizer's steps."""

from __future__ import annotations

import numpy as np
import pytest
from sklearn.neighbors import KNeighborsRegressor

from tests.optimization.problems import sheet
from workbench.dashboards.explanation.words import title_of, told
from workbench.optimization.global_search import GlobalSearch
from workbench.optimization.gradient_descent import GradientDescent
from workbench.optimization.local_search import LocalSearch
from workbench.optimization.recording import trace_optimization
from workbench.optimization.trace import Step, Trace, Try

HERE = np.array([0.5, 0.5])


def start(error: float = 0.4) -> Step:
    return Step(0, (), HERE, error, moved=False)


def words(*steps: Step) -> list[str]:
    return told(Trace(0, (start(), *steps), 9, "the reason", 0.1))


def probes(*errors: float) -> tuple[Try, ...]:
    offsets = [[0.1, 0], [0, 0.1], [-0.1, 0], [0, -0.1]]
    return tuple(Try("probe", HERE + o, e) for o, e in zip(offsets, errors, strict=True))


def test_a_sweep_names_its_probes_by_direction_and_tells_which_are_lower() -> None:
    """East, north, west and south come with their errors, and then the way that is taken."""
    place = HERE + np.array([0.07, 0.07])
    tries = (*probes(0.3, 0.35, 0.5, 0.45), Try("step", place, 0.25))
    text = words(Step(1, tries, place, 0.25, moved=True))[1]
    assert "against 0.4 here" in text
    assert "east 0.3 (lower), north 0.35 (lower), west 0.5, south 0.45" in text
    assert "to the north-east" in text
    assert "finds 0.25: lower." in text


def test_a_step_up_is_said_to_be_unchecked() -> None:
    """Alg. 12 may raise an error, and the words say so."""
    place = HERE + np.array([0.1, 0])
    tries = (*probes(0.3, 0.5, 0.6, 0.5), Try("step", place, 0.9))
    text = words(Step(1, tries, place, 0.9, moved=True))[1]
    assert "0.9: not lower, but Alg. 12 does not check its steps" in text


def test_no_lower_probe_means_no_move() -> None:
    """At a local minimum of the probes the sample stays, and the end says why it ended."""
    tries = (*probes(0.5, 0.5, 0.6, 0.5), Try("step", HERE, 0.4))
    text = words(Step(1, tries, HERE, 0.4, moved=False))[1]
    assert "None is lower, so it stays." in text
    assert text.endswith("The optimization ended after iteration 9: the reason.")


def test_a_step_by_a_model_is_compared_with_what_was_expected() -> None:
    """Expected and found errors are told, and whether the step is taken."""
    there = HERE - [0.1, 0]
    good = Try("step", there, 0.3, predicted=0.28)
    bad = Try("step", HERE, 0.6, predicted=0.2)
    _, taken, refused = words(
        Step(1, (good,), there, 0.3, moved=True), Step(2, (bad,), there, 0.3, moved=False)
    )
    assert "0.1 to the west, where 0.28 is to be expected" in taken
    assert "lower than 0.4: taken" in taken
    assert "0.6, not lower than 0.3: it stays" in refused


def test_parabolas_and_the_return_have_words() -> None:
    """A pattern search tells its parabolas; a return tells to which iteration it goes."""
    place = HERE + np.array([0, 0.05])
    tries = (*probes(0.5, 0.35, 0.5, 0.45), Try("vertex", place, 0.3))
    step = Step(1, tries, place, 0.3, moved=True)
    flat = Step(2, (*tries[:4], Try("vertex", place, 0.3)), place, 0.3, moved=False)
    back = Step(1, (), place, 0.3, moved=True, returned=True)
    _, pattern, staying, returned = words(step, flat, back)
    assert "parabolas through them are lowest 0.05 to the north: 0.3" in pattern
    assert "The lowest of all is taken: 0.3." in pattern
    assert "lowest here" in staying
    assert "probes half as far next" in staying
    assert returned.startswith("Back to iteration 1, which had the lowest error")


@pytest.mark.parametrize(
    "optimizer",
    [GradientDescent(), LocalSearch(), GlobalSearch()],
    ids=["alg12", "local", "global"],
)
@pytest.mark.parametrize("derivatives", [True, False], ids=["rbf", "knn"])
def test_every_real_step_is_told(optimizer, derivatives: bool) -> None:
    """Each step has a sentence of its own with the error that the curve shows."""
    made = sheet(noise=0.2)
    if not derivatives:
        made.back_projector = KNeighborsRegressor(3, weights="distance").fit(
            made.start[:20], made.space.samples[:20]
        )
    trace = trace_optimization(
        optimizer, made.space, made.back_projector, made.start, np.arange(20), 41
    )
    texts = told(trace)
    assert len(texts) == len(trace.steps) > 2
    for step, text in zip(trace.steps, texts, strict=True):
        if step.moved:
            assert f"{step.error:.4g}" in text
        elif step.iteration:
            assert "stays" in text


def test_own_optimizers_keep_their_names() -> None:
    """The package's have titles; what a user registered is called what they called it."""
    assert title_of("alg12") == "Alg. 12"
    assert title_of("mine") == "mine"
