"""Lines in the spectrum of a point: flywheels of one speed share a line, and their phases matter there."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mahovik.use.study.quiet.options import Interval
from mahovik.use.study.quiet.phases import cancel

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

SAME = 1e-9
"""Relative difference of speeds below which two flywheels turn together: a beat lasts years."""


@dataclass(frozen=True, eq=False)
class Line:
    """frequency (Hz); flywheels (indices); amplitude (axes, complex) of their sum; apart: sum of their mean squares."""

    frequency: float
    flywheels: tuple[int, ...]
    amplitude: Complex
    apart: float

    @property
    def mean_square(self) -> float:
        """Mean square in time, summed over axes."""
        return float(np.sum(np.abs(self.amplitude) ** 2)) / 2.0


def groups(speeds: Array) -> list[tuple[int, ...]]:
    """Groups of flywheels of equal speed, by magnitude of speed, without those at rest."""
    found: list[list[int]] = []
    for s in np.argsort(np.abs(speeds), kind="stable"):
        size = abs(speeds[s])
        if size == 0.0:
            continue
        if found and size - abs(speeds[found[-1][0]]) <= SAME * size:
            found[-1].append(int(s))
        else:
            found.append([int(s)])
    return [tuple(sorted(each)) for each in found]


def lines(speeds: Array, phases: Array, a: Complex) -> list[Line]:
    """The lines of these speeds and phases at t = 0 (rad); a (axes x N): amplitudes at phase zero."""
    turned = a * np.exp(1j * np.sign(speeds) * phases)
    found = []
    for group in groups(speeds):
        part = turned[:, group]
        frequency = float(abs(speeds[group[0]])) / (2.0 * np.pi)
        found.append(Line(frequency, group, part.sum(axis=1), float(np.sum(np.abs(part) ** 2)) / 2.0))
    return found


def in_band(frequency: float, band: Interval) -> bool:
    """Whether a line is in the band, ends included."""
    return band[0] <= frequency <= band[1]


def mean_square(found: list[Line], band: Interval) -> float:
    """Mean square of all lines in the band."""
    return sum(each.mean_square for each in found if in_band(each.frequency, band))


def uncontrolled_mean_square(speeds: Array, a: Complex, band: Interval) -> float:
    """Mean square in the band if no phase is held: the mean over all phases."""
    inside_band = (np.abs(speeds) >= 2 * np.pi * band[0]) & (np.abs(speeds) <= 2 * np.pi * band[1]) & (speeds != 0.0)
    return float(np.sum(np.abs(a[:, inside_band]) ** 2)) / 2.0


def best_phases(
    speeds: Array, a: Complex, band: Interval, rng: np.random.Generator, starts: int = 48
) -> tuple[Array, float]:
    """Phases at t = 0 (N, rad) that minimise the mean square in the band, and the minimum.

    The first of a group that turns together has phase zero; so has a flywheel that turns alone or outside the band.
    """
    phases, total = np.zeros(len(speeds)), 0.0
    for group in groups(speeds):
        if not in_band(float(abs(speeds[group[0]])) / (2.0 * np.pi), band):
            continue
        psi, least = cancel(a[:, group], rng, starts)
        phases[list(group)] = np.sign(speeds[list(group)]) * psi
        total += least / 2.0
    return phases, total
