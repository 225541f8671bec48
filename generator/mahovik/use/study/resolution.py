"""Whether float resolves the effect of unbalance: the effect of each flywheel's unbalance beside the rounding of float.

The effect of a flywheel's unbalance on a result is the difference from a balanced and symmetric flywheel, by the
reference in double. The rounding of float in the result is FACTOR units (2^-24) of the magnitudes of its terms at the
same state: weight, springs, gyroscopic terms, the accelerations that balance them.
If the rounding is more than half of the effect in every component, float cannot show the unbalance reliably, even with
correct C.

Evaluated with the flywheels at given speeds, at some phases: with the carrier at rest, where the unbalance stands
beside weight and suspension, and moving by 1 m/s and 1 rad/s about every axis, where gyroscopic terms stand beside it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mahovik.core.stand.model import Flywheel, Stand, Vec6
from mahovik.core.stand.state import State, rest_state
from mahovik.errors import StateError
from mahovik.proof import reference
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import Bodies, PlacedBody, bodies_of
from mahovik.proof.reference.motion import forward
from mahovik.proof.reference.screw import Phi, f, spin
from mahovik.use.study.exchange import Exchange

UNIT = 2.0**-24
"""Largest relative error of one rounding in float."""

FACTOR = 32.0
"""Most units of rounding in a result: 29.3 were measured over 25 stands, the examples and random ones. Most are below
8; the largest are of flywheels whose mounting axes are nearly parallel, which loses digits."""

PART = 0.5
"""Largest part of an effect that rounding may reach while the effect still shows."""

DOUBLE_NOISE = 1e-13
"""Part of the terms' magnitudes: a smaller effect is rounding of the reference, from a flywheel without unbalance."""

PHASES = 4
"""Phases a quarter turn apart, so that no component of a turning vector is missed."""

MOTIONS: Mapping[str, Vec6] = {"at rest": (0.0,) * 6, "moving by 1 m/s and 1 rad/s": (1.0,) * 6}
"""Motions of the carrier, by their words in messages."""


@dataclass(frozen=True)
class Shortfall:
    """A quantity in which float does not show the unbalance of a flywheel.

    flywheel, speed  its name, rad/s
    want, words      name in `eval`, and description
    motion           of the carrier, in words
    effect, rounding of the component that shows most; SI
    """

    flywheel: str
    speed: float
    want: str
    words: str
    motion: str
    effect: float
    rounding: float

    def __str__(self) -> str:
        return (
            f"float: the unbalance of {self.flywheel} at {self.speed * 30 / math.pi:.5g} rpm changes {self.words} by "
            f"{self.effect:.1e}, and float rounds it by up to {self.rounding:.1e} (carrier {self.motion}): "
            "generate double for it"
        )


@dataclass(frozen=True)
class Quantity:
    """A result, and the magnitudes of its terms; one row per flywheel for results of each flywheel."""

    words: str
    key: str
    terms: Callable[[reference.Pieces, State], Array]
    by_flywheel: bool = False


def acceleration_terms(at: reference.Pieces, state: State) -> Array:
    """Terms of V_dot (6): |K^-1| times every term of (8)."""
    V = np.abs(at.V_r)
    V_dot = forward(at, np.zeros(len(at.phi_dot)))
    K = _mass_terms(at)
    momentum = K @ V + _coupling_terms(at.I, at)
    turning = _coupling_terms(at.J - Phi(at.V_r) @ at.I, at)
    right = _wrench_terms(at) + np.abs(Phi(at.V_r)) @ momentum + np.abs(at.K_dot) @ V + turning
    stream = np.abs(at.stream_rate())
    return np.asarray(_inverse_magnitude(at.K) @ (right + K @ np.abs(at.V_r_dot(V_dot))) + stream)


def _inverse_magnitude(S: Array) -> Array:
    """|S^-1|, element by element, of a symmetric positive definite S; scaled first, for units mix."""
    scale = 1.0 / np.sqrt(np.diag(S))
    return np.asarray(np.abs(np.linalg.inv(S * np.outer(scale, scale))) * np.outer(scale, scale))


def momentum_terms(at: reference.Pieces, state: State) -> Array:
    """Terms of Z (6)."""
    return np.asarray(_mass_terms(at) @ (np.abs(at.V) + np.abs(at.V - at.V_r)) + _coupling_terms(at.I, at))


def mount_terms(at: reference.Pieces, state: State) -> Array:
    """Terms of mount_wrench (Nx6): lengths of force and moment, since their axes do not turn with the flywheel."""
    found = np.zeros((len(at.flywheels), 6))
    for row, s in enumerate(at.flywheels):
        carried = s.L.T @ at.V
        V = np.abs(carried + f * s.phi_dot)
        V_dot = np.abs(spin @ carried * s.phi_dot)
        Theta = np.abs(s.Theta)
        own = sum((np.abs(P) for P in at.terms[s.body.name].values()), np.zeros(6))
        whole = Theta @ V_dot + np.abs(Phi(carried + f * s.phi_dot)) @ (Theta @ V) + own
        found[row] = _lengths(whole)
    return found


