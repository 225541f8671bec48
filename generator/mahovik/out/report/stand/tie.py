"""A line between the carrier and the ground in the drawing of a stand."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Tie:
    """Its point on the carrier in E1, and on the ground in E0 (3 each, m)."""

    carrier: Array
    ground: Array
