"""Tests of the objective: what it asks of back-projectors and error measures, and checks."""

from __future__ import annotations

import numpy as np
import pytest

from tests.optimization.problems import sheet
from workbench.errors import WorkbenchError
from workbench.optimization import objective as module
from workbench.optimization.global_search import GlobalSearch
from workbench.optimization.gradient_descent import GradientDescent
from workbench.optimization.local_search import LocalSearch
from workbench.optimization.objective import Objective

OPTIMIZERS = pytest.mark.parametrize(
    "optimizer", [LocalSearch, GlobalSearch, GradientDescent], ids=["local", "global", "alg12"]
)


class Wrapped:
    """A back-projector made of functions."""

    def __init__(self, **methods):
        vars(self).update(methods)


def test_errors_do_not_depend_on_the_blocks(monkeypatch):
    """Points are rebuilt and differentiated some at a time, with the same results."""
    problem = sheet()
    points = problem.start[problem.free]
    errors = problem.objective()(points, problem.free)
    derivatives = problem.objective().derivatives(points, problem.free)
    monkeypatch.setattr(module, "_BLOCK", 7)
    monkeypatch.setattr(module, "_DIFFERENTIATED", 9)
    assert np.allclose(problem.objective()(points, problem.free), errors, rtol=1e-12)
    again = problem.objective().derivatives(points, problem.free)
    for part, expected in zip(again, derivatives, strict=True):
        assert np.allclose(part, expected, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("derivatives", [True, False], ids=["of a space", "of a function"])
def test_the_table_holds_every_pair(derivatives):
    """Its entries are the errors of the samples at the points, one by one."""
    problem = sheet()
    objective = problem.objective() if derivatives else problem.objective_without_derivatives()
    points = problem.start[:8]
    table = objective.table(problem.free[:5], objective.back_project(points))
    expected = [objective(points, np.full(8, index)) for index in problem.free[:5]]
    assert np.allclose(table, expected, atol=1e-12)
    assert objective.effort.distances == 2 * 40


def test_a_jacobian_alone_will_do():
    """A back-projector that does not rebuild and differentiate at once is asked for both."""
    problem = sheet()
    inner = problem.back_projector
    expected = problem.run(LocalSearch())
    problem.back_projector = Wrapped(predict=inner.predict, jacobian=inner.jacobian)
    result = problem.run(LocalSearch())
    assert np.allclose(result.errors, expected.errors, atol=1e-12)
    assert result.effort == expected.effort


@OPTIMIZERS
@pytest.mark.parametrize(
    ("errors", "message"),
    [
        (lambda indices, _: np.full(len(indices), np.nan), "errors of reconstructions: got nan"),
        (lambda *_: 1.0, r"errors: got shape \(\) for 40 reconstructions"),
        (lambda indices, _: np.ones((len(indices), 2)), r"errors: got shape \(40, 2\)"),
    ],
    ids=["nan", "one number", "two columns"],
)
def test_an_error_measure_of_ones_own_is_checked(optimizer, errors, message):
    """One finite error for each reconstruction is wanted."""
    problem = sheet()
    objective = Objective(problem.back_projector, errors)
    with pytest.raises(WorkbenchError, match=message):
        optimizer().optimize(objective, problem.start, problem.free, problem.space.neighbors)


@OPTIMIZERS
def test_samples_that_are_not_finite_are_refused(optimizer):
    """A back-projector that fails at some places is found out, whoever asks."""
    problem = sheet()
    inner = problem.back_projector

    def predict(points):
        rebuilt = inner.predict(points)
        rebuilt[points[:, 0] > np.median(points[:, 0])] = np.nan
        return rebuilt

    problem.back_projector = Wrapped(predict=predict)
    with pytest.raises(WorkbenchError, match="errors of reconstructions: got nan"):
        problem.run(optimizer())
    objective = problem.objective()
    with pytest.raises(WorkbenchError, match="errors of reconstructions: got nan"):
        objective.table(problem.free, objective.back_project(problem.start))


@pytest.mark.parametrize(
    ("jacobian", "message"),
    [
        (lambda points: np.full((len(points), 4, 2), np.nan), "gradients of errors: got nan"),
        (lambda points: np.ones((len(points), 4)), r"jacobian .*: got shape \(40, 4\)"),
        (lambda points: np.ones((len(points), 2, 4)), r"want \(40, 4, 2\)"),
    ],
    ids=["nan", "one direction", "transposed"],
)
def test_unfit_jacobians_are_refused(jacobian, message):
    """Derivatives have one more axis than samples, and are finite."""
    problem = sheet()
    problem.back_projector = Wrapped(predict=problem.back_projector.predict, jacobian=jacobian)
    with pytest.raises(WorkbenchError, match=message):
        problem.run(LocalSearch())


@OPTIMIZERS
@pytest.mark.parametrize(
    ("neighbors", "message"),
    [
        (np.full((60, 2), 60), "neighbors: got 60…60, want indices from 0 to 59"),
        (np.full((60, 2), -1), "neighbors: got -1…-1"),
        (np.full((60, 2), 1.5), r"neighbors: got shape \(60, 2\) of float64"),
    ],
    ids=["outside", "negative", "fractions"],
)
def test_neighbors_are_samples(optimizer, neighbors, message):
    """The message says which indices there are."""
    problem = sheet()
    with pytest.raises(WorkbenchError, match=message):
        optimizer().optimize(problem.objective(), problem.start, problem.free, neighbors)


@OPTIMIZERS
def test_something_must_be_free(optimizer):
    """Nothing to move is refused, as there is no error to lower."""
    problem = sheet()
    with pytest.raises(WorkbenchError, match=r"free: got .* at least 1 sample"):
        optimizer().optimize(problem.objective(), problem.start, [], problem.space.neighbors)
