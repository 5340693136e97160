"""What a panel of the comparison shows, and how its parameters are written."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from workbench.errors import WorkbenchError

#: Names of the panels.
LETTERS = "ABCDEF"

_CHOSEN = ("n_components", "random_state", "metric")
_WANTED = "want for instance: perplexity=10, metric='euclidean'"


@dataclass(frozen=True)
class Panel:
    """What one panel shows.

    Parameters
    ----------
    projector : str
        A registered name.
    parameters : mapping of str to object, optional
        The projector's parameters that are not left as they are.
    optimized : bool
        Whether the embedding is optimized.
    two_step : bool
        Whether the projector places the control points only, and RBFP the rest around them.

    Raises
    ------
    WorkbenchError
        If the parameters are no mapping of names.

    Examples
    --------
    >>> Panel("tsne", {"perplexity": 10}, optimized=True).title
    'tsne (perplexity=10), optimized'
    """

    projector: str
    parameters: Mapping[str, Any] = field(default_factory=dict, hash=False)
    optimized: bool = False
    two_step: bool = False

    def __post_init__(self) -> None:
        given = self.parameters
        if not isinstance(given, Mapping) or not all(isinstance(name, str) for name in given):
            raise WorkbenchError(
                f"parameters: got {given!r}, want names and values such as {{'perplexity': 10}}"
            )
        # A copy, because whoever gave the parameters may change them.
        object.__setattr__(self, "parameters", dict(given))

    @property
    def title(self) -> str:
        """Say what the panel shows, in a line."""
        written = parameters_text(self.parameters)
        words = f"{self.projector} ({written})" if written else self.projector
        return words + ", two-step" * self.two_step + ", optimized" * self.optimized


def parameters_text(parameters: Mapping[str, Any]) -> str:
    """Write parameters as :func:`parsed_parameters` reads them.

    Examples
    --------
    >>> parameters_text({"perplexity": 10, "metric": "euclidean"})
    "perplexity=10, metric='euclidean'"
    """
    return ", ".join(f"{name}={value!r}" for name, value in parameters.items())


def parsed_parameters(text: str) -> dict[str, Any]:
    """Read parameters that a person wrote; nothing of it is run.

    Parameters
    ----------
    text : str
        Such as ``"perplexity=10, metric='euclidean'"``; values are numbers, text in quotes,
        True, False, None, or lists and so on of these.

    Returns
    -------
    dict of str to object

    Raises
    ------
    WorkbenchError
        If it is written in another way.

    Examples
    --------
    >>> parsed_parameters("perplexity=10, metric='euclidean'")
    {'perplexity': 10, 'metric': 'euclidean'}
    """
    try:
        call = ast.parse(f"parameters({text}\n)", mode="eval").body
    except (SyntaxError, ValueError, MemoryError, RecursionError):
        raise WorkbenchError(f"got {text!r}, {_WANTED}") from None
    if not isinstance(call, ast.Call) or not isinstance(call.func, ast.Name) or call.args:
        raise WorkbenchError(f"got {text!r}, {_WANTED}")
    read: dict[str, Any] = {}
    for keyword in call.keywords:
        if keyword.arg is None or keyword.arg in read:
            raise WorkbenchError(f"got {text!r}, {_WANTED}")
        try:
            read[keyword.arg] = ast.literal_eval(keyword.value)
        except (ValueError, TypeError):
            written = ast.unparse(keyword.value)
            raise WorkbenchError(
                f"{keyword.arg}: got {written}, want a number, text in quotes, True, False or None"
            ) from None
    return read


def offered(known: Mapping[str, Any]) -> dict[str, Any]:
    """Leave out parameters that the dashboard chooses, so that nobody has to write them."""
    return {name: value for name, value in known.items() if name not in _CHOSEN}


def check_parameters(
    projector: str, parameters: Mapping[str, Any], known: Mapping[str, Any]
) -> None:
    """Refuse parameters that a projector does not have.

    Parameters
    ----------
    projector : str
        Its name, for the message.
    parameters : mapping of str to object
        Those given.
    known : mapping of str to object
        Those that it has, with their defaults.

    Raises
    ------
    WorkbenchError
        If there is one; the message lists those that it has.
    """
    for name in parameters:
        if name not in known:
            has = parameters_text(offered(known)) or "none"
            raise WorkbenchError(f"{projector} has no parameter {name!r}; it has {has}")
