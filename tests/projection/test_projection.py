"""Tests of workbench.projection."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from scipy.spatial.distance import cdist, pdist
from sklearn.base import BaseEstimator, TransformerMixin
from sklearn.datasets import load_iris, make_blobs
from sklearn.manifold import trustworthiness
from sklearn.utils.estimator_checks import check_estimator

from workbench.errors import AdjustmentWarning, DataError, DegenerateDataWarning, WorkbenchError
from workbench.projection import fit_projection, project, projectors, scale_to_unit_square
from workbench.spaces import PoseSpace, VectorSpace

BUILT_IN = projectors.names()
ON_DISTANCES = ["mds", "isomap", "tsne", "umap", "force"]
# umap-learn moves all new samples in one random descent.
EXPECTED_FAILURES = {
    "umap": {
        "check_methods_sample_order_invariance": "places depend on the order of the samples",
        "check_methods_subset_invariance": "places depend on which samples are placed at once",
    }
}


@pytest.fixture(scope="module")
def iris():
    """Give the Iris table."""
    return VectorSpace(load_iris().data, name="iris")


@pytest.mark.parametrize("name", BUILT_IN)
@pytest.mark.filterwarnings("ignore")  # scikit-learn's checks use tiny data on purpose
def test_projectors_follow_scikit_learns_conventions(name):
    """The estimator passes scikit-learn's own checks."""
    check_estimator(projectors.create(name), expected_failed_checks=EXPECTED_FAILURES.get(name))


@pytest.mark.parametrize("name", BUILT_IN)
@pytest.mark.parametrize("dimensions", [2, 3])
def test_same_seed_same_embedding(iris, name, dimensions):
    """Two runs with one seed agree in every digit, in two and three dimensions."""
    projector = projectors.create(name, n_components=dimensions)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DegenerateDataWarning)
        first, second = (project(iris, projector, random_state=7) for _ in range(2))
    assert first.shape == (150, dimensions)
    assert np.array_equal(first, second)


@pytest.mark.parametrize("name", BUILT_IN)
@pytest.mark.parametrize("dimensions", [2, 3])
@pytest.mark.filterwarnings("ignore::workbench.AdjustmentWarning")
def test_motions_are_projected_to_the_plane_and_to_space(waving, name, dimensions):
    """Every method takes poses and fills the unit square or cube."""
    embedding = project(PoseSpace(waving), name, dimensions=dimensions, random_state=0)
    assert embedding.shape == (60, dimensions)
    assert embedding.min() == 0
    assert embedding.max() == 1
    assert np.linalg.matrix_rank(embedding - embedding.mean(axis=0), tol=1e-6) == dimensions


@pytest.mark.parametrize("name", BUILT_IN)
@pytest.mark.filterwarnings("ignore::workbench.DegenerateDataWarning")
def test_projections_keep_neighborhoods(iris, name):
    """Every method is trustworthy on Iris, far above the 0.5 of a random layout."""
    embedding = project(iris, name, random_state=0)
    assert trustworthiness(iris.samples, embedding, n_neighbors=10) > 0.9


@pytest.mark.parametrize("name", ON_DISTANCES)
def test_precomputed_distances_serve_as_well_as_vectors(iris, name):
    """A projector given Euclidean distances keeps them as well as one given the vectors."""
    projector = projectors.create(name)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DegenerateDataWarning)
        if "random_state" in projector.get_params():
            projector.set_params(random_state=0)
        on_vectors = projector.fit_transform(iris.samples)
        on_distances = projector.set_params(metric="precomputed").fit_transform(iris.distances)
    scores = [trustworthiness(iris.samples, e, n_neighbors=10) for e in (on_vectors, on_distances)]
    assert scores[1] == pytest.approx(scores[0], abs=0.02)


@pytest.mark.parametrize("name", ["pca", "mds"])
def test_a_plane_in_space_is_recovered_exactly(name):
    """Points of a plane in 10 dimensions keep all their distances."""
    rng = np.random.default_rng(0)
    plane = rng.normal(size=(40, 2))
    basis = np.linalg.qr(rng.normal(size=(10, 2)))[0]
    embedding = projectors.create(name).fit_transform(plane @ basis.T + 5.0)
    assert np.allclose(pdist(embedding), pdist(plane), atol=1e-9)


def test_isomap_unrolls_a_curve():
    """Points along a spiral come out in the order and spacing of their arc length."""
    angle = np.linspace(1, 4 * np.pi, 200)
    spiral = np.stack([angle * np.cos(angle), angle * np.sin(angle)], axis=1)
    arc = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(spiral, axis=0), axis=1))])
    first = projectors.create("isomap", n_neighbors=4).fit_transform(spiral)[:, 0]
    assert abs(np.corrcoef(first, arc)[0, 1]) > 0.999


