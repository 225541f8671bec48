"""Accelerations of a log that holds speeds only: derivatives of an interpolating spline of degree 5."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import make_interp_spline

from mahovik.errors import DataError
from mahovik.use.measured.recording import Array

DEGREE = 5

ENDS = 6
"""Rows at either end whose derivative is not used: a spline is worst there."""

FEWEST = 4 * ENDS
"""Rows of a log at least."""


def rates_of(source: str, t: Array, values: Array) -> tuple[Array, float]:
    """Derivatives (T, n) of values, NaN at the ends, and their error over their size, estimated. Raises DataError.

    The estimate is the difference from the spline of every second row, which is far less exact.
    """
    if len(t) < FEWEST or not np.isfinite(t).all() or not np.isfinite(values).all() or not (np.diff(t) > 0).all():
        raise DataError(
            [f"{source}: accelerations are missing, and cannot be derived: expected {FEWEST} rows or more, at rising "
             "times, without missing numbers"]
        )  # fmt: skip
    found = np.asarray(make_interp_spline(t, values, k=DEGREE).derivative()(t), dtype=np.float64)
    coarse = np.asarray(make_interp_spline(t[::2], values[::2], k=DEGREE).derivative()(t[::2]), dtype=np.float64)
    inner = slice(ENDS // 2, -ENDS // 2)
    size = float(np.abs(found).max()) or 1.0
    off = float(np.abs(coarse - found[::2])[inner].max()) / size
    found[:ENDS] = found[-ENDS:] = np.nan
    return found, off
