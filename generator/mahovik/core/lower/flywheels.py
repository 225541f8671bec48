"""Terms of the flywheels at their phases: the one loop over rows that all functions share."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from mahovik.core.formula.derived import accumulate as derived
from mahovik.core.formula.derived import omitting
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
    sine = body.local("sine", (lib.layout.count,))
    cosine = body.local("cosine", (lib.layout.count,))
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
    _start(body, table.place, sums.place, ("mu", "J", "mu_dot", "J_dot", *_SPIN))
    return body.function(
        "start_sums",
        "Sums of carrier, instruments and the constant part of the flywheels.",
        (table, sums),
        equation="(2)",
    )


_NOTES = {
    "mu": "first moment and its rate",
    "J": "inertia",
    "J_dot": "its rate: K_dot of (6)",
    "h_rel": "moment part of I phi' (its force part is mu_dot)",
    "a_rel": "I phi'' + Ls [<e>] Theta f phi'^2, the last two sums of (5)",
}

_MASS = ("J", "J_dot", "mu", "mu_dot")
"""Sums that K and its rate consist of. A compiler can keep their number in registers over a loop, not that of all."""
_SPIN = ("h_rel", "g_rel", "a_rel")
"""The other sums, of the flywheels alone."""
_STEADY_SPIN = ("a_rel", "h_rel", "g_rel")
"""The sums of the flywheels alone at constant speeds, in the order in which compilers need the fewest instructions."""
_ALL = ("mu", "mu_dot", "J", "J_dot", "h_rel", "a_rel", "g_rel")
_INERTIA = ("J", "J_dot", "mu")
"""_MASS but for mu_dot, which goes with the other sums where states are side by side: so both loops keep their sums in
vector registers, and the second one is too long for gcc's unroll-and-jam, which halves its vectors. Small processors
need fewer instructions with the loops as they are."""
APART = {
    ("sum_mass", "sum_spin"): ("sum_inertia", "sum_turning"),
    ("sum_mass", "sum_steady_spin"): ("sum_inertia", "sum_steady_turning"),
}
"""Calls that follow one another, and those with the same arguments and results for states side by side."""
_USED = {_MASS: ("c2", "s2", "dc", "ds", "dc2", "ds2"), _SPIN: ("dc", "ds", "ddc", "dds")}
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


def sum_mass(lib: Library, apart: bool = False) -> Function:
    """First moment and inertia of all bodies, and their rates: row by row, in a loop of its own.

    `apart`: sum_inertia, without the rate of the first moment.
    """
    names = _INERTIA if apart else _MASS
    table, turns = lib.table_argument(), lib.turn_arguments()
    phi_dot = Argument("phi_dot", Kind.REAL, (lib.layout.count,), unit="rad/s")
    sums = Argument("sum", lib.layout.sums, (), "inout")
    body = Body()
    _start(body, table.place, sums.place, names)
    # In float J goes in a loop: a third of the code, which small processors lack; desktop ones are slower with it.
    short = sums.place if lib.layout.precision is FLOAT else None
    with body.loop("k", lib.layout.count) as k:
        given: dict[str, Expr] = dict(let_turn(body, places_of(turns), k, ""))
        given["phi_dot"] = body.let("w", phi_dot.place[k])
        row = columns_of(table.place.flywheel[k])
        _add_row(body, given, row, _sums_of(lib, sums.place), names, _USED[_MASS], short)
    return body.function(
        "sum_inertia" if apart else "sum_mass",
        "Inertia of all bodies and its rate in E1, and their first moment; w = phi'."
        if apart
        else "First moment and inertia of all bodies, and their rates in E1; w = phi'.",
        (table, *turns, phi_dot, sums),
        equation="(2), (6)",
    )


def sum_spin(lib: Library, steady: bool = False, apart: bool = False) -> Function:
    """Terms of the flywheels' turning; `steady`: sum_steady_spin, at constant speeds.

    `apart`: sum_turning, sum_steady_turning, with the rate of the first moment.
    """
    names = (*(("mu_dot",) if apart else ()), *(_STEADY_SPIN if steady else _SPIN))
    table, turns = lib.table_argument(), lib.turn_arguments()
    phi_dot = Argument("phi_dot", Kind.REAL, (lib.layout.count,), unit="rad/s")
    phi_ddot = () if steady else (Argument("phi_ddot", Kind.REAL, (lib.layout.count,), unit="rad/s2"),)
    sums = Argument("sum", lib.layout.sums, (), "inout")
    body = Body()
    _start(body, table.place, sums.place, names if apart else _SPIN)
    with body.loop("k", lib.layout.count) as k:
        given: dict[str, Expr] = dict(let_turn(body, places_of(turns), k, ""))
        given["phi_dot"] = body.let("w", phi_dot.place[k])
        for acceleration in phi_ddot:
            given["phi_ddot"] = body.let("a", acceleration.place[k])
        row = columns_of(table.place.flywheel[k])
        _add_row(body, given, row, _sums_of(lib, sums.place), names, _USED[_SPIN])
    function = body.function(
        f"sum_{'steady_' if steady else ''}{'turning' if apart else 'spin'}",
        ("Rate of the first moment, and terms" if apart else "Terms")
        + " of the flywheels' turning in momentum and forces; w = phi'"
        + (" is constant." if steady else ", a = phi''."),
        (table, *turns, phi_dot, *phi_ddot, sums),
        equation="(2), (5)",
    )
    return replace(function, copied=not apart)


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
    body.call(lib["sum_mass"], table, *turns, x.phi_dot, sums)
    if mass_alone:
        return
    if phi_ddot is None:
        body.call(lib["sum_steady_spin"], table, *turns, x.phi_dot, sums)
    else:
        body.call(lib["sum_spin"], table, *turns, x.phi_dot, phi_ddot, sums)
