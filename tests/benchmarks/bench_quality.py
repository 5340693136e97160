"""Measures of neighbourhoods for all sizes at once, beside ZADU's at one size."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy.spatial.distance import cdist
from zadu import ZADU

from tests.benchmarks.measuring import Measurement, compare, peak_memory, time_of
from workbench.quality.neighborhoods import vector_neighborhood_quality
from workbench.quality.summary import embedding_quality

_N = 5000
_SIZES = np.arange(1, 101)
_MEASURES = [
    {"id": name, "params": {"k": 20}} for name in ("tnc", "mrre", "lcmc")
]  # trustworthiness and continuity come together


def measurements() -> Iterator[Measurement]:
    """Compare on 5000 vectors in ten dimensions, shown by two of them and some noise."""
    generator = np.random.default_rng(0)
    vectors = generator.normal(size=(_N, 10))
    embedding = vectors[:, :2] + 0.3 * generator.normal(size=(_N, 2))

    def ours() -> None:
        vector_neighborhood_quality(vectors, embedding, _SIZES)

    def theirs() -> None:
        ZADU(_MEASURES, vectors).measure(embedding)

    ours()
    theirs()
    peaks = peak_memory(ours), peak_memory(theirs)
    fits = 3 * peaks[0] <= peaks[1]
    row = compare(
        f"trustworthiness, continuity, preservation, LCMC, B_NX, all k to 100, n = {_N}",
        ours,
        "ZADU (scheduled, shared ranks): trustworthiness, continuity, MRRE, LCMC at k = 20",
        theirs,
        at_least=5,
        repeats=3,
        note=f"from vectors; peak memory {peaks[0]:.0f} MB, ZADU's {peaks[1]:.0f} MB measured "
        f"alike, at most a third: {'yes' if fits else 'no'}. Called one by one, without its "
        "scheduler, ZADU's measures take four to five times as long and 1.2 GB",
    )
    yield Measurement(**{**row.__dict__, "met": row.met and fits})

    distances = cdist(vectors, vectors)
    yield time_of(
        f"all usual quality values of an embedding from its distances, n = {_N}",
        lambda: embedding_quality(distances, embedding),
        below=2,
        note="half of the time and all of the memory go into checking that the distances are "
        "a symmetric matrix",
    )
