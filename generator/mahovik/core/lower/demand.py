"""What (12) asks of the flywheels at a state, scaled: shared by inverse and inverse_fast.

K = G G^T, W = G^-1 I D^-1, r = G^-1 b with b = F - K V* - M V - J phi' and D^2 = Theta_ff. The singular values of W are
those of K^-1/2 I Theta_ff^-1/2: dimensionless, the same for any units, origin and axes.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from mahovik.core.formula.derived import accumulate as derived_rows
from mahovik.core.formula.derived import carrier as derived_carrier
from mahovik.core.lower.flywheels import columns_of, let_turn, places_of
from mahovik.core.lower.forward import (
    STATE_STATUSES,
    Scene,
    check_inputs,
    external_wrench,
    relative_rate,
    scene,
    sum_up,
)
from mahovik.core.lower.library import Library
from mahovik.core.lower.matrices import fill
from mahovik.core.lower.solve import carrier_binding
from mahovik.core.lower.symbolic import assign
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Not, Operand, Place, and_, real
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def factor(lib: Library) -> Function:
    """Cholesky factor of K."""
    work = Argument(
        "work", lib.layout.inverse_work, (), "inout", purpose="in: G holds K; out: lower triangle G, K = G G^T"
    )
    G = work.place.G
    body = Body()
    with body.loop("j", 6) as j:
        pivot = body.local("pivot")
        body.set(pivot, G[j][j])
        with body.loop("k", j) as k:
            body.add(pivot, -(G[j][k] * G[j][k]))
        lib.guard(body, Not(pivot > 0), "NOT_POSITIVE_DEFINITE")
        root = body.let("root", lib["sqrt"](pivot))
        body.set(G[j][j], root)
        with body.loop("i", 6, start=j + 1) as i:
            rest = body.local("rest")
            body.set(rest, G[i][j])
            with body.loop("k", j) as k:
                body.add(rest, -(G[i][k] * G[j][k]))
            body.set(G[i][j], rest / root)
    return body.checked_function(
        "factor",
        "Cholesky factor of the mass matrix, in place: K = G G^T.",
        (work,),
        statuses=("OK", "NOT_POSITIVE_DEFINITE"),
    )


@dataclass(frozen=True)
class Beginning:
    """How a demand begins: its arguments, and what is known once the right-hand side F of K V* + I phi'' = F is."""

    arguments: tuple[Argument, ...]
    table: Place
    work: Place
    seen: Scene
    moving: Place
    F: Place


def begin_demand(lib: Library, body: Body) -> Beginning:
    """Sums over the flywheels, and F, for a wanted V*."""
    table, x = lib.table_argument(), lib.state_argument()
    V_dot = Argument("V_dot", Kind.REAL, (6,), unit="m/s2, rad/s2", purpose="wanted")
    turns, wrench = lib.turn_arguments(), lib.wrench_arguments()
    work = Argument("work", lib.layout.inverse_work, (), "out")
    seen = scene(lib, body, table.place, x.place, turns=places_of(turns))
    moving = relative_rate(body, x.place, V_dot.place, seen.stream)
    sum_up(lib, body, table.place, x.place, seen, None)
    F = body.local("F", (6,), comment="wrench (7); then the right-hand side of K V* + I phi'' = F")
    external_wrench(lib, body, table.place, x.place, seen, wrench, F)
    body.call(lib["subtract_rates"], table.place, seen.sums, seen.V, F)
    return Beginning((table, x, *turns, V_dot, *wrench, work), table.place, work.place, seen, moving, F)


def demand(lib: Library) -> Function:
    """Everything of (12) at a state: K factored, I, b, W, r."""
    layout, body = lib.layout, Body()
    begun = begin_demand(lib, body)
    table, w, seen, moving, F = begun.table, begun.work, begun.seen, begun.moving, begun.F
    K_rows: dict[str, Any] = carrier_binding(lib, table, seen.sums)
    fill(body, w.G, derived_carrier.mass_matrix(layout.added_mass), K_rows)
    body.note("b = F - K V*: the wrench demanded of the flywheels")
    with body.loop("i", 6) as i:
        total: Expr = F[i]
        for j in range(6):
            total = total - w.G[i][j] * moving[j]
        demanded = body.let("demanded", total)
        body.set(w.b[i], demanded)
        body.set(w.r[i], demanded)
    lib.check(body, "factor", w)
    if layout.flywheels:
        with body.loop("s", layout.count) as s:
            turn = let_turn(body, seen.turns, s)
            row = table.flywheel[s]
            scale = body.let("scale", table.flywheel[s].spin_root_inv)
            body.set(w.scale[s], scale)
            assign(body, [w.I[i][s] for i in range(6)], derived_rows.columns().I, turn | columns_of(row))
            with body.loop("i", 6) as i:
                body.set(w.W[i][s], w.I[i][s] * scale)
    substitute(lib, body, w)
    return body.checked_function(
        "demand",
        "Matrix and right-hand side of (12) at a state: I, b, and both scaled to W, r.",
        begun.arguments,
        equation="(12)",
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE"),
    )


def substitute(lib: Library, body: Body, w: Place) -> None:
    """W = G^-1 W, r = G^-1 r by forward substitution."""
    layout = lib.layout
    body.note("W = G^-1 I D^-1, r = G^-1 b: forward substitution" if layout.flywheels else "r = G^-1 b")
    with body.loop("i", 6) as i:
        inverse = body.let("inverse", 1 / w.G[i][i])
        rest = body.local("rest")
        if layout.flywheels:
            with body.loop("s", layout.count) as s:
                body.set(rest, w.W[i][s])
                with body.loop("k", i) as k:
                    body.add(rest, -(w.G[i][k] * w.W[k][s]))
                body.set(w.W[i][s], rest * inverse)
        body.set(rest, w.r[i])
        with body.loop("k", i) as k:
            body.add(rest, -(w.G[i][k] * w.r[k]))
        body.set(w.r[i], rest * inverse)


ANSWER_NOTE = "RANGE also where the answer is no finite number."


def check_answer(lib: Library, body: Body, values: Place, count: Operand) -> None:
    """RANGE where a result is not finite: near singular states extreme demands need more than the largest number."""
    lib.check_as(body, "RANGE", "within", values, count, lib.limits["LARGEST"].expression)


def check_demand(
    lib: Library,
    body: Body,
    table: Argument,
    x: Argument,
    V_dot: Argument,
    options: Place,
    shares: tuple[str, ...],
    wrench: tuple[Argument, ...],
    turns: tuple[Argument, ...] = (),
) -> None:
    """Inputs of both variants, and of the options the weights and `shares`, numbers of 0 to 1."""
    check_inputs(lib, body, table, x, (), wrench, turns)
    lib.check(body, "within", V_dot.place, len(V_dot.place), lib.limits["MAX_ACCELERATION"].expression)
    lib.check(body, "within", options.weight, lib.layout.count, lib.limits["MAX_WEIGHT"].expression)
    given = body.local("shares", (len(shares),))
    for k, name in enumerate(shares):
        body.set(given[k], options.member(name))
    lib.check(body, "within", given, len(shares), lib.limits["LARGEST"].expression)
    for share in given:
        lib.guard(body, Not(and_(share >= 0, share <= 1)), "BAD_ARGUMENT")
    with body.loop("s", lib.layout.count) as s:
        lib.guard(body, Not(options.weight[s] >= real(lib.thresholds.weight)), "RANGE")
