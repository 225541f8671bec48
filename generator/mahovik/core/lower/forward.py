"""forward (8), as public function; what it shares with others: attitude, stream, sums."""

from __future__ import annotations

from dataclasses import dataclass, replace

from mahovik.core.formula.derived import wrench as derived
from mahovik.core.lower import flywheels, hold
from mahovik.core.lower.flywheels import Turns, named_turns, places_of, turns_of
from mahovik.core.lower.library import Library
from mahovik.core.lower.symbolic import assign
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Given, Not, Operand, Place, real
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind

STATE_STATUSES = ("OK", "NOT_FINITE", "RANGE")


@dataclass(frozen=True)
class Scene:
    """Inputs of the equations; None for those that the stand does not need.

    C attitude; V relative to the stream; stream and g (gravity) in E1; sums over all bodies; own: wrenches of the
    flywheels of their own, six numbers each; turns: sines and cosines of the phases.
    """

    C: Place | None
    V: Place
    stream: Place | None
    g: Place | None
    sums: Place
    own: Place | None
    turns: Turns


def check_inputs(
    lib: Library,
    body: Body,
    table: Argument,
    x: Argument,
    phi_ddot: tuple[Argument, ...] = (),
    wrench: tuple[Argument, ...] = (),
    turns: tuple[Argument, ...] = (),
    tau: tuple[Argument, ...] = (),
) -> None:
    """Checks of state, sines, stream, accelerations, run-time wrenches, torques: before anything is computed.

    Accelerations or torques are looked at together with the state, where nothing has its turn between them.
    """
    limit = {name: found.expression for name, found in lib.limits.items()}
    rest: list[tuple[Place, Operand, Expr]] = [(a.place, lib.layout.count, limit["MAX_ACCELERATION"]) for a in phi_ddot]
    rest += [(a.place, len(a.place), limit["MAX_WRENCH"]) for a in wrench]
    rest += [(a.place, lib.layout.count, limit["MAX_WRENCH"]) for a in tau]
    if rest and rest[0][1] is lib.layout.count and "check_motion" in lib and not lib.layout.stream:
        given, _, bound = rest.pop(0)
        lib.check(body, "check_motion", x.place, given, bound)
    else:
        lib.check(body, "check_state", x.place)
    if turns:
        sine, cosine = (a.place for a in turns)
        with body.when(Given(sine)):
            lib.guard(body, Not(Given(cosine)), "BAD_ARGUMENT")
            lib.check(body, "check_turns", sine, cosine)
        with body.otherwise():
            lib.guard(body, Given(cosine), "BAD_ARGUMENT")
    if lib.layout.stream:
        lib.check(body, "within", table.place.stream, 3, limit["MAX_VELOCITY"])
    if lib.layout.structure.stream_stations:
        lib.check(body, "check_depth", table.place, x.place)
    for values, count, most in rest:
        lib.check(body, "within", values, count, most)


def scene(lib: Library, body: Body, table: Place, x: Place, attitude: bool = False, turns: Turns = ()) -> Scene:
    """Attitude, twist relative to the stream, gravity, and places for sums.

    `attitude`: C even where (8) needs none. `turns`: sines and cosines that are known already.
    """
    layout = lib.layout
    C = stream = g = own = None
    V = x.V
    by_quaternion = layout.held and layout.weight and not (attitude or layout.stream or "C" in lib.taken("external"))
    if (layout.attitude_needed or attitude) and not by_quaternion:
        C = body.local("C", (9,), comment="attitude")
        body.call(lib["rotation"], x.attitude, C)
    if layout.stream:
        assert C is not None
        stream = body.local("u", (3,), comment="stream in E1")
        flow = table.stream
        if layout.structure.stream_stations:
            flow = body.local("flow", (3,), comment="stream in E0, at this depth")
            body.call(lib["stream_at"], table, x, flow)
        body.call(lib["rotate_back"], C, flow, stream)
        V = body.local("V", (6,), comment="V relative to the stream: the fluid's frame is inertial as well")
        for i in range(6):
            body.set(V[i], x.V[i] - stream[i] if i < 3 else x.V[i])
    if layout.weight:
        g = body.local("g", (3,), comment="gravity in E1")
        if C is None:
            body.call(lib["turn_back"], x.attitude, table.gravity, g)
        else:
            body.call(lib["rotate_back"], C, table.gravity, g)
    if layout.own_turning:
        own = body.local("own", (6 * int(layout.count),), comment="own wrenches of the flywheels, six numbers each")
    sums = body.local("sum", (), layout.sums)
    return Scene(C, V, stream, g, sums, own, turns or turns_of(lib, body, x))


