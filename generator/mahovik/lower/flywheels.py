"""What the flywheels add at their phases: the one loop over rows that all functions share."""

from __future__ import annotations

from collections.abc import Sequence

from mahovik.formula.derived import accumulate as derived
from mahovik.lower.library import Library
from mahovik.lower.symbolic import add_each, assign, translate
from mahovik.program.build import Body
from mahovik.program.expression import Expr, Place, real
from mahovik.program.function import Argument, Function
from mahovik.program.types import Kind

_COMMENTS = {
    "c2": "of the double phase",
    "s2": "",
    "dc": "rates: d(cos phi)/dt",
    "ds": "",
    "dc2": "",
    "ds2": "",
    "ddc": "second rates",
    "dds": "",
}


def let_weights(body: Body, given: dict[str, Expr], names: Sequence[str]) -> dict[str, Expr]:
    """Named temporaries c2 ... dds from c, s, phi_dot, phi_ddot in `given`; returns `given` and them."""
    expressions = derived.weights()
    bound = dict(given)
    for name in names:
        bound[name] = body.let(name, translate(expressions[name], bound), _COMMENTS[name])
    return bound


def sine_and_cosine(lib: Library, body: Body, phase: Expr, suffix: str = "") -> dict[str, Expr]:
    """Local s, c (with a suffix) of a phase."""
    s = body.local(f"s{suffix}")
    c = body.local(f"c{suffix}")
    body.call(lib["sincos"], phase, s, c)
    return {"s": s, "c": c}


Turns = tuple[Place, ...]
"""Sines and cosines of all phases, two arrays; empty where a function takes them of the phases of the state."""


def places_of(arguments: Sequence[Argument]) -> Turns:
    """The places of arguments."""
    return tuple(a.place for a in arguments)


def turns_of(lib: Library, body: Body, x: Place) -> Turns:
    """Sines and cosines of the phases of a state as locals, where internal functions take them."""
    if not lib.layout.sine_input:
        return ()
    sine = body.local("sine", (lib.layout.count,))
    cosine = body.local("cosine", (lib.layout.count,))
    with body.loop("s", lib.layout.count) as s:
        turn = sine_and_cosine(lib, body, x.phi[s], "_phi")
        body.set(sine[s], turn["s"])
        body.set(cosine[s], turn["c"])
    return sine, cosine


def turn_of(lib: Library, body: Body, x: Place, s: Place, turns: Turns, suffix: str = "_phi") -> dict[str, Expr]:
    """s, c of flywheel s: as given, or locals (with a suffix) computed of its phase."""
    if turns:
        sine, cosine = turns
        return {"s": sine[s], "c": cosine[s]}
    return sine_and_cosine(lib, body, x.phi[s], suffix)


def named_turns(turns: Turns) -> dict[str, Place]:
    """Sines and cosines by the names of the arguments that take them."""
    return dict(zip(("sine", "cosine"), turns, strict=True)) if turns else {}


AT_NOTES = ("Of given sines and cosines, used as they are: the phases of x are checked, but not used.",)
"""What the functions say that take sines and cosines."""


def columns_of(row: Place) -> dict[str, Place]:
    """The columns of a row by the names that the derivation uses."""
    names = ("mu_c", "mu_s", "J_c", "J_s", "J_2c", "J_2s", "t_0", "t_c", "t_s")
    return {name: row.member(name) for name in names}


def start_sums(lib: Library) -> Function:
    """The sums without flywheels' harmonics: constants of the table."""
    stand = lib.table_argument()
    sums = Argument("sum", lib.layout.sums, (), "out")
    body = Body()
    body.copy_array(sums.place.mu, stand.place.first_moment)
    body.copy_array(sums.place.J, stand.place.inertia)
    for name in ("mu_dot", "J_dot", "h_rel", "a_rel", "g_rel"):
        for element in sums.place.member(name):
            body.set(element, real(0))
    return Function(
        "start_sums",
        "Sums of carrier, instruments and the constant part of the flywheels.",
        (stand, sums),
        body.statements,
        equation="(2)",
    )


def add_flywheel(lib: Library) -> Function:
    """One row at its phase."""
    row = Argument("row", lib.layout.row)
    sine = Argument("s", Kind.REAL, purpose="sin phi")
    cosine = Argument("c", Kind.REAL, purpose="cos phi")
    phi_dot = Argument("phi_dot", Kind.REAL, unit="rad/s")
    phi_ddot = Argument("phi_ddot", Kind.REAL, unit="rad/s2")
    sums = Argument("sum", lib.layout.sums, (), "inout")
    body = Body()
    given: dict[str, Expr] = {"s": sine.place, "c": cosine.place}
    given |= {"phi_dot": phi_dot.place, "phi_ddot": phi_ddot.place}
    weights = let_weights(body, given, tuple(_COMMENTS))
    binding = weights | columns_of(row.place)
    parts = derived.sums()
    notes = {
        "mu": "first moment and its rate",
        "J": "inertia and its rate: K_dot of (6)",
        "h_rel": "moment part of I phi' (its force part is mu_dot)",
        "a_rel": "I phi'' + Ls [<e>] Theta f phi'^2, the last two sums of (5)",
    }
    for name in ("mu", "mu_dot", "J", "h_rel", "a_rel", "g_rel"):
        if name in notes:
            body.note(notes[name])
        if name == "J":  # a loop: a third of the code, and compilers see what to do side by side
            add_each(body, {sums.place.J: parts.J, sums.place.J_dot: parts.J_dot}, binding)
            continue
        assign(body, list(sums.place.member(name)), getattr(parts, name), binding, add=True)
    return Function(
        "add_flywheel",
        "Adds what one flywheel's row gives at its phase to the sums.",
        (row, sine, cosine, phi_dot, phi_ddot, sums),
        body.statements,
        equation="(2), (5), (6)",
    )
