"""Force of the legs by a potential and by Rayleigh's function."""

from __future__ import annotations

import math
from functools import cache

import casadi as ca
import numpy as np

from mahovik.core.stand.model import Stand, State
from mahovik.errors import StateError
from mahovik.laws.leg.law import legs_of
from mahovik.proof.second.body import Array, CarrierEnergy, Chart, Expr, turn

SHORTEST = 1e-9
"""m; a shorter leg has no direction."""


def force(stand: Stand, inputs: dict[str, Expr]) -> Expr:
    """Generalized force (6) of all legs on the carrier."""
    legs = legs_of(stand)
    if not legs:
        return ca.MX.zeros(6)
    numbers = ca.DM(np.array([(*leg.ground, *leg.carrier, leg.length, leg.stiffness, leg.damping) for leg in legs]))
    pose = (ca.repmat(inputs[name], 1, len(legs)) for name in ("position", "C", "V"))
    return ca.sum2(_leg_force().map(len(legs))(numbers.T, *pose))


@cache
def _leg_force() -> Expr:
    """(leg, place, C, V) -> generalized force (6) of a leg, of any pose of the carrier.

    -dU/dq - dR/dq' of U = stiffness (l - length)^2 / 2 and Rayleigh's R = damping l'^2 / 2, l the distance of the two
    points. `leg` is ground 3, carrier 3, length, stiffness, damping; `place` (3; m) of O1 and C are the pose.
    """
    chart = Chart()
    leg, place, C = ca.SX.sym("leg", 9), ca.SX.sym("place", 3), ca.SX.sym("C", 3, 3)
    ground, carrier, unstretched, stiffness, damping = ca.vertsplit(leg, [0, 3, 6, 7, 8, 9])
    end = place + C @ (chart.delta + turn(chart.xi) @ carrier)
    distance = ca.norm_2(end - ground)
    potential = stiffness * (distance - unstretched) ** 2 / 2
    rayleigh = damping * chart.rate(distance) ** 2 / 2
    force = chart.at_present(-ca.gradient(potential, chart.q) - ca.gradient(rayleigh, chart.q_dot))[:6]
    return ca.Function("leg_force", [leg, place, C, chart.q_dot[:6]], [force])


def arguments(stand: Stand, state: State, C: Array) -> dict[str, Array]:
    """No inputs of its own. StateError if a leg has no length."""
    for leg in legs_of(stand):
        length = math.hypot(*(np.array(state.position) + C @ np.array(leg.carrier) - np.array(leg.ground)))
        if length < SHORTEST:
            where = f"leg between ground {leg.ground} and carrier {leg.carrier}"
            raise StateError(f"{where}: length {length:.3g} m is zero")
    return {}


LAW = CarrierEnergy(force, arguments=arguments)
