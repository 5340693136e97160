"""What the registries refuse, at a glance."""

from __future__ import annotations

from collections.abc import Iterator

import workbench
from tests.contract.refusals import (
    Case,
    Refused,
    check_refused,
    each_row,
    refused,
)
from workbench.spaces import VectorSpace

BY_EVERY_REGISTRY: tuple[Case, ...] = (
    ("no name", lambda register: register("", VectorSpace), "got ''", "want a non-empty string"),
    ("number", lambda register: register(3, VectorSpace), "got 3", "want a non-empty string"),
    ("no factory", lambda register: register("mine", 3), "got int", "want a class or function"),
)


def of_registries() -> Iterator[Refused]:
    for register in (
        "register_back_projector",
        "register_control_point_projector",
        "register_dataset",
        "register_interpolator",
        "register_optimizer",
        "register_projector",
        "register_selector",
    ):
        yield from refused(register, getattr(workbench, register), BY_EVERY_REGISTRY)


@each_row(of_registries())
def test_registries_refuse(row):
    """The message names what it got and what it wants."""
    check_refused(row)
