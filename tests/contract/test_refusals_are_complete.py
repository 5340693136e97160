"""Whether every public function that says what it refuses is in a table of refusals."""

from __future__ import annotations

import inspect
import pkgutil
import re
from importlib import import_module
from pathlib import Path

import workbench
from workbench.backprojection import back_projectors
from workbench.interpolation import interpolators
from workbench.projection import control_point_projectors, projectors
from workbench.selection import selectors

PACKAGES = ("selection", "interpolation", "projection", "backprojection", "quality", "mocap")
REGISTRIES = (selectors, interpolators, projectors, control_point_projectors, back_projectors)

#: Steps inside the package whose input is checked before, and checks that others call.
INTERNAL = {
    "as_curves",
    "as_pair",
    "as_points",
    "as_size",
    "as_sizes",
    "as_vectors",
    "at_most",
    "body_coordinate_errors",
    "check_curves",
    "check_interpolator",
    "check_motion",
    "check_rotations",
    "check_sigma",
    "check_whole_number",
    "control_points",
    "curve_keyframes",
    "empty_result",
    "find_feet",
    "fixed_samples",
    "least_squares_keyframes",
    "motion_of",
    "nearest_rotations_with_derivatives",
    "pair_sums",
    "pose_track",
    "positions",
    "principal_curves",
    "radial_kernel",
    "rotation_distance_derivatives",
    "solve",
    "value_track",
    "with_ends",
}

#: Files refuse in tests of their own.
OF_FILES = {
    "find_skeleton",
    "read_amc",
    "read_asf",
    "read_asf_amc",
    "read_number_rows",
    "read_text_bytes",
}

TABLES = "".join(
    path.read_text(encoding="utf-8") for path in Path(__file__).parent.glob("test_refused_*.py")
)


def public() -> dict[str, object]:
    """Find the public functions and classes whose docstring says what they refuse."""
    found: dict[str, object] = {}
    for package in PACKAGES:
        folder = import_module(f"workbench.{package}")
        for module in pkgutil.iter_modules(folder.__path__):
            here = import_module(f"workbench.{package}.{module.name}")
            for name, value in vars(here).items():
                own = getattr(value, "__module__", None) == here.__name__
                if own and not name.startswith("_") and callable(value):
                    found[name] = value
    for name in workbench.__all__:
        found[name] = getattr(workbench, name)
    refusing = re.compile(r"^ *Raises\n *-+\n", flags=re.M)
    return {n: v for n, v in found.items() if refusing.search(inspect.getdoc(v) or "")}


def test_every_public_function_is_in_a_table():
    """What says that it raises is shown to, in the tables or by the registry that holds it."""
    by_registry = {registry.factory(name).__name__ for registry in REGISTRIES for name in registry}
    missing = {
        name
        for name in public().keys() - by_registry - INTERNAL - OF_FILES
        if not re.search(rf"\b{name}\b", TABLES)
    }
    assert missing == set()


def test_no_exemption_is_out_of_date():
    """Every exempted name is there, and says that it raises."""
    assert public().keys() >= INTERNAL | OF_FILES
