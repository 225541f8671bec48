"""Modes of a linear model: natural frequencies, damping ratios, shapes, also in words."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass

import numpy as np

from mahovik.use.numeric.se3 import Array, Complex
from mahovik.use.study.linear.model import Channel, LinearModel
from mahovik.use.study.rest import reduced_basis

SAME = 1e-9
"""Relative difference below which two magnitudes of eigenvalues are equal but for rounding."""

FREE = 1e-6
"""Part of the largest eigenvalue below which one is zero: a pair of zeros scatters by the root of rounding."""

STIFF = 1e-10
"""Part of the largest stiffness below which a direction is free."""

SLOWEST = 1e-6
"""1/s: slower modes always count as zero."""

SMALL = 5e-4
"""Part of the largest displacement of a shape: smaller ones are left out."""

ALIGNED = 1.0
"""deg: a phase this near to 0 or 180 deg is written as a sign."""


@dataclass(frozen=True, eq=False)
class Mode:
    """One mode: exp(eigenvalue t) times its shape.

    kind        "free": eigenvalue zero, no restoring force; "oscillation": a pair; "decay", "growth": real
    eigenvalue  1/s; for a pair, the one with positive imaginary part
    frequency   |eigenvalue| / 2 pi, Hz: natural, without damping
    damping     ratio, -Re / |eigenvalue|; negative: it grows
    shape       (n, complex) displacements by `Modes.coordinates`, the largest is 1
    """

    kind: str
    eigenvalue: complex
    frequency: float
    damping: float
    shape: Complex

    @property
    def damped_frequency(self) -> float:
        """Im(eigenvalue) / 2 pi, Hz."""
        return float(self.eigenvalue.imag) / (2.0 * np.pi)


@dataclass(frozen=True, eq=False)
class Modes:
    """Modes of a model by natural frequency, free ones first. A pair of eigenvalues is one mode.

    coordinates  of the shapes: pose (6), or the freedoms (m) of a held carrier, and phi of free flywheels
    zeros        number of zero eigenvalues; an undamped free direction has two, its position and its speed
    """

    coordinates: tuple[Channel, ...]
    modes: tuple[Mode, ...]
    zeros: int

    @property
    def unstable(self) -> bool:
        """Whether some mode grows."""
        return any(mode.damping < 0.0 and mode.kind != "free" for mode in self.modes)


def modes(model: LinearModel) -> Modes:
    """The modes of a linear model. Free directions (without stiffness) replace zero eigenvalues."""
    n, m = len(model.A), model.freedoms
    places = [*range(m), *range(2 * m, m + n // 2)]
    values, vectors = np.linalg.eig(model.A)
    limit = max(FREE * float(np.abs(values).max(initial=0.0)), SLOWEST)
    zero = np.abs(values) <= limit
    result = [_free(column) for column in _still(model.A, places)]
    rounding = FREE * np.abs(values)
    result += [
        _mode(complex(values[i]), vectors[places, i], bool(abs(values[i].imag) > rounding[i]))
        for i in _by_size(values)
        if not zero[i] and values[i].imag > -rounding[i]
    ]
    coordinates = tuple(model.states[i] for i in places)
    return Modes(coordinates, tuple(result), int(zero.sum()))


def _by_size(values: Complex) -> list[int]:
    """Indices of eigenvalues by magnitude; of magnitudes that only rounding tells apart, the growing one first."""
    order = np.argsort(np.abs(values), kind="stable")
    sizes = np.abs(values)[order]
    group = np.concatenate([[0], np.cumsum(np.diff(sizes) > SAME * sizes[1:])]).astype(int)
    return [int(order[i]) for i in np.lexsort((-values[order].real, group))]


def _mode(value: complex, shape: Complex, turning: bool) -> Mode:
    size = abs(value)
    kind = "oscillation" if turning else "decay" if value.real < 0.0 else "growth"
    damping = -value.real / size
    if abs(damping) <= FREE:
        damping = 0.0  # rounding, of either sign
    return Mode(kind, value, size / (2.0 * np.pi), damping, _scale_mode(shape))


def _free(shape: Array) -> Mode:
    return Mode("free", 0j, 0.0, 0.0, _scale_mode(shape.astype(np.complex128)))


def _scale_mode(shape: Complex) -> Complex:
    """Scale so that the largest displacement (m or rad) is 1."""
    largest = shape[int(np.argmax(np.abs(shape)))]
    return np.asarray(shape / largest) if largest != 0.0 else shape


def _still(A: Array, places: list[int]) -> list[Array]:
    """Displacements (a basis) that nothing brings back: A x = 0 with no speed in x."""
    _, sizes, rows = np.linalg.svd(A[:, places])
    kept = sizes > max(STIFF * float(sizes.max(initial=0.0)), SLOWEST**2)
    return list(reduced_basis(rows[int(kept.sum()) :]))


def shape_words(modes: Modes, shape: Complex) -> str:
    """Displacements of a shape, largest first, with their phases unless these are signs."""
    largest_first = sorted(zip(modes.coordinates, shape.tolist(), strict=True), key=lambda pair: -abs(pair[1]))
    return ", ".join(f"{channel.name} {_number(x)}" for channel, x in largest_first if abs(x) > SMALL)


def _number(x: complex) -> str:
    degrees = math.degrees(cmath.phase(x))
    if abs(degrees) <= ALIGNED:
        return f"{abs(x):.3g}"
    if abs(degrees) >= 180.0 - ALIGNED:
        return f"{-abs(x):.3g}"
    return f"{abs(x):.3g} at {degrees:.0f} deg"
