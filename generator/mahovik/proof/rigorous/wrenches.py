"""External wrenches (7): of each body in its own frame about its origin; suspension and legs on the carrier."""

from __future__ import annotations

from collections.abc import Sequence

from flint import arb_mat

from mahovik.core.stand.model import Body, Damping, Leg, Stand, Suspension
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.rigorous.ball import column, cross, dot, elements, length, matrix, number, part, zeros
from mahovik.proof.rigorous.bodies import Placed
from mahovik.proof.rigorous.rotation import SEQUENCE, rotation_vector, turned
from mahovik.proof.rigorous.screw import ANGULAR, LINEAR, force_at, stacked


def own_wrench(body: Body, gravity: arb_mat, V_r: arb_mat, given: arb_mat) -> arb_mat:
    """P_k (6; N, N m): weight, buoyancy, damping, run-time wrench; `gravity` (3), `V_r` (6) in the body's frame."""
    P = force_at(gravity * number(body.mass), column(body.center_of_mass)) + given
    if body.buoyancy is not None:
        P = P - force_at(gravity * number(body.buoyancy.displaced_mass), column(body.buoyancy.center))
    return P if body.damping is None else P + damping_wrench(body.damping, V_r)


def damping_wrench(damping: Damping, V_r: arb_mat) -> arb_mat:
    """-(linear V_r) - (quadratic (V_r |V_r|)) + hydrodynamic derivatives (6; N, N m)."""
    P, twist = zeros(6), elements(V_r)
    if damping.linear is not None:
        P = P - matrix(damping.linear) * V_r
    if damping.quadratic is not None:
        P = P - matrix(damping.quadratic) * column([x * abs(x) for x in twist])
    for term in damping.terms:
        first, second = (abs(twist[a.component]) if a.absolute else twist[a.component] for a in term.of)
        P[term.wrench, 0] = P[term.wrench, 0] + number(term.value) * first * second
    return P


def suspension_wrench(stand: Stand, law: Suspension, O1: arb_mat, C: arb_mat, V: arb_mat) -> arb_mat:
    """-(stiffness x + damping V) (6; N, N m), x = (C^T (O1 - position), rotation vector of C_eq^T C)."""
    C_eq = turned(SEQUENCE[stand.angles], law.angles)
    x = stacked(C.transpose() * (O1 - column(law.position)), rotation_vector(C_eq.transpose() * C))
    return -(matrix(law.stiffness) * x + matrix(law.damping) * V)


def leg_wrench(leg: Leg, O1: arb_mat, C: arb_mat, V: arb_mat) -> arb_mat:
    """Wrench (6; N, N m) of a spring-damper leg on the carrier about O1 in E1. StateError where it has no length."""
    point = column(leg.carrier)
    span = O1 + C * point - column(leg.ground)
    distance = length(span)
    if not distance > 0:
        raise StateError(f"leg between ground {leg.ground} and carrier {leg.carrier}: no length")
    along = C.transpose() * span * (1 / distance)
    rate = dot(along, part(V, LINEAR) + cross(part(V, ANGULAR)) * point)
    tension = number(leg.stiffness) * (distance - number(leg.length)) + number(leg.damping) * rate
    return force_at(-(along * tension), point)


def external_wrenches(
    stand: Stand, state: State, C: arb_mat, V: arb_mat, V_r: arb_mat, bodies: Sequence[Placed]
) -> dict[str, arb_mat]:
    """P_k (6; N, N m) by body name, in the body's frame about its origin; suspension and legs with the carrier's."""
    gravity, O1 = C.transpose() * column(stand.gravity), column(state.position)
    P: dict[str, arb_mat] = {}
    for k in bodies:
        C_k = part(k.L, LINEAR, LINEAR)
        given = column(state.wrench.get(k.body.name, (0.0,) * 6))
        P[k.body.name] = own_wrench(k.body, C_k.transpose() * gravity, k.twist(V_r), given)
    ties = [leg_wrench(leg, O1, C, V) for leg in stand.legs]
    if stand.suspension is not None:
        ties.append(suspension_wrench(stand, stand.suspension, O1, C, V))
    for tie in ties:
        P[stand.carrier.name] = P[stand.carrier.name] + tie
    return P
