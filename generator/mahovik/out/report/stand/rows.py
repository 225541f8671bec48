"""Choice of rows of a long run to evaluate again."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def some_rows(M: int, most: int) -> NDArray[np.intp]:
    """Rows of M, evenly, about `most`; the first and the last among them."""
    step = max(1, -(-M // most))
    return np.unique(np.append(np.arange(0, M, step), max(M - 1, 0))).astype(np.intp)
