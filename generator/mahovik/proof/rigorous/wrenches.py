"""External wrenches (7): of each body in its own frame about its origin; the laws of `laws/` on the carrier."""

from __future__ import annotations

from collections.abc import Sequence

from flint import arb_mat

from mahovik import laws
from mahovik.core.stand.model import Body, Damping, Stand
from mahovik.core.stand.state import State
from mahovik.proof.rigorous.ball import column, elements, matrix, number, part, zeros
from mahovik.proof.rigorous.bodies import Placed
from mahovik.proof.rigorous.screw import LINEAR, force_at


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


def external_wrenches(
    stand: Stand, state: State, C: arb_mat, V: arb_mat, V_r: arb_mat, bodies: Sequence[Placed]
) -> dict[str, arb_mat]:
    """P_k (6; N, N m) by body name, in the body's frame about its origin; the laws of `laws/` with the carrier's."""
    gravity, O1 = C.transpose() * column(stand.gravity), column(state.position)
    P: dict[str, arb_mat] = {}
    for k in bodies:
        C_k = part(k.L, LINEAR, LINEAR)
        given = column(state.wrench.get(k.body.name, (0.0,) * 6))
        P[k.body.name] = own_wrench(k.body, C_k.transpose() * gravity, k.twist(V_r), given)
    for law in laws.parts("rigorous"):
        for wrench in law.wrenches(stand, state, O1, C, V):
            P[stand.carrier.name] = P[stand.carrier.name] + wrench
    return P
