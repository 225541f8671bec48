"""States at which the limit of one motor decides EXCESSIVE, and how much of it a demand takes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np

from mahovik.core.stand.model import Stand, State, rest_state
from mahovik.core.stand.motor import Motor
from mahovik.proof import reference
from mahovik.proof.reference.algebra import Array, twists
from mahovik.proof.reference.evaluate import held_state
from mahovik.proof.reference.inverse import least_error, scaled_demand, shares_of, weights
from mahovik.proof.reference.motion import forward, torque
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.verify.scales import Scales, bits_of

NARROW = 1e-4
"""Part of its limit by which a motor needs less at one state, and more at the next."""

OTHERS = 0.5
"""Part of what they have that the other motors may need at that."""

STRONGEST, HALVINGS = 2.0**40, 60
"""Largest demand that is tried, rad/s2 of one flywheel; steps of the search for one."""


@dataclass(frozen=True, eq=False)
class MotorEdge:
    """Demands of a carrier at rest that one flywheel meets more than the others, at a speed of its own.

    wheel  its place among the flywheels
    state  with its speed, and without a demand
    sense  1 driving, -1 braking
    """

    stand: Stand
    wheel: int
    state: State
    sense: float
    at: Pieces

    @property
    def name(self) -> str:
        """Flywheel, speed and sense."""
        words = "driving" if self.sense > 0 else "braking"
        return f"motor of {self.stand.flywheels[self.wheel].name} {words} at {self.state.phi_dot[self.wheel]:.6g} rad/s"

    @cached_property
    def _motion(self) -> tuple[Array, Array]:
        """V* (6), phi'' (N) of least size for it and tau (N), one after the other, of no demand and by one rad/s2."""

        def motion(demand: float) -> Array:
            alone = np.zeros(len(self.stand.flywheels))
            alone[self.wheel] = self.sense * demand
            V_dot = forward(self.at, alone)
            phi_ddot = least_error(scaled_demand(self.at, V_dot), weights(self.stand)).phi_ddot
            return np.concatenate([V_dot, phi_ddot, torque(self.at, V_dot, phi_ddot)])

        still = motion(0.0)
        return still, motion(1.0) - still

    def shares(self, demand: float) -> Array:
        """What a demand (rad/s2) needs of every motor over what it has (N)."""
        still, change = self._motion
        phi_ddot, tau = np.split((still + demand * change)[6:], 2)
        return shares_of(self.stand, self.at, tau, phi_ddot)

    def demand(self, part: float) -> float | None:
        """The demand (rad/s2) that takes a part of what the motor has; None where none does so of it alone."""
        low, high = 0.0, 1.0
        while not self.shares(high)[self.wheel] > part:
            high *= 2.0
            if high > STRONGEST:
                return None
        if self.shares(low)[self.wheel] > part:
            return None
        for _ in range(HALVINGS):
            middle = (low + high) / 2.0
            low, high = (low, middle) if self.shares(middle)[self.wheel] > part else (middle, high)
        return high if np.delete(self.shares(high), self.wheel).max(initial=0.0) < OTHERS else None

    def state_at(self, demand: float) -> State:
        """The state with the V_dot, or u_dot, of a demand."""
        still, change = self._motion
        V_dot: Any = tuple((still + demand * change)[:6].tolist())
        if self.stand.hold is None:
            return replace(self.state, V_dot=V_dot)
        u_dot = np.linalg.lstsq(twists(self.stand.hold), np.array(V_dot), rcond=None)[0]
        return held_state(self.stand, replace(self.state, u_dot=tuple(u_dot.tolist())))


def motor_edges(stand: Stand, states: Sequence[tuple[str, State]]) -> Iterator[MotorEdge]:
    """For each flywheel with a limited motor one for each speed that tells its numbers, at phases of the states."""
    for s, wheel in enumerate(stand.flywheels if states else ()):
        motor = wheel.motor
        for k, speed in enumerate(_speeds(motor) if motor is not None and motor.is_limited else ()):
            phi_dot = tuple(speed if i == s else 0.0 for i in range(len(stand.flywheels)))
            at_rest = replace(rest_state(stand), phi=states[(s + k) % len(states)][1].phi, phi_dot=phi_dot)
            at = reference.pieces(stand, at_rest)
            yield from (MotorEdge(stand, s, at_rest, sense, at) for sense in ((1.0, -1.0) if speed else (1.0,)))


def _speeds(motor: Motor) -> list[float]:
    """Speeds (rad/s) at rest, at and between points of the curve, halfway to no load, and where dry friction grows."""
    knots = [speed for speed, _ in motor.torque_speed]
    between = [(a + b) / 2.0 for a, b in pairwise(knots)]
    halfway = [] if motor.speed is None else [motor.speed / 2.0]
    dry = [motor.coulomb_speed / 2.0, 3.0 * motor.coulomb_speed] if motor.coulomb or motor.viscous else []
    return sorted({0.0, *knots, *between, *halfway, *dry})


def motor_states(stand: Stand, scales: Scales, states: Sequence[tuple[str, State]]) -> Iterator[tuple[str, State]]:
    """States at which a motor has a little more than is needed, or a little less, and rounding does not decide it."""
    for edge in motor_edges(stand, states):
        for side in (-1.0, 1.0):
            demand = edge.demand(1.0 + side * NARROW)
            if demand is None:
                continue
            state = edge.state_at(demand)
            measured = scales.want(state, "inverse")
            due = ("EXCESSIVE" in bits_of(measured.values["status"])) == (side > 0) if measured else False
            if measured and due and not measured.undecided and "EXCESSIVE" not in measured.in_doubt:
                yield f"{edge.name}, {'beyond' if side > 0 else 'within'} its limit", state
