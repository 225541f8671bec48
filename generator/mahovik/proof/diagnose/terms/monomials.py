"""The products of velocities, accelerations, phases and attitude that occur in (8), with values at many states."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations_with_replacement

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.proof.reference.array import Array

VELOCITIES = ("u", "v", "w", "p", "q", "r")
"""Letters of SNAME: the twist of E1 relative to the fluid, in E1."""

WRENCHES = ("X", "Y", "Z", "K", "M", "N")
"""Letters of SNAME: force and moment about O1, in E1."""

ACCELERATIONS = tuple(f"{letter}_dot" for letter in VELOCITIES)
DOWN = ("g_x", "g_y", "g_z")
"""Components in E1 of the unit vector along gravity; -sin theta, cos theta sin phi, cos theta cos phi with z down."""


@dataclass(frozen=True, eq=False)
class Monomial:
    """A product: its factors by name, and its value at each state.

    accelerates  whether the derivative of a velocity is one of its factors
    """

    factors: tuple[str, ...]
    values: Array
    accelerates: bool

    @property
    def term(self) -> str:
        """The product as it is written, "u q"."""
        return " ".join(self.factors) or "1"


@dataclass(frozen=True, eq=False)
class Motion:
    """Values of the factors at n states: twist relative to the fluid and its derivative (n, 6), phases, speeds and
    accelerations of flywheels (n, N), gravity in E1 (n, 3; m/s2)."""

    V_r: Array
    V_r_dot: Array
    phi: Array
    phi_dot: Array
    phi_ddot: Array
    gravity: Array


def monomials(stand: Stand, motion: Motion) -> list[Monomial]:
    """All products for a stand: bilinear in velocities, linear in accelerations and attitude, harmonics of phases."""
    names = [each.name for each in stand.flywheels]
    V = dict(zip(VELOCITIES, motion.V_r.T, strict=True))
    waves = list(harmonics(names, motion.phi))
    one = np.ones(len(motion.V_r))
    found = [Monomial(wave, values, accelerates=False) for wave, values in waves]
    found += [Monomial((a,), V[a], accelerates=False) for a in VELOCITIES]
    found += [Monomial((f"|{a}|", b), np.abs(V[a]) * V[b], accelerates=False) for a in VELOCITIES for b in VELOCITIES]
    speeds = {f"{name}.speed": x for name, x in zip(names, motion.phi_dot.T, strict=True)}
    rates = {f"{name}.acceleration": x for name, x in zip(names, motion.phi_ddot.T, strict=True)}
    down = _down(motion.gravity)
    for wave, values in waves:
        found += [
            Monomial((a, b, *wave), V[a] * V[b] * values, accelerates=False)
            for a, b in combinations_with_replacement(VELOCITIES, 2)
        ]
        found += [Monomial((a, *wave), x * values, accelerates=False) for a, x in down.items()]
        found += [
            Monomial((a, *wave), x * values, accelerates=True)
            for a, x in zip(ACCELERATIONS, motion.V_r_dot.T, strict=True)
        ]
    for name in names:
        own = [((), one), *((w, x) for w, x in waves if w and w[0].endswith(f" {name}"))]
        speed, rate = f"{name}.speed", f"{name}.acceleration"
        for wave, values in own:
            found += [Monomial((a, speed, *wave), V[a] * speeds[speed] * values, accelerates=False) for a in VELOCITIES]
            found.append(Monomial((speed, speed, *wave), speeds[speed] ** 2 * values, accelerates=False))
        # an acceleration also with the phases of other flywheels: an index may be wrong
        found += [Monomial((rate, *wave), rates[rate] * values, accelerates=False) for wave, values in waves]
        found.append(Monomial((speed,), speeds[speed], accelerates=False))
    return found


def harmonics(names: Sequence[str], phi: Array) -> Iterator[tuple[tuple[str, ...], Array]]:
    """1, and cosine and sine of the phase (n, N) of each flywheel and of twice the phase."""
    yield (), np.ones(len(phi))
    for name, x in zip(names, phi.T, strict=True):
        for multiple in (1, 2):
            of = f"{name}" if multiple == 1 else f"{multiple} {name}"
            yield (f"cos {of}",), np.cos(multiple * x)
            yield (f"sin {of}",), np.sin(multiple * x)


def _down(gravity: Array) -> Mapping[str, Array]:
    size = np.linalg.norm(gravity, axis=1)
    if not size.all():
        return {}
    return dict(zip(DOWN, (gravity / size[:, None]).T, strict=True))


def count(stand: Stand) -> int:
    """How many products there are for a stand."""
    N = len(stand.flywheels)
    zero = np.zeros((1, N))
    gravity = np.array([stand.gravity])
    return len(monomials(stand, Motion(np.zeros((1, 6)), np.zeros((1, 6)), zero, zero, zero, gravity)))
