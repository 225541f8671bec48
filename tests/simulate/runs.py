"""Columns of `mahovik.simulate` by their names with units, as its files have them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

import mahovik


def columns(stand: Any, until: float, **options: Any) -> dict[str, NDArray[np.float64]]:
    """The columns of a run that is complete."""
    run = mahovik.simulate(stand, until=until, **options)
    assert run["stopped"] is None
    return {f"{one.name} [{one.unit}]" if one.unit else one.name: one.values for one in run.columns}
