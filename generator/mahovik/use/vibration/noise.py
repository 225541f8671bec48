"""Broadband noise of wheels: density and mean square of what is seen, at one set of speeds."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.errors import CheckError
from mahovik.use.numeric import Array
from mahovik.use.vibration.chain import Chain
from mahovik.use.vibration.maker import PARTS, Noise

GRID = 600
"""Frequencies of the density, even in their logarithm, beside those of the tables and of modes."""

AROUND = np.linspace(-25.0, 25.0, 101)
"""Frequencies about a structural mode, in half widths of its peak."""


@dataclass(frozen=True, eq=False)
class Broadband:
    """frequency (F, Hz) and one-sided density (F, 3; square of the unit by Hz); by_wheel: mean squares (N, 3)."""

    frequency: Array
    density: Array
    by_wheel: Array

    def mean_square(self, high: float = np.inf) -> Array:
        """(3): integral of the density up to a frequency, Hz."""
        f, d = self.frequency, self.density
        if high <= f[0]:
            return np.zeros(3)
        n = int(np.searchsorted(f, high, side="right"))
        at = np.array([np.interp(min(high, f[-1]), f, each) for each in d.T])
        x, y = np.append(f[:n], min(high, f[-1])), np.vstack([d[:n], at])
        return np.asarray(np.trapezoid(y, x, axis=0))


def broadband(chain: Chain, speeds: Array) -> Broadband | None:
    """The broadband part at speeds (N, rad/s); None without a table of noise.

    Raises CheckError: noise drives a mode without damping, and its mean square is infinite.
    """
    tables = chain.makers.noise
    if not tables:
        return None
    f = _grid(chain)
    for natural, damping in chain.modes:
        hertz = natural / (2.0 * np.pi)
        if damping == 0.0 and f[0] <= hertz <= f[-1]:
            raise CheckError(f"noise drives a mode of {hertz:.6g} Hz without damping: expected a damping above 0")
    omega = 2.0 * np.pi * f[None]
    total, each = np.zeros((len(f), 3)), np.zeros((len(chain.names), 3))
    for s, name in enumerate(chain.names):
        table = tables.get(name)
        if table is not None:
            own = _density(table, f, chain, s, speeds, omega)
            each[s] = np.trapezoid(own, f, axis=0)
            total += own
    return Broadband(f, total, each)


def _density(table: Noise, f: Array, chain: Chain, s: int, speeds: Array, omega: Array) -> Array:
    """Density (F, 3) by one wheel: independent radial axes are half a forward and half a backward turning vector."""
    parts = np.arange(len(PARTS))
    forward, backward = (
        np.abs(chain.unit_answers(s, parts, speeds[None], omega, back)[0]) ** 2 for back in (False, True)
    )
    radial = np.array(["radial" in part for part in PARTS])
    gain = np.where(radial, (forward + backward) / 2.0, forward)
    source = np.stack([np.interp(f, table.frequency, d, 0.0, 0.0) for d in table.density.T], axis=1)
    return np.asarray((gain * source[:, None, :]).sum(axis=2))


def _grid(chain: Chain) -> Array:
    """Frequencies from the lowest to the highest of the tables, dense about modes."""
    tables = list(chain.makers.noise.values())
    low = min(float(table.frequency[0]) for table in tables)
    high = max(float(table.frequency[-1]) for table in tables)
    found = [np.geomspace(low, high, GRID), *(table.frequency for table in tables)]
    for omega, damping in chain.modes:
        found.append(omega / (2.0 * np.pi) * (1.0 + max(damping, 1e-4) * AROUND))
    all_of = np.unique(np.concatenate(found))
    return all_of[(all_of >= low) & (all_of <= high)]
