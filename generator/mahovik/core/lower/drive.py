"""torque: what the drives must give for a motion; coupled: the motion that given drive torques make."""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.core.lower import hold
from mahovik.core.lower.flywheels import (
    Carried,
    along,
    common_terms,
    couple_flywheel,
    named_turns,
    places_of,
)
from mahovik.core.lower.forward import (
    STATE_STATUSES,
    Scene,
    all_turns,
    check_inputs,
    equations_along,
    external_wrench,
    from_stream,
    relative_rate,
    scene,
    sum_up,
)
from mahovik.core.lower.held_drive import solve_held
from mahovik.core.lower.library import Library
from mahovik.core.lower.solve import start_blocks
from mahovik.core.lower.wrenches import flywheel_wrenches
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Place, equal, integer, real
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind

Pair = tuple[Place, Place]


def torque(lib: Library) -> Function:
    """tau for given V*, phi''."""
    layout = lib.layout
    arguments = _torque_arguments(lib, lib.given_turns())
    table, x, *turns, V_dot, phi_ddot = [a for a in arguments if a.name not in ("wrench", "tau")]
    wrench = tuple(a for a in arguments if a.name == "wrench")
    body = Body()
    check_inputs(lib, body, table, x, (phi_ddot,), wrench, tuple(turns))
    lib.check(body, "within", V_dot.place, 6, lib.limits["MAX_ACCELERATION"].expression)
    if layout.sine_input:
        sine, cosine = all_turns(lib, body, x.place, tuple(turns))
        given = {a.name: a.place for a in arguments} | {"sine": sine, "cosine": cosine}
        body.call(lib["balance"], *lib.arguments_of("balance", **given))
    else:
        _balance(lib, body, arguments)
    return body.checked_function(
        "torque",
        "Drive torques for a given motion: tau = f^T (Theta V_s* + Phi(V_s) Z_s - P_s).",
        arguments,
        statuses=STATE_STATUSES,
        public=True,
    )


def balance(lib: Library) -> Function:
    """tau, from checked inputs."""
    arguments = _torque_arguments(lib, lib.turn_arguments())
    body = Body()
    _balance(lib, body, arguments)
    return body.function("balance", "Drive torques for a given motion, from checked inputs.", arguments)


def _torque_arguments(lib: Library, turns: tuple[Argument, ...]) -> tuple[Argument, ...]:
    """table, x, sines and cosines, V_dot, phi_ddot, run-time wrenches, tau."""
    purpose = "drive torques, mount on flywheel, about the spin axis"
    return (
        lib.table_argument(),
        lib.state_argument(),
        *turns,
        Argument("V_dot", Kind.REAL, (6,), unit="m/s2, rad/s2", purpose="derivative of the components of V"),
        *lib.phi_ddot_arguments(),
        *lib.flywheel_wrench_arguments(),
        Argument("tau", Kind.REAL, (lib.layout.count,), "out", "N m", purpose),
    )


def _balance(lib: Library, body: Body, arguments: tuple[Argument, ...]) -> None:
    """tau of checked arguments."""
    layout = lib.layout
    place = {a.name: a.place for a in arguments}
    table, x = place["table"], place["x"]
    wrench = tuple(a for a in arguments if a.name == "wrench")
    seen = scene(lib, body, table, x, turns=tuple(place[n] for n in ("sine", "cosine") if n in place))
    moving = relative_rate(body, x, place["V_dot"], seen.stream)
    flywheel_wrenches(lib, body, table, x, seen, wrench)
    alike = common_terms.put_into(body, lib, seen.V, seen.g)
    coupling = body.local("drive", (), layout.coupling)
    with body.loop("s", layout.count) as s:
        couple_flywheel.put_into(body, lib, table, s, seen, alike, coupling)
        spin = table.flywheel[s].spin * place["phi_ddot"][s]
        total = along(list(coupling.I), moving) + spin + coupling.bias
        body.set(place["tau"][s], total if seen.own is None else total - seen.own[s * integer(6) + 3])


def _coupled_arguments(lib: Library, turns: tuple[Argument, ...]) -> tuple[Argument, ...]:
    """table, x, sines and cosines, tau, locked, run-time wrenches, V_dot, phi_ddot."""
    count = lib.layout.count
    return (
        lib.table_argument(),
        lib.state_argument(),
        *turns,
        Argument("tau", Kind.REAL, (count,), unit="N m", purpose="drive torques, mount on flywheel"),
        lib.locked_argument(),
        *lib.wrench_arguments(),
        Argument("V_dot", Kind.REAL, (6,), "out", "m/s2, rad/s2", "derivative of the components of V"),
        Argument("phi_ddot", Kind.REAL, (count,), "out", "rad/s2", "flywheel accelerations"),
        *hold.results(lib),
    )


