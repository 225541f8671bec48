"""Parts of a drawing that a law adds: lines to the ground, places in the carrier."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Tie:
    """A tie of the carrier to the ground, by its points: on the carrier in E1, on the ground in E0 (3 each, m)."""

    carrier: Array
    ground: Array


@dataclass(frozen=True, eq=False)
class Mark:
    """A place in E1 (3, m) with a sign of its own, and what it is."""

    at: Array
    words: str
