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
from mahovik.proof.reference.array import Array, stack, times, transpose, vector
from mahovik.proof.reference.assembly import body_wrenches, run_time_wrench
from mahovik.proof.reference.bodies import Bodies, bodies_of, spatial_inertia
from mahovik.proof.reference.motion import forward, mounts_on_flywheels
from mahovik.proof.reference.pieces import body_wrench, coupling, coupling_bias, velocity_matrix
from mahovik.proof.reference.rotation import C1
from mahovik.proof.reference.screw import Phi, block_diagonal, f, spin

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
    """A result, and the magnitudes of its terms; a row a flywheel (Nx6) for results of each flywheel, else (6)."""

    words: str
    key: str
    terms: Callable[[reference.Pieces, State], Array]


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
    s = at.bodies.flywheels
    carried = transpose(s.L) @ at.V
    V = carried + np.outer(at.phi_dot, f)
    Theta, V_dot = np.abs(s.Theta), np.abs(carried @ spin.T * at.phi_dot[:, None])
    own = stack([sum(map(np.abs, at.terms[body.name].values()), np.zeros(6)) for body in s.bodies], 6)
    return _lengths(times(Theta, V_dot) + times(np.abs(Phi(V)), times(Theta, np.abs(V))) + own)


def _coupling_terms(columns: Array, at: reference.Pieces) -> Array:
    """Columns (6xN) times phi', by their lengths, since a flywheel's terms are turned into E1."""
    return np.asarray(_lengths(columns.T * at.phi_dot[:, None]).sum(axis=0))


def _lengths(screws: Array) -> Array:
    """Lengths of the two halves of each screw (Nx6), repeated in all their components."""
    return np.repeat(np.linalg.norm(screws.reshape(-1, 2, 3), axis=2), 3, axis=1)


def _mass_terms(at: reference.Pieces) -> Array:
    """Terms of K (6x6), body by body."""
    k = at.bodies
    return np.asarray((np.abs(k.L @ k.Theta @ transpose(k.L)) + np.abs(k.Lambda)).sum(axis=0))


def _wrench_terms(at: reference.Pieces) -> Array:
    """Terms of F (6), body by body and kind by kind."""
    kinds = [sum(map(np.abs, each.values()), np.zeros(6)) for each in at.terms.values()]
    return np.asarray(times(np.abs(at.bodies.L), np.array(kinds)).sum(axis=0))


QUANTITIES: Mapping[str, Quantity] = {
    "forward": Quantity("the carrier's acceleration V_dot", "V_dot", acceleration_terms),
    "momentum": Quantity("the momentum Z", "Z", momentum_terms),
    "mounts": Quantity("the wrench of its mount", "mount_wrench", mount_terms),
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
    bodies, others = bodies_of(stand), [balanced_flywheel(s) for s in stand.flywheels]
    for motion in MOTIONS:
        best = {want: np.tile((0.0, np.inf), (len(others), 1)) for want in QUANTITIES}
        for state in states(stand, speeds, motion):
            for want, effects in _effects(stand, state, bodies, others).items():
                better = effects[:, 0] / effects[:, 1] > best[want][:, 0] / best[want][:, 1]
                best[want][better] = effects[better]
        for want, rows in best.items():
            for number, (effect, rounding) in enumerate(rows.tolist()):
                if 0.0 < effect * PART < rounding:
                    name, words = stand.flywheels[number].name, QUANTITIES[want].words
                    found[number, want] = Shortfall(name, speeds[number], want, words, motion, effect, rounding)
    return [found[key] for key in sorted(found)]


def _effects(stand: Stand, state: State, bodies: Bodies, others: Sequence[Flywheel]) -> dict[str, Array]:
    """Effect of each flywheel's unbalance and rounding (Nx2) by want, in the component that shows it best."""
    try:
        at = reference.pieces(stand, state, bodies)
    except StateError:
        return {}  # a law is undefined: not a state of the stand
    V_dot = reference.evaluate(stand, state, ["forward"], at)["V_dot"]
    found = {}
    for want, changes in exchanged(at, state, V_dot, others).items():
        effect = np.abs(changes)
        size = np.broadcast_to(QUANTITIES[want].terms(at, state), effect.shape)
        seen = effect > DOUBLE_NOISE * size
        with np.errstate(divide="ignore"):
            share = np.divide(effect, size, out=np.zeros_like(effect), where=seen)
        at_best = np.arange(len(effect)), np.argmax(share, axis=1)
        rounding = np.where(seen[at_best], FACTOR * UNIT * size[at_best], np.inf)
        found[want] = np.column_stack([effect[at_best], rounding])
    return found


def exchanged(at: reference.Pieces, state: State, V_dot: Array, others: Sequence[Flywheel]) -> Mapping[str, Array]:
    """Changes of V_dot, Z and of its own mount_wrench (Nx6 each, by want) where one flywheel is another.

    What a flywheel adds to (2)-(9) is linear in its Theta and P. So the difference of two flywheels at one state is
    what a flywheel adds whose Theta and P are the differences of theirs, and nothing cancels.

    V_dot   (6) of `forward` before
    others  N flywheels, each in the place of one of the stand, with its mount, axis and zero
    """
    s, phi_ddot = at.bodies.flywheels, vector(state.phi_ddot)
    Theta = stack([spatial_inertia(other) for other in others], 6, 6) - s.Theta
    d = Bodies(tuple(others), s.L, Theta, s.Lambda, s.phi, s.phi_dot)
    gravities, twists = transpose(s.L[:, :3, :3]) @ at.gravity, s.twists(at.V_r)
    kinds = [
        body_wrenches(other, gravity, V_r, run_time_wrench(state, other))
        for other, gravity, V_r in zip(others, gravities, twists, strict=True)
    ]
    P = stack([body_wrench(each) for each in kinds], 6) - at.P_s
    Lt = transpose(d.L)
    K, I, J = d.L @ Theta @ Lt, coupling(d).T, coupling_bias(d, at.V_r).T
    K_dot = d.L @ (spin @ Theta - Theta @ spin) @ Lt * d.phi_dot[:, None, None]
    # (K + dK) (V* + dV*) = right + d right, where K V* = right
    right = times(d.L, P) - velocity_matrix(K, K_dot, at.V_r) @ at.V_r - K @ at.V_r_dot(V_dot)
    right -= J * d.phi_dot[:, None] + I * phi_ddot[:, None]
    scale = 1.0 / np.sqrt(np.diag(at.K))
    solved = np.linalg.solve((at.K + K) * np.outer(scale, scale), (scale * right)[:, :, None])[:, :, 0]
    mounts = mounts_on_flywheels(d, P, at.V, np.array(state.V_dot), phi_ddot)
    return {
        "forward": scale * solved,
        "momentum": K @ at.V + I * d.phi_dot[:, None],
        "mounts": times(block_diagonal(C1(d.phi)), mounts),
    }


def states(stand: Stand, speeds: Sequence[float], motion: str) -> Iterator[State]:
    """States at some phases; neighbouring flywheels differ by a tenth of a radian, so that they do not cancel."""
    count = len(stand.flywheels)
    for k in range(PHASES):
        phases = tuple(0.3 + 0.1 * s + k * math.pi / 2 for s in range(count))
        yield replace(rest_state(stand), phi=phases, phi_dot=tuple(speeds), V=MOTIONS[motion])


def shortfalls_line(short: Sequence[Shortfall]) -> str:
    """One line on all quantities that float does not resolve; empty without any."""
    return f"{short[0]}{f' (and {len(short) - 1} more)' if len(short) > 1 else ''}" if short else ""
