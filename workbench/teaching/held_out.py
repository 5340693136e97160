"""Back-projection judged by samples that it has not seen, as lesson 4 does."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.backprojection import BackProjector
from workbench.errors import WorkbenchError
from workbench.projection import fit_projection
from workbench.projection.new_samples import placed_by_projector
from workbench.spaces import VectorSpace
from workbench.spaces.splits import split, standardized_by


@dataclass(frozen=True, eq=False)
class HeldOut:
    """Samples in two parts, both placed by a projection that has seen the first only.

    Attributes
    ----------
    training : VectorSpace
        Samples that projection and back-projection are fitted to.
    test : VectorSpace
        The others.
    training_places : ndarray of shape (n_training, 2)
    test_places : ndarray of shape (n_test, 2)
        Where the projection puts them.

    Examples
    --------
    >>> from workbench import load_space
    >>> from workbench.backprojection.rbf import RBF
    >>> parts = HeldOut.of(load_space("uci/iris"), "pca", random_state=0)
    >>> len(parts.training), len(parts.test)
    (105, 45)
    >>> bool(parts.training_error(RBF()) < 1e-6 < parts.error(RBF()) < 1)
    True
    """

    training: VectorSpace
    test: VectorSpace
    training_places: NDArray[np.float64]
    test_places: NDArray[np.float64]

    @classmethod
    def of(cls, space: VectorSpace, projector: str, *, random_state: int = 0) -> HeldOut:
        """Hold back three samples of ten, and project.

        Parameters
        ----------
        space : VectorSpace
            A raw table; its columns are standardised by the training samples.
        projector : str
            A projector that can place new samples by itself, such as ``"pca"``.
        random_state : int
            Seed of the choice and the projector.

        Raises
        ------
        WorkbenchError
            If the projector cannot place new samples.
        """
        rng = np.random.default_rng(random_state)
        training_rows, test_rows = split(space, "random", 0.7, rng)
        scaled = standardized_by(space, training_rows)
        training, test = scaled.subset(training_rows), scaled.subset(test_rows)
        projection = fit_projection(training, projector, random_state=random_state)
        places = placed_by_projector(projection, training, test)
        if places is None:
            raise WorkbenchError(
                f"projector: got {projector!r}, which cannot place new samples, want one that "
                "can, such as 'pca'"
            )
        return cls(training, test, projection.embedding, places)

    def error(self, model: BackProjector) -> float:
        """Fit a back-projector to all training samples; measure it on the test samples.

        Relative to answering with the mean of the training samples, whatever is asked.
        """
        self._fit(model)
        return self._relative(self.test.samples, model.predict(self.test_places))

    def training_error(self, model: BackProjector) -> float:
        """Measure it on the samples that it was fitted to."""
        self._fit(model)
        return self._relative(self.training.samples, model.predict(self.training_places))

    def _fit(self, model: BackProjector) -> None:
        model.fit(self.training_places, self.training.samples)

    def _relative(self, samples: NDArray[np.float64], rebuilt: Any) -> float:
        mean = self.training.samples.mean(axis=0)
        errors = np.linalg.norm(samples - np.asarray(rebuilt), axis=1)
        return float(errors.mean() / np.linalg.norm(samples - mean, axis=1).mean())
