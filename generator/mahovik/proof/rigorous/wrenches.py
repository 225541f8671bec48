"""External wrenches (7): of each body in its own frame about its origin; the laws of `laws/` on the carrier."""

from __future__ import annotations

from collections.abc import Sequence

from flint import arb_mat

from mahovik.contract import laws
from mahovik.core.stand.model import Body, Stand
from mahovik.core.stand.state import State
from mahovik.proof.rigorous.ball import column, part
from mahovik.proof.rigorous.bodies import PlacedBody
from mahovik.proof.rigorous.screw import LINEAR


def own_wrench(body: Body, gravity: arb_mat, V_r: arb_mat, given: arb_mat) -> arb_mat:
    """P_k (6; N, N m): laws of bodies and run-time wrench; `gravity` (3), `V_r` (6) in the body's frame."""
    return sum((wrench(body, gravity, V_r) for wrench in laws.of_bodies("rigorous", "wrench")), given)


def external_wrenches(
    stand: Stand, state: State, C: arb_mat, V: arb_mat, V_r: arb_mat, bodies: Sequence[PlacedBody]
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
