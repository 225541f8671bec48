"""torque: what the drives must give for a motion; coupled: the motion that given drive torques make."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from mahovik.derive.order import SYMMETRIC
from mahovik.formula.derived import accumulate as derived_rows
from mahovik.formula.derived import carrier as derived_carrier
from mahovik.formula.derived import drive as derived
from mahovik.formula.derived import wrench as derived_wrench
from mahovik.lower.flywheels import AT_NOTES, columns_of, places_of, turn_of, turns_of
from mahovik.lower.forward import (
    STATE_STATUSES,
    Scene,
    check_inputs,
    external_wrench,
    from_stream,
    relative_rate,
    scene,
)
from mahovik.lower.library import Library
from mahovik.lower.solve import parts_of_twist
from mahovik.lower.symbolic import assign, translate
from mahovik.lower.wrenches import own_wrenches
from mahovik.program.build import Body
from mahovik.program.expression import Expr, Not, Place, Status, both, equal, integer, real
from mahovik.program.function import Argument, Function
from mahovik.program.types import Kind

_DOUBLE = {"two_c2": "twice the cosine and sine of the double phase", "two_s2": ""}


def couple(lib: Library) -> Function:
    """I_s and the bias torque of one flywheel."""
    layout = lib.layout
    row = Argument("row", layout.row)
    s = Argument("s", Kind.REAL, purpose="sin phi")
    c = Argument("c", Kind.REAL, purpose="cos phi")
    swing = Argument("swing", Kind.REAL, (3,), unit="m/s2", purpose="omega x v, less gravity")
    spun = Argument("spun", Kind.REAL, (6,), unit="rad2/s2", purpose="products of omega")
    g = Argument("g", Kind.REAL, (3,), unit="m/s2", purpose="gravity in E1")
    out = Argument("out", layout.coupling, (), "out")
    body = Body()
    binding: dict[str, Expr] = {"s": s.place, "c": c.place}
    for name in ("two_c2", "two_s2"):
        binding[name] = body.let(name, translate(derived_rows.weights()[name], binding), _DOUBLE[name])
    everything: dict[str, Any] = binding | columns_of(row.place)
    assign(body, list(out.place.I), derived_rows.columns().I, everything)
    mu_p, J_p = derived.phase_derivatives()
    assert list(mu_p) == list(derived_rows.columns().I[:3])
    slope = body.local("J_p", (6,), comment="dJ / dphi")
    assign(body, list(slope), J_p, everything)
    everything |= {"J_p": slope, "spun": spun.place, "swing": swing.place}
    everything |= {"mu_p": list(out.place.I)[:3], "g": g.place}
    if layout.flywheel_buoyancy:
        sunk = body.local("displaced_p", (3,), comment="derivative of the displaced first moment")
        for i in range(3):
            body.set(sunk[i], row.place.displaced_s[i] * c.place - row.place.displaced_c[i] * s.place)
        everything["displaced_p"] = sunk
    body.set(out.place.bias, translate(derived.bias_torque(layout.flywheel_buoyancy), everything))
    return Function(
        "couple",
        "Column of I of one flywheel, and the drive torque that it takes at V* = 0, phi'' = 0.",
        (row, s, c, swing, spun, g, out),
        body.statements,
        equation="(9)",
    )


@dataclass(frozen=True)
class Carried:
    """What the carrier's motion does to all flywheels alike: swing = omega x v - g (3), spun: products of omega (6)."""

    swing: Place
    spun: Place


def carried(lib: Library, body: Body, seen: Scene) -> Carried:
    """Both, into locals."""
    swing = body.local(
        "swing", (3,), comment="acceleration of O1 at V* = 0, less gravity" if lib.layout.weight else "omega x v"
    )
    bound = parts_of_twist(seen.V) | ({"g": seen.g} if seen.g is not None else {})
    assign(body, list(swing), derived.swing(lib.layout.weight), bound)
    spun = body.local("spun", (6,), comment="J . spun = -omega . J omega / 2 for any J")
    assign(body, list(spun), derived.spin_products(), bound)
    return Carried(swing, spun)


def couple_flywheel(
    lib: Library, body: Body, stand: Place, x: Place, s: Place, seen: Scene, by: Carried, out: Place
) -> dict[str, Expr]:
    """I_s and the bias torque of flywheel s into `out`; returns its sine and cosine."""
    turn = turn_of(lib, body, x, s, seen.turns)
    named = {"row": stand.flywheel[s], **turn, "swing": by.swing, "spun": by.spun, "g": seen.g, "out": out}
    body.call(lib["couple"], *lib.passed("couple", **named))
    return turn


