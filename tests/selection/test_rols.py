"""Tests of workbench.selection.rols."""

from __future__ import annotations

import numpy as np
import pytest

from tests.selection.conftest import still_motion
from workbench.errors import DataError, DegenerateDataWarning, WorkbenchError
from workbench.selection import rols
from workbench.selection.rols import RegularizedOrthogonalLeastSquares, orthogonal_selection
from workbench.spaces import VectorSpace


def naive(columns, outputs, count, r, first):
    """Orthogonalise all columns anew for every choice, by a QR decomposition of those chosen."""
    targets = outputs - outputs.mean(axis=0)
    chosen = []
    for i in range(count):
        rest = columns
        if chosen:
            basis, _ = np.linalg.qr(columns[:, chosen])
            rest = columns - basis @ (basis.T @ columns)
        ratios = np.array(
            [
                -1.0
                if j in chosen
                else sum((a @ q) ** 2 / ((a @ a + r) * (q @ q)) for q in targets.T)
                for j, a in enumerate(rest.T)
            ]
        )
        chosen.append(int(first[i]) if i < len(first) else int(np.argmax(ratios)))
    return chosen


@pytest.fixture
def table():
    """Give 60 rows of 4 numbers."""
    return VectorSpace(np.random.default_rng(4).normal(size=(60, 4)), name="cloud")


@pytest.mark.parametrize("fixed", [[], [7, 2]], ids=["free", "fixed"])
@pytest.mark.parametrize("seed", range(4))
def test_choices_are_those_of_a_plain_implementation(seed, fixed):
    """Columns and their order agree with orthogonalising the whole matrix each time."""
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(40, 3))
    columns = np.sqrt(1 + ((points[:, None] - points) ** 2).sum(axis=2))
    outputs = points[:, :2] + 0.1 * rng.normal(size=(40, 2)) + 5.0
    first = np.array(fixed, dtype=np.intp)
    found = orthogonal_selection(columns, outputs, 12, 1e-5, first)
    assert found.tolist() == naive(columns, outputs, 12, 1e-5, fixed)


def test_with_all_candidates_the_matrix_is_that_of_rbfp(table):
    """For vectors the argument of the multiquadric is the Euclidean distance."""
    selector = RegularizedOrthogonalLeastSquares(subset=1.0, outputs=table.samples)
    wanted = naive(np.sqrt(1 + table.distances**2), table.samples, 8, 1e-5, [])
    assert selector.select(table, 8).tolist() == sorted(wanted)


def test_between_poses_the_argument_is_the_root_of_the_distance(wandering):
    """For motions it is √D_q, so the square is D_q itself."""
    outputs = wandering.features[:, [0, 13]]
    selector = RegularizedOrthogonalLeastSquares(subset=1.0, outputs=outputs)
    wanted = naive(np.sqrt(1 + wandering.distances), outputs, 6, 1e-5, [])
    assert selector.select(wandering, 6).tolist() == sorted(wanted)


def test_each_choice_lowers_the_residual(table):
    """The more columns are chosen, the less of the outputs is left by least squares."""
    columns = np.sqrt(1 + table.distances**2)
    targets = table.samples - table.samples.mean(axis=0)
    nothing = np.empty(0, dtype=np.intp)
    chosen = orthogonal_selection(columns, table.samples, 15, 1e-5, nothing)
    left = []
    for n in range(1, 16):
        weights = np.linalg.lstsq(columns[:, chosen[:n]], targets, rcond=None)[0]
        left.append(np.linalg.norm(targets - columns[:, chosen[:n]] @ weights))
    assert np.all(np.diff(left) < 0)


def test_a_linear_output_is_explained_by_its_two_ends():
    """On a line, the two columns chosen for the coordinate come from opposite sides."""
    line = VectorSpace(np.linspace(-10, 10, 41)[:, None])
    chosen = RegularizedOrthogonalLeastSquares(subset=1.0).select(line, 2)
    assert line.samples[chosen[0], 0] < 0 < line.samples[chosen[1], 0]


@pytest.mark.parametrize("name", ["table", "wandering"])
def test_the_seed_decides_and_fixed_samples_stay(request, name):
    """One seed gives one selection, others give others, fixed samples always stay."""
    space = request.getfixturevalue(name)
    runs = [
        RegularizedOrthogonalLeastSquares(random_state=seed).select(space, 8, fixed=[3, 30])
        for seed in (1, 1, 2)
    ]
    assert np.array_equal(runs[0], runs[1])
    assert not np.array_equal(runs[0], runs[2])
    for found in runs:
        assert {3, 30} <= set(found.tolist())
        assert len(found) == 8
        assert np.all(np.diff(found) > 0)


def test_the_share_grows_with_the_count(table):
    """More control points than candidates: all that are wanted are found."""
    found = RegularizedOrthogonalLeastSquares(subset=0.1, random_state=0).select(table, 50)
    assert len(set(found.tolist())) == 50


def test_copies_of_a_sample_do_no_harm():
    """Columns that depend on others add nothing, and the count is right all the same."""
    values = np.repeat(np.random.default_rng(0).normal(size=(4, 2)), 8, axis=0)
    found = RegularizedOrthogonalLeastSquares(subset=1.0).select(VectorSpace(values), 10)
    assert len(set(found.tolist())) == 10
    assert len(np.unique(values[found], axis=0)) == 4


def test_outputs_that_do_not_vary_are_said():
    """A motion without any motion leaves the choice open."""
    with pytest.warns(DegenerateDataWarning, match="no output varies"):
        found = RegularizedOrthogonalLeastSquares(random_state=0).select(still_motion(12), 4)
    assert len(set(found.tolist())) == 4


def test_too_little_memory_is_said_before_it_is_used(table, monkeypatch):
    """The message tells how to do with less."""

    def none_left(n_bytes, what, instead):
        raise DataError(f"{what} needs {n_bytes:g} bytes; {instead}")

    monkeypatch.setattr(rols, "require_memory", none_left)
    with pytest.raises(DataError, match=r"30 candidates needs 28800 .* smaller share"):
        RegularizedOrthogonalLeastSquares().select(table, 5)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"regularization": 0}, "regularization: got 0, want a number above 0"),
        ({"regularization": np.nan}, "regularization: got nan"),
        ({"subset": 1.5}, "subset: got 1.5, want a number above 0 and at most 1"),
        ({"subset": "all"}, "subset: got 'all'"),
        ({"outputs": "map"}, "outputs: got 'map'"),
        ({"outputs": np.ones((5, 2))}, r"outputs: got shape \(5, 2\), want \(60"),
        ({"outputs": np.full((60, 2), np.inf)}, "outputs: got inf"),
    ],
    ids=["zero", "nan", "above 1", "word", "unknown", "shape", "infinite"],
)
def test_bad_parameters_are_refused(table, options, message):
    """The message names the parameter."""
    with pytest.raises(WorkbenchError, match=message):
        RegularizedOrthogonalLeastSquares(**options).select(table, 5)
