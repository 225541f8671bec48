"""The envelope of a long line: few points, and every peak stays in sight."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mahovik.out.report.plot.panel import Array

BINS = 400
"""Parts of the abscissa: the least and the largest value of each are kept, in their order."""


def envelope(y: Array, bins: int = BINS) -> NDArray[np.intp]:
    """Indices (rising) of the points of y (M) that are drawn: all of few; else first, last, extremes of every bin.

    A value that is not finite ends a line: a bin keeps one such value.
    """
    M = len(y)
    if 2 * bins >= M:
        return np.arange(M)
    edges = np.linspace(0, M, bins + 1).astype(np.intp)
    width = int(np.diff(edges).max())
    at = np.minimum(edges[:-1, None] + np.arange(width), edges[1:, None] - 1)  # the last of a bin again
    values = y[at]
    broken = ~np.isfinite(values)
    rows = np.arange(bins)
    least = at[rows, np.argmin(np.where(broken, np.inf, values), axis=1)]
    most = at[rows, np.argmax(np.where(broken, -np.inf, values), axis=1)]
    gaps = at[rows, np.argmax(broken, axis=1)][broken.any(axis=1)]
    return np.unique(np.concatenate([[0, M - 1], least, most, gaps]))
