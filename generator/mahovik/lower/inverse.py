"""inverse (12): flywheel accelerations for a wanted motion of the carrier, with diagnostics, and a cheap variant.

K = G G^T, W = G^-1 I D^-1, r = G^-1 b with b = F - K V* - M V - J phi' and D^2 = diag(weight Theta_ff):
least |r - W y|, then least |y|; phi'' = D^-1 y. With all weights 1 the singular values of W are those of
K^-1/2 I Theta_ff^-1/2.
"""

from __future__ import annotations

from typing import Any

from mahovik.derive import accumulate as derived_rows
from mahovik.derive import carrier as derived_carrier
from mahovik.lower.flywheels import AT_NOTES, columns_of, places_of, turn_of, turns_of
from mahovik.lower.forward import (
    STATE_STATUSES,
    check_inputs,
    external_wrench,
    relative_rate,
    scene,
)
from mahovik.lower.library import Library
from mahovik.lower.matrices import fill
from mahovik.lower.solve import carrier_binding
from mahovik.lower.symbolic import assign
from mahovik.program.build import Body, call
from mahovik.program.expression import Const, Convert, Expr, Not, Place, Status, both, integer, magnitude, real, select
from mahovik.program.function import STATUS_VALUES, Argument, Function
from mahovik.program.types import Kind


def factor(lib: Library) -> Function:
    """Cholesky factor of K."""
    work = Argument(
        "work", lib.layout.inverse_work, (), "inout", purpose="in: G holds K; out: lower triangle G, K = G G^T"
    )
    G = work.place.G
    body = Body()
    lib.begin(body)
    with body.loop("j", 6) as j:
        pivot = body.local("pivot")
        body.set(pivot, G[j][j])
        with body.loop("k", j) as k:
            body.add(pivot, -(G[j][k] * G[j][k]))
        lib.guard(body, Not(pivot > 0), "NOT_POSITIVE_DEFINITE")
        root = body.let("root", call(lib["sqrt"], pivot))
        body.set(G[j][j], root)
        with body.loop("i", 6, start=j + 1) as i:
            rest = body.local("rest")
            body.set(rest, G[i][j])
            with body.loop("k", j) as k:
                body.add(rest, -(G[i][k] * G[j][k]))
            body.set(G[i][j], rest / root)
    body.ret(Status("OK"))
    return Function(
        "factor",
        "Cholesky factor of the mass matrix, in place: K = G G^T.",
        (work,),
        body.statements,
        returns=Kind.STATUS,
        statuses=("OK", "NOT_POSITIVE_DEFINITE"),
    )


def demand(lib: Library) -> Function:
    """Everything of (12) at a state: K factored, I, b, W, r."""
    layout = lib.layout
    stand, x = lib.table_argument(), lib.state_argument()
    V_dot = Argument("V_dot", Kind.REAL, (6,), unit="m/s2, rad/s2", purpose="wanted")
    weight = Argument("weight", Kind.REAL, (layout.count,), purpose="of the flywheels in the norm, greater than 0")
    turns, wrench = lib.turn_arguments(), lib.wrench_arguments()
    work = Argument("work", layout.inverse_work, (), "out")
    w = work.place
    body = Body()
    lib.begin(body)
    seen = scene(lib, body, stand.place, x.place, turns=places_of(turns))
    moving = relative_rate(body, x.place, V_dot.place, seen.stream)
    body.call(lib["start_sums"], stand.place, seen.sums)
    column = body.local("column", (6,), comment="I_s")
    with body.loop("s", layout.count) as s:
        turn = turn_of(lib, body, x.place, s, seen.turns)
        row = stand.place.flywheel[s]
        body.call(lib["add_flywheel"], row, turn["s"], turn["c"], x.place.phi_dot[s], real(0), seen.sums)
        assign(body, list(column), derived_rows.columns().I, turn | columns_of(row))
        with body.loop("i", 6) as i:
            body.set(w.I[i][s], column[i])
    F = body.local("F", (6,), comment="wrench (7); then what K V* + I phi'' must equal")
    Z = body.local("Z", (6,), comment="momentum screw (2)")
    external_wrench(lib, body, stand.place, x.place, seen, wrench, F)
    body.call(lib["momentum_screw"], stand.place, seen.sums, seen.V, Z)
    body.call(lib["subtract_rates"], seen.sums, seen.V, Z, F)
    K_rows: dict[str, Any] = carrier_binding(lib, stand.place, seen.sums)
    fill(body, w.G, derived_carrier.mass_matrix(layout.added_mass), K_rows)
    body.note("b = F - K V*: what the flywheels must give")
    with body.loop("i", 6) as i:
        total: Expr = F[i]
        for j in range(6):
            total = total - w.G[i][j] * moving[j]
        body.set(w.b[i], total)
        body.set(w.r[i], total)
    lib.check(body, "factor", w)
    with body.loop("s", layout.count) as s:
        theta = stand.place.flywheel[s].spin * weight.place[s]
        body.set(w.scale[s], 1 / call(lib["sqrt"], theta))
        with body.loop("i", 6) as i:
            body.set(w.W[i][s], w.I[i][s] * w.scale[s])
    body.note("W = G^-1 I D^-1, r = G^-1 b: forward substitution")
    with body.loop("i", 6) as i:
        with body.loop("k", i) as k:
            with body.loop("s", layout.count) as s:
                body.add(w.W[i][s], -(w.G[i][k] * w.W[k][s]))
            body.add(w.r[i], -(w.G[i][k] * w.r[k]))
        inverse = body.let("inverse", 1 / w.G[i][i])
        with body.loop("s", layout.count) as s:
            body.set(w.W[i][s], w.W[i][s] * inverse)
        body.set(w.r[i], w.r[i] * inverse)
    body.ret(Status("OK"))
    return Function(
        "demand",
        "What (12) asks of the flywheels at a state: I, b, and both scaled to W, r.",
        (stand, x, *turns, V_dot, weight, *wrench, work),
        body.statements,
        equation="(12)",
        returns=Kind.STATUS,
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE"),
    )


