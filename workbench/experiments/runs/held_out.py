"""Runs that rebuild held-out samples: those that no step has seen."""

from __future__ import annotations

import time
import warnings
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.backprojection import back_projector_for
from workbench.backprojection.inverse import ProjectorInverse
from workbench.backprojection.knn import KNN
from workbench.errors import WorkbenchError
from workbench.experiments.runs.shared import SharedSteps, messages
from workbench.experiments.store import Arrays, Row
from workbench.optimization import optimizers
from workbench.optimization.objective import Objective
from workbench.projection import fit_projection
from workbench.projection.fitted import Projection
from workbench.projection.new_samples import NEIGHBORS, Neighborhood, placed_by_projector
from workbench.projection.rbfp import RBFP
from workbench.results import SpatialResult
from workbench.schemes import SpatialScheme
from workbench.spaces import Space, VectorSpace
from workbench.spaces.splits import SPLITS, split, standardized_by

#: How the positions of the training samples came about.
POSITIONS = ("raw", "alg12", "local")
#: Maps that place new samples by the positions of the training samples, see the columns of
#: :meth:`HeldOutRun.execute`.
MAPS = ("mean", "nearest", "rbf")

#: Share of the samples that the methods are fitted to.
TRAINING_SHARE = 0.7


@dataclass(frozen=True)
class HeldOutRun:
    """One projector, its positions raw and optimized, judged by samples that were held out.

    The projector, the choice of control points, the back-projector and the optimizers see the
    training samples only. Test samples are placed by maps that are fitted to the training
    samples' positions and never look at a test sample's error.

    Parameters
    ----------
    dataset : str
        Name that :func:`workbench.load_space` knows, or the path of a file.
    projector : str
        A registered name.
    split : {"random", "blocks"}
        Whether test samples are drawn one by one or, for motions, in runs of frames.
    ratio : float
        Share of the training samples that become control points, between 0 and 1.
    seed : int
        Seed of the split, the control points and the projector.
    standardized : bool
        Whether the columns of a table are brought to unit variance, by the mean and variance
        of the training samples.

    Raises
    ------
    WorkbenchError
        If the projector is no name, or the split unknown.
    """

    dataset: str
    projector: str
    split: str = "random"
    ratio: float = 0.03
    seed: int = 0
    standardized: bool = False

    def __post_init__(self) -> None:
        if not isinstance(self.projector, str):
            got = type(self.projector).__name__
            raise WorkbenchError(f"projector of a run: got {got}, want a registered name")
        if self.split not in SPLITS:
            raise WorkbenchError(f"split: got {self.split!r}, want one of {', '.join(SPLITS)}")

    def __str__(self) -> str:
        scaling = ", standardized" if self.standardized else ""
        return (
            f"{self.dataset}{scaling}, {self.projector}, held out ({self.split}), "
            f"{100 * self.ratio:.4g} %, seed {self.seed}"
        )

    @property
    def standardize(self) -> bool:
        """Always False: a table is standardised here, without a look at the test samples."""
        return False

    def specification(self) -> dict[str, Any]:
        """Describe the run by plain values, as stored with its result."""
        return {
            "scheme": f"{self.projector}, held out",
            **asdict(self),
            "standardize": self.standardized,
        }

    def execute(self, shared: SharedSteps) -> tuple[Row, Arrays]:
        """Execute the run.

        Parameters
        ----------
        shared : SharedSteps
            The space.

        Returns
        -------
        row : dict
            Mean errors over the test samples. ``error_POSITIONS_MAP`` is that of the
            back-projector of the control points, for positions of the training samples in
            :data:`POSITIONS` and maps in :data:`MAPS`: the mean position of the nearest
            training samples weighted by the inverse of their distance, the position of the
            nearest one, and radial basis functions through all positions (RBFP, linear
            kernel). ``error_raw_own`` places by the projector's own ``transform``,
            ``error_inverse`` then rebuilds by its own inverse (None where it has none).
            From raw positions and the first map, ``error_plane_nearest``,
            ``error_plane_mean`` and ``error_plane_control`` rebuild by the nearest training
            sample in the plane, the mean of the nearest, and the nearest control point.
            ``error_mean_sample`` takes the training samples' mean, ``error_data_nearest``
            the training sample nearest in the data, and ``error_self_placed`` moves each
            test sample by its own error, from ``error_raw_mean``: it looks at the answer.
            ``training_error_POSITIONS`` is that of the training samples, and
            ``unexplained_POSITIONS`` the share of their positions that their neighbours
            leave open, see :meth:`Neighborhood.unexplained`.
        arrays : dict of str to ndarray
            ``test`` (n_test,) and ``control_points`` (n_control_points,): indices of the
            samples; ``errors_raw``, ``errors_alg12`` and ``errors_local`` (n_test,) by the
            first map.

        Raises
        ------
        WorkbenchError
            If a table is to be split into blocks, a motion to be standardised, or there are
            too few samples.
        """
        rng = np.random.default_rng(self.seed)
        training_rows, test_rows = split(shared.space, self.split, TRAINING_SHARE, rng)
        space = shared.space
        if self.standardized:
            space = standardized_by(space, training_rows)
        with warnings.catch_warnings(record=True) as caught:
            row, arrays = _HeldOut(self, space, training_rows, test_rows).measured()
        row.update(
            n_samples=len(space),
            n_training=len(training_rows),
            n_test=len(test_rows),
            warnings="; ".join(messages(caught)),
        )
        return row, {"test": test_rows, **arrays}


