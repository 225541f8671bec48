"""A wheel as its maker describes it: harmonics, broadband noise, internal modes, from CSV files.

Harmonics: amplitude c Omega^2 at the frequency h Omega, Omega the wheel's speed, h its order. A radial force or moment
turns, (cos, sin) along axes 2 and 3 of the wheel's mount: `sense` forward with the wheel, or backward against it, which
excites the other whirl of a rocking mode; where it is unknown the larger amplitude of the two counts. Phases are
unknown. Source: R. A. Masterson, D. W. Miller, R. L. Grogan, Development and validation of reaction wheel disturbance
models, J. Sound Vib. 249 (2002).

Internal modes: the rotor on its bearings. Radial and axial: the mount gets H(omega) times what it would get of a rigid
wheel; rocking: a rotor of transverse inertia J_t and polar inertia g J_t, whose whirls are split by the speed:

    J_t theta'' - i g J_t Omega theta' + c theta' + k theta = moment,  theta = theta_2 + i theta_3.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from mahovik.core.stand.files import WORDS, read_columns
from mahovik.core.stand.units import PLAIN, Dimension
from mahovik.use.numeric.se3 import Array, Complex
from mahovik.use.vibration.lines import SAME

FORCE = Dimension("a force by the square of a speed", "N/(rad/s)^2")
MOMENT = Dimension("a moment by the square of a speed", "N m/(rad/s)^2")

PARTS = {
    "radial force": (0.0, 1.0, -1.0j, 0.0, 0.0, 0.0),
    "axial force": (1.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    "radial moment": (0.0, 0.0, 0.0, 0.0, 1.0, -1.0j),
    "axial moment": (0.0, 0.0, 0.0, 1.0, 0.0, 0.0),
}
"""Columns of harmonics and noise: wrench on the mount about Os, in the wheel's axes at phase 0, for amplitude 1."""

PATTERNS = np.array(list(PARTS.values()))
"""(4, 6): of the parts."""


@dataclass(frozen=True, eq=False)
class Harmonics:
    """order, sense (H), amplitude (H, 4; N or N m by (rad/s)^2) of the parts, tolerance (H): part of the amplitude."""

    order: Array
    amplitude: Array
    tolerance: Array
    sense: tuple[str, ...]


SENSES = ("forward", "backward", "unknown")
"""How a radial part turns, seen from the wheel's own turning."""


def read_harmonics(path: Path) -> Harmonics:
    """A table of harmonics; without a sense order 1 turns forward, others in an unknown one. Raises TableError."""
    known = {"order": PLAIN, "tolerance": PLAIN, "sense": WORDS}
    known |= {part: MOMENT if "moment" in part else FORCE for part in PARTS}
    columns = read_columns(path, known, ["order"])
    order = columns.numbers["order"]
    amplitude = np.stack([columns.get(part) for part in PARTS], axis=1)
    tolerance = columns.get("tolerance")
    for i in range(columns.rows):
        if not order[i] > 0.0:
            raise columns.refuse(i, f"order {order[i]:g}, expected a number above 0")
        if (amplitude[i] < 0.0).any() or tolerance[i] < 0.0:
            raise columns.refuse(i, "an amplitude or tolerance below 0")
        if order[i] in order[:i]:
            raise columns.refuse(i, f"order {order[i]:g} appears twice")
    sense = columns.texts.get("sense", [""] * columns.rows)
    sense = [word or ("forward" if h == 1.0 else "unknown") for word, h in zip(sense, order, strict=True)]
    for i, word in enumerate(sense):
        if word not in SENSES:
            raise columns.refuse(i, f'sense "{word}", expected one of {", ".join(SENSES)}')
    return Harmonics(order, amplitude, tolerance, tuple(sense))


@dataclass(frozen=True, eq=False)
class Noise:
    """One-sided densities (F, 4; N^2/Hz or (N m)^2/Hz) of the parts at frequencies (F, Hz) that rise; radial: per axis.

    Linear between them, zero outside.
    """

    frequency: Array
    density: Array


