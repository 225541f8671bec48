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
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mahovik.core.stand.model import Flywheel, Stand, Vec6
from mahovik.core.stand.state import State, rest_state
from mahovik.proof import reference
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import Bodies
from mahovik.proof.reference.momentum import momentum
from mahovik.proof.reference.motion import answer_forward
from mahovik.proof.reference.pieces import (
    Pieces,
    coupling,
    coupling_bias,
    mass_matrix,
    mass_matrix_rate,
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

PHASES = 4
"""Phases a quarter turn apart, so that no component of a turning vector is missed."""

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
    for motion in MOTIONS:
        best = {want: np.tile((0.0, np.inf), (len(speeds), 1)) for want in QUANTITIES}
        for state in states(stand, speeds, motion):
            for want, effects in _effects(scales, state).items():
                better = effects[:, 0] / effects[:, 1] > best[want][:, 0] / best[want][:, 1]
                best[want][better] = effects[better]
        for want, rows in best.items():
            for number, (effect, rounding) in enumerate(rows.tolist()):
                if 0.0 < effect * PART < rounding:
                    name, words = stand.flywheels[number].name, QUANTITIES[want][1]
                    result[number, want] = Shortfall(name, speeds[number], want, words, motion, effect, rounding)
    return [result[key] for key in sorted(result)]


def _effects(scales: Scales, state: State) -> dict[str, Array]:
    """Effect of each flywheel's unbalance and rounding (Nx2) by want, in the component that shows it best."""
    stand, effects = scales.stand, {}
    with np.errstate(all="ignore"):
        balanced = replace(stand, flywheels=tuple(map(balanced_flywheel, stand.flywheels)))
        balanced_pieces = reference.pieces(balanced, state)
        swapped = list(_with_one_balanced(scales.at(state), balanced_pieces))
    for want, (key, _) in QUANTITIES.items():
        measured = scales.want(state, want)
        if measured is None:
            continue  # a law is undefined: not a state of the stand
        value, size = np.array(measured.values[key]), np.array(measured.scales[key])
        if want == "mounts":  # each by the accelerations given and its own flywheel
            balanced_values = np.array(reference.evaluate(balanced, state, [want], balanced_pieces)[key])
        else:
            balanced_values = np.array([WITHOUT_ONE[want](at, stand, state) for at in swapped])
        change = np.abs(balanced_values - value)
        sizes = np.broadcast_to(size, change.shape)
        at = np.argmax(change / np.maximum(sizes, 1e-300), axis=1)
        effect, size = (np.take_along_axis(x, at[:, None], axis=1)[:, 0] for x in (change, sizes))
        seen = effect > DOUBLE_NOISE * size
        effects[want] = np.stack([np.where(seen, effect, 0.0), np.where(seen, FACTOR * UNIT * size, np.inf)], axis=1)
    return effects


WITHOUT_ONE: Mapping[str, Callable[[Pieces, Stand, State], Array]] = {
    "forward": lambda at, stand, state: answer_forward(at, stand, state)["V_dot"],
    "momentum": lambda at, stand, state: momentum(at),
}
"""Quantities in which all flywheels add up, by want."""


def _with_one_balanced(at: Pieces, balanced: Pieces) -> Iterator[Pieces]:
    """What (8) and the momentum take, with one flywheel after the other as in `balanced`, the rest as in `at`."""
    wheels, change = at.bodies.flywheels, balanced.bodies.flywheels.Theta - at.bodies.flywheels.Theta
    for s, wheel in enumerate(wheels.bodies):
        one = slice(s, s + 1)
        Theta = Bodies((wheel,), wheels.L[one], change[one], wheels.Lambda[one], wheels.phi[one], wheels.phi_dot[one])
        K, K_bodies = (x + mass_matrix(Theta) for x in (at.K, at.K_bodies))
        K_dot = at.K_dot + mass_matrix_rate(Theta)
        I, J = at.I.copy(), at.J.copy()
        I[:, one] += coupling(Theta)
        J[:, one] += coupling_bias(Theta, at.V_r)
        F = at.F + wheels.L[s] @ (balanced.P[wheel.name] - at.P[wheel.name])
        M = velocity_matrix(K, K_dot, at.V_r)
        yield replace(at, K_bodies=K_bodies, K=K, K_dot=K_dot, M=M, I=I, J=J, F=F)


def states(stand: Stand, speeds: Sequence[float], motion: str) -> Iterator[State]:
    """States at some phases; neighbouring flywheels differ by a tenth of a radian, so that they do not cancel."""
    count = len(stand.flywheels)
    for k in range(PHASES):
        phases = tuple(0.3 + 0.1 * s + k * math.pi / 2 for s in range(count))
        yield replace(rest_state(stand), phi=phases, phi_dot=tuple(speeds), V=MOTIONS[motion])


def shortfalls_line(short: Sequence[Shortfall]) -> str:
    """One line on all quantities that float does not resolve; empty without any."""
    return f"{short[0]}{f' (and {len(short) - 1} more)' if len(short) > 1 else ''}" if short else ""
