"""The one array type of the reference, 64-bit floats, and its answers. Shapes are in each docstring."""

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