def along(column: Place, V_dot: Place) -> Expr:
    """I_s . V*."""
    return translate(derived_wrench.row_times("column", "V_dot"), {"column": column, "V_dot": V_dot})


def torque(lib: Library, at: bool = False) -> Function:
    """tau for given V*, phi''; `at`: torque_at, of given sines and cosines of the phases."""
    layout = lib.layout
    arguments = _torque_arguments(lib, at)
    stand, x, *turns, V_dot, phi_ddot = [a for a in arguments if a.name not in ("wrench", "tau")]
    tau, wrench = arguments[-1], tuple(a for a in arguments if a.name == "wrench")
    body = Body()
    check_inputs(lib, body, stand, x, (phi_ddot,), wrench, tuple(turns))
    lib.check(body, "within", V_dot.place, 6, lib.limits["MAX_ACCELERATION"].expression)
    if layout.sine_input:
        inputs = [*(places_of(turns) or turns_of(lib, body, x.place)), *places_of((V_dot, phi_ddot, *wrench))]
        body.call(lib["balance"], stand.place, x.place, *inputs, tau.place)
    else:
        _balance(lib, body, arguments)
    body.ret(Status("OK"))
    return Function(
        "torque_at" if at else "torque",
        "Drive torques for a given motion: tau = f^T (Theta V_s* + Phi(V_s) Z_s - P_s).",
        arguments,
        body.statements,
        returns=Kind.STATUS,
        statuses=STATE_STATUSES,
        notes=AT_NOTES if at else (),
        public=True,
    )


def balance(lib: Library) -> Function:
    """What torque and torque_at share, from checked inputs."""
    arguments = _torque_arguments(lib, at=True)
    body = Body()
    _balance(lib, body, arguments)
    return Function("balance", "Drive torques for a given motion, from checked inputs.", arguments, body.statements)


def _torque_arguments(lib: Library, at: bool) -> tuple[Argument, ...]:
    """stand, x, sines and cosines, V_dot, phi_ddot, run-time wrenches, tau."""
    purpose = "drive torques, mount on flywheel, about the spin axis"
    return (
        lib.table_argument(),
        lib.state_argument(),
        *(lib.turn_arguments() if at else ()),
        Argument("V_dot", Kind.REAL, (6,), unit="m/s2, rad/s2", purpose="derivative of the components of V"),
        *lib.phi_ddot_arguments(),
        *lib.wrench_arguments(),
        Argument("tau", Kind.REAL, (lib.layout.count,), "out", "N m", purpose),
    )


def _balance(lib: Library, body: Body, arguments: tuple[Argument, ...]) -> None:
    """tau of checked arguments."""
    layout = lib.layout
    place = {a.name: a.place for a in arguments}
    stand, x = place["stand"], place["x"]
    wrench = tuple(a for a in arguments if a.name == "wrench")
    seen = scene(lib, body, stand, x, turns=tuple(place[n] for n in ("sine", "cosine") if n in place))
    moving = relative_rate(body, x, place["V_dot"], seen.stream)
    if layout.own_turning:
        scratch = body.local("scratch", (6,), comment="wrench on the carrier, of no use here")
        for element in scratch:
            body.set(element, real(0))
        own_wrenches(lib, body, stand, x, seen.turns, seen.V, wrench, scratch, seen.own)
    alike = carried(lib, body, seen)
    coupling = body.local("drive", (), layout.coupling)
    with body.loop("s", layout.count) as s:
        couple_flywheel(lib, body, stand, x, s, seen, alike, coupling)
        spin = stand.flywheel[s].spin * place["phi_ddot"][s]
        total = along(coupling.I, moving) + spin + coupling.bias
        body.set(place["tau"][s], total if seen.own is None else total - seen.own[s * integer(6) + 3])


