"""Phases at which tables of a programme are compared."""

from __future__ import annotations

import numpy as np

from mahovik.proof.reference.array import Array


def spread_phases(count: int) -> Array:
    """Rising phases in [0, 1), spread by the golden ratio, so that they fall everywhere between nodes."""
    return np.sort((np.arange(1.0, count + 1.0) * (np.sqrt(5.0) - 1.0) / 2.0) % 1.0)
