"""Terms of the flywheels at their phases: the one loop over rows that all functions share."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from mahovik.core.formula.derived import accumulate as derived
from mahovik.core.formula.tree import omitting
from mahovik.core.lower import lanes
from mahovik.core.lower.library import Library
from mahovik.core.lower.symbolic import add_each, assign, translate
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Place, real
from mahovik.core.program.function import Function
from mahovik.core.program.types import FLOAT, Kind

_COMMENTS = {
    "c2": "cos 2 phi, then sin 2 phi",
    "s2": "",
    "dc": "time derivatives: d(cos phi)/dt, ...",
    "ds": "",
    "dc2": "",
    "ds2": "",
    "ddc": "second time derivatives",
    "dds": "",
}


def let_weights(body: Body, given: dict[str, Expr], names: Sequence[str]) -> dict[str, Expr]:
    """Named temporaries c2 ... dds from c, s, phi_dot, phi_ddot in `given`; returns `given` and them.

    Without phi_ddot in `given` it is 0.
    """
    expressions = derived.weights()
    bound = dict(given)
    for name in names:
        value = expressions[name] if "phi_ddot" in given else omitting(expressions[name], "phi_ddot")
        bound[name] = body.let(name, translate(value, bound), _COMMENTS[name])
    return bound


def sine_and_cosine(lib: Library, body: Body, phase: Expr, suffix: str = "") -> dict[str, Expr]:
    """Local s, c (with a suffix) of a phase."""
    s = body.local(f"s{suffix}")
    c = body.local(f"c{suffix}")
    body.call(lib["sincos"], phase, s, c)
    return {"s": s, "c": c}


Turns = tuple[Place, ...]
"""Sines and cosines of all phases, two arrays; empty where there are no flywheels."""


def places_of(arguments: Sequence[Argument]) -> Turns:
    """The places of arguments."""
    return tuple(a.place for a in arguments)


def turns_of(lib: Library, body: Body, x: Place) -> Turns:
    """Sines and cosines of the phases of a state as locals: all of them first, as none waits for another."""
    if not lib.layout.flywheels:
        return ()
    sine = body.local("sine", (lib.layout.room,))
    cosine = body.local("cosine", (lib.layout.room,))
    body.call(lib["sincos_each"], x.phi, sine, cosine)
    return sine, cosine


def turn_of(turns: Turns, s: Expr) -> dict[str, Expr]:
    """s, c of flywheel s."""
    sine, cosine = turns
    return {"s": sine[s], "c": cosine[s]}


def let_turn(body: Body, turns: Turns, s: Expr, suffix: str = "_phi") -> dict[str, Expr]:
    """s, c of flywheel s as named temporaries (with a suffix)."""
    return {name: body.let(f"{name}{suffix}", place) for name, place in turn_of(turns, s).items()}


def named_turns(turns: Turns) -> dict[str, Place]:
    """Sines and cosines by the names of the arguments that take them."""
    return dict(zip(("sine", "cosine"), turns, strict=True)) if turns else {}


AT_NOTES = ("Takes sines and cosines of the phases and uses them as given; the phases of x are checked, but not used.",)
"""Notes of the functions that take sines and cosines."""


COLUMNS = ("mu_c", "mu_s", "J_c", "J_s", "J_2c", "J_2s", "t_0", "t_c", "t_s")
"""The columns of a row, which the derivation uses by these names."""


def columns_of(row: Place) -> dict[str, Place]:
    """The columns of a row by name."""
    return {name: row.member(name) for name in COLUMNS}


def start_sums(lib: Library) -> Function:
    """The sums without flywheels' harmonics: constants of the table."""
    table = lib.table_argument()
    sums = Argument("sum", lib.layout.sums, (), "out")
    body = Body()
    _start(body, table.place, sums.place, ("mu", "J", "mu_dot", "J_dot", "h_rel", "g_rel", "a_rel"))
    return body.function(
        "start_sums",
        "Sums of carrier, instruments and the constant part of the flywheels.",
        (table, sums),
        equation="(2)",
    )


_NOTES = {
    "mu": "first moment",
    "mu_dot": "rate of the first moment: force part of I phi'",
    "J": "inertia",
    "J_dot": "its rate: K_dot of (6)",
    "h_rel": "its moment part",
    "a_rel": "I phi'' + Ls [<e>] Theta f phi'^2, the last two sums of (5)",
}