def test_pca_places_new_samples_on_the_map(iris):
    """Transforming the training samples gives their positions, halves give half maps."""
    projector = projectors.create("pca").fit(iris.samples)
    assert np.allclose(projector.transform(iris.samples), projector.embedding_)
    assert np.allclose(projector.transform(iris.samples[:9]), projector.embedding_[:9])


@pytest.mark.parametrize(
    ("name", "parameter"),
    [
        ("isomap", "n_neighbors"),
        ("lle", "n_neighbors"),
        ("tsne", "perplexity"),
        ("umap", "n_neighbors"),
    ],
)
def test_parameters_too_large_for_the_data_are_lowered_and_said(name, parameter):
    """Nine samples allow neither 14 neighbours nor a perplexity of 50."""
    samples = np.random.default_rng(0).normal(size=(9, 4))
    with pytest.warns(AdjustmentWarning, match=f"{parameter}=.* lowered to"):
        embedding = projectors.create(name).fit_transform(samples)
    assert np.isfinite(embedding).all()


@pytest.mark.parametrize(
    ("name", "parameter", "value"),
    [
        ("isomap", "n_neighbors", 14),
        ("lle", "n_neighbors", 15),
        ("tsne", "perplexity", 50),
        ("force", "n_iterations", 50),
        ("force", "step", 8),
    ],
)
def test_defaults_are_those_of_the_thesis(name, parameter, value):
    """Costa 2018, chapter 5 and Alg. 7: neighbours, perplexity, iterations and step."""
    assert projectors.create(name).get_params()[parameter] == value


@pytest.mark.parametrize("name", BUILT_IN)
def test_constant_data_are_refused_alike(name):
    """Data without any difference cannot be projected, whatever the method."""
    with pytest.raises(WorkbenchError, match="flat: all samples are equal"):
        project(VectorSpace(np.full((20, 3), 0.1), name="flat"), name)


@pytest.mark.parametrize("name", ["isomap", "lle", "umap"])
def test_a_graph_in_parts_is_said(name):
    """Two far clusters are projected all the same, and the warning counts the parts."""
    samples, _ = make_blobs([25, 25], centers=[[0, 0], [99, 99]], random_state=0)
    with pytest.warns(DegenerateDataWarning, match="falls into 2 parts"):
        embedding = projectors.create(name, n_neighbors=5).fit_transform(samples)
    assert np.isfinite(embedding).all()


@pytest.mark.parametrize("name", [name for name in BUILT_IN if name != "pca"])
def test_what_will_not_fit_into_memory_is_refused(monkeypatch, name):
    """Ten million samples are too many for 10 GB; the message tells what to do instead."""

    def refuse(n_bytes, what, instead):
        if n_bytes > 10e9:
            raise DataError(f"{what} needs {n_bytes / 1e9:.0f} GB; {instead}")

    monkeypatch.setattr("workbench.projection.base.require_memory", refuse)
    samples = np.arange(10_000_000.0)[:, None]
    with pytest.raises(DataError, match=r"of 10000000 samples needs \d+ GB; .*in two steps"):
        projectors.create(name).fit_transform(samples)


@pytest.mark.parametrize("name", ["mds", "isomap", "lle", "force"])
def test_methods_on_all_pairs_ask_for_the_memory_of_a_matrix_at_least(name):
    """What they ask for grows with the square: no less than one matrix of distances."""
    projector = projectors.create(name)
    assert projector._memory((5000, 9)) >= 8 * 5000**2
    assert projector._memory((10_000, 9)) == 4 * projector._memory((5000, 9))


def test_pca_asks_for_the_memory_of_its_factors():
    """It is linear in both: three times the table of samples."""
    assert projectors.create("pca")._memory((10_000, 9)) == 3 * 8 * 10_000 * 9


@pytest.mark.parametrize("name", ON_DISTANCES)
@pytest.mark.parametrize(
    ("spoil", "message"),
    [
        (lambda d: d[:, :-1], r"got shape \(20, 19\), want a square"),
        (lambda d: -d, "want none below 0"),
        (lambda d: np.triu(d), "not symmetric"),
    ],
    ids=["not square", "negative", "one-sided"],
)
def test_matrices_that_hold_no_distances_are_refused(name, spoil, message):
    """Other shapes, signs and one-sided matrices are named."""
    samples = np.random.default_rng(0).normal(size=(20, 3))
    projector = projectors.create(name, metric="precomputed")
    with pytest.raises(WorkbenchError, match=message):
        projector.fit_transform(spoil(cdist(samples, samples)))


@pytest.mark.parametrize("name", ["pca", "isomap", "umap"])
def test_new_samples_are_placed_near_their_like(iris, name):
    """Flowers that the map has not seen come to lie among their own species."""
    new = np.arange(150) % 5 == 0
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DegenerateDataWarning)
        projector = projectors.create(name).fit(iris.samples[~new])
    placed = projector.transform(iris.samples[new])
    species = np.repeat([0, 1, 2], 50)
    nearest = cdist(placed, projector.embedding_).argmin(axis=1)
    assert np.mean(species[~new][nearest] == species[new]) > 0.85


