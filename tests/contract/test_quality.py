"""What every measure of an embedding keeps: found by its signature, so new ones are covered."""

from __future__ import annotations

import inspect
import pkgutil
from collections.abc import Callable
from dataclasses import fields, is_dataclass
from importlib import import_module
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.distance import pdist, squareform

import workbench.quality
from tests.contract.strategies import examples, seeds
from workbench.quality.labels import neighborhood_hit
from workbench.quality.neighborhoods import vector_neighborhood_quality
from workbench.quality.shepard import nonmetric_stress, shepard_goodness, shepard_pairs

Measure = Callable[[Any, Any], dict[str, np.ndarray]]

#: Measures by value, 0 at best, and whether they are the same at every scale.
STRESSES = {
    "stress": False,
    "raw_stress": False,
    "normalized_stress": False,
    "kruskal_stress": False,
    "sammon_stress": False,
    "scale_normalized_stress": True,
    "nonmetric_stress": True,
    "local_stress": True,
}
#: Values that are not measures themselves.
_COUNTS = {"k", "n_samples", "first", "second", "data", "embedding"}


def values_of(result: Any) -> dict[str, np.ndarray]:
    """Give the values of a result by name; a plain number or array has the name ''."""
    if not is_dataclass(result):
        return {"": np.asarray(result)}
    named = [f.name for f in fields(result)]
    derived = [n for n, p in vars(type(result)).items() if isinstance(p, property)]
    return {n: np.asarray(getattr(result, n)) for n in named + derived if n not in _COUNTS}


def measures() -> dict[str, Measure]:
    """Collect every public function of (distances, embedding) with its results by name."""
    found: dict[str, Measure] = {
        "shepard_goodness": lambda d, e: values_of(shepard_goodness(shepard_pairs(d, e))),
        "nonmetric_stress": lambda d, e: values_of(nonmetric_stress(shepard_pairs(d, e))),
    }
    for module in pkgutil.iter_modules(workbench.quality.__path__):
        for name, function in vars(import_module(f"workbench.quality.{module.name}")).items():
            if name.startswith("_") or not inspect.isfunction(function) or name in HELPERS:
                continue
            parameters = list(inspect.signature(function).parameters)
            if parameters[:2] == ["distances", "embedding"]:
                extra = {"k": 1} if "k" in parameters else {}
                found[name] = lambda d, e, f=function, x=extra: values_of(f(d, e, **x))
    return found


#: They take a matrix and an embedding, and measure nothing; the diagram's counts may change by
#: rounding at the edges of its bins.
HELPERS = {"as_pair", "shepard_diagram", "shepard_pairs"}
MEASURES = measures()
every_measure = pytest.mark.parametrize("name", MEASURES)


def drawn(seed: int, n: int, dimensions: int = 2) -> tuple[np.ndarray, np.ndarray]:
    """Draw distances between n samples in 4-D, and an unrelated embedding."""
    rng = np.random.default_rng(seed)
    return squareform(pdist(rng.normal(size=(n, 4)))), rng.random((n, dimensions))


def agree(first: dict[str, np.ndarray], second: dict[str, np.ndarray]) -> bool:
    return first.keys() == second.keys() and all(
        np.allclose(first[name], second[name], rtol=1e-8, atol=1e-9) for name in first
    )


sizes = st.integers(4, 24)
both_dimensions = st.sampled_from([2, 3])


def test_the_measures_are_found():
    """The signature finds what the documentation lists."""
    assert set(STRESSES) <= set(MEASURES)
    assert {"neighborhood_quality", "local_neighborhood_quality", "embedding_quality"} <= set(
        MEASURES
    )


@every_measure
@examples
@given(seed=seeds, n=sizes, dimensions=both_dimensions)
def test_turning_mirroring_and_moving_the_map_changes_nothing(name, seed, n, dimensions):
    """An embedding has no directions and no zero."""
    distances, embedding = drawn(seed, n, dimensions)
    rng = np.random.default_rng(seed)
    turn = np.linalg.qr(rng.normal(size=(dimensions, dimensions)))[0]
    for frame in (turn, turn * np.where(np.arange(dimensions) == 0, -1.0, 1.0)):
        moved = embedding @ frame + rng.normal(size=dimensions)
        assert agree(MEASURES[name](distances, embedding), MEASURES[name](distances, moved))


