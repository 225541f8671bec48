"""The array type of the reference (64-bit floats), its answers, its linear solves. Shapes are in each docstring."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

Values = dict[str, Any]
"""Results by the names of the contract: arrays, floats; a status is a string, a rank an int."""


def vector(numbers: Sequence[float]) -> Array:
    """An input of the state as an array of floats."""
    return np.array(numbers, dtype=np.float64)


def solve(S: Array, b: Array) -> Array:
    """x of S x = b, S (nxn) regular, b (n). Rows and columns are scaled first: units mix metres and radians."""
    rows = 1.0 / np.max(np.abs(S), axis=1)
    columns = 1.0 / np.max(np.abs(S * rows[:, None]), axis=0)
    return np.asarray(columns * np.linalg.solve(rows[:, None] * S * columns, rows * b), dtype=np.float64)


def solve_symmetric(S: Array, b: Array) -> Array:
    """x of S x = b, S (nxn) symmetric and regular, b (n). Scaled to a unit diagonal first, rows as columns.

    A row of small numbers, such as that of a flywheel beside a carrier of 1e12 kg, then stays small: scaled up on its
    own it would become a pivot, and with it the error of its numbers the error of all.
    """
    scale = 1.0 / np.sqrt(np.abs(np.diag(S)))
    return np.asarray(scale * np.linalg.solve(S * np.outer(scale, scale), scale * b), dtype=np.float64)
