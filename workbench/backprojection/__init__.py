"""Back-projectors: from positions in an embedding back to samples.

A back-projector has ``fit(points, samples)`` and ``predict(points)``; any scikit-learn
regressor is one for vectors, and :class:`~workbench.backprojection.poses.PoseBackProjector`
makes it one for poses.
"""

from __future__ import annotations

from typing import Any, Protocol

from numpy.typing import ArrayLike

from workbench.registry import Registry
from workbench.spaces import PoseSpace, Space


class BackProjector(Protocol):
    """What a back-projector offers."""

    def fit(self, points: Any, samples: Any) -> Any:
        """Learn to rebuild samples from their positions in the embedding."""
        ...

    def predict(self, points: ArrayLike) -> Any:
        """Rebuild one sample for each position."""
        ...


back_projectors = Registry(
    "back-projector",
    {
        "rbf": "workbench.backprojection.rbf:RBF",
        "ilamp": "workbench.backprojection.ilamp:ILAMP",
        "knn": "workbench.backprojection.knn:KNN",
        "inverse": "workbench.backprojection.inverse:ProjectorInverse",
        "spatial-keyframes": "workbench.backprojection.poses:SpatialKeyframes",
    },
    needs=("fit", "predict"),
)
register_back_projector = back_projectors.register


def back_projector_for(
    space: Space, back_projector: str | BackProjector | None, *, random_state: int | None = None
) -> BackProjector:
    """Build a back-projector that fits a space's samples.

    Parameters
    ----------
    space : Space
        The samples to rebuild.
    back_projector : str, back-projector or None
        A registered name, an object, or None for the space's usual one: spatial keyframes
        for poses, RBF for vectors.
    random_state : int, optional
        Seed for a method that leaves its own open.

    Returns
    -------
    back-projector
        Unfitted. For poses, a method that rebuilds vectors is made to rebuild poses.

    Raises
    ------
    WorkbenchError
        If the name is unknown or the method rebuilds poses and the space holds vectors.
    """
    from workbench.backprojection.poses import PoseBackProjector
    from workbench.backprojection.regressor import RegressorBackProjector, predicts_one_number
    from workbench.errors import WorkbenchError

    poses = isinstance(space, PoseSpace)
    if back_projector is None:
        back_projector = "spatial-keyframes" if poses else "rbf"
    built = back_projectors.build(back_projector, random_state)
    if isinstance(built, PoseBackProjector):
        if not poses:
            raise WorkbenchError(
                f"back-projector: got {back_projector!r}, which rebuilds poses, "
                f"want one for vectors such as 'rbf' (data: {space.name!r})"
            )
        return built
    if predicts_one_number(built):
        built = RegressorBackProjector(built)
    return PoseBackProjector(built) if poses else built