class _HeldOut:
    """The steps of one run."""

    def __init__(
        self,
        run: HeldOutRun,
        space: Space,
        training_rows: NDArray[np.intp],
        test_rows: NDArray[np.intp],
    ) -> None:
        self.run = run
        self.training_rows = training_rows
        self.training = space.subset(training_rows)
        self.test = space.subset(test_rows)
        self.everything = np.arange(len(self.test))
        self.neighborhood = Neighborhood(self.training, self.test)
        self.seconds: dict[str, float] = {}

    def measured(self) -> tuple[Row, Arrays]:
        """Fit everything to the training samples and measure it on the test samples."""
        start = time.perf_counter()
        projection = fit_projection(self.training, self.run.projector, random_state=self.run.seed)
        self.seconds["project"] = time.perf_counter() - start
        results = {name: self._trained(name, projection.embedding) for name in POSITIONS}
        raw = results["raw"]
        row: Row = {"n_control_points": len(raw.control_points)}
        arrays: Arrays = {"control_points": self.training_rows[raw.control_points]}
        for name, result in results.items():
            # The same function for all: it is fitted to control points, which do not move.
            places = self._placed(result.embedding)
            for map_name, points in places.items():
                errors = self._errors(raw.back_projector, points)
                row[f"error_{name}_{map_name}"] = float(errors.mean())
                if map_name == "mean":
                    arrays[f"errors_{name}"] = errors
            row[f"training_error_{name}"] = result.error
            free = np.setdiff1d(np.arange(len(self.training)), raw.control_points)
            row[f"unexplained_{name}"] = self.neighborhood.unexplained(result.embedding, free)
        points = self.neighborhood.mean_positions(raw.embedding)
        row.update(self._baselines(raw, points))
        row.update(self._own(raw, projection))
        row["error_self_placed"] = self._self_placed(raw, points)
        row.update({f"seconds_{step}": value for step, value in self.seconds.items()})
        row["seconds_total"] = sum(self.seconds.values())
        return row, arrays

    def _trained(self, positions: str, projected: NDArray[np.float64]) -> SpatialResult:
        """Run the scheme on the training samples."""
        optimizer = None if positions == "raw" else positions
        start = time.perf_counter()
        result = SpatialScheme(self.run.projector, optimizer=optimizer).run(
            self.training,
            ratio=self.run.ratio,
            random_state=self.run.seed,
            projected=projected,
        )
        self.seconds[f"train_{positions}"] = time.perf_counter() - start
        return result

    def _placed(self, embedding: NDArray[np.float64]) -> dict[str, NDArray[np.float64]]:
        """Place the test samples by every map that is fitted to positions."""
        start = time.perf_counter()
        every = np.arange(len(self.training))
        through_all = RBFP("linear").fit(self.training, every, embedding)
        places = {
            "mean": self.neighborhood.mean_positions(embedding),
            "nearest": embedding[self.neighborhood.nearest],
            "rbf": through_all.transform(self.test.samples),
        }
        seconds = time.perf_counter() - start
        self.seconds["place"] = self.seconds.get("place", 0.0) + seconds
        return places

    def _errors(self, back_projector: Any, points: NDArray[np.float64]) -> NDArray[np.float64]:
        return self.test.errors(self.everything, back_projector.predict(points))

    def _fitted(self, method: Any, points: NDArray[np.float64], samples: Any) -> Any:
        """Fit a method for vectors, made to rebuild poses where the samples are poses."""
        return back_projector_for(self.training, method).fit(points, samples)

    def _baselines(self, raw: SpatialResult, points: NDArray[np.float64]) -> Row:
        """Rebuild the test samples without the back-projector of the control points."""
        training, keys = self.training.samples, raw.control_points
        in_plane = {
            "plane_nearest": self._fitted(KNN(1), raw.embedding, training),
            "plane_mean": self._fitted(KNN(min(NEIGHBORS, len(training))), raw.embedding, training),
            "plane_control": self._fitted(KNN(1), raw.embedding[keys], training[keys]),
            "mean_sample": self._fitted(KNN(len(training)), raw.embedding, training),
        }
        errors = {name: self._errors(method, points) for name, method in in_plane.items()}
        nearest = training[self.neighborhood.nearest]
        errors["data_nearest"] = self.test.errors(self.everything, nearest)
        return {f"error_{name}": float(values.mean()) for name, values in errors.items()}

    def _own(self, raw: SpatialResult, projection: Projection) -> Row:
        """Place by the projector's own map, and rebuild by its own inverse, if it has them."""
        row: Row = {"error_raw_own": None, "error_inverse": None}
        points = placed_by_projector(projection, self.training, self.test)
        if points is None:
            return row
        row["error_raw_own"] = float(self._errors(raw.back_projector, points).mean())
        # UMAP, made from distances between poses, has none for them.
        from_vectors = isinstance(self.training, VectorSpace) or not hasattr(
            projection.projector, "metric"
        )
        if from_vectors and hasattr(projection.projector, "inverse_transform"):
            method = back_projector_for(self.training, ProjectorInverse())
            method.use_projection(projection)  # type: ignore[attr-defined]  # of this one
            method.fit(projection.embedding, self.training.samples)
            row["error_inverse"] = float(self._errors(method, points).mean())
        return row

    def _self_placed(self, raw: SpatialResult, points: NDArray[np.float64]) -> float:
        """Let each test sample look for its own best place: what no new sample can do."""
        result = optimizers.build("local", None).optimize(
            Objective.of(self.test, raw.back_projector),
            points,
            self.everything,
            self.test.neighbors,
        )
        return float(result.errors.mean())
