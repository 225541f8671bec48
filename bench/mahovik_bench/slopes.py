"""Cost of a further flywheel: straight lines through figures at several N."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np


def slope(by_N: Mapping[int, float]) -> tuple[float, float] | None:
    """(per flywheel, at none) by least squares; None of fewer than three."""
    if len(by_N) < 3:
        return None
    per, fixed = np.polyfit(list(by_N), list(by_N.values()), 1)
    return float(per), float(fixed)