_MASS = ("J", "J_dot", "mu")
"""Sums of one loop. A compiler can keep their number in registers, of doubles or of vectors, not that of all."""
_MOMENT_RATE = ("mu_dot",)
"""Which K's rate needs besides."""
_SPIN = (*_MOMENT_RATE, "h_rel", "g_rel", "a_rel")
"""The other sums, of the flywheels alone."""
_STEADY_SPIN = (*_MOMENT_RATE, "a_rel", "h_rel", "g_rel")
"""The sums of the flywheels alone at constant speeds, in the order in which compilers need the fewest instructions."""
_ALL = ("mu", "mu_dot", "J", "J_dot", "h_rel", "a_rel", "g_rel")
_USED = {
    _MASS: ("c2", "s2", "dc", "ds", "dc2", "ds2"),
    _MOMENT_RATE: ("dc", "ds"),
    _SPIN: ("dc", "ds", "ddc", "dds"),
    _STEADY_SPIN: ("dc", "ds", "ddc", "dds"),
}
"""Weights of each."""


def _add_row(
    body: Body,
    given: dict[str, Expr],
    columns: Mapping[str, Any],
    sums: Mapping[str, list[Place]],
    names: tuple[str, ...],
    weights: tuple[str, ...],
    short: Place | None = None,
) -> None:
    """sums of these names += what a row of these columns gives for s, c, phi_dot, phi_ddot, by the weights.

    `short`: the sums, for J in a loop. Products with a phi_ddot of 0 are left out, which leaves the sums as they are:
    those that it enters begin with +0, and a zero of any sign added to them changes nothing.
    """
    binding: dict[str, Any] = {**let_weights(body, given, weights), **columns}
    parts = derived.sums()
    for name in names:
        if name in _NOTES and not (short is not None and name == "J_dot"):
            body.note(_NOTES[name])
        if short is not None and name in ("J", "J_dot"):
            if name == "J":
                add_each(body, {short.J: parts.J, short.J_dot: parts.J_dot}, binding)
            continue
        values = getattr(parts, name)
        if "phi_ddot" not in given:
            values = [omitting(value, "phi_ddot") for value in values]
        assign(body, sums[name], values, binding, add=True)


def _start(body: Body, table: Place, sums: Place, names: tuple[str, ...]) -> None:
    """Sums of carrier, instruments and the constant part of the flywheels."""
    constant = {"mu": table.first_moment, "J": table.inertia}
    for name in names:
        if name in constant:
            body.copy_array(sums.member(name), constant[name])
        else:
            for element in sums.member(name):
                body.set(element, real(0))


def _sums_of(lib: Library, sums: Place) -> dict[str, list[Place]]:
    """The elements of each sum."""
    return {f.name: list(sums.member(f.name)) for f in lib.layout.sums.fields}


def sum_mass(lib: Library) -> Function:
    """Inertia of all bodies, its rate, and their first moment: row by row, in a loop of its own."""
    table, turns = lib.table_argument(), lib.turn_arguments()
    phi_dot = Argument("phi_dot", Kind.REAL, (lib.layout.count,), unit="rad/s")
    sums = Argument("sum", lib.layout.sums, (), "inout")
    body = Body()
    _start(body, table.place, sums.place, _MASS)
    # In float J goes in a loop: a third of the code, which small processors lack; desktop ones are slower with it.
    short = sums.place if lib.layout.precision is FLOAT else None
    with body.loop("k", lib.layout.count) as k:
        given: dict[str, Expr] = dict(let_turn(body, places_of(turns), k, ""))
        given["phi_dot"] = body.let("w", phi_dot.place[k])
        row = columns_of(table.place.flywheel[k])
        _add_row(body, given, row, _sums_of(lib, sums.place), _MASS, _USED[_MASS], short)
    return body.function(
        "sum_mass",
        "Inertia of all bodies and its rate in E1, and their first moment; w = phi'.",
        (table, *turns, phi_dot, sums),
        equation="(2), (6)",
    )


def sum_moment_rate(lib: Library) -> Function:
    """Rate of the first moment alone, for what needs K and its rate and no more."""
    table, turns = lib.table_argument(), lib.turn_arguments()
    phi_dot = Argument("phi_dot", Kind.REAL, (lib.layout.count,), unit="rad/s")
    sums = Argument("sum", lib.layout.sums, (), "inout")
    body = Body()
    _start(body, table.place, sums.place, _MOMENT_RATE)
    with body.loop("k", lib.layout.count) as k:
        given: dict[str, Expr] = dict(let_turn(body, places_of(turns), k, ""))
        given["phi_dot"] = body.let("w", phi_dot.place[k])
        row = columns_of(table.place.flywheel[k])
        _add_row(body, given, row, _sums_of(lib, sums.place), _MOMENT_RATE, _USED[_MOMENT_RATE])
    return body.function(
        "sum_moment_rate",
        "Rate of the first moment of all bodies in E1; w = phi'.",
        (table, *turns, phi_dot, sums),
        equation="(6)",
    )