def solve_coupled(lib: Library) -> Function:
    """V*, phi'' for given tau, from checked inputs."""
    layout = lib.layout
    turns = lib.turn_arguments()
    arguments = _coupled_arguments(lib, turns)
    table, x = arguments[:2]
    held = len(hold.results(lib))
    given, results = arguments[2 + len(turns) : -2 - held], places_of(arguments[-2 - held :])
    tau, locked, *wrench = given
    body = Body()
    seen = scene(lib, body, table.place, x.place, turns=places_of(turns_in(arguments)))
    if layout.held:
        freedoms, drift = equations_along(lib, body, table.place, x.place, seen, tuple(wrench), None)
        solve_held(lib, body, table.place, seen, (tau.place, locked.place), freedoms, drift, results)
    else:
        system = without_drives(lib, body, table.place, x.place, seen, tuple(wrench))
        solve_free(lib, body, table.place, seen, (tau.place, locked.place), system, (results[0], results[1]))
        from_stream(body, x.place, seen, results[0])
    return body.checked_function(
        "solve_coupled",
        "V* and phi'' for given drive torques, from checked inputs; results are written where the status is OK.",
        arguments,
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE"),
    )


def without_drives(lib: Library, body: Body, table: Place, x: Place, seen: Scene, wrench: tuple[Argument, ...]) -> Pair:
    """K and F of K V* + I phi'' = F, before the flywheels are eliminated; their sums are in `seen`."""
    sum_up(lib, body, table, x, seen, None)
    F = body.local("F", (6,), comment="wrench (7); then the right-hand side of K V* + I phi'' = F")
    external_wrench(lib, body, table, x, seen, wrench, F)
    body.call(lib["subtract_rates"], table, seen.sums, seen.V, F)
    K = body.local("K", (), lib.layout.schur, "mass matrix with free flywheels eliminated")
    start_blocks.put_into(body, lib, table, seen.sums, K)
    return K, F


def turns_in(arguments: tuple[Argument, ...]) -> tuple[Argument, ...]:
    """Sines and cosines among the arguments."""
    return tuple(a for a in arguments if a.name in ("sine", "cosine"))


@dataclass(frozen=True)
class Solved:
    """What solving leaves: columns of I and bias torques of the drives (N), common terms, and the factors of K."""

    drives: Place
    alike: Carried
    factor: Place


def solve_free(lib: Library, body: Body, table: Place, seen: Scene, given: Pair, system: Pair, results: Pair) -> Solved:
    """V*, phi'' of K, F without drives, for given tau and locks, flywheel by flywheel."""
    layout = lib.layout
    (tau, locked), (K, F), (V_dot, phi_ddot) = given, system, results
    drives = body.local("drive", (layout.count,), layout.coupling)
    alike = common_terms.put_into(body, lib, seen.V, seen.g)
    rate = body.local("rate", (layout.count,), comment="accelerations at V* = 0")
    with body.loop("s", layout.count) as s:
        with body.when(equal(locked[s], integer(0))):
            couple_flywheel.put_into(body, lib, table, s, seen, alike, drives[s])
            demand = tau[s] - drives[s].bias
            if seen.own is not None:
                demand = demand + seen.own[s * integer(6) + 3]
            body.set(rate[s], demand * table.flywheel[s].spin_inv)
            body.call(lib["eliminate"], drives[s].I, table.flywheel[s].spin_inv, rate[s], K, F)
        with body.otherwise():
            for element in drives[s].I:
                body.set(element, real(0))
            body.set(rate[s], real(0))
    factor = body.local("factor", (), layout.schur_factor)
    lib.check(body, "factor_schur", K, factor)
    body.call(lib["solve_schur"], factor, F, V_dot)
    with body.loop("s", layout.count) as s:
        body.set(phi_ddot[s], real(0))
        with body.when(equal(locked[s], integer(0))):
            back = along(list(drives[s].I), V_dot) * table.flywheel[s].spin_inv
            body.set(phi_ddot[s], rate[s] - back)
    return Solved(drives, alike, factor)


def check_drive(lib: Library, body: Body, arguments: tuple[Argument, ...]) -> None:
    """Checks of state, torques and run-time wrenches, of the arguments of `coupled` or `step`."""
    by_name = {a.name: a for a in arguments}
    wrench = tuple(a for a in arguments if a.name == "wrench")
    check_inputs(lib, body, by_name["table"], by_name["x"], (), wrench, turns_in(arguments), (by_name["tau"],))


def coupled(lib: Library) -> Function:
    """V*, phi'' for given tau."""
    layout = lib.layout
    arguments = _coupled_arguments(lib, lib.given_turns())
    held = len(hold.results(lib))
    V_dot, phi_ddot, *others = arguments[-2 - held :]
    body = Body()
    check_drive(lib, body, arguments)
    motion = body.local("V_result", (6,))
    spins = body.local("phi_result", (layout.count,))
    x = arguments[1].place
    named = {a.name: a.place for a in arguments} | named_turns(all_turns(lib, body, x, turns_in(arguments)))
    named |= {"V_dot": motion, "phi_ddot": spins}
    found = [body.local(f"{a.name}_result", a.shape) for a in others]
    named |= {a.name: value for a, value in zip(others, found, strict=True)}
    lib.check(body, "solve_coupled", *lib.arguments_of("solve_coupled", **named))
    body.copy_array(V_dot.place, motion)
    for argument, value in zip(others, found, strict=True):
        body.copy_array(argument.place, value)
    with body.loop("s", layout.count) as s:
        body.set(phi_ddot.place[s], spins[s])
    return body.checked_function(
        "coupled",
        "Motion of the whole system under given drive torques: V* and phi'' together, flywheels eliminated first"
        + (", along the freedoms of the hold." if held else "."),
        arguments,
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE"),
        public=True,
    )
