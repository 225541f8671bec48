"""Force of the suspension: a law without a potential, linear in a displacement that is found beforehand."""

from __future__ import annotations

import casadi as ca
import numpy as np

from mahovik.core.stand.model import Stand, State
from mahovik.laws.suspension.law import Suspension
from mahovik.proof.second.body import Array, CarrierEnergy, Expr, by_angles, rotation_vector

SMALL = 0.02
"""rad: a rotation vector below it is differentiated as a series, exact to rounding there."""


def inputs(stand: Stand) -> dict[str, tuple[int, int]]:
    """Shape of the displacement: an input, since a rotation vector is no smooth function of C."""
    return {"displacement": (6, 1)} if stand.law(Suspension) else {}


def force(stand: Stand, inputs: dict[str, Expr]) -> Expr:
    """P = -(stiffness x + damping V) (6; N, N m), on the carrier at O1 in E1."""
    law = stand.law(Suspension)
    if law is None:
        return ca.MX.zeros(6)
    return -(ca.DM(law.stiffness) @ inputs["displacement"] + ca.DM(law.damping) @ inputs["V"])


def arguments(stand: Stand, state: State, C: Array) -> dict[str, Array]:
    """x (6; m, rad): place of O1 from equilibrium in E1, and the rotation vector from the equilibrium's axes."""
    law = stand.law(Suspension)
    if law is None:
        return {}
    equilibrium = by_angles(stand.angles, ca.DM(law.angles)).full()
    away = np.array(state.position) - np.array(law.position)
    return {"displacement": np.concatenate([C.T @ away, rotation_vector(equilibrium.T @ C)])}


def arguments_near(stand: Stand, C0: Array, place: Expr, C: Expr) -> dict[str, Expr]:
    """x as an expression of a pose near the attitude C0. Not right at half a turn from equilibrium."""
    law = stand.law(Suspension)
    if law is None:
        return {}
    equilibrium = by_angles(stand.angles, ca.DM(law.angles))
    R = equilibrium.T @ C
    odd = ca.vertcat(R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]) / 2
    if float(np.linalg.norm(rotation_vector(equilibrium.full().T @ C0))) < SMALL:
        s2 = ca.sumsqr(odd)  # of the sine of the angle: arcsine over sine
        vector = odd * (1 + s2 / 6 + 3 * s2**2 / 40 + 5 * s2**3 / 112 + 35 * s2**4 / 1152)
    else:
        sine = ca.norm_2(odd)
        vector = odd / sine * ca.atan2(sine, (ca.trace(R) - 1) / 2)
    return {"displacement": ca.vertcat(C.T @ (place - ca.DM(law.position)), vector)}


LAW = CarrierEnergy(force, inputs, arguments, arguments_near)
