"""Lesson 1, what a projection keeps and loses: its exercises and their solutions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.quality.neighborhoods import neighborhood_quality
from workbench.teaching.answers import Choice, Number, Samples
from workbench.teaching.exercises import Exercise, FunctionExercise, Mistake, Question

FloatArray = NDArray[np.float64]


def distance(samples: FloatArray, pair: tuple[int, int]) -> float:
    """Measure the Euclidean distance of two samples."""
    first, second = pair
    return float(np.sqrt(((samples[first] - samples[second]) ** 2).sum()))


def _one_row_further(samples: FloatArray, pair: tuple[int, int]) -> float:
    return distance(samples, (pair[0] - 1, pair[1] - 1))


def farthest_neighbor(distances: FloatArray, plane_distances: FloatArray) -> int:
    """Find the sample whose nearest one in the plane is farthest from it in the data."""
    others = plane_distances.copy()
    np.fill_diagonal(others, np.inf)
    nearest = others.argmin(axis=1)
    return int(distances[np.arange(len(distances)), nearest].argmax())


def _nearest(plane_distances: FloatArray) -> NDArray[np.intp]:
    return (plane_distances + np.diag(np.full(len(plane_distances), np.inf))).argmin(axis=1)


def _closest_neighbor(distances: FloatArray, plane_distances: FloatArray) -> int:
    return int(distances[np.arange(len(distances)), _nearest(plane_distances)].argmin())


def _neighbor_itself(distances: FloatArray, plane_distances: FloatArray) -> int:
    return int(_nearest(plane_distances)[farthest_neighbor(distances, plane_distances)])


def _roles_exchanged(distances: FloatArray, plane_distances: FloatArray) -> int:
    return farthest_neighbor(plane_distances, distances)


def kept_neighbors(distances: FloatArray, plane_distances: FloatArray, k: int) -> float:
    """Give the mean share of the k nearest in the data that are k nearest in the plane."""
    shares = []
    for i in range(len(distances)):
        # The sample itself comes first, at distance 0: it is left out.
        in_data = np.argsort(distances[i], kind="stable")
        in_plane = np.argsort(plane_distances[i], kind="stable")
        near = set(in_data[in_data != i][:k])
        shares.append(len(near & set(in_plane[in_plane != i][:k])) / k)
    return float(np.mean(shares))


def _near(distances: FloatArray, k: int) -> list[list[int]]:
    """List the k nearest others of each sample, nearest first."""
    order = np.argsort(distances, axis=1, kind="stable")
    return [[int(j) for j in row if j != i][:k] for i, row in enumerate(order)]


def _with_itself(distances: FloatArray, plane_distances: FloatArray, k: int) -> float:
    in_data = np.argsort(distances, axis=1, kind="stable")[:, :k]
    in_plane = np.argsort(plane_distances, axis=1, kind="stable")[:, :k]
    return float(np.mean([len({*a} & {*b}) / k for a, b in zip(in_data, in_plane, strict=True)]))


def _with_itself_beside(distances: FloatArray, plane_distances: FloatArray, k: int) -> float:
    return (k * kept_neighbors(distances, plane_distances, k) + 1) / k


def _counted(distances: FloatArray, plane_distances: FloatArray, k: int) -> float:
    return k * kept_neighbors(distances, plane_distances, k)


def _summed(distances: FloatArray, plane_distances: FloatArray, k: int) -> float:
    return len(distances) * kept_neighbors(distances, plane_distances, k)


def _of_all_near(distances: FloatArray, plane_distances: FloatArray, k: int) -> float:
    pairs = zip(_near(distances, k), _near(plane_distances, k), strict=True)
    return float(np.mean([len({*a} & {*b}) / len({*a} | {*b}) for a, b in pairs]))


def _in_order(distances: FloatArray, plane_distances: FloatArray, k: int) -> float:
    return float(np.mean(np.array(_near(distances, k)) == np.array(_near(plane_distances, k))))


def _cases(distances: FloatArray, plane_distances: FloatArray, k: int) -> Sequence[tuple[Any, ...]]:
    few = slice(0, min(40, len(distances)))
    return (
        (distances, plane_distances, k),
        (distances[few, few], plane_distances[few, few], max(1, k // 2)),
    )


def kept_by_chance(n_samples: int, k: int) -> float:
    """Give the share of k neighbours that random places keep, in the mean."""
    return k / (n_samples - 1)


def lowered_most(distances: FloatArray, embedding: FloatArray, k: int) -> str:
    """Tell which of two measures an embedding lowers more."""
    quality = neighborhood_quality(distances, embedding, k)
    lower = quality.trustworthiness[0] < quality.continuity[0]
    return "trustworthiness" if lower else "continuity"


def _lowered_less(distances: FloatArray, embedding: FloatArray, k: int) -> str:
    lowered = lowered_most(distances, embedding, k)
    return "continuity" if lowered == "trustworthiness" else "trustworthiness"


def largest_share(samples: FloatArray) -> float:
    """Give the largest share that one column has of the variance of all."""
    variances = samples.var(axis=0)
    return float(variances.max() / variances.sum())


def _share_of_deviations(samples: FloatArray) -> float:
    deviations = samples.std(axis=0)
    return float(deviations.max() / deviations.sum())


EXERCISES: Sequence[Question] = (
    Exercise(
        key="distance",
        task="Compute the Euclidean distance of the two samples and assign it to `answer`.",
        solution=distance,
        praise="Yes. All that follows asks how much of such distances a plane can keep.",
        hint="Take the difference of the two rows, square it, sum up, take the root.",
        kind=Number(),
        mistakes=(
            Mistake(lambda samples, pair: distance(samples, pair) ** 2, "The root is missing."),
            Mistake(
                lambda samples, pair: np.abs(samples[pair[0]] - samples[pair[1]]).sum(),
                "You summed absolute differences, the Manhattan distance. Square them, and take "
                "the root of the sum.",
            ),
            Mistake(
                lambda samples, pair: (samples[pair[0]] - samples[pair[1]]).sum(),
                "Differences of opposite sign cancel. Square each before you sum up.",
            ),
            Mistake(_one_row_further, "Rows count from 0 in Python: row 0 is the first."),
        ),
    ),
    Exercise(
        key="false-neighbor",
        task="Find the sample whose nearest neighbour in the plane is farthest from it in the "
        "data, and assign its index to `answer`.",
        solution=farthest_neighbor,
        praise="Yes. In the plane it seems to have a close relative, and it has none there: a "
        "false neighbour.",
        hint="Find each sample's nearest other one in the plane (`argmin` along axis 1, with the "
        "diagonal out of the way). Then look up the distance of each such pair in the data.",
        kind=Samples(),
        mistakes=(
            Mistake(
                lambda distances, plane_distances: int(
                    distances[np.arange(len(distances)), plane_distances.argmin(axis=1)].argmax()
                ),
                "Each sample is its own nearest here, at distance 0. Fill the diagonal with "
                "`np.inf` first.",
            ),
            Mistake(
                _neighbor_itself,
                "This is the neighbour. Give the sample that it is the neighbour of.",
            ),
            Mistake(
                _roles_exchanged,
                "You looked for neighbours in the data and measured in the plane: this one is "
                "a missed neighbour. Do it the other way round.",
            ),
            Mistake(_closest_neighbor, "This is the smallest distance. Look for the largest."),
        ),
    ),
    FunctionExercise(
        key="kept-neighbors",
        task="Replace the `...` in `kept_neighbors` so that it returns the share of neighbours "
        "that the plane keeps.",
        solution=kept_neighbors,
        praise="Yes. This is neighbourhood preservation, as the dashboards and figures here "
        "measure it: no sample counts as its own neighbour.",
        hint="For each sample, make the set of its k nearest others in the data and the same in "
        "the plane; count what both contain, divide by k, and take the mean over all samples.",
        kind=Number(tolerance=1e-6),
        cases=_cases,
        mistakes=(
            Mistake(
                _with_itself,
                "You count each sample as its own neighbour. It is its nearest in the data and "
                "in the plane, always, so one of k is a gift: even random places seem to keep "
                "something. Leave the sample out and take k others.",
            ),
            Mistake(
                _with_itself_beside,
                "You count each sample as its own neighbour, beside k others. Leave it out.",
            ),
            Mistake(_counted, "This is a number of neighbours. Divide it by k."),
            Mistake(_summed, "This is a sum over all samples. Take the mean."),
            Mistake(
                _of_all_near,
                "You divide by the number of samples that are near on one side or the other "
                "(Jaccard). That is a measure too; here, divide by k.",
            ),
            Mistake(
                _in_order,
                "You compare the first neighbour with the first, the second with the second. "
                "Their order does not count here: compare sets.",
            ),
        ),
    ),
    Exercise(
        key="by-chance",
        task="Say which share of k neighbours random places keep, in the mean.",
        solution=kept_by_chance,
        praise="Yes: k / (n − 1). What a projection keeps must be compared with this, all the "
        "more when k is large.",
        hint="Fix one sample. Each of the n − 1 others is among its k nearest in the plane with "
        "the same probability. How large is it?",
        kind=Number(),
        mistakes=(
            Mistake(
                lambda n_samples, k: k / n_samples,
                "Nearly. The sample itself is no neighbour, so how many others are there?",
            ),
            Mistake(
                lambda **_: 0.0,
                "Not nothing: among so many neighbours, some are right by luck.",
            ),
            Mistake(
                lambda n_samples, k: k**2 / (n_samples - 1),
                "This is the expected number of kept neighbours. Divide it by k.",
            ),
            Mistake(lambda k, **_: 1 / k, "This is one neighbour of k. Think of n, too."),
            Mistake(
                lambda n_samples, k: 100 * k / (n_samples - 1),
                "This is a percentage. Give the share, between 0 and 1.",
            ),
        ),
    ),
    Exercise(
        key="cut-ring",
        task='Assign "trustworthiness" or "continuity" to `answer`.',
        solution=lowered_most,
        praise="Yes. A cut tears neighbours apart, which continuity tells. Hardly anybody who "
        "is near in the plane is far in the data, so the embedding can be trusted.",
        hint="Think of the two ends of the cut.",
        kind=Choice(("trustworthiness", "continuity")),
        mistakes=(
            Mistake(
                _lowered_less,
                "Look at two samples beside the cut, one at each end. Are they neighbours in "
                "the data or in the plane? Trustworthiness falls for neighbours in the plane "
                "that are none in the data.",
            ),
        ),
    ),
    Exercise(
        key="largest-share",
        task="Compute the largest share that one column has of the variance of all columns.",
        solution=largest_share,
        praise="Yes. On the raw table, distance is all but the distance in this one column.",
        hint="`samples.var(axis=0)` gives the variance of each column. Divide the largest by "
        "their sum.",
        kind=Number(tolerance=1e-5),
        mistakes=(
            Mistake(
                _share_of_deviations,
                "You took standard deviations. Squared distances add up, so take variances.",
            ),
            Mistake(
                lambda samples: 100 * largest_share(samples),
                "This is a percentage. Give the share, between 0 and 1.",
            ),
            Mistake(
                lambda samples: samples.var(axis=0).max(),
                "This is the variance itself. Divide it by the sum over all columns.",
            ),
            Mistake(
                lambda samples: samples.var(axis=0).max() / samples.var(),
                "You divided by the variance of all entries together. Divide by the sum of the "
                "columns' variances.",
            ),
        ),
    ),
)