def sum_up(
    lib: Library, body: Body, table: Place, x: Place, seen: Scene, phi_ddot: Place | None, mass_alone: bool = False
) -> None:
    """Sums over all bodies into seen.sums; without phi_ddot those of constant speeds. `mass_alone`: for K and K_dot."""
    flywheels.sum_up.put_into(body, lib, table, x, seen.turns, seen.sums, phi_ddot, mass_alone)


def external_wrench(
    lib: Library, body: Body, table: Place, x: Place, seen: Scene, wrench: tuple[Argument, ...], F: Place
) -> None:
    """F of (7), or zero where the stand has none."""
    if not lib.layout.wrenches:
        for element in F:
            body.set(element, real(0))
        return
    named = {"table": table, "x": x, "sum": seen.sums, "C": seen.C, "V": seen.V, "g": seen.g, "F": F}
    named |= {"own": seen.own, **named_turns(seen.turns)}
    passed = lib.arguments_of("external", **named, **{w.name: w.place for w in wrench})
    if lib["external"].returns is None:
        body.call(lib["external"], *passed)
    else:
        lib.check(body, "external", *passed)


def drift_of(body: Body, x: Place, stream: Place) -> Place:
    """omega x C^T u: V_r* = V* + (omega x C^T u, 0)."""
    drift = body.local("drift", (3,), comment="omega x C^T u")
    assign(body, list(drift), derived.turning_velocity(), {"omega": list(x.V)[3:], "O": stream})
    return drift


def relative_rate(body: Body, x: Place, V_dot: Place, stream: Place | None) -> Place:
    """V_r* = V* + (omega x C^T u, 0); V* itself where there is no stream."""
    if stream is None:
        return V_dot
    drift = drift_of(body, x, stream)
    moving = body.local("V_r_dot", (6,), comment="V_r* = V* + (omega x C^T u, 0)")
    for i in range(6):
        body.set(moving[i], V_dot[i] + drift[i] if i < 3 else V_dot[i])
    return moving


def all_turns(lib: Library, body: Body, x: Place, given: tuple[Argument, ...]) -> Turns:
    """Sines and cosines as internal functions take them: those of arguments that a caller gives, or of the phases."""
    if not given:
        return turns_of(lib, body, x)
    turns = tuple(body.local(f"{a.name}s", a.shape) for a in given)
    note = "the phases of x are checked, but not used"
    with body.when(Given(given[0].place), comment=note), body.loop("s", lib.layout.count) as s:
        for to, a in zip(turns, given, strict=True):
            body.set(to[s], a.place[s])
    with body.otherwise():
        body.call(lib["sincos_each"], x.phi, *turns)
    return turns


def accelerate(lib: Library) -> Function:
    """V* for given phi'' by (8), from checked inputs."""
    table, x = lib.table_argument(), lib.state_argument()
    turns, phi_ddot, wrench = lib.turn_arguments(), lib.phi_ddot_arguments(), lib.wrench_arguments()
    V_dot = Argument("V_dot", Kind.REAL, (6,), "out", "m/s2, rad/s2", "derivative of the components of V")
    held = hold.results(lib)
    body = Body()
    seen = scene(lib, body, table.place, x.place, turns=places_of(turns))
    accelerations = phi_ddot[0].place if phi_ddot else None
    if lib.layout.held:
        for rates in places_of(held):
            equations_along(lib, body, table.place, x.place, seen, wrench, accelerations, rates)[0].solve()
    else:
        sum_up(lib, body, table.place, x.place, seen, accelerations)
        F = body.local("F", (6,), comment="wrench (7); then the right-hand side of (8)")
        K = body.local("K", (), lib.layout.carrier_factor) if lib.layout.added_mass else None
        external_wrench(lib, body, table.place, x.place, seen, wrench, F)
        body.call(lib["subtract_rates"], table.place, seen.sums, seen.V, F)
        if K is None:  # the factors are few enough to stay in registers, in one function
            lib.check(body, "solve_carrier_once", table.place, seen.sums, F, V_dot.place)
        else:
            lib.check(body, "factor_carrier", table.place, seen.sums, K)
            body.call(lib["solve_carrier"], table.place, K, F, V_dot.place)
        from_stream(body, x.place, seen, V_dot.place)
    found = body.checked_function(
        "accelerate",
        "K V* = F - M V - sum(I phi'' + J phi') from checked inputs; V_dot is written where the status is OK."
        if not lib.layout.held
        else "u* of S^T K S u* = S^T (F - M V - sum(I phi'' + J phi')) from checked inputs; valid if the status is OK.",
        (table, x, *turns, *phi_ddot, *wrench, *(held if lib.layout.held else (V_dot,))),
        equation="(8)",
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE"),
    )
    return replace(found, short=lib.layout.held)  # few freedoms leave little of it


