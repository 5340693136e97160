"""Open registries of named methods.

The command line, the notebooks and the dashboards all look methods up here, so a
method registered in a notebook cell is available everywhere in that kernel.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from importlib import import_module
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

    Examples
    --------
    >>> registry = Registry("number", {"third": "fractions:Fraction"})
    >>> registry.create("third", 1, 3)
    Fraction(1, 3)
    >>> registry.register("half", lambda: 0.5)
    >>> registry.names()
    ['third', 'half']
    """

    def __init__(self, kind: str, entries: dict[str, str]) -> None:
        self.kind = kind
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