def read_noise(path: Path) -> Noise:
    """A table of broadband noise. Raises TableError."""
    force, moment = Dimension("a density of force", "N^2/Hz"), Dimension("a density of moment", "N^2 m^2/Hz")
    known = {"frequency": Dimension("a frequency", "Hz")}
    known |= {part: moment if "moment" in part else force for part in PARTS}
    columns = read_columns(path, known, ["frequency"])
    f = columns.numbers["frequency"]
    density = np.stack([columns.get(part) for part in PARTS], axis=1)
    for i in range(columns.rows):
        if not f[i] > (f[i - 1] if i else 0.0):
            raise columns.refuse(i, f"frequency {f[i]:g} Hz, expected one above 0 and above the last")
        if (density[i] < 0.0).any():
            raise columns.refuse(i, "a density below 0")
    if columns.rows < 2:
        raise columns.refuse(0, "expected at least two frequencies")
    return Noise(f, density)


KINDS = ("radial", "axial", "rocking")


@dataclass(frozen=True, eq=False)
class InnerModes:
    """Internal modes of a wheel by kind: natural frequency (rad/s), damping ratio; g of the rocking one."""

    modes: dict[str, tuple[float, float]]
    polar: float = 0.0

    def gain(self, kind: str, omega: Array, speed: Array) -> Complex:
        """H (...) of the mode of a kind at omega (rad/s; negative: against the sense of axis 1) and speed (rad/s).

        NaN at a resonance without damping.
        """
        if kind not in self.modes:
            return np.ones(np.broadcast(omega, speed).shape, dtype=np.complex128)
        natural, damping = self.modes[kind]
        through = natural**2 + 2j * damping * natural * omega
        whirl = self.polar * speed * omega if kind == "rocking" else 0.0
        left = through - omega**2 + whirl
        met = np.abs(left) <= 2.0 * SAME * natural * np.abs(omega)
        return np.where(met, np.nan, through / np.where(met, 1.0, left))

    def transmit(self, wrench: Complex, omega: Array, speed: Array) -> Complex:
        """Wrench (..., 6) on the mount, in the wheel's axes, from that of a rigid wheel at omega (...; rad/s, >= 0)."""
        result = wrench.astype(np.complex128)
        axial = self.gain("axial", omega, speed)
        result[..., 0] = axial * wrench[..., 0]
        for kind, i in (("radial", 1), ("rocking", 4)):
            forward = (wrench[..., i] + 1j * wrench[..., i + 1]) / 2.0
            backward = (wrench[..., i] - 1j * wrench[..., i + 1]) / 2.0
            forward = self.gain(kind, omega, speed) * forward
            backward = self.gain(kind, -omega, speed).conj() * backward
            result[..., i], result[..., i + 1] = forward + backward, (forward - backward) / 1j
        return result


def read_inner_modes(path: Path) -> InnerModes:
    """A table of internal modes, a row per kind. Raises TableError."""
    known = {"mode": WORDS, "frequency": Dimension("a frequency", "Hz"), "damping": PLAIN, "polar ratio": PLAIN}
    columns = read_columns(path, known, ["mode", "frequency", "damping"])
    modes: dict[str, tuple[float, float]] = {}
    polar = 0.0
    for i, kind in enumerate(columns.texts["mode"]):
        if kind not in KINDS or kind in modes:
            again = "appears twice" if kind in modes else f"expected one of {', '.join(KINDS)}"
            raise columns.refuse(i, f'mode "{kind}": {again}')
        frequency, damping = float(columns.numbers["frequency"][i]), float(columns.numbers["damping"][i])
        if not frequency > 0.0 or damping < 0.0:
            raise columns.refuse(i, f"frequency {frequency:g} Hz, damping {damping:g}: expected above 0, and not below")
        modes[kind] = (2.0 * np.pi * frequency, damping)
        if kind == "rocking":
            polar = float(columns.get("polar ratio")[i])
            if not 0.0 <= polar <= 2.0:
                raise columns.refuse(i, f"polar ratio {polar:g}, expected 0 to 2")
    return InnerModes(modes, polar)