def equations_along(
    lib: Library,
    body: Body,
    table: Place,
    x: Place,
    seen: Scene,
    wrench: tuple[Argument, ...],
    phi_ddot: Place | None,
    y: Place | None = None,
) -> tuple[hold.Freedoms, Place | None]:
    """(8) along the freedoms, P u* = y, without phi_ddot for phi'' = 0; and omega x C^T u of a stream.

    `y`: a place for the right-hand side, then for u*.
    """
    F = body.local("F", (6,), comment="wrench (7)" if lib.layout.along else "wrench (7); then what is to be projected")
    if lib.layout.along:
        sums = hold.sum_up_along.put_into(body, lib, table, x, seen.turns, phi_ddot, seen.sums)
        external_wrench(lib, body, table, x, seen, wrench, F)
        freedoms = hold.Freedoms(lib, body, table, sums.P, y)
        named = {"table": table, "sum": sums, "V": x.V, "F": F, "y": freedoms.y}
        body.call(lib["right_side"], *lib.arguments_of("right_side", **named))
        return freedoms, None
    sum_up(lib, body, table, x, seen, phi_ddot)
    external_wrench(lib, body, table, x, seen, wrench, F)
    freedoms = hold.Freedoms(lib, body, table, y=y)
    if not freedoms.count:
        return freedoms, None if seen.stream is None else drift_of(body, x, seen.stream)
    body.call(lib["subtract_rates"], table, seen.sums, seen.V, F)
    drift = without_drift(lib, body, table, x, seen, F)
    body.call(lib["project_mass"], *lib.arguments_of("project_mass", table=table, sum=seen.sums, P=freedoms.P))
    body.call(lib["project_wrench"], *lib.arguments_of("project_wrench", table=table, F=F, y=freedoms.y))
    return freedoms, drift


def from_stream(body: Body, x: Place, seen: Scene, V_dot: Place) -> None:
    """V* = V_r* - (omega x C^T u, 0), where there is a stream."""
    if seen.stream is None:
        return
    body.note("V* = V_r* - (omega x C^T u, 0)")
    drift = drift_of(body, x, seen.stream)
    for i in range(3):
        body.set(V_dot[i], V_dot[i] - drift[i])


def without_drift(lib: Library, body: Body, table: Place, x: Place, seen: Scene, F: Place) -> Place | None:
    """Takes K (omega x C^T u, 0) from F, where there is a stream, so that F belongs to V*; returns omega x C^T u."""
    if seen.stream is None:
        return None
    drift = drift_of(body, x, seen.stream)
    body.call(lib["subtract_drift"], table, seen.sums, drift, F)
    return drift


def forward(lib: Library) -> Function:
    """V* for given phi'' by (8)."""
    table, x, turns = lib.table_argument(), lib.state_argument(), lib.given_turns()
    phi_ddot, wrench = lib.phi_ddot_arguments(), lib.wrench_arguments()
    purpose = "derivative of the components of V; may overlap any input"
    V_dot = Argument("V_dot", Kind.REAL, (6,), "out", "m/s2, rad/s2", purpose, overlaps=True)
    body = Body()
    check_inputs(lib, body, table, x, phi_ddot, wrench, turns)
    held = hold.results(lib)
    layout = lib.layout
    at_once = layout.held or not (layout.stream or layout.added_mass)  # V_dot is written last, after all is read
    result = V_dot.place if at_once else body.local("result", (6,))
    others = [body.local(f"{a.name}_result", a.shape) for a in held]
    named = {"table": table.place, "x": x.place, "V_dot": result} | named_turns(all_turns(lib, body, x.place, turns))
    named |= {a.name: a.place for a in (*phi_ddot, *wrench)}
    named |= {a.name: found for a, found in zip(held, others, strict=True)}
    lib.check(body, "accelerate", *lib.arguments_of("accelerate", **named))
    if lib.layout.held:  # all inputs have been read
        hold.write_twist.put_into(body, lib, table.place, others, result)
    if not at_once:
        body.copy_array(V_dot.place, result)
    for argument, found in zip(held, others, strict=True):
        body.copy_array(argument.place, found)
    return body.checked_function(
        "forward",
        "Acceleration of the carrier for given accelerations of the flywheels: "
        + ("along the freedoms of the hold, S^T: K V* = F" if lib.layout.held else "K V* = F")
        + " - M V - sum(I phi'' + J phi').",
        (table, x, *turns, *phi_ddot, *wrench, V_dot, *held),
        equation="(8)",
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE"),
        public=True,
    )
