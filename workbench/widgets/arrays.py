"""Traits that hold arrays and travel to the browser as bytes.

JSON would turn 20 000 positions into half a megabyte of digits; a buffer is drawn as it
arrives.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import traitlets
from numpy.typing import ArrayLike, DTypeLike, NDArray

from workbench.errors import WorkbenchError


class ArrayTrait(traitlets.TraitType):
    """An array of one data type, little-endian and read-only.

    Read-only, because a change in place would never reach the browser. The browser gets the
    flat bytes and knows the shape from its other traits.

    Parameters
    ----------
    dtype : dtype
        Type of the values, for instance ``"<f4"``.
    """

    def __init__(self, dtype: DTypeLike, **kwargs: Any) -> None:
        self.dtype = np.dtype(dtype)
        super().__init__(default_value=self._frozen([]), **kwargs)
        self.tag(sync=True, to_json=_to_bytes, from_json=self._from_bytes)

    def validate(self, obj: Any, value: ArrayLike) -> NDArray[Any]:  # noqa: ARG002 - traitlets' signature
        """Convert to the trait's type."""
        return self._frozen(value)

    def _frozen(self, value: ArrayLike) -> NDArray[Any]:
        try:
            array = np.array(value, dtype=self.dtype, order="C")
        except (TypeError, ValueError, OverflowError):
            raise WorkbenchError(
                f"{self.name}: got {value!r}, want an array of {self.dtype.name} values"
            ) from None
        array.setflags(write=False)
        return array

    def _from_bytes(self, value: Any, widget: Any) -> NDArray[Any]:  # noqa: ARG002 - ipywidgets' signature
        return np.frombuffer(value, dtype=self.dtype) if value is not None else self._frozen([])


class SelectionTrait(ArrayTrait):
    """Indices of samples, sorted, each once, whatever order they are given in."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__("<i4", **kwargs)

    def validate(self, obj: Any, value: ArrayLike) -> NDArray[Any]:
        """Sort the indices and refuse what cannot be one."""
        given = np.asarray(value)
        if given.dtype == bool or (given.size and given.dtype.kind not in "iu"):
            raise WorkbenchError(
                f"{self.name}: got values of type {given.dtype}, want indices of samples"
            )
        if given.size and given.min() < 0:
            raise WorkbenchError(f"{self.name}: got index {given.min()}, want indices from 0")
        return super().validate(obj, np.unique(given))


def _to_bytes(value: NDArray[Any], widget: Any) -> bytes:  # noqa: ARG001 - ipywidgets' signature
    return value.tobytes()