def sum_spin(lib: Library, steady: bool = False) -> Function:
    """Terms of the flywheels' turning; `steady`: sum_steady_spin, at constant speeds."""
    table, turns = lib.table_argument(), lib.turn_arguments()
    phi_dot = Argument("phi_dot", Kind.REAL, (lib.layout.count,), unit="rad/s")
    phi_ddot = () if steady else (Argument("phi_ddot", Kind.REAL, (lib.layout.count,), unit="rad/s2"),)
    sums = Argument("sum", lib.layout.sums, (), "inout")
    body = Body()
    _start(body, table.place, sums.place, _SPIN)
    with body.loop("k", lib.layout.count) as k:
        given: dict[str, Expr] = dict(let_turn(body, places_of(turns), k, ""))
        given["phi_dot"] = body.let("w", phi_dot.place[k])
        for acceleration in phi_ddot:
            given["phi_ddot"] = body.let("a", acceleration.place[k])
        row = columns_of(table.place.flywheel[k])
        names = _STEADY_SPIN if steady else _SPIN
        _add_row(body, given, row, _sums_of(lib, sums.place), names, _USED[names])
    return body.function(
        "sum_steady_spin" if steady else "sum_spin",
        "Rate of the first moment, and terms of the flywheels' turning in momentum and forces; w = phi'"
        + (" is constant." if steady else ", a = phi''."),
        (table, *turns, phi_dot, *phi_ddot, sums),
        equation="(2), (5)",
    )


def add_block(lib: Library) -> Function:
    """The rows of a block, one a lane."""
    block = Argument("block", lib.layout.block)
    first = lanes.first_argument()
    inputs = [
        lanes.room_argument(lib, "sine", "of the phases"),
        lanes.room_argument(lib, "cosine"),
        lanes.room_argument(lib, "phi_dot", unit="rad/s"),
        lanes.room_argument(lib, "phi_ddot", unit="rad/s2"),
    ]
    sums = Argument("lane", lib.layout.lane_sums, (), "inout")
    body = Body()
    with body.loop("k", lib.layout.lane_count) as k:
        names = ("s", "c", "w", "a")
        s, c, w, a = (body.let(n, x.place[first.place + k]) for n, x in zip(names, inputs, strict=True))
        targets = {f.name: lanes.lane(sums.place.member(f.name), k) for f in lib.layout.sums.fields}
        given: dict[str, Expr] = {"s": s, "c": c, "phi_dot": w, "phi_ddot": a}
        _add_row(body, given, lanes.lane_columns(block.place, k, COLUMNS), targets, _ALL, tuple(_COMMENTS))
    return body.function(
        "add_block",
        "Adds the terms of a block of flywheels, each to the sums of its lane; w = phi', a = phi''.",
        (block, first, *inputs, sums),
        equation="(2), (5), (6)",
    )


def sum_up(
    lib: Library,
    body: Body,
    table: Place,
    x: Place,
    turns: Turns,
    sums: Place,
    phi_ddot: Place | None,
    mass_alone: bool = False,
) -> None:
    """Sums over all bodies; without phi_ddot those of constant speeds. `mass_alone`: what K and K_dot need."""
    layout = lib.layout
    if not layout.flywheels:
        body.call(lib["start_sums"], table, sums)
        return
    if layout.lanes == 1:
        body.call(lib["sum_mass"], table, *turns, x.phi_dot, sums)
        if mass_alone:
            body.call(lib["sum_moment_rate"], table, *turns, x.phi_dot, sums)
        elif phi_ddot is None:
            body.call(lib["sum_steady_spin"], table, *turns, x.phi_dot, sums)
        else:
            body.call(lib["sum_spin"], table, *turns, x.phi_dot, phi_ddot, sums)
        return
    speeds = lanes.roomy(lib, body, x.phi_dot, "speeds")
    if phi_ddot is None:
        accelerations = body.local("accelerations", (layout.room,), comment="none")
        with body.loop("s", layout.room) as s:
            body.set(accelerations[s], real(0))
    else:
        accelerations = lanes.roomy(lib, body, phi_ddot, "accelerations")
    parts = body.local("lane", (), layout.lane_sums, "sums over the flywheels, lane by lane")
    body.call(lib["clear_lanes"], parts)
    with lanes.blocks(lib, body) as (b, first):
        body.call(lib["add_block"], table.block[b], first, *turns, speeds, accelerations, parts)
    body.call(lib["add_lanes"], table, parts, sums)