def _check(
    lib: Library,
    body: Body,
    stand: Argument,
    x: Argument,
    V_dot: Argument,
    options: Place,
    wrench: tuple[Argument, ...],
    turns: tuple[Argument, ...] = (),
) -> None:
    """Inputs of both variants, and the options."""
    largest = lib.limits["LARGEST"].expression
    check_inputs(lib, body, stand, x, (), wrench, turns)
    lib.check(body, "within", V_dot.place, 6, lib.limits["MAX_ACCELERATION"].expression)
    lib.check(body, "within", options.weight, lib.layout.count, lib.limits["MAX_PARAMETER"].expression)
    lib.check(body, "within", options.limit, lib.layout.count, largest)
    shares = body.local("shares", (2,))
    for k, name in enumerate(("near", "damping")):
        body.set(shares[k], options.member(name))
    lib.check(body, "within", shares, 2, largest)
    for share in shares:
        lib.guard(body, Not(both(share >= 0, share <= 1)), "BAD_ARGUMENT")
    with body.loop("s", lib.layout.count) as s:
        lib.guard(
            body, Not(both(options.weight[s] > real(lib.thresholds.weight), options.limit[s] > 0)), "BAD_ARGUMENT"
        )


def inverse(lib: Library) -> Function:
    """phi'' for a wanted V*, with diagnostics."""
    layout = lib.layout
    stand, x = lib.table_argument(), lib.state_argument()
    V_dot = Argument("V_dot", Kind.REAL, (6,), unit="m/s2, rad/s2", purpose="wanted derivative of the components of V")
    options = Argument(
        "options", layout.inverse_options, purpose="weights, limits, damping; default_options has those of the stand"
    )
    wrench = lib.wrench_arguments()
    out = Argument("out", layout.inverse_result, (), "out", purpose="phi_ddot and how good it is")
    o, p = out.place, options.place
    body = Body()
    _check(lib, body, stand, x, V_dot, p, wrench)
    work = body.local("work", (), layout.inverse_work)
    inputs = [w.place for w in wrench]
    turns = turns_of(lib, body, x.place)
    lib.check(body, "demand", stand.place, x.place, *turns, V_dot.place, p.weight, *inputs, work)
    wanted = body.local("wanted")
    body.set(wanted, real(0))
    with body.loop("i", 6) as i:
        body.add(wanted, work.r[i] * work.r[i])
    body.call(lib["orthogonalise"], work)
    _sort(body, work)
    first = work.sigma[0]
    flags = body.local("flags", (), Kind.INT)
    rank = body.local("rank", (), Kind.INT)
    damped = body.local("damping")
    body.set(flags, integer(0))
    body.set(rank, integer(0))
    body.set(damped, real(0))
    with body.loop("s", layout.count) as s:
        body.set(o.phi_ddot[s], real(0))
    body.note("y = sum of (u_i . r) sigma_i / (sigma_i^2 + lambda^2) v_i over what is not zero")
    with body.loop("i", 6) as i, body.when(work.sigma[i] > lib.thresholds.rank * first):
        body.set(rank, rank + 1)
        ratio = body.let("ratio", work.sigma[i] / first)
        share = body.local("lambda")
        body.set(share, real(0))
        with body.when(ratio < p.near):
            body.set(flags, _flag(flags, "NEAR_SINGULAR"))
            with body.when(p.damping > 0):
                body.set(flags, _flag(flags, "DAMPED"))
                body.set(share, p.damping * first * (1 - ratio / p.near))
                body.set(damped, select(share > damped, share, damped))
        part = body.let("part", work.r[i] / (work.sigma[i] * work.sigma[i] + share * share))
        with body.loop("s", layout.count) as s:
            body.add(o.phi_ddot[s], part * work.W[i][s])
    _limit(lib, body, o, p, work, flags)
    with body.when(rank < min(6, int(layout.count))):
        body.set(flags, _flag(flags, "RANK_DEFICIENT"))
    _residual(lib, body, o, work, wanted, flags)
    body.set(o.rank, rank)
    body.set(o.damping, damped)
    with body.loop("i", min(6, int(layout.count))) as i:
        body.set(o.sigma[i], work.sigma[i])
    body.ret(Convert(flags, Kind.STATUS))
    return Function(
        "inverse",
        "Flywheel accelerations for a wanted motion of the carrier: I phi'' = F - K V* - M V - J phi'. "
        "Least residual in the norm of K^-1, then least weighted phi''.",
        (stand, x, V_dot, options, *wrench, out),
        body.statements,
        equation="(12)",
        returns=Kind.STATUS,
        statuses=(
            *STATE_STATUSES,
            "NOT_POSITIVE_DEFINITE",
            "BAD_ARGUMENT",
            "NEAR_SINGULAR",
            "DAMPED",
            "LIMITED",
            "UNREACHABLE",
            "RANK_DEFICIENT",
        ),
        notes=("Positive statuses are bits that may come together.",),
        public=True,
    )