def _coupling_terms(columns: Array, at: reference.Pieces) -> Array:
    """Columns (6xN) times phi', by their lengths, since a flywheel's terms are turned into E1."""
    return np.asarray(sum((_lengths(c * speed) for c, speed in zip(columns.T, at.phi_dot, strict=True)), np.zeros(6)))


def _lengths(screw: Array) -> Array:
    """Lengths of the two halves, repeated in all their components."""
    return np.repeat([np.linalg.norm(screw[:3]), np.linalg.norm(screw[3:])], 3)


def _bodies(at: reference.Pieces) -> tuple[PlacedBody, ...]:
    return (*at.fixed, *at.flywheels)


def _mass_terms(at: reference.Pieces) -> Array:
    """Terms of K (6x6), body by body."""

    total = sum((np.abs(k.L @ k.Theta @ k.L.T) for k in _bodies(at)), np.zeros((6, 6)))
    return np.asarray(total + sum(np.abs(p.Lambda) for p in at.fixed))


def _wrench_terms(at: reference.Pieces) -> Array:
    """Terms of F (6), body by body and kind by kind."""
    total = np.zeros(6)
    for k in _bodies(at):
        for P in at.terms[k.body.name].values():
            total += np.abs(k.L) @ np.abs(P)
    return total


QUANTITIES: Mapping[str, Quantity] = {
    "forward": Quantity("the carrier's acceleration V_dot", "V_dot", acceleration_terms),
    "momentum": Quantity("the momentum Z", "Z", momentum_terms),
    "mounts": Quantity("the wrench of its mount", "mount_wrench", mount_terms, by_flywheel=True),
}
"""Quantities by want. Drive torques are left out: they need not show an unbalance."""


def balanced_flywheel(flywheel: Flywheel) -> Flywheel:
    """The same flywheel without unbalance or asymmetry: mass centre on its axis, inertia of revolution."""
    J = flywheel.inertia
    across = 0.5 * (J[1][1] + J[2][2])
    return replace(
        flywheel,
        center_of_mass=(flywheel.center_of_mass[0], 0.0, 0.0),
        inertia=((J[0][0], 0.0, 0.0), (0.0, across, 0.0), (0.0, 0.0, across)),
    )


def shortfalls(stand: Stand, speeds: Sequence[float]) -> list[Shortfall]:
    """Quantities that float does not resolve with flywheels at these speeds (rad/s); one per flywheel and want.

    None of a held carrier, which has no C in float yet.
    """
    if stand.hold is not None:
        return []
    found: dict[tuple[int, str], Shortfall] = {}
    bodies = bodies_of(stand)
    exchanges = [Exchange.of(number, s, balanced_flywheel(s)) for number, s in enumerate(stand.flywheels)]
    for motion in MOTIONS:
        best: dict[tuple[int, str], tuple[float, float]] = {}
        for state in states(stand, speeds, motion):
            for number, want, effect, rounding in _effects(stand, state, bodies, exchanges):
                known = best.get((number, want), (0.0, math.inf))
                best[number, want] = max(known, (effect, rounding), key=lambda pair: pair[0] / pair[1])
        for (number, want), (effect, rounding) in best.items():
            if 0.0 < effect * PART < rounding:
                flywheel, words = stand.flywheels[number], QUANTITIES[want].words
                found[number, want] = Shortfall(flywheel.name, speeds[number], want, words, motion, effect, rounding)
    return [found[key] for key in sorted(found)]


def _effects(
    stand: Stand, state: State, bodies: Bodies, exchanges: Sequence[Exchange]
) -> Iterator[tuple[int, str, float, float]]:
    """Flywheel, want, effect of its unbalance and rounding, in the component that shows it best."""
    try:
        at = reference.pieces(stand, state, bodies)
    except StateError:
        return  # a law is undefined: not a state of the stand
    V_dot = reference.evaluate(stand, state, ["forward"], at)["V_dot"]
    terms = {want: quantity.terms(at, state) for want, quantity in QUANTITIES.items()}
    for exchange in exchanges:
        number, changes = exchange.number, exchange.changes(at, state, V_dot)
        for want, quantity in QUANTITIES.items():
            effect, size = np.abs(changes[want]), terms[want]
            if quantity.by_flywheel:
                size = size[number]
            seen = effect > DOUBLE_NOISE * size
            if np.any(seen):
                effect, size = effect[seen], size[seen]
                index = int(np.argmax(effect / size))
                yield number, want, float(effect[index]), float(FACTOR * UNIT * size[index])


def states(stand: Stand, speeds: Sequence[float], motion: str) -> Iterator[State]:
    """States at some phases; neighbouring flywheels differ by a tenth of a radian, so that they do not cancel."""
    count = len(stand.flywheels)
    for k in range(PHASES):
        phases = tuple(0.3 + 0.1 * s + k * math.pi / 2 for s in range(count))
        yield replace(rest_state(stand), phi=phases, phi_dot=tuple(speeds), V=MOTIONS[motion])


def shortfalls_line(short: Sequence[Shortfall]) -> str:
    """One line on all quantities that float does not resolve; empty without any."""
    return f"{short[0]}{f' (and {len(short) - 1} more)' if len(short) > 1 else ''}" if short else ""
