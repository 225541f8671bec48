"""The total external wrench F of (7) in E1 about O1, with those kinds only that the stand has."""

from __future__ import annotations

from typing import Any

from mahovik.contract.laws import of_bodies, part
from mahovik.core.formula.derived import wrench as derived
from mahovik.core.lower.flywheels import Turns, let_turn, named_turns, places_of, turn_of
from mahovik.core.lower.forward import Scene
from mahovik.core.lower.laws import add_force
from mahovik.core.lower.library import Library
from mahovik.core.lower.symbolic import assign
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Place, Status, integer, real
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def external(lib: Library) -> Function:
    """F of (7) from checked inputs."""
    layout = lib.layout
    table, x = lib.table_argument(), lib.state_argument()
    sums = Argument("sum", layout.sums, purpose="their mu gives the moment of the weight")
    C = Argument("C", Kind.REAL, (9,), purpose="attitude of the carrier")
    V = Argument("V", Kind.REAL, (6,), purpose="twist relative to the fluid")
    g = Argument("g", Kind.REAL, (3,), unit="m/s2", purpose="gravity in E1")
    F = Argument("F", Kind.REAL, (6,), "out", "N, N m", "in E1 about O1")
    own = own_argument(lib)
    given, wrench = lib.turn_arguments(), lib.wrench_arguments()
    turns = places_of(given)
    body = Body()
    laws = lib.layout.law_tables
    refuses, checked = any(law.refuses for law in laws), "check_actuators" in lib
    if checked:
        lib.check(body, "check_actuators", table.place)
    for element in F.place:
        body.set(element, real(0))
    if layout.weight:
        _weight(lib, body, table.place, x.place, turns, sums.place, g.place, F.place)
    if layout.carrier_damped:
        _damp(lib, body, table.place, table.place.damper, V.place, F.place)
    if layout.carrier_input:
        for i in range(6):
            body.add(F.place[i], wrench[0].place[i])
    if layout.own:
        own_wrenches(
            lib, body, table.place, x.place, turns, V.place, wrench[0].place if wrench else None, F.place, own.place
        )
    for law in laws:
        law.act(lib, body, table.place, x.place, C.place, F.place)
    if refuses or checked:
        body.ret(Status("OK"))
    return Function(
        "external",
        "Total external wrench of " + _kinds(lib) + ", from checked inputs.",
        (table, x, *given, sums, C, V, g, *wrench, F, own),
        body.statements,
        equation="(7)",
        returns=Kind.STATUS if refuses or checked else None,
        statuses=("OK", "NOT_FINITE", "RANGE") if checked else ("OK", "RANGE") if refuses else (),
    )


def _kinds(lib: Library) -> str:
    layout = lib.layout
    of_carrier = [law.words for law in layout.law_tables]
    names = [*layout.body_laws, *of_carrier, *(["run-time wrenches"] if layout.inputs else [])]
    return ", ".join(names) or "no kind at all"


def own_argument(lib: Library) -> Argument:
    """Own wrenches of the flywheels, where any has such: six numbers each in Es about Os."""
    purpose = "wrenches of the flywheels of their own, six numbers each, in Es about Os"
    return Argument("own", Kind.REAL, (6 * int(lib.layout.count),), "out", "N, N m", purpose)


def own_wrenches(
    lib: Library,
    body: Body,
    table: Place,
    x: Place,
    turns: Turns,
    V: Place,
    wrench: Place | None,
    F: Place,
    own: Place | None,
) -> None:
    """Adds the wrenches of all bodies that have some in their own frame to F; of the flywheels also to `own`."""
    if lib.layout.own_turning:
        assert own is not None
        with body.loop("i", 6 * int(lib.layout.count)) as i:
            body.set(own[i], real(0))
    with body.loop("k", len(lib.layout.own)) as k:
        everything = {"table": table, "frame": table.frame[k], "x": x, "V": V, "F": F, "own": own, "wrench": wrench}
        everything |= named_turns(turns)
        body.call(lib["own_wrench"], *lib.arguments_of("own_wrench", **everything))


def flywheel_wrenches(
    lib: Library, body: Body, table: Place, x: Place, seen: Scene, wrench: tuple[Argument, ...]
) -> None:
    """Set the flywheels' own wrenches in `seen`, where they have such; `wrench`: `flywheel_wrench_arguments`."""
    if seen.own is None:
        return
    scratch = body.local("scratch", (6,), comment="wrench on the carrier, not used here")
    for element in scratch:
        body.set(element, real(0))
    given = wrench[0].place if wrench else None
    if lib.layout.own_inputs and given is None:
        given = body.local("none", (6 * len(lib.layout.inputs),), comment="wrenches on bodies that are no flywheels")
        with body.loop("i", len(given)) as i:
            body.set(given[i], real(0))
    own_wrenches(lib, body, table, x, seen.turns, seen.V, given, scratch, seen.own)