def eliminate(lib: Library) -> Function:
    """One free flywheel eliminated from the coupled equations."""
    layout = lib.layout
    column = Argument("I", Kind.REAL, (6,))
    inverse = Argument("spin_inv", Kind.REAL, unit="1/(kg m2)")
    rate = Argument("rate", Kind.REAL, unit="rad/s2", purpose="its acceleration at V* = 0")
    schur = Argument("K", layout.schur, (), "inout")
    F = Argument("F", Kind.REAL, (6,), "inout")
    body = Body()
    i, K = column.place, schur.place
    scaled = body.local("scaled", (6,), comment="I / Theta_ff")
    for k in range(6):
        body.set(scaled[k], i[k] * inverse.place)
    for k, (a, b) in enumerate(SYMMETRIC):
        body.add(K.A[k], -(i[a] * scaled[b]))
    for a in range(3):
        for b in range(3):
            body.add(K.B[3 * a + b], -(i[3 + a] * scaled[b]))
    for k, (a, b) in enumerate(SYMMETRIC):
        body.add(K.D[k], -(i[3 + a] * scaled[3 + b]))
    for k in range(6):
        body.add(F.place[k], -(i[k] * rate.place))
    return Function(
        "eliminate",
        "Eliminates one free flywheel: K - I I^T / Theta_ff, F - I rate.",
        (column, inverse, rate, schur, F),
        body.statements,
    )


def solve_schur(lib: Library) -> Function:
    """6x6 solve by blocks of 3x3."""
    schur = Argument("K", lib.layout.schur)
    F = Argument("F", Kind.REAL, (6,))
    y = Argument("y", Kind.REAL, (6,), "out", purpose="must not overlap F")
    body = Body()
    lib.begin(body)
    K = schur.place
    adjugate, determinant = derived_carrier.inverse_of_symmetric()
    names = ("11", "22", "33", "12", "13", "23")
    cofactor: list[Expr] = [body.let(f"c{n}", translate(e, {"A": K.A})) for n, e in zip(names, adjugate, strict=True)]
    d = body.let("det", translate(determinant, {"A": K.A, "cofactor": cofactor}))
    whole = both(d >= lib.layout.precision.smallest, d <= lib.limits["LARGEST"].expression)
    lib.guard(body, Not(both(both(K.A[0] > 0, cofactor[2] > 0), whole)), "NOT_POSITIVE_DEFINITE")
    r = body.let("r", 1 / d)
    inverse = body.local("A_inv", (6,))
    for k in range(6):
        body.set(inverse[k], cofactor[k] * r)
    U = body.local("U", (9,), comment="A^-1 B^T")
    S = body.local("S", (6,), comment="D - B A^-1 B^T")
    n = body.local("moment", (3,), comment="n - B A^-1 f")
    omega_dot = body.local("omega_dot", (3,))
    six = list(F.place)
    binding = {"A_inv": inverse, "B": K.B, "U": U, "J": K.D, "f": six[:3], "n": six[3:], "omega_dot": omega_dot}
    assign(body, list(U), derived_carrier.schur_coupling(True), binding)
    assign(body, list(S), derived_carrier.reduced_inertia(True), binding)
    assign(body, list(n), derived_carrier.reduced_moment(True), binding)
    lib.check(body, "solve3", S, n, omega_dot)
    out = list(y.place)
    assign(body, out[:3], derived_carrier.linear_part(True), binding)
    for target, value in zip(out[3:], omega_dot, strict=True):
        body.set(target, value)
    body.ret(Status("OK"))
    return Function(
        "solve_schur",
        "Solves [A B^T; B D] y = F, symmetric positive definite, by blocks of 3x3.",
        (schur, F, y),
        body.statements,
        returns=Kind.STATUS,
        statuses=("OK", "NOT_POSITIVE_DEFINITE"),
    )


def _coupled_arguments(lib: Library, at: bool) -> tuple[Argument, ...]:
    """stand, x, sines and cosines, tau, locked, run-time wrenches, V_dot, phi_ddot."""
    count = lib.layout.count
    return (
        lib.table_argument(),
        lib.state_argument(),
        *(lib.turn_arguments() if at else ()),
        Argument("tau", Kind.REAL, (count,), unit="N m", purpose="drive torques, mount on flywheel"),
        lib.locked_argument(),
        *lib.wrench_arguments(),
        Argument("V_dot", Kind.REAL, (6,), "out", "m/s2, rad/s2", "derivative of the components of V"),
        Argument("phi_ddot", Kind.REAL, (count,), "out", "rad/s2", "flywheel accelerations"),
    )


