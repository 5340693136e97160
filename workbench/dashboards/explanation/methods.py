"""The methods that the explained optimizer offers, those of the user's namespace among them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from workbench.backprojection import back_projectors
from workbench.dashboards.explanation.jobs import Method
from workbench.errors import WorkbenchError
from workbench.optimization import optimizers
from workbench.projection import projectors
from workbench.registry import Registry

#: The back-projector that suits the data: spatial keyframes for motions, RBF for tables.
USUAL = "usual for the data"


class Methods:
    """Methods by name: registered ones, a notebook's regressors, and those handed over.

    Attributes
    ----------
    projectors, back_projectors, optimizers : dict of str to Method
        What is on offer, as of the last :meth:`read`.
    """

    projectors: dict[str, Method]
    back_projectors: dict[str, Method]
    optimizers: dict[str, Method]

    def __init__(self) -> None:
        self._own: dict[str, Method] = {}
        self.back_projectors = {}
        self.read()

    def read(self, in_use: str | None = None) -> None:
        """List methods, those registered or made meanwhile among them.

        Parameters
        ----------
        in_use : str, optional
            A back-projector that stays on offer though its variable may be gone.
        """
        kept = {name: m for name, m in self.back_projectors.items() if name == in_use}
        regressors = {name: Method.of(name, r) for name, r in namespace_regressors().items()}
        self.projectors = _registered(projectors)
        self.optimizers = _registered(optimizers)
        usual = {USUAL: Method.of(USUAL, _usual)}
        self.back_projectors = {
            **usual,
            **kept,
            **_registered(back_projectors),
            **regressors,
            **self._own,
        }

    def offered(self, method: Any) -> str:
        """Find the name of a back-projector, putting an object on offer.

        Raises
        ------
        WorkbenchError
            If there is none of that name, or it is no back-projector.
        """
        if method is None:
            return USUAL
        if not isinstance(method, str):
            name = method_name(method)
            self._own[name] = self.back_projectors[name] = Method.of(name, method)
            return name
        self.read(in_use=method)
        _check("back_projector", method, self.back_projectors)
        return method

    def check_projector(self, name: str) -> None:
        """Refuse what is no projector's name, and say which there are."""
        _check("projector", name, self.projectors)

    def check_optimizer(self, name: str) -> None:
        """Refuse what is no optimizer's name, and say which there are."""
        _check("optimizer", name, self.optimizers)


def _registered(registry: Registry) -> dict[str, Method]:
    return {name: Method.of(name, registry.factory(name)) for name in registry.names()}


def _check(kind: str, name: Any, methods: Mapping[str, Method]) -> None:
    if name not in methods:
        raise WorkbenchError(f"{kind}: got {name!r}, want one of {', '.join(methods)}")


def namespace_regressors(namespace: Mapping[str, Any] | None = None) -> dict[str, Any]:
    """Find scikit-learn regressors among a notebook's variables.

    Parameters
    ----------
    namespace : mapping of str to object, optional
        By default the variables of the running notebook, if there is one.

    Returns
    -------
    dict of str to regressor
        By what to call them: the variable's name and the class's.

    Examples
    --------
    >>> from sklearn.tree import DecisionTreeRegressor
    >>> list(namespace_regressors({"tree": DecisionTreeRegressor(), "n": 3, "_": None}))
    ['tree (DecisionTreeRegressor)']
    """
    if namespace is None:
        try:
            from IPython.core.getipython import get_ipython
        except ImportError:  # outside a notebook IPython need not be there
            return {}
        shell = get_ipython()
        namespace = dict(shell.user_ns) if shell is not None else {}
    from sklearn.base import is_regressor

    return {
        f"{name} ({type(value).__name__})": value
        for name, value in namespace.items()
        if not name.startswith("_")
        and not isinstance(value, type)
        and hasattr(value, "__sklearn_tags__")
        and is_regressor(value)
    }


def method_name(method: Any) -> str:
    """Call an object that was handed over what it prints as, if that is short.

    Raises
    ------
    WorkbenchError
        If it is no back-projector.
    """
    if isinstance(method, type):
        raise WorkbenchError(
            f"back_projector: got the class {method.__name__}, "
            f"want an object such as {method.__name__}()"
        )
    if not all(callable(getattr(method, name, None)) for name in back_projectors.needs):
        raise WorkbenchError(
            f"back_projector: got {method!r}, want one of {', '.join(back_projectors.names())}, "
            "or an object with fit and predict"
        )
    text = " ".join(repr(method).split())
    return text if len(text) <= 48 else type(method).__name__


def _usual() -> None:
    """Stand for no choice."""
