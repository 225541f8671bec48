"""Structural modes as a table: frequency, damping, modal mass, shapes at the wheels' mounts and at points.

One-way: the exact mount wrenches of a rigid carrier drive the modes,

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

from mahovik.core.stand.files import TableError, read_columns
from mahovik.core.stand.model import Stand
from mahovik.core.stand.units import PLAIN, Dimension
from mahovik.use.numeric.se3 import Array, Complex
from mahovik.use.vibration.lines import SAME
from mahovik.use.vibration.torus import Flags

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