def move(lib: Library) -> Function:
    """V*, phi'' for given tau, from checked inputs."""
    layout = lib.layout
    arguments = _coupled_arguments(lib, at=True)
    turns = lib.turn_arguments()
    stand, x = arguments[:2]
    tau, locked, *wrench, V_dot, phi_ddot = arguments[2 + len(turns) :]
    body = Body()
    lib.begin(body)
    seen = scene(lib, body, stand.place, x.place, turns=places_of(arguments[2 : 2 + len(turns)]))
    drives = body.local("drive", (layout.count,), layout.coupling)
    alike = carried(lib, body, seen)
    body.call(lib["start_sums"], stand.place, seen.sums)
    with body.loop("s", layout.count) as s:
        turn = couple_flywheel(lib, body, stand.place, x.place, s, seen, alike, drives[s])
        speed = x.place.phi_dot[s]
        body.call(lib["add_flywheel"], stand.place.flywheel[s], turn["s"], turn["c"], speed, real(0), seen.sums)
    F = body.local("F", (6,), comment="wrench (7); then what K V* + I phi'' must equal")
    Z = body.local("Z", (6,), comment="momentum screw (2)")
    external_wrench(lib, body, stand.place, x.place, seen, tuple(wrench), F)
    body.call(lib["momentum_screw"], stand.place, seen.sums, seen.V, Z)
    body.call(lib["subtract_rates"], seen.sums, seen.V, Z, F)
    K = body.local("K", (), layout.schur, "mass matrix with free flywheels eliminated")
    start_schur(lib, body, stand.place, seen.sums, K)
    rate = body.local("rate", (layout.count,), comment="accelerations at V* = 0")
    with body.loop("s", layout.count) as s:
        body.set(rate[s], real(0))
        with body.when(equal(locked.place[s], integer(0))):
            demand = tau.place[s] - drives[s].bias
            if seen.own is not None:
                demand = demand + seen.own[s * integer(6) + 3]
            body.set(rate[s], demand * stand.place.flywheel[s].spin_inv)
            body.call(lib["eliminate"], drives[s].I, stand.place.flywheel[s].spin_inv, rate[s], K, F)
    lib.check(body, "solve_schur", K, F, V_dot.place)
    with body.loop("s", layout.count) as s:
        body.set(phi_ddot.place[s], real(0))
        with body.when(equal(locked.place[s], integer(0))):
            back = along(drives[s].I, V_dot.place) * stand.place.flywheel[s].spin_inv
            body.set(phi_ddot.place[s], rate[s] - back)
    from_stream(body, x.place, seen, V_dot.place)
    body.ret(Status("OK"))
    return Function(
        "move",
        "V* and phi'' for given drive torques, from checked inputs; results are written where the status is OK.",
        arguments,
        body.statements,
        returns=Kind.STATUS,
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE"),
    )


def check_drive(lib: Library, body: Body, arguments: tuple[Argument, ...]) -> None:
    """Checks of state, torques and run-time wrenches, of the arguments of `coupled` or `step`."""
    by_name = {a.name: a for a in arguments}
    wrench = tuple(a for a in arguments if a.name == "wrench")
    turns = tuple(a for a in arguments if a.name in ("sine", "cosine"))
    check_inputs(lib, body, by_name["stand"], by_name["x"], (), wrench, turns)
    lib.check(body, "within", by_name["tau"].place, lib.layout.count, lib.limits["MAX_WRENCH"].expression)


def coupled(lib: Library, at: bool = False) -> Function:
    """V*, phi'' for given tau; `at`: coupled_at, of given sines and cosines of the phases."""
    layout = lib.layout
    arguments = _coupled_arguments(lib, at)
    V_dot, phi_ddot = arguments[-2:]
    body = Body()
    check_drive(lib, body, arguments)
    motion = body.local("V_result", (6,))
    spins = body.local("phi_result", (layout.count,))
    stand, x, *inputs = places_of(arguments[:-2])
    if not at:
        inputs = [*turns_of(lib, body, x), *inputs]
    lib.check(body, "move", stand, x, *inputs, motion, spins)
    body.copy_array(V_dot.place, motion)
    with body.loop("s", layout.count) as s:
        body.set(phi_ddot.place[s], spins[s])
    body.ret(Status("OK"))
    return Function(
        "coupled_at" if at else "coupled",
        "Motion of the whole system under given drive torques: V* and phi'' together, flywheels eliminated first.",
        arguments,
        body.statements,
        returns=Kind.STATUS,
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE"),
        notes=AT_NOTES if at else (),
        public=True,
    )


def start_schur(lib: Library, body: Body, stand: Place, sums: Place, K: Place) -> None:
    """K of (2) by blocks."""
    if lib.layout.added_mass:
        body.copy_array(K.A, stand.A)
        binding = {"mu": sums.mu, "G": stand.G}
    else:
        for k in range(6):
            body.set(K.A[k], stand.mass if k < 3 else real(0))
        binding = {"mu": sums.mu}
    assign(body, list(K.B), derived_carrier.coupling_block(lib.layout.added_mass), binding)
    body.copy_array(K.D, sums.J)
