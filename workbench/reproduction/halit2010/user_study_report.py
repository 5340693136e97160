"""Save what is known of each rated motion, for the report and for the notebook's reader."""

from __future__ import annotations

import pandas as pd
import plotly.graph_objects as go

from workbench.reproduction.halit2010.user_study import Result
from workbench.reproduction.halit2010.user_study_figures import figure_alt, figure_caption, figures
from workbench.reproduction.halit2010.user_study_tables import (
    comparisons_caption,
    comparisons_table,
    differences_caption,
    differences_table,
)
from workbench.reproduction.outputs import Outputs


def save(outputs: Outputs, result: Result) -> list[go.Figure | pd.DataFrame]:
    """Save the figures and both tables of one rated motion.

    Parameters
    ----------
    outputs : Outputs
        Where to.
    result : Result
        From :func:`workbench.reproduction.halit2010.user_study.results`.

    Returns
    -------
    list of Figure and DataFrame
        The same, to be displayed.
    """
    rated, drawn = result.rated, figures(result)
    for name, figure in drawn.items():
        outputs.figure(
            rated.figure_id,
            figure,
            caption=figure_caption(result, name),
            alt=figure_alt(result, name),
            name=name,
        )
    differences = differences_table(result)
    comparisons = comparisons_table(result.ours or result.theirs)
    outputs.table(rated.table_id, differences, caption=differences_caption(result))
    outputs.table(
        rated.table_id, comparisons, caption=comparisons_caption(result), name="comparisons"
    )
    return [*drawn.values(), differences.round(3), comparisons.round(3)]
