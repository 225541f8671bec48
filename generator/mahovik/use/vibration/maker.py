"""What makers and analysts say in CSV files: harmonics, broadband noise, internal modes of a wheel; structural modes.

Harmonics: amplitude c Omega^2 at the frequency h Omega, Omega the wheel's speed, h its order. A radial force or moment
turns, (cos, sin) along axes 2 and 3 of the wheel's mount: `sense` forward with the wheel, or backward against it, which
excites the other whirl of a rocking mode; where it is unknown the larger amplitude of the two counts. Phases are
unknown. Source: R. A. Masterson, D. W. Miller, R. L. Grogan, Development and validation of reaction wheel disturbance
models, J. Sound Vib. 249 (2002).

Internal modes: the rotor on its bearings. Radial and axial: the mount gets H(omega) times what it would get of a rigid
wheel; rocking: a rotor of transverse inertia J_t and polar inertia g J_t, whose whirls are split by the speed:

    J_t theta'' - i g J_t Omega theta' + c theta' + k theta = moment,  theta = theta_2 + i theta_3.

Structural modes are driven one-way, by the exact mount wrenches of a rigid carrier:

    m (q'' + 2 zeta omega_0 q' + omega_0^2 q) = sum_s shape_s^T (wrench of wheel s on its mount),

and the motion of a point is that of the rigid carrier and sum shape_p q. The modes are those of the structure without
the rotors. Left out is the way back, from the moving mounts to the wheels: per mode the wheels' masses shift its
frequency by about half of `mass_ratio`, and their spin couples two directions by about `gyro_ratio`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from mahovik.core.stand.files import WORDS, TableError, read_columns
from mahovik.core.stand.model import Stand
from mahovik.core.stand.units import PLAIN, Dimension
from mahovik.use.numeric.se3 import Array, Complex
from mahovik.use.vibration.lines import SAME
from mahovik.use.vibration.torus import Flags

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
    sense = columns.texts.get("sense", [""] * columns.rows)
    sense = [word or ("forward" if h == 1.0 else "unknown") for word, h in zip(sense, order, strict=True)]
    lines = list(zip(order.tolist(), sense, strict=True))
    for i, (h, word) in enumerate(lines):
        if word not in SENSES:
            raise columns.refuse(i, f'sense "{word}", expected one of {", ".join(SENSES)}')
        above = [other for same, other in lines[:i] if same == h]
        if word in above or (above and "unknown" in (word, *above)):
            raise columns.refuse(i, f"order {h:g} appears twice, expected it once, or forward and backward")
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


SHAPE = ("x", "y", "z", "rx", "ry", "rz")
"""Components of a shape, in E1: displacement by q (1), turning by q (rad/m)."""


@dataclass(frozen=True, eq=False)
class Structure:
    """m modes: omega (m; rad/s), damping (m), mass (m; kg); shapes (6, m) in E1 by name of a wheel (at Os) or point."""

    path: Path
    omega: Array
    damping: Array
    mass: Array
    shapes: dict[str, Array]

    def at(self, name: str, what: str) -> Array:
        """The shapes at a wheel's mount or at a point (6, m). Raises TableError."""
        if name not in self.shapes:
            raise TableError(
                [f'{self.path}: mode shape missing for {what} "{name}"; add columns {name} x [-] .. {name} rz [rad/m]']
            )
        return self.shapes[name]

    def compliance(self, omega: Array) -> Complex:
        """(..., m): q by modal force at omega (...; rad/s); NaN for a mode without damping at its own frequency."""
        w = omega[..., None]
        stiffness = np.empty((*omega.shape, len(self.omega)), dtype=np.complex128)
        stiffness.real = self.mass * (self.omega**2 - w**2)
        stiffness.imag = 2.0 * self.mass * self.damping * self.omega * w
        if not self.damping.all():
            stiffness[self.is_resonant(omega)] = np.nan
        with np.errstate(invalid="ignore"):
            return np.asarray(1.0 / stiffness)

    def is_resonant(self, omega: Array) -> Flags:
        """(..., m): whether a mode has no damping and its frequency is omega (...; rad/s)."""
        return np.asarray((self.damping == 0.0) & (np.abs(omega[..., None] - self.omega) <= SAME * self.omega))


def read_structure(path: Path, stand: Stand) -> Structure:
    """A table of modes: `frequency`, `damping`, `modal mass`, and `NAME x` to `NAME rz`. Raises TableError."""
    bodies = [s.name for s in stand.flywheels] + [p.name for p in stand.instruments] + [p.name for p in stand.points]
    bodies.append(stand.carrier.name)
    plain = {"frequency": Dimension("a frequency", "Hz"), "damping": PLAIN, "modal mass": Dimension("a mass", "kg")}

    turning = Dimension("turning by displacement", "rad/m")
    of_shapes = {f"{body} {part}": turning if part.startswith("r") else PLAIN for body in bodies for part in SHAPE}
    columns = read_columns(path, plain | of_shapes, plain)
    numbers = columns.numbers
    shapes: dict[str, Array] = {}
    for body in dict.fromkeys(name.rpartition(" ")[0] for name in numbers if name not in plain):
        missing = [part for part in SHAPE if f"{body} {part}" not in numbers]
        if missing:
            found_parts = ", ".join(part for part in SHAPE if part not in missing)
            raise TableError(
                [
                    f'{path}: mode shape of "{body}" has {found_parts} alone, expected all of {", ".join(SHAPE)}; '
                    f"add columns {', '.join(f'{body} {part}' for part in missing)}, 0 where nothing moves"
                ]
            )
        shapes[body] = np.array([numbers[f"{body} {part}"] for part in SHAPE])
    for i in range(columns.rows):
        if not (numbers["frequency"][i] > 0.0 and numbers["modal mass"][i] > 0.0 and numbers["damping"][i] >= 0.0):
            raise columns.refuse(i, "expected a frequency and a modal mass above 0, and a damping not below")
    omega = 2.0 * np.pi * numbers["frequency"]
    return Structure(path, omega, numbers["damping"], numbers["modal mass"], shapes)


def way_back(structure: Structure, names: Sequence[str], Theta: Array, spin: Array) -> tuple[Array, Array]:
    """Estimates (m) of what the way back would change: `mass_ratio`, `gyro_ratio`.

    Theta (N, 6, 6): inertia of the wheels about Os on axes of E1; spin (N, 3; N m s): largest spin momentum in E1.
    mass_ratio  sum shape^T Theta shape / m: twice the relative shift of the frequency
    gyro_ratio  sum |turning|^2 |spin| / (m omega)
    """
    mass, gyro = np.zeros(len(structure.omega)), np.zeros(len(structure.omega))
    for s, name in enumerate(names):
        shape = structure.shapes.get(name)
        if shape is not None:
            mass += np.einsum("im,ij,jm->m", shape, Theta[s], shape)
            gyro += (shape[3:] ** 2).sum(axis=0) * float(np.linalg.norm(spin[s]))
    return mass / structure.mass, gyro / (structure.mass * structure.omega)