def _flag(flags: Place, name: str) -> Expr:
    """flags with the bit of a status."""
    return flags | Const(STATUS_VALUES[name], Kind.INT, name)


def _sort(body: Body, work: Place) -> None:
    """Descending singular values: the order of the rows, by exchanging neighbours a fixed number of times."""
    body.note("descending singular values, by exchanging neighbours")
    with body.loop("pass", 5), body.loop("i", 5) as i, body.when(work.sigma[i] < work.sigma[i + 1]):
        for member in ("sigma", "r"):
            values = work.member(member)
            kept = body.let(f"kept_{member}", values[i])
            body.set(values[i], values[i + 1])
            body.set(values[i + 1], kept)
        for member, length, by_column in (("W", work.W.shape[1], False), ("U", 6, True)):
            m = work.member(member)
            with body.loop("j", length) as j:
                one, two = (m[j][i], m[j][i + 1]) if by_column else (m[i][j], m[i + 1][j])
                kept = body.let("kept", one)
                body.set(one, two)
                body.set(two, kept)


def _limit(lib: Library, body: Body, o: Place, p: Place, work: Place, flags: Place) -> None:
    """phi'' = D^-1 y, cut to its limits; the mask says whose."""
    with body.loop("s", lib.layout.count) as s:
        free = body.let("free", o.phi_ddot[s] * work.scale[s])
        over = body.let("over", magnitude(free) - p.limit[s])
        body.set(o.phi_ddot[s], free)
        body.set(o.limited[s], integer(0))
        with body.when(over > 0):
            body.set(o.phi_ddot[s], select(free < 0, -p.limit[s], p.limit[s]))
            body.set(o.limited[s], integer(1))
            body.set(flags, _flag(flags, "LIMITED"))


def _residual(lib: Library, body: Body, o: Place, work: Place, wanted: Place, flags: Place) -> None:
    """b - I phi'', its scaled size against the demand, and the direction hardest to reach."""
    left = body.local("left")
    z = body.local("z", (6,), comment="G^-1 residual")
    body.set(left, real(0))
    with body.loop("i", 6) as i:
        body.set(o.residual[i], work.b[i])
        with body.loop("s", lib.layout.count) as s:
            body.add(o.residual[i], -(work.I[i][s] * o.phi_ddot[s]))
    with body.loop("i", 6) as i:
        body.set(z[i], o.residual[i])
        with body.loop("k", i) as k:
            body.add(z[i], -(work.G[i][k] * z[k]))
        body.set(z[i], z[i] / work.G[i][i])
        body.add(left, z[i] * z[i])
        body.note("G u of the least singular value")
        body.set(o.hardest[i], real(0))
        with body.loop("k", i + 1) as k:
            body.add(o.hardest[i], work.G[i][k] * work.U[k][5])
    tolerance = lib.thresholds.unreachable
    with body.when(left > tolerance * tolerance * wanted):
        body.set(flags, _flag(flags, "UNREACHABLE"))


