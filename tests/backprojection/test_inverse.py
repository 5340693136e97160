"""Tests of workbench.backprojection.inverse."""

from __future__ import annotations

import numpy as np
import pytest
from sklearn import decomposition
from sklearn.exceptions import NotFittedError

from workbench.backprojection import back_projector_for
from workbench.backprojection.inverse import ProjectorInverse
from workbench.errors import WorkbenchError
from workbench.projection import fit_projection
from workbench.projection.fitted import Projection
from workbench.schemes import SpatialScheme
from workbench.spaces import PoseSpace, VectorSpace

rng = np.random.default_rng(0)
SAMPLES = rng.normal(size=(60, 7)) * np.arange(1, 8)


def pca_projection(samples, components=2):
    """Give a projection by scikit-learn's PCA, scaled as schemes scale theirs."""
    pca = decomposition.PCA(components).fit(samples)
    plane = pca.transform(samples)
    low, extent = plane.min(axis=0), float(np.ptp(plane, axis=0).max())
    return Projection((plane - low) / extent, pca, low, extent)


@pytest.mark.parametrize("components", [2, 3], ids=["2-D", "3-D"])
def test_it_is_the_projectors_inverse_in_the_projectors_coordinates(components):
    """The unit square is scaled back before PCA puts points on its plane."""
    projection = pca_projection(SAMPLES, components)
    inverse = ProjectorInverse()
    inverse.use_projection(projection)
    found = inverse.fit(projection.embedding[:5], SAMPLES[:5]).predict(projection.embedding)
    pca = projection.projector
    assert np.allclose(found, pca.inverse_transform(pca.transform(SAMPLES)))


def test_a_plane_is_recovered():
    """Samples of a plane in 10-D come back from their projection to 1e-9."""
    axes = np.linalg.qr(rng.normal(size=(10, 2)))[0].T
    samples = rng.random((50, 2)) @ axes + 3.0
    projection = pca_projection(samples)
    inverse = ProjectorInverse()
    inverse.use_projection(projection)
    found = inverse.fit(projection.embedding, samples).predict(projection.embedding)
    assert np.abs(found - samples).max() < 1e-9


@pytest.mark.parametrize("kind", ["table", "motion"])
def test_schemes_invert_their_projector(kind, waving):
    """By name, PCA's own inverse rebuilds rows and poses, better than the mean does."""
    space = VectorSpace(SAMPLES) if kind == "table" else PoseSpace(waving)
    result = SpatialScheme("pca", back_projector="inverse").run(space, ratio=0.1, random_state=0)
    pca = decomposition.PCA(2).fit(space.features)
    expected = pca.inverse_transform(pca.transform(space.features)).reshape(space.samples.shape)
    free = np.setdiff1d(np.arange(len(space)), result.control_points)
    if kind == "motion":
        u, _, v = np.linalg.svd(expected)
        u[..., 2] *= np.linalg.det(u @ v)[..., None]
        expected = u @ v
    assert np.allclose(result.reconstruction[free], expected[free], atol=1e-8)
    assert result.relative_error < 1.0


def test_a_projector_without_an_inverse_is_refused():
    """The message names the projector and those that have one."""
    projection = fit_projection(VectorSpace(SAMPLES), "mds")
    with pytest.raises(WorkbenchError, match=r"got MDS, which has no inverse.*pca or umap"):
        ProjectorInverse().use_projection(projection)


@pytest.mark.parametrize("kind", ["table", "motion"])
@pytest.mark.parametrize("options", [{"projected": True}, {"projector": "mds"}], ids=str)
def test_schemes_without_an_inverse_are_refused(kind, options, waving):
    """A ready embedding and MDS cannot be inverted, for tables and motions alike."""
    space = VectorSpace(SAMPLES) if kind == "table" else PoseSpace(waving)
    projected = rng.random((60, 2)) if options.get("projected") else None
    scheme = SpatialScheme(options.get("projector", "pca"), back_projector="inverse")
    with pytest.raises(WorkbenchError, match="back-projector 'inverse': got"):
        scheme.run(space, ratio=0.1, random_state=0, projected=projected)


def test_fitting_before_a_projection_is_refused(waving):
    """Alone or in the adaptor for poses, it asks for the projection first."""
    with pytest.raises(WorkbenchError, match="got no projector to invert"):
        ProjectorInverse().fit(rng.random((5, 2)), SAMPLES[:5])
    poses = back_projector_for(PoseSpace(waving), "inverse")
    with pytest.raises(WorkbenchError, match="got no projector to invert"):
        poses.fit(rng.random((5, 2)), waving.rotations[:5])


def test_wrong_input_is_refused():
    """Nan, other shapes and predicting before fitting are refused."""
    projection = pca_projection(SAMPLES)
    inverse = ProjectorInverse()
    with pytest.raises(NotFittedError, match="not fitted"):
        inverse.predict(projection.embedding)
    inverse.use_projection(projection)
    with pytest.raises(ValueError, match="NaN"):
        inverse.fit(np.full((60, 2), np.nan), SAMPLES)
    inverse.fit(projection.embedding, SAMPLES)
    with pytest.raises(ValueError, match="NaN"):
        inverse.predict([[0.0, np.nan]])
    with pytest.raises(ValueError, match="3 features"):
        inverse.predict(np.zeros((4, 3)))
