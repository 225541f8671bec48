"""Columns of `mahovik.simulate` by their names with units, as its files have them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

import mahovik


def columns(stand: Any, until: float, **given: Any) -> dict[str, NDArray[np.float64]]:
    """The columns of a run that is complete."""
    found = mahovik.simulate(stand, until=until, **given)
    assert found["stopped"] is None
    return {f"{one.name} [{one.unit}]" if one.unit else one.name: one.values for one in found.columns}
