"""What every registered projector and control-point projector keeps, on random data."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.contract.strategies import examples, poses, seeds, spaces, tables
from workbench.errors import AdjustmentWarning, DataError
from workbench.projection import control_point_projectors, project, projectors
from workbench.projection.two_step import project_in_two_steps
from workbench.spaces import Space, VectorSpace

every_projector = pytest.mark.parametrize("name", projectors.names())
#: umap-learn takes seconds to compile and long for each run, so it gets one example of each.
QUICK = [name for name in projectors.names() if name != "umap"]
#: Eigenvectors of nearly equal eigenvalues, and descents, make large differences of small ones.
AMPLIFY_ROUNDING = {"lle", "tsne"}
quick_projectors = pytest.mark.parametrize("name", QUICK)
every_control_point_projector = pytest.mark.parametrize("name", control_point_projectors.names())
both_dimensions = pytest.mark.parametrize("dimensions", [2, 3])
pytestmark = pytest.mark.filterwarnings("ignore::UserWarning")


def check_embedding(space: Space, name: str, dimensions: int, seed: int) -> None:
    """Check one projection, and that it can be had again from untouched samples."""
    before = space.samples.copy()
    found = project(space, name, dimensions=dimensions, random_state=seed)
    again = project(space, name, dimensions=dimensions, random_state=seed)
    assert found.shape == (len(space), dimensions)
    assert np.isfinite(found).all()
    assert (found.min(), found.max()) == (0.0, 1.0)
    assert np.array_equal(found, again)
    assert np.array_equal(space.samples, before)


@quick_projectors
@both_dimensions
@examples
@given(space=spaces(), seed=seeds)
def test_embeddings_fill_the_unit_square(name, dimensions, space, seed):
    """As many positions as samples, finite, the same for the same seed, however few."""
    check_embedding(space, name, dimensions, seed)


@settings(examples, max_examples=1)
@given(space=tables(8, 12), seed=seeds)
def test_umap_fills_the_unit_square(space, seed):
    """The same of UMAP."""
    check_embedding(space, "umap", 2, seed)


@every_projector
@pytest.mark.parametrize("n_samples", [3, 20])
def test_parameters_too_large_are_lowered_and_said(name, n_samples):
    """Defaults that need more samples than there are become what these allow."""
    space = VectorSpace(np.random.default_rng(0).normal(size=(n_samples, 4)))
    projector = projectors.create(name)
    limits = {"n_neighbors": n_samples - 1, "perplexity": (n_samples - 1) / 3}
    lowered = [p for p, most in limits.items() if getattr(projector, p, 0) > most]
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        assert project(space, name, random_state=0).shape == (n_samples, 2)
    said = [str(w.message) for w in caught if issubclass(w.category, AdjustmentWarning)]
    assert len(said) == len(lowered)
    for parameter in lowered:
        assert f"{parameter}={getattr(projector, parameter)} lowered to" in said[0]


@every_projector
def test_equal_samples_are_refused(name):
    """Where all rows are equal there is nothing to project."""
    with pytest.raises(DataError, match="all samples are equal"):
        project(VectorSpace(np.ones((9, 3)), name="ones"), name, random_state=0)


@pytest.mark.parametrize("name", [n for n in QUICK if n not in AMPLIFY_ROUNDING])
@examples
@given(space=tables(), unit=st.sampled_from([0.25, 16.0]), shift=st.sampled_from([0.0, 8.0]))
def test_units_do_not_change_what_is_near(name, space, unit, shift):
    """Measured in another unit and from another zero, a table has the same map, to rounding."""
    maps = [
        project(VectorSpace(values), name, random_state=0)
        for values in (space.samples, unit * space.samples + shift)
    ]
    apart = [np.linalg.norm(m[:, None] - m[None], axis=2) for m in maps]
    assert np.abs(apart[0] - apart[1]).max() < 1e-5


@every_control_point_projector
@both_dimensions
@examples
@given(space=spaces(), draw=st.data())
def test_control_points_keep_their_positions(name, dimensions, space, draw):
    """Different samples stay where they were put; new ones get finite places."""
    control = draw_control_points(draw, space)
    positions = np.random.default_rng(draw.draw(seeds)).random((len(control), dimensions))
    before = space.samples.copy()
    fitted = control_point_projectors.create(name).fit(space, control, positions)
    apart = space.cross_distances(space.samples[control], space.samples[control])
    alone = np.sum(apart == 0, axis=1) == 1
    placed = fitted.transform(space.samples[control])
    assert np.abs(placed - positions)[alone].max(initial=0.0) < 1e-6
    assert len(fitted.control_samples_) == len(np.unique(apart == 0, axis=0))
    everywhere = fitted.transform(space.samples)
    assert everywhere.shape == (len(space), dimensions)
    assert np.isfinite(everywhere).all()
    assert np.array_equal(space.samples, before)


@every_control_point_projector
@examples
@given(space=tables(), draw=st.data())
def test_equal_samples_share_a_place(name, space, draw):
    """A row that occurs twice is put in one place, with new samples as with old ones."""
    control = draw_control_points(draw, space)
    positions = np.random.default_rng(draw.draw(seeds)).random((len(control), 2))
    fitted = control_point_projectors.create(name).fit(space, control, positions)
    doubled = fitted.transform(np.repeat(space.samples, 2, axis=0))
    assert np.array_equal(doubled[::2], doubled[1::2])
    # The place of a sample does not depend on which others are placed with it.
    assert np.allclose(fitted.transform(space.samples[:1]), doubled[:1], atol=1e-9)


@every_control_point_projector
@examples
@given(space=poses(4, 12), draw=st.data())
def test_two_steps_place_all_samples(name, space, draw):
    """Whatever is drawn as control points, the map fills the unit square."""
    control = draw_control_points(draw, space)
    if not np.ptp(space.features[control], axis=0).any():
        return  # equal control points leave nothing to project, as other tests say
    found = project_in_two_steps(space, "mds", name, control, seed_share=0.0, random_state=0)
    assert found.shape == (len(space), 2)
    assert (found.min(), found.max()) == (0.0, 1.0)


def draw_control_points(draw: st.DataObject, space: Space) -> np.ndarray:
    rows = st.integers(0, len(space) - 1)
    return np.sort(draw.draw(st.lists(rows, min_size=3, max_size=8, unique=True), "control"))