def inverse_fast(lib: Library, at: bool = False) -> Function:
    """phi'' for a wanted V* by the normal equations: for fast loops away from singularity.

    `at`: inverse_fast_at, of given sines and cosines of the phases.
    """
    layout = lib.layout
    stand, x = lib.table_argument(), lib.state_argument()
    V_dot = Argument("V_dot", Kind.REAL, (6,), unit="m/s2, rad/s2", purpose="wanted derivative of the components of V")
    options = Argument("options", layout.inverse_options, purpose="weights and damping; near and limits are not read")
    given, wrench = lib.turn_arguments() if at else (), lib.wrench_arguments()
    phi_ddot = Argument("phi_ddot", Kind.REAL, (layout.count,), "out", "rad/s2", "flywheel accelerations")
    p = options.place
    wide = int(layout.count) >= 6
    size = 6 if wide else int(layout.count)
    body = Body()
    _check(lib, body, stand, x, V_dot, p, wrench, given)
    work = body.local("work", (), layout.inverse_work)
    inputs = [w.place for w in wrench]
    turns = places_of(given) or turns_of(lib, body, x.place)
    lib.check(body, "demand", stand.place, x.place, *turns, V_dot.place, p.weight, *inputs, work)
    body.note("normal equations: W W^T z = r, y = W^T z" if wide else "normal equations: W^T W y = W^T r")
    gram = body.local("gram", (size, size))
    z = body.local("z", (size,))
    trace = body.local("trace")
    body.set(trace, real(0))
    with body.loop("i", size) as i:
        with body.loop("j", i + 1) as j:
            body.set(gram[i][j], real(0))
            with body.loop("k", layout.count if wide else 6) as k:
                one, two = (work.W[i][k], work.W[j][k]) if wide else (work.W[k][i], work.W[k][j])
                body.add(gram[i][j], one * two)
        body.add(trace, gram[i][i])
        if wide:
            body.set(z[i], work.r[i])
        else:
            body.set(z[i], real(0))
            with body.loop("k", 6) as k:
                body.add(z[i], work.W[k][i] * work.r[k])
    share = body.let("lambda2", p.damping * p.damping * trace, "damping, squared")
    with body.loop("i", size) as i:
        body.add(gram[i][i], share)
    _solve_gram(lib, body, gram, z, size)
    with body.loop("s", layout.count) as s:
        y = body.local("y")
        body.set(y, real(0) if wide else z[s])
        if wide:
            with body.loop("k", 6) as k:
                body.add(y, work.W[k][s] * z[k])
        body.set(phi_ddot.place[s], y * work.scale[s])
    body.ret(Status("OK"))
    return Function(
        "inverse_fast_at" if at else "inverse_fast",
        "Flywheel accelerations for a wanted motion of the carrier, without diagnostics: normal equations.",
        (stand, x, *given, V_dot, options, *wrench, phi_ddot),
        body.statements,
        equation="(12)",
        returns=Kind.STATUS,
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE", "BAD_ARGUMENT"),
        notes=(
            "Squares the condition: as good as inverse where singular values are within some thousands of one another;",
            "NOT_POSITIVE_DEFINITE where they are not and damping is 0. Damping is relative to the norm of W.",
            *(AT_NOTES if at else ()),
        ),
        public=True,
    )


def _solve_gram(lib: Library, body: Body, gram: Place, z: Place, size: int) -> None:
    """z = gram^-1 z by a Cholesky factor in the lower triangle, in place."""
    with body.loop("j", size) as j:
        least = body.let("least", lib.thresholds.gram_pivot * gram[j][j], "below it a pivot is rounding only")
        with body.loop("k", j) as k:
            body.add(gram[j][j], -(gram[j][k] * gram[j][k]))
        lib.guard(body, Not(gram[j][j] > least), "NOT_POSITIVE_DEFINITE")
        body.set(gram[j][j], call(lib["sqrt"], gram[j][j]))
        with body.loop("i", size, start=j + 1) as i:
            with body.loop("k", j) as k:
                body.add(gram[i][j], -(gram[i][k] * gram[j][k]))
            body.set(gram[i][j], gram[i][j] / gram[j][j])
    with body.loop("i", size) as i:
        with body.loop("k", i) as k:
            body.add(z[i], -(gram[i][k] * z[k]))
        body.set(z[i], z[i] / gram[i][i])
    with body.loop("t", size) as t:
        i_ = body.let("i", integer(size - 1) - t)
        with body.loop("k", size, start=i_ + 1) as k:
            body.add(z[i_], -(gram[k][i_] * z[k]))
        body.set(z[i_], z[i_] / gram[i_][i_])
