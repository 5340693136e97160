"""Tables and the checksum of their content."""

from __future__ import annotations

import numpy as np
import pytest

from workbench.datasets.tables import Table, content_checksum
from workbench.errors import DataError

VALUES = np.array([[1.0, 2.0], [3.0, 4.0], [5.0, 6.5]])


def test_checksum_sees_content_and_not_representation() -> None:
    """Memory layout, byte order and the sign of zero do not matter; a digit or label does."""
    labels = np.array(["a", "b", "a"])
    reference = content_checksum(VALUES, labels)
    assert content_checksum(np.asfortranarray(VALUES), labels.astype("U9")) == reference
    assert content_checksum(VALUES.astype(">f8"), labels) == reference
    assert content_checksum(VALUES, np.array(["a", "b", "b"])) != reference
    assert content_checksum(VALUES.T.copy(), labels) != reference
    altered = VALUES.copy()
    altered[2, 1] = np.nextafter(6.5, 7)
    assert content_checksum(altered, labels) != reference
    zeros = np.zeros((3, 2))
    assert content_checksum(zeros) == content_checksum(-zeros)


def test_checksum_tells_apart_tables_of_other_shape() -> None:
    """The same numbers in rows of another length are another table."""
    numbers = np.arange(12.0)
    assert content_checksum(numbers.reshape(3, 4)) != content_checksum(numbers.reshape(4, 3))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        pytest.param({"values": VALUES[:1]}, "got 1 row, want at least 3", id="one row"),
        pytest.param({"values": VALUES[:0]}, "got no rows", id="no rows"),
        pytest.param({"values": VALUES[0]}, "want a table", id="a vector"),
        pytest.param({"columns": ("x",)}, "got 1 column names, want 2", id="names"),
        pytest.param({"labels": np.array(["a"])}, "got labels of shape", id="labels"),
        pytest.param(
            {"values": np.where(VALUES == 4, np.nan, VALUES)},
            "nan in row 2 of column 'y'",
            id="nan",
        ),
        pytest.param(
            {"values": np.where(VALUES == 5, -np.inf, VALUES)},
            "-inf in row 3 of column 'x'",
            id="inf",
        ),
    ],
)
def test_refuses_parts_that_do_not_fit(changes: dict[str, object], message: str) -> None:
    """A table cannot be made of parts that do not fit each other."""
    parts: dict[str, object] = {"name": "mine", "values": VALUES, "columns": ("x", "y"), **changes}
    with pytest.raises(DataError, match=message):
        Table(**parts)  # type: ignore[arg-type]  # on purpose


def test_space_keeps_numbers_names_and_labels() -> None:
    """The space of a table has its numbers, names and labels, standardised on request."""
    table = Table("mine", VALUES, ("x", "y"), np.array(["a", "b", "a"]))
    space = table.space()
    np.testing.assert_array_equal(space.samples, VALUES)
    assert (space.name, space.columns) == ("mine", ("x", "y"))
    assert space.labels is not None
    assert space.labels.tolist() == ["a", "b", "a"]
    standardized = table.space(standardize=True).samples
    np.testing.assert_allclose(standardized.mean(axis=0), 0, atol=1e-15)
    np.testing.assert_allclose(standardized.std(axis=0), 1)
