"""Statistics of results over clips and seeds."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from workbench.errors import WorkbenchError
from workbench.figures.boxplots import Box
from workbench.validation import finite


def boxplot_statistics(values: ArrayLike) -> Box:
    """Compute the values that a box plot shows, as Costa 2018 draws them.

    The whiskers end at data: the lowest value above Q1 − 1.5·IQR and the highest below
    Q3 + 1.5·IQR, with IQR = Q3 − Q1; values beyond are outliers (footnote to section 5).
    Quartiles are interpolated linearly between data, which the thesis does not state.

    Parameters
    ----------
    values : array-like of shape (n_values,)
        At least one finite number.

    Returns
    -------
    Box

    Raises
    ------
    WorkbenchError
        If there is no value, or one that is not finite.

    Examples
    --------
    >>> box = boxplot_statistics([1, 2, 3, 4, 20])
    >>> box.q1, box.median, box.q3, box.whisker_top, box.outliers
    (2.0, 3.0, 4.0, 4.0, (20.0,))
    """
    data = np.sort(np.asarray(values, dtype=np.float64).ravel())
    if data.size == 0:
        raise WorkbenchError("values: got none, want at least one number")
    finite(data, "values")
    q1, median, q3 = np.quantile(data, [0.25, 0.5, 0.75])
    reach = 1.5 * (q3 - q1)
    # Not strictly inside: where all values are equal, the fences are that value too.
    inside = (data >= q1 - reach) & (data <= q3 + reach)
    within = data[inside]
    return Box(
        whisker_bottom=float(within[0]),
        q1=float(q1),
        median=float(median),
        q3=float(q3),
        whisker_top=float(within[-1]),
        n_outliers=int((~inside).sum()),
        outliers=tuple(float(value) for value in data[~inside]),
    )
