"""Open registries of named methods.

The command line, the notebooks and the dashboards all look methods up here, so a
method registered in a notebook cell is available everywhere in that kernel.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from copy import deepcopy
from importlib import import_module
from numbers import Integral
from typing import Any

from workbench.errors import WorkbenchError


class Registry:
    """Map names to factories, importing a built-in method only when it is used.

    Imports are deferred because some methods pull in packages that take seconds to
    import (umap-learn), which ``workbench --help`` must not wait for.

    Parameters
    ----------
    kind : str
        What the registry holds, as used in messages ("projector").
    entries : dict of str to str
        Built-in methods as ``"package.module:Name"``.
    needs : tuple of str
        Methods that every object must have to be used.

    Examples
    --------
    >>> registry = Registry("number", {"third": "fractions:Fraction"})
    >>> registry.create("third", 1, 3)
    Fraction(1, 3)
    >>> registry.register("half", lambda: 0.5)
    >>> registry.names()
    ['third', 'half']
    """

    def __init__(self, kind: str, entries: dict[str, str], needs: tuple[str, ...] = ()) -> None:
        self.kind = kind
        self.needs = needs
        self._entries: dict[str, str | Callable[..., Any]] = dict(entries)

    def __contains__(self, name: object) -> bool:
        return name in self._entries

    def __iter__(self) -> Iterator[str]:
        return iter(self._entries)

    def names(self) -> list[str]:
        """List the registered names, built-in ones first."""
        return list(self._entries)

    def register(self, name: str, factory: Callable[..., Any]) -> None:
        """Add a method, or replace the one of that name.

        Parameters
        ----------
        name : str
            Name under which schemes, dashboards and figures find the method.
        factory : callable
            Class or function whose keyword arguments are the method's parameters.

        Raises
        ------
        WorkbenchError
            If the name is not a non-empty string or the factory cannot be called.
        """
        if not isinstance(name, str) or not name:
            raise WorkbenchError(f"name of a {self.kind}: got {name!r}, want a non-empty string")
        if not callable(factory):
            raise WorkbenchError(
                f"factory of {self.kind} {name!r}: got {type(factory).__name__}, "
                "want a class or function"
            )
        self._entries[name] = factory

    def factory(self, name: str) -> Callable[..., Any]:
        """Look up the factory of a method.

        Raises
        ------
        WorkbenchError
            If no method has that name; the message lists those that exist.
        """
        try:
            entry = self._entries[name]
        except (KeyError, TypeError):
            known = ", ".join(self.names())
            raise WorkbenchError(f"{self.kind}: got {name!r}, want one of {known}") from None
        if isinstance(entry, str):
            module, _, attribute = entry.partition(":")
            entry = getattr(import_module(module), attribute)
            self._entries[name] = entry
        return entry

    def create(self, name: str, *args: Any, **parameters: Any) -> Any:
        """Build the method of that name with the given parameters."""
        return self.factory(name)(*args, **parameters)

    def build(self, method: Any, random_state: int | None = None) -> Any:
        """Make a method ready for one use, from its name or from an object.

        An object is copied, so that using it does not change it. Every ``random_state``
        that is open (None), its own or that of an estimator inside, gets the seed: the same
        seed gives the same result, whatever the method.

        Parameters
        ----------
        method : str or object
            A registered name, or an object with the methods in ``needs``.
        random_state : int, optional
            The seed.

        Returns
        -------
        object

        Raises
        ------
        WorkbenchError
            If the name is unknown, a class is given instead of an object, or a method is
            missing.

        Examples
        --------
        >>> from workbench.projection import projectors
        >>> projectors.build("tsne", random_state=7).random_state
        7
        """
        if isinstance(method, type):
            raise WorkbenchError(
                f"{self.kind}: got the class {method.__name__}, "
                f"want an object such as {method.__name__}()"
            )
        built = self.create(method) if isinstance(method, str) else fresh_copy(method)
        missing = [name for name in self.needs if not callable(getattr(built, name, None))]
        if missing:
            raise WorkbenchError(
                f"{self.kind}: got {method!r}, want one of {', '.join(self.names())} "
                f"or an object with {' and '.join(self.needs)}"
            )
        _seed(built, random_state)
        return built


def fresh_copy(method: Any) -> Any:
    """Copy a method without what it has learnt, where it can tell the two apart.

    Parameters
    ----------
    method : object
        A scikit-learn estimator, or any object.

    Returns
    -------
    object
    """
    if hasattr(method, "get_params"):
        from sklearn.base import clone

        return clone(method)
    return deepcopy(method)


def _seed(method: Any, random_state: int | None) -> None:
    """Give the seed to each ``random_state`` that is open, inner estimators included."""
    if random_state is None:
        return
    if not isinstance(random_state, Integral) or not 0 <= random_state < 2**32:
        raise WorkbenchError(
            f"random_state: got {random_state!r}, want a whole number from 0 to {2**32 - 1}"
        )
    if hasattr(method, "get_params"):
        is_open = {
            name: random_state
            for name, value in method.get_params().items()
            if value is None and name.split("__")[-1] == "random_state"
        }
        method.set_params(**is_open)
    elif getattr(method, "random_state", random_state) is None:
        method.random_state = random_state
