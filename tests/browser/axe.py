"""Look for what keeps people from using a page: the rules of axe-core."""

from __future__ import annotations

from typing import Any


def violations(page: Any, within: str = "html") -> list[str]:
    """Check a page by the rules of WCAG 2.1, levels A and AA.

    Parameters
    ----------
    page : playwright page
        The page, as it is now.
    within : str
        CSS selector of the part to check; nothing outside is looked at.

    Returns
    -------
    list of str
        A line for each element that breaks a rule: the rule, the element, and what is wrong.
    """
    from axe_playwright_python.base import AXE_SCRIPT

    page.evaluate(AXE_SCRIPT)
    found = page.evaluate(
        """(within) => axe.run(within, {
          resultTypes: ["violations"],
          runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa"],
        })""",
        within,
    )
    return [
        f"{rule['id']}: {' '.join(map(str, node['target']))}: {_reason(node)}"
        for rule in found["violations"]
        for node in rule["nodes"]
    ]


def _reason(node: dict[str, Any]) -> str:
    """Say what is wrong with an element."""
    return " ".join(node["failureSummary"].split())
