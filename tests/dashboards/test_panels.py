"""Parameters of a panel, as a person writes them."""

from __future__ import annotations

import pytest

from workbench.dashboards.comparison.panel_controls import PanelChooser
from workbench.dashboards.comparison.panels import Panel, parameters_text, parsed_parameters
from workbench.errors import WorkbenchError


@pytest.mark.parametrize(
    "parameters",
    [{}, {"perplexity": 10}, {"metric": "it's", "min_dist": 0.5, "order": None, "at": (1, [2.0])}],
    ids=["none", "one", "many"],
)
def test_what_is_written_is_read_again(parameters: dict) -> None:
    """Numbers, text, None and lists survive."""
    assert parsed_parameters(parameters_text(parameters)) == parameters


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("perplexity", "want for instance: perplexity=10"),
        ("perplexity=", "want for instance"),
        ("10", "want for instance"),
        ("**{'a': 1}", "want for instance"),
        ("a=1) + f(b=2", "want for instance"),
        ("a=1, a=2", "want for instance"),
        ("a=__import__('os')", r"a: got __import__\('os'\), want a number"),
        ("metric=euclidean", "metric: got euclidean, want a number, text in quotes"),
        ("a" * 100_000 + "=" + "(" * 100_000, "want for instance"),
        ("a=1\0", "want for instance"),
    ],
    ids=[
        "name",
        "no value",
        "no name",
        "stars",
        "escape",
        "twice",
        "call",
        "quotes",
        "deep",
        "nul",
    ],
)
def test_what_are_no_parameters_is_refused(text: str, words: str) -> None:
    """Nothing is run, and the message shows how parameters are written."""
    with pytest.raises(WorkbenchError, match=words):
        parsed_parameters(text)


def test_panels_differ_by_their_parameters() -> None:
    """Equal ones are equal whatever the order, and what was given can change afterwards."""
    given = {"perplexity": 10, "metric": "euclidean"}
    panel = Panel("tsne", given)
    same = Panel("tsne", {"metric": "euclidean", "perplexity": 10})
    assert panel == same
    assert hash(panel) == hash(same)
    given["perplexity"] = 20
    assert panel == same != Panel("tsne", given)
    assert panel != Panel("tsne", panel.parameters, two_step=True)
    with pytest.raises(WorkbenchError, match="parameters: got True, want names and values"):
        Panel("tsne", True)


def chooser() -> PanelChooser:
    return PanelChooser("A", ["pca", "tsne", "lle"], Panel("tsne", {"perplexity": 10}))


def test_a_wrong_text_leaves_the_parameters_before() -> None:
    """The text stays to be corrected, the problem stands beside it, and goes with it."""
    controls = chooser()
    controls.parameters.value = "perplexity=ten"
    assert controls.panel.parameters == {"perplexity": 10}
    assert controls.parameters.value == "perplexity=ten"
    assert "want a number" in controls.problem
    controls.parameters.value = "perplexity=20"
    assert controls.panel.parameters == {"perplexity": 20}
    assert controls.problem == ""


def test_each_projector_keeps_its_parameters() -> None:
    """Another projector starts without any, and the first one's come back with it."""
    controls = chooser()
    controls.projector.value = "lle"
    assert controls.panel == Panel("lle")
    controls.parameters.value = "n_neighbors=5"
    controls.projector.value = "tsne"
    assert controls.panel == Panel("tsne", {"perplexity": 10})
    controls.projector.value = "lle"
    assert controls.panel == Panel("lle", {"n_neighbors": 5})


def test_defaults_are_shown_and_unknown_names_are_refused() -> None:
    """What the dashboard sets itself is not offered."""
    controls = chooser()
    known = {"n_components": 2, "perplexity": 50.0, "metric": "euclidean", "random_state": None}
    controls.describe("tsne", known)
    assert "usual: perplexity=50.0" in controls.hint.value
    controls.parameters.value = "perplxity=3"
    assert controls.problem.startswith("tsne has no parameter 'perplxity'; it has")
    assert controls.panel.parameters == {"perplexity": 10}