def _weight(lib: Library, body: Body, table: Place, x: Place, turns: Turns, sums: Place, g: Place, F: Place) -> None:
    """Weight of every body at its mass centre, less the Archimedes force."""
    layout = lib.layout
    binding: dict[str, Any] = {"g": g, "mu": sums.mu, "m": table.mass}
    if layout.displaces:
        binding["weight_mass"] = table.weight_mass
        binding["displaced_moment"] = table.displaced_moment
    if layout.flywheel_displaces:
        moment = body.local("displaced", (3,), comment="first moment of displaced fluid at the phases")
        body.copy_array(moment, table.displaced_moment)
        with body.loop("s", layout.count) as s:
            row = table.flywheel[s]
            turn = turn_of(turns, s)
            for i in range(3):
                body.add(moment[i], row.displaced_c[i] * turn["c"] + row.displaced_s[i] * turn["s"])
        binding["displaced_moment"] = moment
    part("weight", "lower").add_weight(body, layout.displaces, binding, F)


def _damp(lib: Library, body: Body, table: Place, damper: Place, V: Place, P: Place) -> None:
    for name in of_bodies("lower", "BY_TWIST"):
        if name in lib:
            body.call(lib[name], *lib.arguments_of(name, table=table, damper=damper, V=V, P=P))


def own_wrench(lib: Library) -> Function:
    """Wrench of one instrument or flywheel that acts in its own frame, added to F."""
    layout = lib.layout
    table, x = lib.table_argument(), lib.state_argument()
    frame = Argument("frame", layout.frame)
    V = Argument("V", Kind.REAL, (6,), purpose="twist of the carrier relative to the fluid")
    F = Argument("F", Kind.REAL, (6,), "inout", "N, N m", "in E1 about O1; this wrench is added to it")
    own = own_argument(lib)
    given, wrench = lib.turn_arguments(), lib.wrench_arguments()
    body = Body()
    origin = frame.place.origin
    axes = body.local("axes", (9,), comment="axes of the body in E1")
    P = body.local("P", (6,), comment="in the body's own frame")
    body.copy_array(axes, frame.place.axes)
    for element in P:
        body.set(element, real(0))
    if layout.own_turning:
        with body.when(frame.place.flywheel >= 0):
            turn = let_turn(body, places_of(given), frame.place.flywheel, "")
            assign(body, list(axes), derived.turned_axes(), turn | {"R": frame.place.axes})
    if layout.own_damped:
        _own_damping(lib, body, table.place, frame.place, x.place, V.place, axes, P)
    if layout.own_inputs:
        with body.when(frame.place.wrench >= 0), body.loop("i", 6) as i:
            body.add(P[i], wrench[0].place[frame.place.wrench * integer(6) + i])
    if layout.own_turning:
        with body.when(frame.place.flywheel >= 0), body.loop("i", 6) as i:
            body.set(own.place[frame.place.flywheel * integer(6) + i], P[i])
    force = body.local("force", (3,), comment="in E1")
    moment = body.local("moment", (3,), comment="in E1, about the body's origin")
    _turn(body, axes, list(P)[:3], force)
    _turn(body, axes, list(P)[3:], moment)
    add_force(body, list(F.place), origin, list(force), list(moment))
    return Function(
        "own_wrench",
        "Adds the wrench that acts on one instrument or flywheel in its own frame.",
        (table, frame, x, *given, V, *wrench, F, own),
        body.statements,
        equation="(7)",
    )


def _turn(body: Body, C: Place, a: list[Place], out: Place) -> None:
    assign(body, list(out), derived.rotated(), {"C": C, "a": a})


def _own_damping(
    lib: Library, body: Body, table: Place, frame: Place, x: Place, V: Place, axes: Place, P: Place
) -> None:
    """Twist of the body relative to the fluid in its own frame, L^T V_r + f phi', and its damping."""
    six = list(V)
    velocity = body.local("velocity", (3,), comment="of the body's origin, in E1")
    twist = body.local("twist", (6,), comment="of the body, in its own frame")
    assign(body, list(velocity), derived.twist_at(), {"v": six[:3], "omega": six[3:], "O": frame.origin})
    back = derived.rotated_back()
    assign(body, list(twist)[:3], back, {"C": axes, "a": velocity})
    assign(body, list(twist)[3:], back, {"C": axes, "a": six[3:]})
    if lib.layout.own_turning:
        with body.when(frame.flywheel >= 0):
            body.add(twist[3], x.phi_dot[frame.flywheel], "L^T V + f phi'")
    _damp(lib, body, table, frame.damper, twist, P)
