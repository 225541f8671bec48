"""Whether float resolves the effect of unbalance: the effect of each flywheel's unbalance beside the rounding of float.

The effect of a flywheel's unbalance on a result is the difference from a balanced and symmetric flywheel, by the
reference in double. The rounding of float is FACTOR units (2^-24) of the scale of the result, which is measured: what
it changes by where every number of stand and state changes a little. If the rounding is more than half of the effect in
every component, float cannot show the unbalance reliably, even with correct C.

Evaluated with the flywheels at given speeds, at some phases: with the carrier at rest, where the unbalance stands
beside weight and suspension, and moving by 1 m/s and 1 rad/s about every axis, where gyroscopic terms stand beside it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mahovik.core.stand.model import Flywheel, Stand, State, Vec6, rest_state
from mahovik.proof import reference
from mahovik.proof.reference.algebra import Array, times
from mahovik.proof.reference.motion import bias
from mahovik.proof.reference.pieces import (
    Bodies,
    Pieces,
    bodies_of,
    coupling,
    coupling_bias,
    mass_matrices,
    mass_matrix_rates,
    momentum,
    velocity_matrix,
)
from mahovik.proof.verify.scales import Scales

UNIT = 2.0**-24
"""Largest relative error of one rounding in float."""

FACTOR = 32.0
"""Most units of rounding in a result, of its scale."""

PART = 0.5
"""Largest part of an effect that rounding may reach while the effect still shows."""

DOUBLE_NOISE = 1e-13
"""Part of the scale: a smaller effect is rounding of the reference, from a flywheel without unbalance."""

PHASES = 2
"""Phases a quarter turn apart, so that no component of a turning vector is missed; half a turn on is the opposite."""

MOTIONS: Mapping[str, Vec6] = {"at rest": (0.0,) * 6, "moving by 1 m/s and 1 rad/s": (1.0,) * 6}
"""Motions of the carrier, by their words in messages."""

QUANTITIES = {
    "forward": ("V_dot", "the carrier's acceleration V_dot"),
    "momentum": ("Z", "the momentum Z"),
    "mounts": ("mount_wrench", "the wrench of its mount"),
}
"""Keys and words of results by want of `eval`. Drive torques are left out: they need not show an unbalance."""


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
    if stand.hold is not None or not stand.flywheels:
        return []
    result: dict[tuple[int, str], Shortfall] = {}
    scales = Scales(stand, "float")
    balanced = replace(stand, flywheels=tuple(map(balanced_flywheel, stand.flywheels)))
    balanced_bodies = bodies_of(balanced)
    for motion in MOTIONS:
        best = {want: np.tile((0.0, np.inf), (len(speeds), 1)) for want in QUANTITIES}
        for state in states(stand, speeds, motion):
            for want, effects in _effects(scales, state, balanced, balanced_bodies).items():
                better = effects[:, 0] / effects[:, 1] > best[want][:, 0] / best[want][:, 1]
                best[want][better] = effects[better]
        for want, rows in best.items():
            for number, (effect, rounding) in enumerate(rows.tolist()):
                if 0.0 < effect * PART < rounding:
                    name, words = stand.flywheels[number].name, QUANTITIES[want][1]
                    result[number, want] = Shortfall(name, speeds[number], want, words, motion, effect, rounding)
    return [result[key] for key in sorted(result)]


def _effects(scales: Scales, state: State, balanced: Stand, balanced_bodies: Bodies) -> dict[str, Array]:
    """Effect of each flywheel's unbalance and rounding (Nx2) by want, in the component that shows it best."""
    effects = {}
    with np.errstate(all="ignore"):
        balanced_pieces = reference.pieces(balanced, state, balanced_bodies)
        with_one_balanced = _with_one_balanced(scales.at(state), balanced_pieces)
    for want, (key, _) in QUANTITIES.items():
        measured = scales.want(state, want)
        if measured is None:
            continue  # a law is undefined: not a state of the stand
        value, size = np.array(measured.values[key]), np.array(measured.scales[key])
        if want == "mounts":  # each by the accelerations given and its own flywheel
            balanced_values = np.array(reference.evaluate(balanced, state, [want], balanced_pieces)[key])
        else:
            balanced_values = with_one_balanced[want]
        change = np.abs(balanced_values - value)
        sizes = np.broadcast_to(size, change.shape)
        at = np.argmax(change / np.maximum(sizes, 1e-300), axis=1)
        effect, size = (np.take_along_axis(x, at[:, None], axis=1)[:, 0] for x in (change, sizes))
        seen = effect > DOUBLE_NOISE * size
        effects[want] = np.stack([np.where(seen, effect, 0.0), np.where(seen, FACTOR * UNIT * size, np.inf)], axis=1)
    return effects


def _with_one_balanced(at: Pieces, balanced: Pieces) -> dict[str, Array]:
    """V_dot of (8) and momentum (Nx6 each) with one flywheel after the other as in `balanced`, the rest as in `at`.

    Flywheels add up in K, K*, J phi' and F. None accelerates, and the carrier is free.
    """
    wheels = at.bodies.flywheels
    change = replace(wheels, Theta=balanced.bodies.flywheels.Theta - wheels.Theta)
    K, K_dot = mass_matrices(change), mass_matrix_rates(change)
    turning = wheels.phi_dot[:, None]
    F = times(wheels.L, balanced.P_s - at.P_s)
    changed_bias = times(velocity_matrix(K, K_dot, at.V_r), at.V_r) + coupling_bias(change, at.V_r).T * turning
    K_changed, pull = at.K + K, at.F - bias(at) + F - changed_bias
    unit = 1.0 / np.sqrt(np.abs(np.diagonal(K_changed, axis1=1, axis2=2)))  # K is scaled to a unit diagonal
    scaled = K_changed * unit[:, :, None] * unit[:, None, :]
    V_r_dot = unit * np.linalg.solve(scaled, (unit * pull)[..., None])[..., 0]
    return {
        "forward": at.V_dot(V_r_dot),
        "momentum": momentum(at) + times(K, at.V) + coupling(change).T * turning,
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
