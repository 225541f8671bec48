"""Broadband noise of wheels: mean square of what is seen, within bands of frequency, at many sets of speeds."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mahovik.errors import CheckError
from mahovik.use.numeric.se3 import Array
from mahovik.use.vibration.chain import Chain
from mahovik.use.vibration.maker import PARTS

GRID = 600
"""Frequencies of the density, even in their logarithm, beside those of the tables and of modes."""

AROUND = np.linspace(-25.0, 25.0, 101)
"""Frequencies about a structural mode, in half widths of its peak."""

CHUNK = 100_000
"""Speeds and frequencies treated at once: their product."""

Band = tuple[float, float]


def noise(chain: Chain, speeds: Array, bands: Sequence[Band | None]) -> Array:
    """Mean square (bands, S, 3) at speeds (S, N; rad/s) within bands (Hz; None: all); zero without a table of noise.

    Independent radial axes are half a forward and half a backward turning vector. Raises CheckError: noise drives a
    mode without damping, and its mean square is infinite.
    """
    result = np.zeros((len(bands), len(speeds), 3))
    if not chain.makers.noise:
        return result
    f = _grid(chain)
    radial, parts = np.array(["radial" in part for part in PARTS]), np.arange(len(PARTS))
    step = max(1, CHUNK // len(f))
    for i in range(0, len(speeds), step):
        rows = speeds[i : i + step]
        omega = np.broadcast_to(2.0 * np.pi * f, (len(rows), len(f)))
        density = np.zeros((len(rows), len(f), 3))
        for s, name in enumerate(chain.names):
            table = chain.makers.noise.get(name)
            if table is not None:
                forward, backward = np.abs(chain.unit_answers(s, parts, rows, omega)) ** 2
                gain = np.where(radial, (forward + backward) / 2.0, forward)
                source = np.stack([np.interp(f, table.frequency, d, 0.0, 0.0) for d in table.density.T], axis=1)
                density += (gain * source[:, None, :]).sum(axis=3)
        for k, band in enumerate(bands):
            result[k, i : i + step] = integral(f, density, band or (0.0, np.inf))
    return result


def integral(f: Array, density: Array, band: Band) -> Array:
    """Integral (S, 3) of a density (S, F, 3), linear between frequencies (F, Hz) and zero outside, over a band."""
    low, high = max(band[0], f[0]), min(band[1], f[-1])
    if low >= high:
        return np.zeros((len(density), 3))
    x = np.unique(np.concatenate([[low, high], f[(f > low) & (f < high)]]))
    i = np.clip(np.searchsorted(f, x, side="right") - 1, 0, len(f) - 2)
    share = ((x - f[i]) / (f[i + 1] - f[i]))[:, None]
    return np.asarray(np.trapezoid((1.0 - share) * density[:, i] + share * density[:, i + 1], x, axis=1))


def _grid(chain: Chain) -> Array:
    """Frequencies from the lowest to the highest of the tables, dense about modes. Raises CheckError."""
    tables = list(chain.makers.noise.values())
    low = min(float(table.frequency[0]) for table in tables)
    high = max(float(table.frequency[-1]) for table in tables)
    grids = [np.geomspace(low, high, GRID), *(table.frequency for table in tables)]
    for omega, damping in chain.modes:
        hertz = omega / (2.0 * np.pi)
        if damping == 0.0 and low <= hertz <= high:
            raise CheckError(f"noise drives a mode of {hertz:.6g} Hz without damping: expected a damping above 0")
        grids.append(hertz * (1.0 + max(damping, 1e-4) * AROUND))
    f = np.unique(np.concatenate(grids))
    return f[(f >= low) & (f <= high)]
