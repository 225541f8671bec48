"""The one linear solve of the reference."""

from __future__ import annotations

import numpy as np

from mahovik.proof.reference.array import Array


def solve(S: Array, b: Array) -> Array:
    """x of S x = b, S (nxn) regular, b (n). Rows and columns are scaled first: units mix metres and radians."""
    rows = 1.0 / np.max(np.abs(S), axis=1)
    columns = 1.0 / np.max(np.abs(S * rows[:, None]), axis=0)
    return np.asarray(columns * np.linalg.solve(rows[:, None] * S * columns, rows * b), dtype=np.float64)