def test_pcas_inverse_is_the_nearest_point_of_its_plane(iris):
    """Going there and back is the identity on the map and leaves the rest of the variance."""
    projector = projectors.create("pca").fit(iris.samples)
    rebuilt = projector.inverse_transform(projector.embedding_)
    assert np.allclose(projector.transform(rebuilt), projector.embedding_)
    left = np.linalg.svd(iris.samples - iris.samples.mean(axis=0), compute_uv=False)[2:]
    assert np.linalg.norm(rebuilt - iris.samples) == pytest.approx(np.linalg.norm(left))


@pytest.mark.filterwarnings("ignore::workbench.DegenerateDataWarning")
def test_umaps_inverse_rebuilds_flowers(iris):
    """Ten positions of the map give samples far nearer to theirs than the mean is."""
    projector = projectors.create("umap", random_state=0).fit(iris.samples)
    rebuilt = projector.inverse_transform(projector.embedding_[::15])
    error = np.linalg.norm(rebuilt - iris.samples[::15], axis=1).mean()
    assert error < 0.3 * iris.mean_prediction_error()


@pytest.mark.filterwarnings("ignore::workbench.DegenerateDataWarning")
def test_a_map_of_distances_has_no_inverse(iris):
    """Distances do not tell what the samples are; the message says which metric does."""
    projector = projectors.create("umap", metric="precomputed").fit(iris.distances[:40, :40])
    with pytest.raises(WorkbenchError, match="metric: got 'precomputed', want 'euclidean'"):
        projector.inverse_transform([[0.0, 0.0]])


@pytest.mark.parametrize(
    ("points", "message"),
    [([[1.0, 2.0, 3.0]], r"shape \(1, 3\)"), ([1.0, 2.0], r"shape \(2,\)"), ([[np.nan, 0]], "nan")],
    ids=["three dimensions", "one point", "nan"],
)
def test_inverses_refuse_what_are_no_positions(iris, points, message):
    """Other shapes and gaps are named."""
    with pytest.raises(WorkbenchError, match=f"X: got .*{message}"):
        projectors.create("pca").fit(iris.samples).inverse_transform(points)


def test_an_inverse_in_the_coordinates_of_the_unit_square(iris):
    """A fitted projection tells how its scaled positions read in the projector's own."""
    projection = fit_projection(iris, "pca")
    rebuilt = projection.projector.inverse_transform(projection.unscaled(projection.embedding))
    expected = projectors.create("pca").fit(iris.samples)
    assert np.allclose(rebuilt, expected.inverse_transform(expected.embedding_), atol=1e-9)


def test_motions_are_projected_by_their_pose_distances(waving):
    """MDS of a motion equals MDS of its D_q matrix."""
    space = PoseSpace(waving)
    expected = projectors.create("mds", metric="precomputed").fit_transform(space.distances)
    assert np.array_equal(project(space, "mds"), scale_to_unit_square(expected))


def test_scaling_to_the_unit_square_keeps_the_shape():
    """Distances shrink by one factor, the larger extent becomes 1."""
    points = np.random.default_rng(0).normal(size=(30, 2)) * [9, 2] + 100
    scaled = scale_to_unit_square(points)
    ratio = cdist(scaled, scaled)[0, 1:] / cdist(points, points)[0, 1:]
    assert np.allclose(ratio, ratio[0])
    assert scaled.min() == 0
    assert scaled.max() == pytest.approx(1)


def test_coinciding_points_cannot_be_scaled():
    """An embedding in one place is refused."""
    with pytest.raises(WorkbenchError, match="one place"):
        scale_to_unit_square(np.ones((5, 2)))


def test_a_users_own_projector_is_found_by_name(iris, monkeypatch):
    """A registered class is used like a built-in one, and its parameters are not changed."""

    class FirstTwo(TransformerMixin, BaseEstimator):
        def fit(self, X, y=None):
            return self

        def transform(self, X):
            return X[:, :2]

    monkeypatch.setattr(projectors, "_entries", dict(projectors._entries))
    projectors.register("first-two", FirstTwo)
    assert np.array_equal(project(iris, "first-two"), scale_to_unit_square(iris.samples[:, :2]))


def test_a_projector_with_a_wrong_result_is_named(iris):
    """An embedding of the wrong shape is refused with the projector's name."""

    class Wrong(TransformerMixin, BaseEstimator):
        def fit(self, X, y=None):
            return self

        def transform(self, X):
            return X

    with pytest.raises(WorkbenchError, match=r"embedding by 'Wrong'.*\(150, 4\)"):
        project(iris, Wrong())


def test_fit_transform_is_all_that_a_projector_needs(iris):
    """A plain class with that one method projects."""

    class FirstTwo:
        def fit_transform(self, X):
            return X[:, :2]

    expected = scale_to_unit_square(iris.samples[:, :2])
    assert np.array_equal(project(iris, FirstTwo()), expected)