@pytest.mark.parametrize(
    "name", [name for name in MEASURES if STRESSES.get(name, name != "embedding_quality")]
)
@examples
@given(seed=seeds, n=sizes, size=st.floats(1e-3, 1e3))
def test_size_does_not_matter_where_it_is_said_not_to(name, seed, n, size):
    """Neighbourhoods, orders and normalised stresses are those of the map's shape."""
    distances, embedding = drawn(seed, n)
    assert agree(MEASURES[name](distances, embedding), MEASURES[name](distances, size * embedding))


@pytest.mark.parametrize("name", [n for n in STRESSES if not STRESSES[n]])
def test_size_matters_where_it_is_said_to(name):
    """The forms of stress that are not normalised change with the size of the map."""
    distances, embedding = drawn(3, 12)
    assert not agree(MEASURES[name](distances, embedding), MEASURES[name](distances, 2 * embedding))


@every_measure
@examples
@given(seed=seeds, n=sizes)
def test_the_order_of_the_samples_does_not_matter(name, seed, n):
    """Samples in another order have the same values, each its own where there is one each."""
    distances, embedding = drawn(seed, n)
    order = np.random.default_rng(seed).permutation(n)
    before = MEASURES[name](distances, embedding)
    after = MEASURES[name](distances[np.ix_(order, order)], embedding[order])
    for key, values in before.items():
        each_its_own = values.shape == (n,)
        assert np.allclose(after[key], values[order] if each_its_own else values, rtol=1e-8)


@pytest.mark.parametrize("name", STRESSES)
@examples
@given(seed=seeds, n=sizes)
def test_stress_is_at_least_zero_and_zero_for_a_perfect_map(name, seed, n):
    """Whatever the form, keeping all distances costs nothing."""
    distances, embedding = drawn(seed, n)
    assert np.all(MEASURES[name](distances, embedding)[""] >= 0)
    kept = squareform(pdist(embedding))
    assert np.all(MEASURES[name](kept, embedding)[""] < 1e-12)
    if name in ("scale_normalized_stress", "nonmetric_stress"):
        assert MEASURES[name](distances, embedding)[""] <= 1


@examples
@given(seed=seeds, n=sizes, data=st.data())
def test_neighborhood_measures_stay_within_their_bounds(seed, n, data):
    """Shares from 0 to 1; all 1 for the data themselves."""
    distances, embedding = drawn(seed, n)
    size = data.draw(st.integers(1, (n - 1) // 2))
    labels = np.random.default_rng(seed).integers(0, 3, n)
    for name in ("neighborhood_quality", "local_neighborhood_quality"):
        function = getattr(import_module("workbench.quality.neighborhoods"), name)
        found, best = (
            function(d, embedding, size) for d in (distances, squareform(pdist(embedding)))
        )
        for value in ("trustworthiness", "continuity", "preservation"):
            # A single sample's ranks may be worse than a whole map's can.
            lowest = 0.0 if name == "neighborhood_quality" else -np.inf
            assert np.all(getattr(found, value) >= lowest - 1e-12)
            assert np.all(getattr(found, value) <= 1.0)
            assert np.all(getattr(best, value) == 1.0)
    hits = neighborhood_hit(embedding, labels, size)
    assert np.all((hits >= 0) & (hits <= 1))
    assert np.all(neighborhood_hit(embedding, np.zeros(n), size) == 1.0)
    assert -1 <= shepard_goodness(shepard_pairs(distances, embedding)) <= 1


@examples
@given(seed=seeds, n=sizes)
def test_a_perfect_map_has_the_best_of_every_value(seed, n):
    """Goodness, preservation and their kin are 1; what is taken off for chance stays off."""
    _, embedding = drawn(seed, n)
    kept = squareform(pdist(embedding))
    found = values_of(vector_neighborhood_quality(embedding, embedding, (n - 1) // 2))
    assert found["rescaled_preservation"] == pytest.approx(1.0)
    assert found["intrusiveness"] == 0.0
    assert shepard_goodness(shepard_pairs(kept, embedding)) == pytest.approx(1.0)
    summary = MEASURES["embedding_quality"](kept, embedding)
    assert summary["trustworthiness"] == summary["neighborhood_preservation"] == 1.0
