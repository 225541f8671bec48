"""The products of velocities, accelerations, phases and attitude that occur in (8), with values at many states."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations_with_replacement

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.diagnose.terms.directions import FREE, Directions, along_freedoms
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.array import Array

DOWN = ("g_x", "g_y", "g_z")
"""Components in E1 of the unit vector along gravity; -sin theta, cos theta sin phi, cos theta cos phi with z down."""


STREAM = ("stream_x", "stream_y", "stream_z")
"""Components in E1 of the velocity of the fluid."""


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
    """Values of the factors at n states: speeds of the carrier relative to the fluid and their derivatives (n, k),
    phases, speeds and accelerations of flywheels (n, N), gravity in E1 (n, 3; m/s2).

    along  whose letters the speeds have
    """

    V_r: Array
    V_r_dot: Array
    phi: Array
    phi_dot: Array
    phi_ddot: Array
    gravity: Array
    along: Directions = FREE

    @classmethod
    def of(cls, states: Sequence[State], at: Sequence[Pieces], V_r_dot: Array, along: Directions = FREE) -> Motion:
        """The motion at states, `at` their pieces, where the twist has the derivative V_r_dot (n, 6)."""
        wheels = (len(states), len(at[0].phi_dot))
        return cls(
            np.array([p.V_r for p in at]) @ along.dual,
            V_r_dot @ along.dual,
            np.array([s.phi for s in states]).reshape(wheels),
            np.array([s.phi_dot for s in states]).reshape(wheels),
            np.array([s.phi_ddot for s in states]).reshape(wheels),
            np.array([p.gravity for p in at]),
            along,
        )


def monomials(stand: Stand, motion: Motion) -> list[Monomial]:
    """All products for a stand: bilinear in velocities, linear in accelerations and attitude, harmonics of phases."""
    names = [each.name for each in stand.flywheels]
    letters = motion.along.letters
    V = dict(zip(letters, motion.V_r.T, strict=True))
    waves = list(harmonics(names, motion.phi))
    one = np.ones(len(motion.V_r))
    found = [Monomial(wave, values, accelerates=False) for wave, values in waves]
    found += [Monomial((a,), V[a], accelerates=False) for a in letters]
    found += [Monomial((f"|{a}|", b), np.abs(V[a]) * V[b], accelerates=False) for a in letters for b in letters]
    speeds = {f"{name}.speed": x for name, x in zip(names, motion.phi_dot.T, strict=True)}
    rates = {f"{name}.acceleration": x for name, x in zip(names, motion.phi_ddot.T, strict=True)}
    down = _down(motion.gravity)
    for wave, values in waves:
        found += [
            Monomial((a, b, *wave), V[a] * V[b] * values, accelerates=False)
            for a, b in combinations_with_replacement(letters, 2)
        ]
        found += [Monomial((a, *wave), x * values, accelerates=False) for a, x in down.items()]
        found += [
            Monomial((a, *wave), x * values, accelerates=True)
            for a, x in zip(motion.along.rates, motion.V_r_dot.T, strict=True)
        ]
    for name in names:
        own = [((), one), *((w, x) for w, x in waves if w and w[0].endswith(f" {name}"))]
        speed, rate = f"{name}.speed", f"{name}.acceleration"
        for wave, values in own:
            found += [Monomial((a, speed, *wave), V[a] * speeds[speed] * values, accelerates=False) for a in letters]
            found.append(Monomial((speed, speed, *wave), speeds[speed] ** 2 * values, accelerates=False))
        # an acceleration also with the phases of other flywheels: an index may be wrong
        found += [Monomial((rate, *wave), rates[rate] * values, accelerates=False) for wave, values in waves]
        found.append(Monomial((speed,), speeds[speed], accelerates=False))
    return found


def momentum_monomials(stand: Stand, motion: Motion, streams: Array | None) -> list[Monomial]:
    """All products in the momentum: velocities and speeds by harmonics of phases; the stream (n, 3) in E1, if any."""
    names = [each.name for each in stand.flywheels]
    factors = dict(zip(motion.along.letters, motion.V_r.T, strict=True))
    factors |= {f"{name}.speed": x for name, x in zip(names, motion.phi_dot.T, strict=True)}
    if streams is not None:
        factors |= dict(zip(STREAM, streams.T, strict=True))
    waves = list(harmonics(names, motion.phi))
    return [Monomial((a, *wave), x * values, accelerates=False) for wave, values in waves for a, x in factors.items()]


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
    along = along_freedoms(stand)
    zero, speeds = np.zeros((1, N)), np.zeros((1, len(along.letters)))
    gravity = np.array([stand.gravity])
    return len(monomials(stand, Motion(speeds, speeds, zero, zero, zero, gravity, along)))
