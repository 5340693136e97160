"""Held-out runs against plain numpy, and against what they must not see."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from workbench.errors import WorkbenchError
from workbench.experiments.grid import run_grid
from workbench.experiments.runs.held_out import HeldOutRun
from workbench.experiments.runs.shared import SharedSteps
from workbench.spaces import PoseSpace, Space, VectorSpace


@pytest.fixture
def table() -> VectorSpace:
    """Give 60 rows on a curved sheet in 4-D, whose columns differ in scale."""
    plane = np.random.default_rng(1).random((60, 2))
    sheet = np.column_stack([plane, np.sin(3 * plane[:, 0]), plane.sum(axis=1) ** 2])
    return VectorSpace(sheet * [1.0, 2.0, 5.0, 0.5] + [3.0, 0.0, 1.0, 9.0], name="sheet")


def _executed(space: Space, **options):
    options = {"projector": "pca", "ratio": 0.2, **options}
    return HeldOutRun("sheet", **options).execute(SharedSteps(space))


def _distances(first, second):
    return np.sqrt(((first[:, None] - second[None]) ** 2).sum(axis=2))


@pytest.mark.parametrize("standardized", [False, True], ids=["raw", "standardized"])
def test_errors_are_those_of_plain_numpy(table, standardized):
    """PCA by SVD, nearest rows and linear RBF weights, written out, give the same errors."""
    row, arrays = _executed(table, seed=3, standardized=standardized)
    test, control = arrays["test"], arrays["control_points"]
    training = np.setdiff1d(np.arange(60), test)
    assert (len(training), len(test), len(control)) == (42, 18, 8)
    rows = table.samples
    if standardized:
        rows = (rows - rows[training].mean(axis=0)) / rows[training].std(axis=0)
    known, new, keys = rows[training], rows[test], np.searchsorted(training, control)

    mean = known.mean(axis=0)
    axes = np.linalg.svd(known - mean, full_matrices=False)[2][:2]
    places = (known - mean) @ axes.T
    low, extent = places.min(axis=0), np.ptp(places, axis=0).max()
    places = (places - low) / extent

    distances = _distances(new, known)
    nearest = np.argsort(distances, axis=1)[:, :5]
    weights = 1 / np.take_along_axis(distances, nearest, axis=1)
    weights /= weights.sum(axis=1, keepdims=True)
    by_mean = np.einsum("nk,nkd->nd", weights, places[nearest])
    by_nearest = places[distances.argmin(axis=1)]
    own = ((new - mean) @ axes.T - low) / extent

    centers = places[keys]
    ones = np.column_stack([np.ones(len(keys)), centers])
    system = np.block([[_distances(centers, centers), ones], [ones.T, np.zeros((3, 3))]])
    solution = np.linalg.solve(system, np.vstack([known[keys], np.zeros((3, 4))]))

    def rebuilt(points):
        basis = [_distances(points, centers), np.ones((len(points), 1)), points]
        return np.hstack(basis) @ solution

    def error(reconstructions):
        return np.linalg.norm(new - reconstructions, axis=1).mean()

    in_plane = _distances(by_mean, places)
    expected = {
        "error_raw_mean": error(rebuilt(by_mean)),
        "error_raw_nearest": error(rebuilt(by_nearest)),
        "error_raw_own": error(rebuilt(own)),
        "error_inverse": error((own * extent + low) @ axes + mean),
        "error_mean_sample": error(mean),
        "error_data_nearest": error(known[distances.argmin(axis=1)]),
        "error_plane_nearest": error(known[in_plane.argmin(axis=1)]),
        "error_plane_mean": error(known[np.argsort(in_plane, axis=1)[:, :5]].mean(axis=1)),
        "error_plane_control": error(known[keys][in_plane[:, keys].argmin(axis=1)]),
    }
    assert {name: row[name] for name in expected} == pytest.approx(expected, rel=1e-9)
    assert arrays["errors_raw"] == pytest.approx(np.linalg.norm(new - rebuilt(by_mean), axis=1))
    assert row["training_error_raw"] == pytest.approx(
        np.linalg.norm(known - rebuilt(places), axis=1).mean()
    )


@pytest.mark.parametrize("standardized", [False, True], ids=["raw", "standardized"])
def test_nothing_is_learnt_from_test_samples(table, standardized):
    """With other test samples, all that is fitted to the training samples stays as it was."""
    row, arrays = _executed(table, standardized=standardized)
    values = table.samples.copy()
    values[arrays["test"]] *= 1.7
    other, other_arrays = _executed(VectorSpace(values), standardized=standardized)
    assert np.array_equal(arrays["control_points"], other_arrays["control_points"])
    fitted = [name for name in row if name.startswith(("training_error", "unexplained"))]
    assert len(fitted) == 6
    assert [row[name] for name in fitted] == [other[name] for name in fitted]
    assert row["error_raw_mean"] != other["error_raw_mean"]


@pytest.mark.parametrize("split", ["random", "blocks"])
def test_nothing_is_learnt_from_test_frames(waving, split):
    """The same for a motion, however it is split."""
    row, arrays = _executed(PoseSpace(waving), projector="isomap", split=split)
    frames = waving.rotations.copy()
    frames[arrays["test"]] = frames[arrays["test"]][:, [1, 0, 3, 2]]
    other, _ = _executed(
        PoseSpace(replace(waving, rotations=frames)), projector="isomap", split=split
    )
    for name in row:
        if name.startswith(("training_error", "unexplained")):
            assert row[name] == other[name]
    assert row["error_raw_mean"] != other["error_raw_mean"]


def test_optimizers_lower_the_training_error(waving):
    """The positions that the maps are fitted to are optimized ones."""
    row, _ = _executed(PoseSpace(waving), split="random", ratio=0.1)
    assert row["training_error_local"] < 0.98 * row["training_error_raw"]
    assert row["training_error_alg12"] < row["training_error_raw"]
    assert row["error_local_mean"] != row["error_raw_mean"]
    assert row["error_self_placed"] < row["error_raw_mean"]


def test_only_what_a_projector_offers_is_measured(table, waving):
    """MDS places nothing new, Isomap has no inverse, PCA of poses has both."""
    mds, isomap = (_executed(table, projector=name)[0] for name in ("mds", "isomap"))
    assert mds["error_raw_own"] is None
    assert mds["error_inverse"] is None
    assert isomap["error_raw_own"] > 0
    assert isomap["error_inverse"] is None
    assert _executed(PoseSpace(waving), split="blocks")[0]["error_inverse"] > 0


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"projector": object()}, "projector of a run: got object, want a registered name"),
        ({"projector": "pca", "split": "halves"}, "split: got 'halves', want one of random"),
    ],
    ids=["projector", "split"],
)
def test_a_run_refuses_what_is_no_plain_value(options, message):
    """A run that could not be stored is refused when it is made."""
    with pytest.raises(WorkbenchError, match=message):
        HeldOutRun("uci/iris", **options)


def test_a_grid_stores_the_run_under_what_it_says(tmp_path):
    """The row says how the data were scaled, and a failed run says which one it was."""
    runs = [
        HeldOutRun("uci/iris", "pca", standardized=True, seed=2),
        HeldOutRun("uci/iris", "pca", split="blocks"),
    ]
    done, failed = (row for _, row in run_grid(runs, tmp_path).iterrows())
    assert (done["status"], done["standardize"], done["n_samples"], done["n_test"]) == (
        "done",
        True,
        150,
        45,
    )
    assert failed["message"].startswith("uci/iris, pca, held out (blocks), 3 %, seed 0: ")
    assert "no order in time" in failed["message"]
