"""What Python and the authoring pad agree on."""

from __future__ import annotations

import re

import ipywidgets
import numpy as np
import pytest

from workbench.errors import WorkbenchError
from workbench.widgets.authoring import AuthoringPad


def test_every_trait_is_described() -> None:
    """Who wires the pad finds each synchronised trait among its attributes, and no other."""
    own = set(AuthoringPad.class_traits(sync=True)) - set(ipywidgets.DOMWidget.class_traits())
    traits = {name for name in own if not name.startswith("_")}
    _, _, attributes = (AuthoringPad.__doc__ or "").partition("Attributes\n")
    described = re.findall(r"^    ([a-z_, ]+) : ", attributes, flags=re.MULTILINE)
    assert {name for line in described for name in line.split(", ")} == traits


def test_an_array_is_kept_whole_and_read_only() -> None:
    """Doubles arrive as they are: the browser computes with the numbers of Python."""
    third = 1.0 / 3.0
    pad = AuthoringPad(markers=[[third, -third]])
    assert np.asarray(pad.markers).tolist() == [[third, -third]]
    assert np.frombuffer(pad.get_state()["markers"]).tolist() == [third, -third]
    with pytest.raises(ValueError, match="read-only"):
        pad.markers[0, 0] = 1.0


def test_what_is_no_array_is_refused() -> None:
    """The message names the trait."""
    with pytest.raises(WorkbenchError, match="times"):
        AuthoringPad(times="soon")
