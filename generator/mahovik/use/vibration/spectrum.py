"""Density and cumulative RMS over frequency at one speed: lines and noise together."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.use.numeric import Array
from mahovik.use.vibration.lines import COMBINATION, TABLE, coherent
from mahovik.use.vibration.noise import Broadband
from mahovik.use.vibration.study import Jitter


@dataclass(frozen=True, eq=False)
class Spectrum:
    """Mean squares of lines at frequency (m, Hz; ascending) by axis (m, 3), and noise.

    edges (B + 1, Hz), density (B, 3): one-sided, mean of every band, lines included
    """

    frequency: Array
    mean_square: Array
    noise: Broadband | None
    edges: Array
    density: Array

    def cumulative(self) -> tuple[Array, Array]:
        """Frequencies (m, Hz) and the RMS (m, 3) of all below and at them."""
        noise = self.noise
        f = np.unique(np.concatenate([self.frequency, noise.frequency])) if noise else np.unique(self.frequency)
        lines = np.vstack([np.zeros((1, 3)), np.cumsum(self.mean_square, axis=0)])
        below = lines[np.searchsorted(self.frequency, f, side="right")]
        return f, np.sqrt(below + np.array([noise.mean_square(x) for x in f])) if noise else np.sqrt(below)


def spectrum(found: Jitter, step: int, width: float = 1.0) -> Spectrum:
    """The spectrum at one speed; `width` of the bands of the density, Hz. Lines of a table count by their squares."""
    lines = found.lines
    known = np.array([name.source != TABLE for name in lines.names], dtype=bool)
    f, a = coherent(lines.frequency[step, known], lines.amplitude[step, known])
    loose = lines.frequency[step, ~known]
    frequency = np.concatenate([f, loose])
    square = np.concatenate([np.abs(a) ** 2, np.abs(lines.amplitude[step, ~known]) ** 2]) / 2.0
    order = np.argsort(frequency, kind="stable")
    order = order[frequency[order] > 0.0]
    frequency, square = frequency[order], square[order]
    noise = found.noise
    top = max(float(frequency[-1]) if len(frequency) else 0.0, float(noise.frequency[-1]) if noise else 0.0)
    edges = np.asarray(np.arange(int(top / width) + 2) * width, dtype=np.float64)
    result = Spectrum(frequency, square, noise, edges, np.zeros((len(edges) - 1, 3)))
    np.add.at(result.density, np.minimum((frequency / width).astype(int), len(edges) - 2), square / width)
    if noise is not None:
        to = np.array([noise.mean_square(edge) for edge in edges])
        result.density[:] += np.diff(to, axis=0) / width
    return result


@dataclass(frozen=True, eq=False)
class Share:
    """Part of the mean square over all phases at one speed: by wheel and what of it (an order, noise)."""

    wheel: str
    what: str
    rms: Array


def budget(found: Jitter, step: int) -> tuple[Share, ...]:
    """RMS (3) of every wheel's order, of combinations and of noise, largest first."""
    lines = found.lines
    total: dict[tuple[str, str], Array] = {}
    square = lines.sizes[step] ** 2 / 2.0
    for i, name in enumerate(lines.names):
        key = ("", "combinations") if name.source == COMBINATION else (name.wheel, f"order {name.order:g}")
        total[key] = total.get(key, np.zeros(3)) + square[i]
    if found.noise is not None:
        for s, wheel in enumerate(found.chain.names):
            total[wheel, "noise"] = found.noise.by_wheel[s]
    shares = [Share(wheel, what, np.sqrt(each)) for (wheel, what), each in total.items() if each.any()]
    return tuple(sorted(shares, key=lambda share: -float(np.linalg.norm(share.rms))))
