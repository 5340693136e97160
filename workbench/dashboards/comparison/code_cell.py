"""A view as the code of a notebook's cell."""

from __future__ import annotations

import ipywidgets as widgets

from workbench.dashboards.comparison.panels import Panel
from workbench.dashboards.shared.sources import Source
from workbench.widgets.code import CodeView

_WIDTH = 96


class CodeControls:
    """A button that shows the cell that makes the present view again, ready to be copied.

    Attributes
    ----------
    button : ipywidgets.ToggleButton
        Shows or hides it.
    cell : CodeView
        The code.
    view : ipywidgets.Widget
        Both.
    """

    def __init__(self) -> None:
        self.button = widgets.ToggleButton(
            description="Copy as code",
            icon="code",
            tooltip="Show a cell that makes this view again",
            layout=widgets.Layout(width="140px"),
        )
        self.cell = CodeView()
        self.cell.layout.display = "none"
        self.button.observe(lambda change: self._show(change["new"]), "value")
        self.view = widgets.VBox([self.button, self.cell])

    def show(self, code: str) -> None:
        """Show other code, where it is shown at all."""
        self.cell.code = code

    def _show(self, wanted: bool) -> None:
        self.cell.layout.display = None if wanted else "none"


def comparison_code(
    source: Source, panels: list[Panel], settings: dict[str, object], defaults: dict[str, object]
) -> str:
    """Write the cell that makes a comparison again.

    Parameters
    ----------
    source : Source
        The samples; those in memory are called ``data`` in the cell.
    panels : list of Panel
        What the panels show.
    settings : dict of str to object
        Other arguments of ``compare_projections``.
    defaults : dict of str to object
        Values of arguments that need not be written.

    Returns
    -------
    str
    """
    in_memory = [part.name for part in source.parts or (source,) if _is_in_memory(part)]
    written = [_panel_code(panel) for panel in panels]
    lines = [_data_code(source), f"[{', '.join(written)}]"]
    if len(lines[1]) > _WIDTH - 5:
        lines[1] = "[\n" + "".join(f"        {panel},\n" for panel in written) + "    ]"
    lines += [
        f"{name}={value!r}" for name, value in settings.items() if value != defaults.get(name)
    ]
    imports = "Panel, compare_projections" if "Panel(" in lines[1] else "compare_projections"
    told = f"# data: samples that were in memory as {in_memory[0]!r}\n" if in_memory else ""
    arguments = "".join(f"    {line},\n" for line in lines)
    return (
        f"from workbench.dashboards import {imports}\n\n{told}"
        f"comparison = compare_projections(\n{arguments})\ncomparison\n"
    )


def _data_code(source: Source) -> str:
    if not source.parts:
        return "data" if _is_in_memory(source) else repr(source.name)
    if any(_is_in_memory(part) for part in source.parts):
        return "data"
    return repr(list(source.names))


def _is_in_memory(source: Source) -> bool:
    return source.token > 0 and not source.registered


def _panel_code(panel: Panel) -> str:
    words = [repr(panel.projector)]
    if panel.parameters:
        words.append(repr(dict(panel.parameters)))
    words += [f"{name}=True" for name in ("optimized", "two_step") if getattr(panel, name)]
    return words[0] if len(words) == 1 else f"Panel({', '.join(words)})"
