"""The equation of a task in drive torques, scaled: W y = r, tau = tau_0 + Theta_ff^1/2 y.

With the free flywheels eliminated, K_c V* = F_c - I (tau - tau_0)/Theta_ff: the equation of `demand` with
K_c = K - sum I I^T/Theta_ff in the place of K, and y/Theta_ff^1/2 in that of phi''. So `project_TASK` makes of
X = C^-1 I Theta_ff^-1/2 and x = C^-1 (F_c - K_c d), K_c = C C^T, the rows that are demanded. tau_0 gives flywheels
their preferred accelerations on a carrier with V* = 0.
"""

from __future__ import annotations

from typing import Any

from mahovik.core.derive.order import SYMMETRIC
from mahovik.core.formula.derived import carrier as derived
from mahovik.core.lower.demand import substitute
from mahovik.core.lower.flywheels import common_terms, couple_flywheel, places_of
from mahovik.core.lower.forward import STATE_STATUSES, external_wrench, relative_rate, scene, sum_up
from mahovik.core.lower.library import Library
from mahovik.core.lower.solve import invert_symmetric, start_blocks
from mahovik.core.lower.symbolic import assign
from mahovik.core.lower.task.demand import factor3, substitute3
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Place, equal, integer, real, select
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def torque_demand(lib: Library, turning: bool) -> Function:
    """X, x and C; of the turning part alone, with v* eliminated, where only turning is demanded."""
    layout = lib.layout
    table, x = lib.table_argument(), lib.state_argument()
    turns, wrench, locked = lib.turn_arguments(), lib.wrench_arguments(), lib.locked_argument()
    preferred = Argument(
        "preferred", Kind.REAL, (layout.count,), unit="rad/s2", purpose="accelerations of the flywheels"
    )
    work = Argument("work", layout.inverse_work, (), "out", purpose="W holds X, r holds x, G holds C; and scale")
    tau_0 = Argument(
        "tau_0", Kind.REAL, (layout.count,), "out", "N m", "torques that give these on a carrier with V* = 0"
    )
    w = work.place
    body = Body()
    seen = scene(lib, body, table.place, x.place, turns=places_of(turns))
    sum_up(lib, body, table.place, x.place, seen, None)
    F = body.local("F", (6,), comment="wrench (7); then F_c")
    external_wrench(lib, body, table.place, x.place, seen, wrench, F)
    body.call(lib["subtract_rates"], table.place, seen.sums, seen.V, F)
    K = body.local("K", (), layout.schur, "mass matrix with free flywheels eliminated")
    start_blocks.put_into(body, lib, table.place, seen.sums, K)
    alike = common_terms.put_into(body, lib, seen.V, seen.g)
    coupling = body.local("drive", (), layout.coupling)
    with body.loop("s", layout.count) as s:
        couple_flywheel.put_into(body, lib, table.place, s, seen, alike, coupling)
        spin = body.let("spin", table.place.flywheel[s].spin)
        bias: Expr = coupling.bias
        if seen.own is not None:
            bias = bias - seen.own[s * integer(6) + 3]
        body.set(tau_0.place[s], spin * preferred.place[s] + bias)
        body.set(w.scale[s], table.place.flywheel[s].spin_root_inv)
        free = equal(locked.place[s], integer(0))
        with body.when(free):
            body.call(lib["eliminate"], coupling.I, table.place.flywheel[s].spin_inv, preferred.place[s], K, F)
        body.note("a locked flywheel takes no part")
        with body.loop("i", 6) as i:
            body.set(w.I[i][s], select(free, coupling.I[i], real(0)))
    if turning:
        _turning_part(lib, body, table.place, w, K, F)
    else:
        still = body.local("still", (6,), comment="V* = 0")
        for element in still:
            body.set(element, real(0))
        _whole(lib, body, w, K, F, relative_rate(body, x.place, still, seen.stream))
    what = "the turning part of the motion" if turning else "the motion"
    return body.checked_function(
        "torque_demand_turning" if turning else "torque_demand",
        f"How {what} depends on the drive torques, scaled, at V* = 0.",
        (table, x, *turns, preferred, locked, *wrench, work, tau_0),
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE"),
    )


def _whole(lib: Library, body: Body, w: Place, K: Place, F: Place, moving: Place) -> None:
    """C, x, X of all six components."""
    for at, block in enumerate((K.A, K.D)):
        for value, (a, b) in zip(block, SYMMETRIC, strict=True):
            body.set(w.G[3 * at + a][3 * at + b], value)
            if a != b:
                body.set(w.G[3 * at + b][3 * at + a], value)
    for a in range(3):
        for b in range(3):
            body.set(w.G[3 + a][b], K.B[3 * a + b])
            body.set(w.G[b][3 + a], K.B[3 * a + b])
    with body.loop("i", 6) as i:
        total: Expr = F[i]
        for j in range(6):
            total = total - w.G[i][j] * moving[j]
        body.set(w.b[i], total)
        body.set(w.r[i], total)
    lib.check(body, "factor", w)
    with body.loop("s", lib.layout.count) as s, body.loop("i", 6) as i:
        body.set(w.W[i][s], w.I[i][s] * w.scale[s])
    substitute(lib, body, w)


def _turning_part(lib: Library, body: Body, table: Place, w: Place, K: Place, F: Place) -> None:
    """C, x, X of the last three components: what eliminating v* leaves of them. A stream moves v* alone."""
    inverse = body.local("A_inv", (6,))
    invert_symmetric.put_into(body, lib, K.A, inverse)
    U = body.local("U", (9,), comment="A^-1 B^T")
    S = body.local("S", (6,), comment="D - B A^-1 B^T")
    binding: dict[str, Any] = {"A_inv": inverse, "B": K.B, "U": U, "J": K.D}
    assign(body, list(U), derived.schur_coupling(True), binding)
    assign(body, list(S), derived.reduced_inertia(True), binding)
    factor3(lib, body, S, w)
    moment = body.local("moment", (3,), comment="of F, then of each column of I, when v* is eliminated")
    six = list(F)
    assign(body, list(moment), derived.reduced_moment(True), binding | {"f": six[:3], "n": six[3:]})
    substitute3(body, w.G, list(moment), list(w.r)[:3], "r")
    with body.loop("s", lib.layout.count) as s:
        column = [w.I[i][s] for i in range(6)]
        assign(body, list(moment), derived.reduced_moment(True), binding | {"f": column[:3], "n": column[3:]})
        substitute3(body, w.G, list(moment), [w.W[i][s] for i in range(3)], "W")
    body.call(lib["scale_turning"], table, w)
